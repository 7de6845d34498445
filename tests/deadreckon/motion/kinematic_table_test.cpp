// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/deadreckon/motion/kinematic_table.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <set>
#include <vector>

#include "reckon/deadreckon/motion/drm.hpp"
#include "reckon/tests/deadreckon/support/oracle.hpp"
#include "reckon/tests/support/allocation_guard.hpp"

namespace reckon::deadreckon {
namespace {

using test::Random;

// Rounding of the numbers that are added up: a few units in the last place of each.
void expect_equal(const Pose& batch, const Pose& single, double size, double speed) {
  EXPECT_LE((batch.position - single.position).norm(), 2e-15 * size);
  EXPECT_LE((batch.velocity - single.velocity).norm(), 2e-15 * speed);
  EXPECT_LE(test::difference(batch.orientation, single.orientation), 1e-15);
  EXPECT_EQ(batch.angular_velocity, single.angular_velocity);
}

TEST(KinematicTable, EqualsTheExtrapolationOfEachEntityForEveryModelAndRate) {
  constexpr std::size_t kRows = 5000;  // not a multiple of any vector or chunk
  Random random(9);
  std::vector<KinematicState> states;
  std::vector<double> times;
  KinematicTable table;
  table.resize(kRows + 3);
  for (std::size_t i = 0; i < kRows + 3; ++i) {
    const double rate = i % 7 == 0 ? 0 : std::pow(10, random.real(-9, 1));
    states.push_back(random.state(static_cast<pdu::DeadReckoningAlgorithm>(i % 10), rate));
    states.back().position *= 6378;
    times.push_back(random.real(-5, 1));
    table.set(i, states.back(), times.back());
  }
  PoseTable poses;
  poses.resize(table.size());
  table.extrapolate(2.5, poses);
  for (std::size_t i = 0; i < table.size(); ++i) {
    SCOPED_TRACE(i);
    const double tau = 2.5 - times[i];
    const double size = states[i].position.norm() + tau * states[i].velocity.norm() +
                        tau * tau * states[i].acceleration.norm();
    expect_equal(poses.pose(i), extrapolate(states[i], tau), size,
                 states[i].velocity.norm() + tau * states[i].acceleration.norm());
  }
}

TEST(KinematicTable, StaysFiniteForEveryTime) {
  KinematicTable table;
  table.resize(10);
  Random random(2);
  for (std::size_t i = 0; i < 10; ++i)
    table.set(i, random.state(static_cast<pdu::DeadReckoningAlgorithm>(i), 5), 0);
  PoseTable poses;
  poses.resize(10);
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (const double now :
       {0.0, 1e300, -1e300, kInfinity, -kInfinity, std::numeric_limits<double>::quiet_NaN()}) {
    table.extrapolate(now, poses);
    for (std::size_t i = 0; i < 10; ++i) EXPECT_TRUE(is_finite(poses.pose(i))) << i << ' ' << now;
  }
}

TEST(KinematicTable, KeepsItsRowsWhenItGrowsAndAllocatesNothingElse) {
  KinematicTable table;
  table.resize(1);
  KinematicState state;
  state.algorithm = pdu::DeadReckoningAlgorithm::fpw;
  state.velocity = {3, 0, 0};
  table.set(0, state, 1);
  table.resize(200);
  PoseTable poses;
  poses.resize(200);
  const reckon::test::AllocationGuard guard;
  table.extrapolate(2, poses);
  EXPECT_EQ(guard.count(), 0U);
  EXPECT_EQ(poses.pose(0).position, Eigen::Vector3d(3, 0, 0));
  EXPECT_EQ(poses.pose(199).orientation.w(), 1);
}

TEST(KinematicTable, StartsEachColumnOnALineOfTheCacheAndAnotherPlaceOfItsPage) {
  for (const std::size_t rows : {1U, 511U, 512U, 513U, 100'000U}) {
    KinematicTable table;
    table.resize(rows);
    std::set<std::uintptr_t> places;
    for (std::size_t i = 0; i < KinematicTable::kColumns; ++i) {
      ASSERT_EQ(table.column(i).size(), rows);
      const auto place = reinterpret_cast<std::uintptr_t>(table.column(i).data());
      EXPECT_EQ(place % 64, 0U);
      EXPECT_TRUE(places.insert(place % 4096).second) << rows << " rows, column " << i;
    }
  }
}

TEST(KinematicTable, KeepsWhatStillHasRoomWhenItShrinks) {
  Random random(9);
  KinematicTable table;
  table.resize(1000);
  for (std::size_t i = 0; i < 1000; ++i)
    table.set(i, random.state(pdu::DeadReckoningAlgorithm::rvb, 0.1), static_cast<double>(i));
  const std::vector<double> times(table.column(16).begin(), table.column(16).end());
  table.resize(0);
  EXPECT_EQ(table.size(), 0U);
  table.resize(3);
  EXPECT_EQ(table.column(16)[2], 0);
  table.resize(1000);
  for (std::size_t i = 0; i < 1000; ++i)
    table.set(i, random.state(pdu::DeadReckoningAlgorithm::rvb, 0.1), static_cast<double>(i));
  table.resize(700);
  table.resize(900);
  for (std::size_t i = 0; i < 900; ++i) EXPECT_EQ(table.column(16)[i], i < 700 ? times[i] : 0) << i;
}

}  // namespace
}  // namespace reckon::deadreckon
