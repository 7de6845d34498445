// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The example scenes in the guide to areas of interest are valid.
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>

#include "reckon/peer/scene/scene_file.hpp"
#include "reckon/tests/support/places.hpp"

namespace reckon::peer {
namespace {

TEST(GuideScenes, AreAllAccepted) {
  std::ifstream file(test::source_dir() + "/docs/area_of_interest.md");
  const std::string page{std::istreambuf_iterator<char>(file), {}};
  constexpr std::string_view kBegin = "```toml\n", kEnd = "```";
  int scenes = 0;
  for (std::size_t at = page.find(kBegin); at != page.npos; at = page.find(kBegin, at)) {
    at += kBegin.size();
    const std::string scene = page.substr(at, page.find(kEnd, at) - at);
    EXPECT_NO_THROW(static_cast<void>(parse_scene_file(scene, "guide"))) << scene;
    ++scenes;
  }
  EXPECT_GE(scenes, 5);
}

}  // namespace
}  // namespace reckon::peer
