// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/queries/pair_queue.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

#include "reckon/tests/haptics/support/pair_oracles.hpp"
#include "reckon/tests/support/allocation_guard.hpp"

namespace reckon::haptics {
namespace {

using Eigen::Vector3d;
using test::drawn_point;
using test::uniform;

constexpr double kQueueTick = 0.01;  // [s]

struct Roamer {
  Vector3d position, velocity;
  double radius;
};

std::vector<Roamer> drawn_roamers(std::mt19937_64& random, std::size_t count, double reach) {
  std::vector<Roamer> balls;
  for (std::size_t i = 0; i < count; ++i)
    balls.push_back(
        {drawn_point(random, reach), drawn_point(random, 1.0), uniform(random, 0.1, 0.5)});
  return balls;
}

BodyMotion motion_of(const Roamer& ball, double now) {
  BodyMotion motion;
  motion.time = now;
  motion.position = ball.position;
  motion.velocity = ball.velocity;
  motion.radius = ball.radius;
  return motion;
}

/// Each pair that overlaps at this time, by comparing all.
std::set<std::pair<std::uint32_t, std::uint32_t>> overlapping(const std::vector<Roamer>& balls) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> pairs;
  for (std::uint32_t j = 1; j < balls.size(); ++j)
    for (std::uint32_t i = 0; i < j; ++i)
      if ((balls[j].position - balls[i].position).norm() < balls[i].radius + balls[j].radius)
        pairs.insert({i, j});
  return pairs;
}

int missed(std::span<const BoxPair> due, const std::vector<Roamer>& balls) {
  int count = 0;
  for (const auto& [i, j] : overlapping(balls))
    count += std::find(due.begin(), due.end(), BoxPair{i, j}) == due.end() ? 1 : 0;
  return count;
}

// 150 balls in a cube of 60 m; each changes its velocity about every two seconds, and reports it.
TEST(PairQueue, MissesNothingWithATenthOfTheTests) {
  std::mt19937_64 random(1);
  std::vector<Roamer> balls = drawn_roamers(random, 150, 30.0);
  PairQueue queue(balls.size());
  for (std::uint32_t i = 0; i < balls.size(); ++i) queue.report(i, motion_of(balls[i], 0.0), 0.0);
  constexpr int kQueueTicks = 2'000;
  std::size_t overlaps = 0;
  int misses = 0;
  for (int tick = 1; tick <= kQueueTicks; ++tick) {
    const double now = tick * kQueueTick;
    for (Roamer& ball : balls) ball.position += kQueueTick * ball.velocity;
    for (std::uint32_t i = 0; i < balls.size(); ++i) {
      if (random() % 200 != 0) continue;
      balls[i].velocity = drawn_point(random, 1.0);
      queue.report(i, motion_of(balls[i], now), now);
    }
    misses += missed(queue.due(now), balls);
    overlaps += overlapping(balls).size();
  }
  const double sweep = kQueueTicks * 150.0 * 149.0 / 2.0;
  EXPECT_EQ(misses, 0);
  EXPECT_GT(overlaps, 100u);
  EXPECT_LT(static_cast<double>(queue.tests()), sweep / 10.0)
      << sweep / static_cast<double>(queue.tests()) << " times fewer than by the tick";
  RecordProperty("times_fewer", std::to_string(sweep / static_cast<double>(queue.tests())));
}

// Only the start is reported: the bounds of acceleration and speed hold all the time.
TEST(PairQueue, MissesNothingOfBodiesWithinTheirBounds) {
  std::mt19937_64 random(2);
  for (const double most_speed : {2.0, 1e9}) {
    std::vector<Roamer> balls = drawn_roamers(random, 60, 8.0);
    PairQueue queue(balls.size());
    for (std::uint32_t i = 0; i < balls.size(); ++i) {
      BodyMotion motion = motion_of(balls[i], 0.0);
      motion.most_acceleration = 0.5;
      motion.most_speed = most_speed;
      queue.report(i, motion, 0.0);
    }
    int misses = 0;
    std::size_t overlaps = 0;
    for (int tick = 1; tick <= 1'000; ++tick) {
      for (Roamer& ball : balls) {
        // Towards the middle, so that bodies meet.
        const Vector3d push = 0.5 * -ball.position.normalized();
        ball.position += kQueueTick * ball.velocity + 0.5 * kQueueTick * kQueueTick * push;
        ball.velocity += kQueueTick * push;
        if (ball.velocity.norm() > 2.0) ball.velocity *= 2.0 / ball.velocity.norm();
      }
      misses += missed(queue.due(tick * kQueueTick), balls);
      overlaps += overlapping(balls).size();
    }
    EXPECT_EQ(misses, 0);
    EXPECT_GT(overlaps, 100u);
  }
}

TEST(PairQueue, GivesTheTimeOfAStraightMeeting) {
  BodyMotion a, b;
  a.radius = b.radius = 0.5;
  b.position = {11.0, 0.0, 0.0};
  b.velocity = {-2.0, 0.0, 0.0};
  EXPECT_NEAR(earliest_contact(a, b, 0.0), 5.0, 1e-9);
  b.velocity = {2.0, 0.0, 0.0};
  EXPECT_EQ(earliest_contact(a, b, 0.0), std::numeric_limits<double>::infinity());
  b.velocity = Vector3d::Zero();
  b.most_acceleration = 5.0;  // 10 m = 5 t^2 / 2
  EXPECT_NEAR(earliest_contact(a, b, 0.0), 2.0, 1e-9);
  b.most_speed = 1.0;
  EXPECT_NEAR(earliest_contact(a, b, 0.0), 10.0 / 1.0, 10.0) << "not later";
  EXPECT_GE(earliest_contact(a, b, 0.0), 2.0);
  a.most_speed = 0.0;
  EXPECT_NEAR(earliest_contact(a, b, 0.0), 10.0, 1e-9);
}

TEST(PairQueue, DueTimeIsNeverAfterTheMeeting) {
  std::mt19937_64 random(3);
  int met = 0;
  for (int i = 0; i < 20'000; ++i) {
    BodyMotion a, b;
    a.position = drawn_point(random, 5.0);
    b.position = drawn_point(random, 5.0);
    a.velocity = drawn_point(random, 2.0);
    b.velocity = a.position - b.position + drawn_point(random, 3.0);
    a.radius = uniform(random, 0, 1);
    b.radius = uniform(random, 0, 1);
    const Vector3d p = b.position - a.position, v = b.velocity - a.velocity;
    const double reach = a.radius + b.radius;
    if (p.norm() <= reach) continue;
    // |p + v t| = reach
    const double half = p.dot(v),
                 root = half * half - v.squaredNorm() * (p.squaredNorm() - reach * reach);
    if (root < 0.0 || half > 0.0) continue;
    ++met;
    const double time = (p.squaredNorm() - reach * reach) / (-half + std::sqrt(root));
    ASSERT_LE(earliest_contact(a, b, 0.0), time * (1 + 1e-12)) << i;
    ASSERT_GT(earliest_contact(a, b, 0.0), 0.1 * time) << i;
  }
  EXPECT_GT(met, 1'000);
}

TEST(PairQueue, ReturnsExistingPairsWhileTheyAreDue) {
  PairQueue queue(3);
  BodyMotion a;
  a.radius = 1.0;
  queue.report(0, a, 0.0);
  queue.report(2, a, 0.0);
  EXPECT_LE(queue.next_due(), 0.0);
  for (const double now : {0.0, 0.0, 1.0, 2.0}) {
    const auto due = queue.due(now);
    ASSERT_EQ(due.size(), 1u) << now;
    EXPECT_EQ(due[0], (BoxPair{0, 2}));
    if (now == 0.0) queue.report(2, a, 0.0);
  }
  queue.remove(2);
  EXPECT_TRUE(queue.due(3.0).empty());
  EXPECT_EQ(queue.next_due(), std::numeric_limits<double>::infinity());
  EXPECT_THROW(PairQueue(5'000), std::invalid_argument);
}

TEST(PairQueue, AllocatesNothing) {
  std::mt19937_64 random(4);
  std::vector<Roamer> balls = drawn_roamers(random, 40, 1.0);
  PairQueue queue(balls.size());
  const test::AllocationGuard guard;
  for (std::uint32_t i = 0; i < balls.size(); ++i) queue.report(i, motion_of(balls[i], 0.0), 0.0);
  std::size_t due = 0;
  for (int tick = 0; tick < 10; ++tick) due += queue.due(tick * kQueueTick).size();
  EXPECT_EQ(guard.count(), 0u);
  EXPECT_GT(due, 0u);
}

}  // namespace
}  // namespace reckon::haptics
