// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The thesis' worlds in scenes/, run as `demo --simulated-time` runs them: the forces equal springs
// in series and a friction cone.
#include <gmock/gmock.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>
#include <vector>

#include "reckon/tests/support/places.hpp"
#include "reckon/tests/tools/support/captured_console.hpp"
#include "reckon/tools/exercise/exercise.hpp"

namespace reckon::tools {
namespace {

using namespace std::chrono_literals;
using Eigen::Vector3d;
using ::testing::HasSubstr;
using ::testing::Not;

std::string path_of(const std::string& name) {
  return reckon::test::source_dir() + "/scenes/" + name + ".toml";
}

/// The force of a hand in one step.
struct Felt {
  Vector3d device, scp, force;
};

/// Each step of each peer over one and a half sweeps.
std::vector<std::vector<Felt>> run_scene(const std::string& name, std::size_t peers) {
  ExerciseOptions options;
  options.peers = peers;
  options.simulated_time = true;
  options.epoch = 1;
  Exercise exercise(peer::load_scene_file(path_of(name)), options);
  std::vector<std::vector<Felt>> felt(peers);
  exercise.on_step([&](std::size_t peer, std::size_t, const haptics::ServoSnapshot& step) {
    felt[peer].push_back({step.device, step.scp, step.force});
  });
  exercise.run(12s);
  EXPECT_EQ(exercise.measurement().trips(), 0U) << name;
  EXPECT_GE(exercise.measurement().energy_min(), -1e-9) << name;
  return felt;
}

double largest(const std::vector<Felt>& steps) {
  double most = 0;
  for (const Felt& step : steps) most = std::max(most, step.force.norm());
  return most;
}

// Grip and wall are springs in series; for the second device also its sensor and motors.
TEST(ThesisScenes, DevicesOfBothKindsFeelOneWallAlike) {
  const auto felt = run_scene("admittance", 2);
  const double takes_force = largest(felt[0]), moves = largest(felt[1]);
  EXPECT_NEAR(takes_force, 0.01 / (1 / 300.0 + 1 / 1200.0), 0.02);
  // Apart from the swing of its mass, which came to the wall at 20 mm/s.
  EXPECT_NEAR(moves, 0.01 / (1 / 300.0 + 1 / 1200.0 + 1 / 20e3 + 1 / 177.7e3), 0.03);
}

TEST(ThesisScenes, AreGoodWithinTheirDevicesLimits) {
  for (const char* name : {"stiff_wall", "slip", "one_user_push", "two_user_push", "admittance"}) {
    const auto result = test::run_reckon({"scene", "check", path_of(name)});
    EXPECT_EQ(result.status, 0) << result.out;
    EXPECT_THAT(result.out, HasSubstr("good"));
    EXPECT_THAT(result.out, Not(HasSubstr("note:"))) << result.out;
  }
}

// At the turn of the sweep everything rests: grip and wall in series.
TEST(ThesisScenes, StiffWallIsASpringInSeries) {
  const auto steps = run_scene("stiff_wall", 1).at(0);
  constexpr double kSeries = 1 / (1 / 300.0 + 1 / 1200.0);
  EXPECT_NEAR(largest(steps), 0.02 * kSeries, 0.01);
  for (const Felt& step : steps) {
    // The wall never pulls, and is exact in every step.
    ASSERT_NEAR(step.force.z(), 1200 * std::max(0.0, -step.device.z()), 2e-3);
    ASSERT_GE(step.scp.z(), -1e-9);
  }
}

TEST(ThesisScenes, SlipUsesTheKineticAndStaticCoefficients) {
  const auto steps = run_scene("slip", 1).at(0);
  double last_stuck = 0, most_stuck = 0;
  std::size_t sliding = 0, stuck = 0, broke_loose = 0;
  bool was_stuck = false;
  for (std::size_t i = 1; i < steps.size(); ++i) {
    const Vector3d& force = steps[i].force;
    if (force.z() < 0.1) continue;
    const double ratio = force.head<2>().norm() / force.z();
    const bool slides = (steps[i].scp - steps[i - 1].scp).head<2>().norm() > 1e-9;
    if (slides) {
      EXPECT_NEAR(ratio, 0.4, 1e-3);
      broke_loose += was_stuck ? 1 : 0;
      if (was_stuck) last_stuck = most_stuck;
      ++sliding;
    } else {
      EXPECT_LE(ratio, 0.6 + 1e-6);
      most_stuck = ratio;
      ++stuck;
    }
    was_stuck = !slides;
  }
  EXPECT_GT(sliding, 3000U);
  EXPECT_GT(stuck, 500U) << "where the hand turns";
  EXPECT_GE(broke_loose, 1U);
  EXPECT_NEAR(last_stuck, 0.6, 0.01) << "what it pulled in the last step before it slid";
}

TEST(ThesisScenes, OneUserFeelsTwoSpringsInSeries) {
  const auto felt = run_scene("one_user_push", 2);
  EXPECT_TRUE(felt.at(0).empty()) << "nobody is at peer 1";
  constexpr double kSeries = 1 / (1 / 300.0 + 1 / 400.0);
  EXPECT_NEAR(largest(felt.at(1)), 0.02 * kSeries, 0.02);
  for (const Felt& step : felt.at(1)) {
    // The ball of 30 mm and the hand of 10 mm, once the peers know each other.
    ASSERT_NEAR(-step.force.x(), 400 * std::max(0.0, 0.04 + step.device.x()), 0.02);
  }
}

TEST(ThesisScenes, TwoUsersFeelThreeSpringsInSeries) {
  const auto felt = run_scene("two_user_push", 2);
  constexpr double kSeries = 1 / (2 / 300.0 + 1 / 400.0);
  for (const auto& steps : felt) EXPECT_NEAR(largest(steps), 0.02 * kSeries, 0.03);
  // Action and reaction, within the threshold of 20 mN and the network delay.
  ASSERT_EQ(felt[0].size(), felt[1].size());
  double apart = 0, off = 0;
  for (std::size_t i = 0; i < felt[0].size(); ++i) {
    const double overlap = 0.04 - (felt[0][i].device - felt[1][i].device).norm();
    apart = std::max(apart, (felt[0][i].force + felt[1][i].force).norm());
    off = std::max(off, std::abs(felt[1][i].force.x() - 400 * std::max(0.0, overlap)));
  }
  EXPECT_LT(apart, 0.06);
  EXPECT_LT(off, 0.05);
}

}  // namespace
}  // namespace reckon::tools
