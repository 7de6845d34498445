// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/federation/exercise_clock.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace reckon::peer {
namespace {

using std::chrono::hours;
using std::chrono::nanoseconds;

constexpr std::int32_t kLast = std::numeric_limits<std::int32_t>::max();  // last hour on the wire

pdu::StartResume start_at(std::int32_t real, std::int32_t simulation) {
  pdu::StartResume order;
  order.real_world_time.hour = real;
  order.simulation_time.hour = simulation;
  return order;
}

pdu::StopFreeze stop_at(std::int32_t real) {
  pdu::StopFreeze order;
  order.real_world_time.hour = real;
  return order;
}

TEST(ExerciseClock, StartsAndStopsAtTheOrderedTimes) {
  ExerciseClock clock;
  EXPECT_EQ(clock.at(hours(500'000)), hours(500'000));
  clock.take(start_at(500'010, 100), hours(500'000));
  EXPECT_EQ(clock.at(hours(500'009)), hours(500'009));
  EXPECT_EQ(clock.at(hours(500'011)), hours(101));
  clock.take(stop_at(500'020), hours(500'012));
  EXPECT_EQ(clock.at(hours(500'019)), hours(109));
  EXPECT_EQ(clock.at(hours(500'021)), hours(110));
}

TEST(ExerciseClock, NeverGoesBackForAnyHours) {
  ExerciseClock clock;
  clock.take(start_at(0, kLast), hours(500'000));
  const nanoseconds before = clock.at(hours(500'001));
  EXPECT_GT(before, hours(500'001));
  clock.take(stop_at(kLast), hours(500'001));
  EXPECT_GE(clock.at(nanoseconds::max()), before) << "frozen in the far future";
  clock.take(start_at(kLast, 0), hours(500'001));
  EXPECT_GE(clock.at(nanoseconds::max()), before) << "resumed where it stood";
}

}  // namespace
}  // namespace reckon::peer
