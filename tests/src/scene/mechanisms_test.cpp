// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/scene/mechanisms.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "reckon/peer/scene/scene_keys.hpp"
#include "reckon/tests/src/support/refusal.hpp"

namespace reckon::peer {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST(Mechanisms, AreSwitchedOnByKeysThatExist) {
  for (const Mechanism& one : mechanisms()) {
    const auto keys = scene_keys();
    const bool found = std::ranges::any_of(
        keys, [&](const SceneKey& key) { return key.section == one.table && key.key == one.key; });
    EXPECT_TRUE(found) << one.table << '.' << one.key;
  }
}

TEST(Mechanisms, AreReportedAtTheirKeyWithTheRemedy) {
  EXPECT_THAT(
      test::refusal("[network]\ninterop = true\n[aoim]\nradius = \"50 m\"\nleaders = true\n"),
      HasSubstr("x.toml:5:11: 'leaders' needs datagrams that plain DIS does not know, which "
                "'interop' excludes: take one of the two out"));
  EXPECT_THAT(
      test::refusal("[aoim]\nhand_out = true\n"),
      HasSubstr("x.toml:2:12: 'hand_out' needs leaders of cells: set 'leaders' too, or take "
                "'hand_out' out"));
}

// Each pair that cannot be had together, and one of each kind that can.
TEST(Mechanisms, ExcludeOneAnotherWhereOneTakesWhatTheOtherNeeds) {
  const std::string leaders = "leaders = true\n", hand_out = leaders + "hand_out = true\n";
  const std::vector<std::pair<std::string, std::string>> refused{
      {leaders, "[network]\ninterop = true\n"},
      {leaders, "[network]\ncompression = \"delta\"\n"},
      {leaders + "channels = true\n", ""},
      {hand_out + "contact_groups = true\n", ""},
      {"follow = \"gate\"\n", ""},
      {"", "[network]\ninterop = true\ncompression = \"delta\"\n"},
      {"contact_groups = true\n", "[network]\ninterop = true\n"},
      {"near_groups = true\n", ""},
      {"channels = true\nnear_groups = true\n", "[network]\ncompression = \"residual\"\n"},
      {"channels = true\nnear_groups = true\n", "[network]\ninterop = true\n"}};
  for (const auto& [aoim, network] : refused)
    EXPECT_THAT(test::refusal("[aoim]\n" + aoim + network), HasSubstr("needs")) << aoim << network;
  for (const auto& [aoim, network] : std::vector<std::pair<std::string, std::string>>{
           {hand_out + "follow = \"gate\"\n", ""},
           {leaders + "contact_groups = true\n", ""},
           {"channels = true\nnear_groups = true\n", "[network]\ncompression = \"delta\"\n"},
           {"channels = true\n", "[network]\ncompression = \"residual\"\n"}})
    EXPECT_THAT(test::refusal("[aoim]\n" + aoim + network), IsEmpty()) << aoim << network;
}

}  // namespace
}  // namespace reckon::peer
