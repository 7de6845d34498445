// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/settings/mechanisms.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "reckon/peer/scene/scene_keys.hpp"
#include "reckon/tests/src/support/refusal.hpp"
#include "reckon/tests/support/tier_rows.hpp"

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
      HasSubstr("x.toml:5:11: 'leaders' needs experimental PDUs, which 'interop' excludes: remove "
                "one of the two"));
  EXPECT_THAT(
      test::refusal("[aoim]\nhand_out = true\n"),
      HasSubstr("x.toml:2:12: 'hand_out' needs leaders of cells: set 'leaders' too, or "
                "remove 'hand_out'"));
}

TEST(Mechanisms, TiersAreReportedAtTheirRow) {
  const std::string tiers =
      "[[aoim.tier]]\nto = \"touch\"\n"
      "[[aoim.tier]]\nfarthest = 9\nactive = 9\noctets = 144\nown_group = true\n"
      "[[aoim.tier]]\nactive = 9\noctets = 144\n";
  EXPECT_THAT(test::refusal("[aoim]\nleaders = true\nhand_out = true\n" + tiers),
              HasSubstr("x.toml:4:1: 'tier' with to = \"touch\" needs fixed groups for each cell, "
                        "which 'hand_out' excludes: remove one of the two\n"
                        "x.toml:6:1: 'tier' with own_group = true needs fixed groups"));
  EXPECT_THAT(test::refusal("[aoim]\nleaders = true\n" + tiers),
              HasSubstr("'leaders' needs complete Entity States, which 'tier' "
                        "with to = \"distance\" excludes"));
  EXPECT_THAT(test::refusal(tiers + "[network]\ncompression = \"residual\"\n"),
              HasSubstr("which 'tier' with own_group = true excludes"));
}

// Each pair that excludes each other, and one pair of each kind that does not.
TEST(Mechanisms, ExcludeEachOtherWhereNeedsConflict) {
  const std::string leaders = "leaders = true\n", hand_out = leaders + "hand_out = true\n";
  const std::vector<std::pair<std::string, std::string>> refused{
      {leaders, "[network]\ninterop = true\n"},
      {leaders, "[network]\ncompression = \"compact\"\n"},
      {leaders + test::kDistanceTiers, ""},
      {hand_out + test::kTouchTier, ""},
      {"follow = \"gate\"\n", ""},
      {"", "[network]\ninterop = true\ncompression = \"compact\"\n"},
      {test::kTouchTier, "[network]\ninterop = true\n"},
      {test::kOwnTiers, "[network]\ncompression = \"residual\"\n"},
      {test::kOwnTiers, "[network]\ninterop = true\n"}};
  for (const auto& [aoim, network] : refused)
    EXPECT_THAT(test::refusal("[aoim]\n" + aoim + network), HasSubstr("needs")) << aoim << network;
  for (const auto& [aoim, network] : std::vector<std::pair<std::string, std::string>>{
           {hand_out + "follow = \"gate\"\n", ""},
           {leaders + test::kTouchTier, ""},
           {test::kOwnTiers, "[network]\ncompression = \"compact\"\n"},
           {test::kDistanceTiers, "[network]\ncompression = \"residual\"\n"}})
    EXPECT_THAT(test::refusal("[aoim]\n" + aoim + network), IsEmpty()) << aoim << network;
}

}  // namespace
}  // namespace reckon::peer
