// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Beacons in a scene file: their carriers and followers.
#include "reckon/peer/notation/beacon_names.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "reckon/peer/loops/aoim_setup.hpp"
#include "reckon/peer/scene/scene_file.hpp"
#include "reckon/tests/src/support/refusal.hpp"

namespace reckon::peer {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

const std::string kHandsOut = "[aoim]\nleaders = true\nhand_out = true\n";

TEST(BeaconNames, AreReadFromAList) {
  EXPECT_TRUE(beacon_names("").empty());
  EXPECT_THAT(beacon_names("gate"), ElementsAre("gate"));
  EXPECT_THAT(beacon_names("gate, ferry-2,a.b_c"), ElementsAre("gate", "ferry-2", "a.b_c"));
  EXPECT_TRUE(is_beacon_name(std::string(kLongestBeacon, 'x')));
  EXPECT_FALSE(is_beacon_name(std::string(kLongestBeacon + 1, 'x')));
  for (const char* list :
       {"gate,", ",gate", "a b", "gate, gate", "tor\"", " ", "gr\xC3\xBC\xC3\x9F"})
    EXPECT_THROW((void)beacon_names(list), std::invalid_argument) << list;
  std::string many = "b0";
  for (std::size_t i = 1; i <= kMostFollowed; ++i) many += ",b" + std::to_string(i);
  EXPECT_THROW((void)beacon_names(many), std::invalid_argument);
}

TEST(BeaconNames, CoverEntitiesAndFollowedBeacons) {
  const SceneFile file =
      parse_scene_file(kHandsOut + "follow = \"gate\"\n[[entity]]\nbeacon = \"gate\"\n", "x.toml");
  EXPECT_EQ(file.entities[0].beacon, "gate");
  EXPECT_THAT(aoim_config(file).follow, ElementsAre(aoim::beacon_tag("gate")));
  EXPECT_EQ(file.hash, parse_scene_file(kHandsOut, "x.toml").hash) << "each peer's own";
  EXPECT_TRUE(aoim_config(parse_scene_file(kHandsOut, "x.toml")).follow.empty());
}

TEST(BeaconNames, AreRefusedWhereTheyCannotBeMeant) {
  EXPECT_THAT(test::refusal("[aoim]\nleaders = true\nfollow = \"gate\"\n"),
              HasSubstr("x.toml:3:10: 'follow' needs a map of groups: set "
                        "'hand_out' too"));
  EXPECT_THAT(test::refusal("[[entity]]\nbeacon = \"gate\"\n"),
              HasSubstr("x.toml:2:10: 'beacon' needs assigned groups"));
  EXPECT_THAT(test::refusal(kHandsOut + "follow = \"the gate\"\n"),
              HasSubstr("'follow': \"the gate\" is not a beacon name"));
  EXPECT_THAT(test::refusal(kHandsOut + "[[entity]]\nbeacon = \"\"\n"),
              HasSubstr("'beacon' is \"\"; use 1 to 31 letters"));
  EXPECT_THAT(
      test::refusal(kHandsOut + "[[entity]]\nbeacon = \"gate\"\n[[entity]]\nbeacon = \"gate\"\n"),
      HasSubstr("there is another beacon 'gate'"));
}

}  // namespace
}  // namespace reckon::peer
