// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// [coupling] of a scene file: which study it is for, and who refuses it.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "reckon/haptics/devices/simulated_device.hpp"
#include "reckon/peer/clocks/clock.hpp"
#include "reckon/peer/network/simulated_network.hpp"
#include "reckon/peer/peer.hpp"
#include "reckon/peer/scene/scene_file.hpp"

namespace reckon::peer {
namespace {

using peer::CouplingMode;
using testing::HasSubstr;

SceneFile scene_with(std::string_view mode) {
  return parse_scene_file(fmt::format("[coupling]\nmode = \"{}\"\n", mode), "x.toml");
}

TEST(CouplingSection, TakesEveryModeAndIsOursWhereItSaysNothing) {
  EXPECT_EQ(parse_scene_file("", "x.toml").coupling.mode, CouplingMode::reckon);
  for (const CouplingMode mode : peer::kCouplingModes)
    EXPECT_EQ(scene_with(peer::name_of(mode)).coupling.mode, mode);
}

TEST(CouplingSection, RefusesAWordThatIsNoMode) {
  try {
    (void)scene_with("effort_flaw");
    FAIL();
  } catch (const SceneFileError& error) {
    EXPECT_THAT(error.what(), HasSubstr("x.toml:2:8: 'mode' is \"effort_flaw\""));
    EXPECT_THAT(error.what(), HasSubstr("(did you mean \"effort_flow\"?)"));
  }
}

// How a study couples hands is no part of the world that peers share.
TEST(CouplingSection, DoesNotChangeTheHash) {
  EXPECT_EQ(scene_with("gain_cut").hash, parse_scene_file("", "x.toml").hash);
}

TEST(CouplingSection, EveryBaselineIsRefusedByAPeer) {
  for (const CouplingMode mode : peer::kCouplingModes) {
    const SceneFile scene = scene_with(peer::name_of(mode));
    const ManualClock clock;
    SimulatedNetwork network({}, clock);
    Link& link = network.link(0);
    haptics::SimulatedDevice device({});
    if (mode == CouplingMode::reckon) {
      EXPECT_NO_THROW(Peer(scene, PeerOptions{}, link, device));
      continue;
    }
    try {
      const Peer peer(scene, PeerOptions{}, link, device);
      FAIL() << peer::name_of(mode);
    } catch (const SceneFileError& error) {
      EXPECT_THAT(error.what(), HasSubstr("is a baseline for studies of simulated devices"));
      EXPECT_THAT(error.what(), HasSubstr("take the key out"));
    }
  }
}

}  // namespace
}  // namespace reckon::peer
