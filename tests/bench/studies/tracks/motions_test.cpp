// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The motions of the studies: their rates match their positions, by central differences.
#include "reckon/bench/studies/tracks/motions.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "reckon/deadreckon/motion/rotation.hpp"

namespace reckon::bench::motions_test {
namespace {

using deadreckon::MotionSample;
using Eigen::Vector3d;

constexpr double kStep = 1 / kMotionRate;

const Motion& motion(std::string_view name) {
  return *std::find_if(motions().begin(), motions().end(),
                       [&](const Motion& row) { return row.name == name; });
}

/// Three consecutive samples and the tolerance of a rate between them.
struct Three {
  const MotionSample &before, &now, &after;

  /// Sum of the changes of a rate: bounds its variation between the samples, including a kink.
  [[nodiscard]] double change(Vector3d MotionSample::*rate) const {
    return (after.*rate - now.*rate).norm() + (now.*rate - before.*rate).norm();
  }
};

class EveryMotion : public testing::TestWithParam<Motion> {
 protected:
  /// Calls check for all neighbours of one continuous path.
  template <typename Check>
  static void for_each(const Track& track, Check&& check) {
    for (std::size_t i = 1; i + 1 < track.samples.size(); ++i) {
      const Three three{track.samples[i - 1], track.samples[i], track.samples[i + 1]};
      const bool jumps = (three.after.position - three.now.position).norm() > 10 ||
                         (three.now.position - three.before.position).norm() > 10;
      if (!jumps) check(three);
      if (testing::Test::HasFailure()) return;
    }
  }
};

TEST_P(EveryMotion, HasFiniteSamplesAtDisplayRate) {
  const Track track = GetParam().generate(10, 1);
  ASSERT_EQ(track.samples.size(), 601U);
  for (std::size_t i = 0; i < track.samples.size(); ++i) {
    EXPECT_DOUBLE_EQ(track.samples[i].time, static_cast<double>(i) / 60);
    EXPECT_TRUE(is_finite(track.samples[i]));
    EXPECT_NEAR(track.samples[i].orientation.norm(), 1, 1e-12);
  }
}

TEST_P(EveryMotion, HasTheVelocityOfItsPositions) {
  if (GetParam().name == "hover") return;  // its rates are noise
  for_each(GetParam().generate(60, 1), [](const Three& t) {
    const Vector3d seen = (t.after.position - t.before.position) / (2 * kStep);
    const double bound = kStep * t.change(&MotionSample::acceleration) + 1e-6 * (1 + seen.norm());
    EXPECT_LE((seen - t.now.velocity).norm(), bound) << t.now.time;
  });
}

TEST_P(EveryMotion, HasTheAccelerationOfItsVelocities) {
  if (GetParam().name == "hover") return;  // its rates are noise
  for_each(GetParam().generate(60, 1), [](const Three& t) {
    const Vector3d seen = (t.after.velocity - t.before.velocity) / (2 * kStep);
    const double bound = t.change(&MotionSample::acceleration) + 1e-6 * (1 + seen.norm());
    EXPECT_LE((seen - t.now.acceleration).norm(), bound) << t.now.time;
  });
}

TEST_P(EveryMotion, HasTheAngularVelocityOfItsOrientations) {
  if (GetParam().name == "hover") return;  // its rates are noise
  for_each(GetParam().generate(60, 1), [](const Three& t) {
    const Vector3d seen =
        deadreckon::logarithm(t.before.orientation.conjugate() * t.after.orientation) / (2 * kStep);
    const double bound = t.change(&MotionSample::angular_velocity) + 1e-6 * (1 + seen.norm());
    EXPECT_LE((seen - t.now.angular_velocity).norm(), bound) << t.now.time;
  });
}

TEST_P(EveryMotion, IsTheSameForTheSameSeed) {
  const Track a = GetParam().generate(20, 7), b = GetParam().generate(20, 7);
  for (std::size_t i = 0; i < a.samples.size(); ++i) {
    EXPECT_EQ(a.samples[i].position, b.samples[i].position);
    EXPECT_EQ(a.samples[i].velocity, b.samples[i].velocity);
  }
}

TEST_P(EveryMotion, HasThresholdsThatGrow) {
  const auto& thresholds = GetParam().thresholds;
  EXPECT_GT(thresholds.front(), 0);
  EXPECT_TRUE(std::is_sorted(thresholds.begin(), thresholds.end()));
}

INSTANTIATE_TEST_SUITE_P(Motions, EveryMotion,
                         testing::ValuesIn(motions().begin(), motions().end()),
                         [](const auto& row) { return std::string(row.param.name); });

TEST(Motions, CircleKeepsItsRadiusSpeedAndHeading) {
  for (const MotionSample& s : motion("circle").generate(60, 1).samples) {
    EXPECT_NEAR(s.position.norm(), 100, 1e-10);
    EXPECT_NEAR(s.velocity.norm(), 20, 1e-12);
    EXPECT_LE((s.orientation * Vector3d::UnitX() - s.velocity / 20).norm(), 1e-12);
    EXPECT_LE((s.orientation * Vector3d::UnitZ() + Vector3d::UnitZ()).norm(), 1e-12);
  }
}

TEST(Motions, AircraftBanksIntoItsTurns) {
  double steepest = 0;
  for (const MotionSample& s : motion("aircraft").generate(90, 1).samples) {
    const Vector3d forward = s.velocity.normalized();
    EXPECT_LE((s.orientation * Vector3d::UnitX() - forward).norm(), 1e-12);
    // The lift, body -z, leans towards the inside of the turn.
    const Vector3d lift = s.orientation * -Vector3d::UnitZ();
    const Vector3d bend = s.acceleration - s.acceleration.dot(forward) * forward;
    const Vector3d level{bend.x(), bend.y(), 0};
    if (level.norm() > 1) {
      EXPECT_GT(lift.dot(level), 0) << s.time;
    }
    steepest = std::max(steepest, std::acos(lift.z()));
  }
  EXPECT_GT(steepest, 1.0);  // over 57 degrees
}

TEST(Motions, HandReachesTenCentimetresAtASpeedLimit) {
  double fastest = 0;
  for (const MotionSample& s : motion("hand").generate(120, 1).samples) {
    fastest = std::max(fastest, s.velocity.norm());
    EXPECT_LE(s.position.norm(), 0.5);
  }
  EXPECT_GT(fastest, 0.8);
  EXPECT_LE(fastest, 1.0);
}

TEST(Motions, HoverRestsWithNoiseAsItsRates) {
  Vector3d sum = Vector3d::Zero();
  const Track track = motion("hover").generate(60, 1);
  for (const MotionSample& s : track.samples) {
    EXPECT_EQ(s.position, track.samples.front().position);
    sum += s.velocity;
  }
  // Five standard errors of the mean of 3601 draws of 0.05 m/s.
  EXPECT_LE((sum / static_cast<double>(track.samples.size())).norm(), 5 * 0.05 * std::sqrt(3) / 60);
}

}  // namespace
}  // namespace reckon::bench::motions_test
