// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/interest/incremental_interest.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include "reckon/tests/support/allocation_guard.hpp"
#include "reckon/tests/support/soak.hpp"

namespace reckon::bench {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

struct Truth {
  aoim::Position position;
  double radius = 0;
};
using Hearings = std::set<std::pair<std::uint32_t, std::uint32_t>>;
using Changes = std::vector<HearingChange>;

/// Pairs of observer and received entity, by comparing all with all.
Hearings brute_force(const std::map<std::uint32_t, Truth>& world) {
  Hearings hearings;
  for (const auto& [a, own] : world) {
    for (const auto& [b, other] : world) {
      const double dx = own.position.x - other.position.x, dy = own.position.y - other.position.y,
                   dz = own.position.z - other.position.z;
      if (a != b && own.radius >= 0 && dx * dx + dy * dy + dz * dz <= own.radius * own.radius) {
        hearings.insert({a, b});
      }
    }
  }
  return hearings;
}

/// Entities that make every kind of change, and the changes that must be reported.
class World {
 public:
  World(std::size_t capacity, double extent, std::uint64_t seed, SimdLevel level)
      : interest_(capacity, level), capacity_(capacity), extent_(extent), random_(seed) {}

  void join() {
    const auto entity = static_cast<std::uint32_t>(random_() % capacity_);
    if (world_.contains(entity)) return;
    const double radius = radii_[random_() % radii_.size()];
    world_[entity] = {anywhere(), radius};
    interest_.add(entity, world_[entity].position, radius);
  }
  void leave() {
    if (world_.empty()) return;
    const auto entity =
        std::next(world_.begin(), static_cast<std::ptrdiff_t>(random_() % world_.size()));
    interest_.remove(entity->first);
    world_.erase(entity);
  }
  void move_all(double step, unsigned percent, unsigned leaps_per_mille, unsigned nan_per_mille) {
    for (auto& [entity, truth] : world_) {
      if (random_() % 100 >= percent) continue;
      truth.position.x += step * unit_(random_);
      truth.position.y += step * unit_(random_);
      truth.position.z += 0.1 * step * unit_(random_);
      if (random_() % 1000 < leaps_per_mille || !std::isfinite(truth.position.x)) {
        truth.position = anywhere();
      }
      if (random_() % 1000 < nan_per_mille) truth.position.x = kNan;
      interest_.move(entity, truth.position);
    }
  }
  /// Fails if the changes of this tick are not the difference of the two truths, in order.
  void expect_exact_step() {
    const std::span<const HearingChange> changes = interest_.step();
    const Hearings now = brute_force(world_);
    std::vector<std::tuple<std::uint32_t, std::uint32_t, bool>> expected, told;
    for (const auto& [a, b] : now) {
      if (!before_.contains({a, b})) expected.emplace_back(a, b, true);
    }
    for (const auto& [a, b] : before_) {
      if (!now.contains({a, b})) expected.emplace_back(a, b, false);
    }
    std::sort(expected.begin(), expected.end());
    for (const HearingChange& c : changes) told.emplace_back(c.observer, c.entity, c.heard);
    ASSERT_EQ(told, expected);
    before_ = now;
    seen_ += expected.size();
  }
  void use_radii(std::vector<double> radii) { radii_ = std::move(radii); }
  [[nodiscard]] std::size_t seen() const { return seen_; }
  [[nodiscard]] const IncrementalInterest& interest() const { return interest_; }
  std::mt19937_64& random() { return random_; }

 private:
  aoim::Position anywhere() {
    return {extent_ * unit_(random_), extent_ * unit_(random_), 2.0 * unit_(random_)};
  }

  IncrementalInterest interest_;
  std::size_t capacity_;
  double extent_;
  std::mt19937_64 random_;
  std::uniform_real_distribution<double> unit_{-1.0, 1.0};
  std::vector<double> radii_{10.0};
  std::map<std::uint32_t, Truth> world_;
  Hearings before_;
  std::size_t seen_ = 0;
};

TEST(IncrementalInterest, EqualsBruteForceForAnyChanges) {
  for (std::uint64_t seed = 1; seed <= test::tries(6U, 12U); ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    World world(400, seed % 3 == 0 ? 400.0 : 60.0, seed, static_cast<SimdLevel>(seed / 2 % 3));
    if (seed % 2 == 0) world.use_radii({0.0, 3.0, 8.0, 12.0, 12.0, 12.0, 90.0, -1.0});
    for (int tick = 0; tick < 40; ++tick) {
      for (int i = 0; i < (tick == 0 ? 500 : static_cast<int>(world.random()() % 6)); ++i)
        world.join();
      for (std::size_t i = world.random()() % 5; i-- > 0;) world.leave();
      const bool storm = tick % 17 == 16;
      world.move_all(tick % 5 == 0 ? 4.0 : 0.3, tick % 7 == 3 ? 10 : 100, storm ? 700 : 5, 3);
      ASSERT_NO_FATAL_FAILURE(world.expect_exact_step()) << "tick " << tick;
    }
    EXPECT_GT(world.seen(), seed % 3 == 0 ? 10u : 1000u);
  }
}

TEST(IncrementalInterest, StaysExactOverManyLayoutsOfSteadyMotion) {
  World world(600, 75.0, 99, best_simd_level());
  for (int i = 0; i < 1500; ++i) world.join();
  for (int tick = 0; tick < 60; ++tick) {
    world.move_all(0.15, 100, 0, 0);
    ASSERT_NO_FATAL_FAILURE(world.expect_exact_step()) << "tick " << tick;
  }
}

TEST(IncrementalInterest, ReceptionIsNotMutualForDifferentRadii) {
  IncrementalInterest interest(2);
  interest.add(0, {0, 0, 0}, 10.0);
  interest.add(1, {6, 0, 8}, 9.0);
  const auto changes = interest.step();
  ASSERT_EQ(changes.size(), 1u);
  EXPECT_EQ(changes[0].observer, 0u);
  EXPECT_EQ(changes[0].entity, 1u);
  EXPECT_TRUE(changes[0].heard);
  EXPECT_TRUE(interest.step().empty());
}

TEST(IncrementalInterest, LeavingAndReturningAtOnceIsNoChange) {
  IncrementalInterest interest(3);
  for (std::uint32_t i = 0; i < 3; ++i) interest.add(i, {1.0 * i, 0, 0}, 1.5);
  EXPECT_EQ(interest.step().size(), 4u);
  interest.remove(1);
  interest.add(1, {1, 0, 0}, 1.5);
  EXPECT_TRUE(interest.step().empty());
  interest.remove(1);
  EXPECT_EQ(interest.step().size(), 4u);
  EXPECT_EQ(interest.size(), 2u);
}

TEST(IncrementalInterest, NobodyReceivesAnEntityWithoutAPosition) {
  IncrementalInterest interest(2);
  interest.add(0, {0, 0, 0}, 5.0);
  interest.add(1, {kNan, 0, 0}, 5.0);
  EXPECT_TRUE(interest.step().empty());
  interest.move(1, {1, 0, 0});
  EXPECT_EQ(interest.step().size(), 2u);
  interest.move(1, {1, std::numeric_limits<double>::infinity(), 0});
  EXPECT_EQ(interest.step().size(), 2u);
}

TEST(IncrementalInterest, AllocatesNothingInSteadyState) {
  constexpr std::uint32_t kCount = 500;
  IncrementalInterest interest(kCount);
  std::mt19937_64 random(8);
  std::uniform_real_distribution<double> where(0.0, 100.0), step(-0.5, 0.5);
  std::vector<aoim::Position> places(kCount);
  for (std::uint32_t i = 0; i < kCount; ++i) {
    places[i] = {where(random), where(random), 0.0};
    interest.add(i, places[i], 10.0);
  }
  std::size_t told = 0;
  const auto tick = [&](int at) {
    for (std::uint32_t i = 0; i < kCount; ++i) {
      places[i] = i % 50 == 0
                      ? aoim::Position{where(random), where(random), 0.0}
                      : aoim::Position{places[i].x + step(random), places[i].y + step(random), 0};
      interest.move(i, places[i]);
    }
    const auto entity = static_cast<std::uint32_t>(at) % kCount;
    interest.remove(entity);
    told += interest.step().size();
    interest.add(entity, places[entity], 10.0);
  };
  for (int i = 0; i < 50; ++i) tick(i);
  const reckon::test::AllocationGuard guard;
  for (int i = 50; i < 150; ++i) tick(i);
  EXPECT_EQ(guard.count(), 0u);
  EXPECT_GT(told, 10'000u);
}

TEST(IncrementalInterest, FewJumpingEntitiesAreComparedIndividually) {
  // Jumps, entities with much larger radii and some far outside, each compared individually; in no
  // tick but the first do most entities jump.
  World world(800, 80.0, 41, best_simd_level());
  world.use_radii({10.0, 10.0, 10.0, 10.0, 10.0, 10.0, 10.0, 10.0, 10.0, 150.0});
  for (int i = 0; i < 1500; ++i) world.join();
  for (int tick = 0; tick < test::tries(15, 30); ++tick) {
    world.move_all(0.2, 100, 30, 5);
    world.join();
    world.leave();
    ASSERT_NO_FATAL_FAILURE(world.expect_exact_step()) << "tick " << tick;
  }
}

TEST(IncrementalInterest, StaysExactWhereSinglePrecisionIsTooCoarse) {
  // Fifty kilometres from most others single precision resolves 4 mm.
  for (const SimdLevel level : {SimdLevel::scalar, SimdLevel::avx2, SimdLevel::avx512}) {
    IncrementalInterest interest(7, level);
    for (std::uint32_t i = 0; i < 4; ++i) interest.add(i, {0, 100.0 * i, 0}, 1.0);
    interest.add(4, {5e4, 0, 0}, 1.0);
    interest.add(5, {5e4, 1.0 + 1e-9, 0}, 1.0);
    interest.add(6, {1e300, 0, 0}, 1.0);
    EXPECT_TRUE(interest.step().empty());
    interest.move(5, {5e4, 1.0, 0});
    EXPECT_EQ(interest.step().size(), 2u);
    interest.move(5, {5e4, 1.0 + 1e-9, 0});
    EXPECT_EQ(interest.step().size(), 2u);
  }
}

TEST(IncrementalInterest, StaysExactForStraysAndLongThinWorlds) {
  // A street of 40 km, and pairs that walk beyond its ends and some 100 m to 1,000 km beside it.
  constexpr std::uint32_t kStreet = 600, kAll = 640;
  IncrementalInterest interest(kAll);
  std::map<std::uint32_t, Truth> world;
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (std::uint32_t i = 0; i < kAll; ++i) {
    world[i] = {{2e4 * unit(random), 5.0 * unit(random), 0}, 200.0};
  }
  for (std::uint32_t i = kStreet; i < kAll; i += 2) {
    const double away = 100.0 * std::pow(1e4, (i - kStreet) / 40.0);
    world[i].position = {(i % 4 == 0 ? away : -away), away * unit(random), 0};
    world[i + 1].position = {world[i].position.x + 199.0, world[i].position.y, 0};
  }
  for (const auto& [i, truth] : world) interest.add(i, truth.position, truth.radius);
  Hearings before;
  for (int tick = 0; tick < 12; ++tick) {
    std::size_t toggled = 0;
    for (const HearingChange& change : interest.step()) {
      const std::pair one(change.observer, change.entity);
      ASSERT_EQ(change.heard, !before.contains(one)) << "tick " << tick;
      change.heard ? before.insert(one), ++toggled : toggled += before.erase(one);
    }
    ASSERT_EQ(before, brute_force(world)) << "tick " << tick;
    ASSERT_GT(toggled, 0u);
    for (auto& [i, truth] : world) {
      truth.position.x += 1.5 * unit(random);
      truth.position.y += (tick == 5 ? 300.0 : 1.5) * unit(random);
      interest.move(i, truth.position);
    }
  }
}

TEST(IncrementalInterest, MemoryFollowsTheNumberOfEntities) {
  IncrementalInterest interest(5000);
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> along(0.0, 1e12);
  for (std::uint32_t i = 0; i < 5000; ++i) interest.add(i, {along(random), along(random), 0}, 1.0);
  EXPECT_TRUE(interest.step().empty());
  EXPECT_LT(interest.memory(), 400u * 5000u);
}

TEST(IncrementalInterest, ReleasesTheMemoryOfAMassJoin) {
  constexpr std::uint32_t kCount = 4000;
  IncrementalInterest interest(kCount);
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> along(0.0, 100.0);
  for (std::uint32_t i = 0; i < kCount; ++i) interest.add(i, {along(random), along(random), 0}, 10);
  EXPECT_GT(interest.step().size(), 100u * kCount);
  EXPECT_GT(interest.memory(), 2000u * kCount);
  for (int i = 0; i < 20; ++i) EXPECT_TRUE(interest.step().empty());
  EXPECT_LT(interest.memory(), 400u * kCount);
}

}  // namespace
}  // namespace reckon::bench
