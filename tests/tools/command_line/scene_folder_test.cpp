// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/command_line/scene_folder.hpp"

#include <gtest/gtest.h>

#include <array>
#include <filesystem>

namespace reckon::tools {
namespace {

// The docs name scenes/two_hands.toml, but a user of the packages has no such folder.
TEST(SceneFolder, ScenesOfTheDocsResolveToShippedFiles) {
  ASSERT_FALSE(std::filesystem::exists("scenes")) << "the test is run in the build folder";
  const std::array<std::string_view, 5> typed{"check", "scenes/two_hands.toml", "scenes/none.toml",
                                              "two_hands.toml", "--mesh"};
  const std::vector<std::string> words = with_shipped_scenes(typed);
  ASSERT_EQ(words.size(), typed.size());
  EXPECT_TRUE(std::filesystem::path(words[1]).is_absolute()) << words[1];
  EXPECT_TRUE(std::filesystem::exists(words[1])) << words[1];
  for (const std::size_t i : {0U, 2U, 3U, 4U}) EXPECT_EQ(words[i], typed[i]);
}

TEST(SceneFolder, AFolderOfTheUsersOwnGoesFirst) {
  const auto before = std::filesystem::current_path();
  const auto own = std::filesystem::temp_directory_path() / "reckon_scene_folder_test";
  std::filesystem::create_directories(own / "scenes");
  std::filesystem::current_path(own);
  const std::vector<std::string> words =
      with_shipped_scenes(std::array<std::string_view, 1>{"scenes/two_hands.toml"});
  std::filesystem::current_path(before);
  std::filesystem::remove_all(own);
  EXPECT_EQ(words[0], "scenes/two_hands.toml");
}

}  // namespace
}  // namespace reckon::tools
