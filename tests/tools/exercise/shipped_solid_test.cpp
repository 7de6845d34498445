// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// scenes/bracket.toml in simulated time: each hand feels its implicit surface as springs in series.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>

#include "reckon/haptics/servo/servo_loop.hpp"
#include "reckon/peer/scene/belongings.hpp"
#include "reckon/tests/support/places.hpp"
#include "reckon/tools/exercise/simulated_hand.hpp"

namespace reckon::tools {
namespace {

using namespace std::chrono_literals;

// The hand's target moves up and down along z in a sine; the surface is at `top` with `stiffness`.
// It is slow: inertia, damping and the servo's sample are within the tolerance.
void expect_springs(std::uint32_t number, double high, double low, double top, double stiffness) {
  const peer::SceneFile file =
      peer::load_scene_file(reckon::test::source_dir() + "/scenes/bracket.toml");
  const auto config = peer::devices_of(file, number).at(0);
  const auto device = make_simulated_device(file, config);
  haptics::ServoLoop servo(*device, haptics::EffectPlan(file.scene), {});
  const double grip = file.operators.at(number - 1).stiffness;
  double most = 0.0;
  double least_energy = 0.0;
  int touching = 0;
  for (auto now = 0ms; now < 8s; now += 1ms) {
    servo.step(now);
    servo.snapshots().update();
    const haptics::ServoSnapshot& felt = servo.snapshots().read();
    least_energy = std::min(least_energy, felt.port_energy_min);
    most = std::max(most, felt.force.z());
    if (!felt.in_mesh_contact) continue;
    ++touching;
    ASSERT_NEAR(felt.scp.z(), top, 1e-6) << "at " << now.count() << " ms";
    ASSERT_LT(felt.force.head<2>().norm(), 1e-3);
  }
  EXPECT_GT(touching, 1000);
  EXPECT_NEAR(most, (top - low) / (1.0 / grip + 1.0 / stiffness), 0.02 * most) << "of " << high;
  EXPECT_GE(least_energy, -1e-9);
}

TEST(ShippedSolid, BracketsPostIsFeltAsSpringsInSeries) {
  expect_springs(1, 0.09, 0.06, 0.065, 400.0);
}

TEST(ShippedSolid, RingIsFeltAsSpringsInSeries) { expect_springs(2, 0.04, 0.005, 0.01, 400.0); }

}  // namespace
}  // namespace reckon::tools
