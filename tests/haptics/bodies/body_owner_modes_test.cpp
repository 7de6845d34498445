// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Bodies that change their owner at run time: simulated while owned, carried otherwise.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <random>

#include "reckon/haptics/bodies/body_world.hpp"
#include "reckon/tests/haptics/support/body_table.hpp"
#include "reckon/tests/haptics/support/moved_bodies.hpp"
#include "reckon/tests/support/soak.hpp"

namespace reckon::haptics::body_owner_modes_test {
namespace {

using Eigen::Vector3d;
using tables::kG;
using tables::MovedBodies;
using tables::Table;

constexpr double kEdge = 0.04, kMass = 0.05;
constexpr double kStepTime = 1e-3;
constexpr Matter kMatter{kMass, 0.5, 0.0};

double motion_energy(const ObjectMotion& state) {
  const double inertia = kMass * kEdge * kEdge / 6;
  return 0.5 * kMass * state.velocity.squaredNorm() + 0.5 * inertia * state.turn_rate.squaredNorm();
}

/// Greatest difference of two motions [m, m/s, rad/s].
double apart(const ObjectMotion& one, const ObjectMotion& other) {
  return std::max({(one.position - other.position).norm(), (one.velocity - other.velocity).norm(),
                   (one.turn_rate - other.turn_rate).norm(),
                   one.orientation.angularDistance(other.orientation)});
}

TEST(OwnedBody, ContinuesFromItsGivenState) {
  Table alone, handed;
  for (Table* table : {&alone, &handed}) {
    table->box(kEdge, {0, 0, 1}, kMatter);
    table->begin();
    ObjectMotion thrown{{0, 0, 1}, Eigen::Quaterniond(Eigen::AngleAxisd(0.4, Vector3d::UnitX()))};
    thrown.velocity = {1, 0.2, 2};
    thrown.turn_rate = {3, -5, 2};
    ASSERT_TRUE(table->world().own(0, thrown));
    table->run(0.2);
  }
  const ObjectMotion left = handed.state();
  ASSERT_TRUE(handed.world().disown(0));
  handed.run(0.1);
  ASSERT_TRUE(handed.state().carried);
  ASSERT_TRUE(handed.world().own(0, left));
  for (int i = 0; i < 200; ++i) {
    alone.run(kStepTime), handed.run(kStepTime);
    ASSERT_LT(apart(alone.state(), handed.state()), 1e-12) << i;
  }
  EXPECT_FALSE(handed.state().carried);
  EXPECT_TRUE(handed.state().awake);
}

TEST(OwnedBody, BeginsToFallInItsFirstPeriod) {
  Table table;
  table.box(kEdge, {0, 0, 1}, kMatter);
  table.begin();
  ObjectMotion state{{0.3, 0.1, 2}, Eigen::Quaterniond::Identity()};
  state.velocity = {1, 0, 0};
  table.world().own(0, state);
  table.run(kStepTime);
  const double t = kStepTime;
  EXPECT_LT((table.state().position - Vector3d(0.3 + t, 0.1, 2 - 0.5 * kG * t * t)).norm(), 1e-12);
  EXPECT_NEAR(table.state().velocity.z(), -kG * t, 1e-12);
}

TEST(DisownedBody, StandsInItsLastStateUntilMoved) {
  Table table;
  table.box(kEdge, {0, 0, 1}, kMatter);
  const auto mover = std::make_shared<MovedBodies>();
  BodyWorld& world = table.begin(mover);
  world.order({BodyAct::push, 0, {}, {0.02, 0.01, 0}, {0.01, 0, 1.01}});
  table.run(0.1);
  const ObjectMotion last = table.state();
  ASSERT_GT(last.velocity.norm(), 0.3);
  const BodyOrder leave{BodyAct::disown, 0};
  const std::uint64_t serial = world.exchange().send(std::span(&leave, 1));
  table.run(kStepTime);
  BodyEnd end;
  ASSERT_TRUE(world.exchange().take_end(end));
  EXPECT_EQ(end.serial, serial);
  EXPECT_TRUE(end.was_owned);
  EXPECT_EQ(end.time, table.now() - tables::kStep);
  EXPECT_EQ(apart(end.state, last), 0.0);
  for (int i = 0; i < 300; ++i) {
    table.run(kStepTime);
    ASSERT_LT((table.state().position - last.position).norm(), 1e-15);
    ASSERT_LT(table.state().orientation.angularDistance(last.orientation), 1e-12);
    ASSERT_TRUE(table.state().velocity.isZero(0.0));
  }
  mover->of(0).position = {1, 2, 3};
  table.run(kStepTime);
  EXPECT_EQ(table.state().position, Vector3d(1, 2, 3));
}

TEST(DisownedBody, IgnoresPushesAndPlaces) {
  Table table;
  table.box(kEdge, {0, 0, 1}, kMatter);
  BodyWorld& world = table.begin();
  world.disown(0);
  table.run(kStepTime);
  const Vector3d at = table.state().position;
  world.order({BodyAct::push, 0, {}, {1, 0, 0}, at});
  world.order({BodyAct::place, 0, {{5, 5, 5}, Eigen::Quaterniond::Identity()}});
  world.order({BodyAct::wake, 0});
  world.disown(0);
  world.order({BodyAct::wake, 7});
  table.run(0.01);
  EXPECT_EQ(table.state().position, at);
  ASSERT_TRUE(world.published().update());
  EXPECT_EQ(world.published().read().ignored, 5u);
}

TEST(DisownedBody, CarriesWhatLiesOnIt) {
  Table table;
  table.floor({0, 0.5, 0});
  table.box(kEdge, {0, 0, 0.5 * kEdge}, kMatter);
  table.box(kEdge, {0, 0, 1.5 * kEdge}, kMatter);
  const auto mover = std::make_shared<MovedBodies>();
  BodyWorld& world = table.begin(mover);
  table.run(2.0);
  ASSERT_FALSE(table.state(1).awake);
  world.disown(0);
  table.run(0.1);
  EXPECT_FALSE(table.state(1).awake) << "nothing has moved";
  const Vector3d from = mover->of(1).position;
  for (int i = 1; i <= 1000; ++i) {
    const double u = 0.5 - 0.5 * std::cos(M_PI * i * 1e-3);
    mover->of(1).position = from + Vector3d(0.2 * u, 0, 0.05 * u);
    mover->of(1).velocity = 0.5 * M_PI * std::sin(M_PI * i * 1e-3) * Vector3d(0.2, 0, 0.05);
    table.run(kStepTime);
  }
  EXPECT_LT((table.state(1).position - table.state(0).position - Vector3d(0, 0, kEdge)).norm(),
            2e-3);
}

// After an outage its owner may have it elsewhere: it strikes nothing on the way, and what lay on
// it falls.
TEST(DisownedBody, JumpsWithoutAStrike) {
  for (const Vector3d& by : {Vector3d(0, 0, 0.01), Vector3d(0.5, 0, 0)}) {
    Table table;
    table.floor({0, 0.5, 0});
    table.box(kEdge, {0, 0, 0.5 * kEdge}, kMatter);
    table.box(kEdge, {0, 0, 1.5 * kEdge}, kMatter);
    const auto mover = std::make_shared<MovedBodies>();
    BodyWorld& world = table.begin(mover);
    table.run(2.0);
    world.disown(0);
    table.run(0.1);
    mover->of(1).position += by;
    double fastest = 0.0;
    for (int i = 0; i < 1000; ++i) {
      table.run(kStepTime);
      fastest = std::max(fastest, table.state(1).velocity.norm());
    }
    EXPECT_LT(fastest, by.z() > 0 ? 0.15 : 1.05 * std::sqrt(2 * kG * kEdge));
    const double height = by.z() > 0 ? 1.5 * kEdge + by.z() : 0.5 * kEdge;
    EXPECT_NEAR(table.state(1).position.z(), height, 1e-3);
  }
}

TEST(OwnedBody, PartsSlowlyFromWhatItOverlaps) {
  for (int seed = 1; seed <= test::tries(60, 600); ++seed) {
    std::mt19937 random(static_cast<unsigned>(seed));
    std::uniform_real_distribution<double> any(-1, 1);
    Table table;
    table.floor({0, 0.5, 0});
    table.box(kEdge, {0, 0, 0.5 * kEdge}, kMatter);
    table.box(kEdge, {1, 0, 0.5 * kEdge}, kMatter);
    BodyWorld& world = table.begin();
    table.run(seed % 2 == 0 ? 0.1 : 1.5);
    const Vector3d middle(0.9 * kEdge * any(random), 0.9 * kEdge * any(random), 0.03 * any(random));
    world.own(1, {middle, Eigen::Quaterniond(Eigen::AngleAxisd(any(random), Vector3d::UnitY()))});
    double most = 0.0;
    for (int i = 0; i < 1500; ++i) {
      table.run(kStepTime);
      const double moving = motion_energy(table.state(0)) + motion_energy(table.state(1));
      ASSERT_TRUE(std::isfinite(moving)) << seed;
      most = std::max(most, moving);
    }
    // It may fall from where it was parted to, not faster.
    EXPECT_LT(most, kMass * kG * 2.0 * kEdge) << seed;
    EXPECT_LT(motion_energy(table.state(1)), 1e-4) << seed;
    EXPECT_GT(table.state(1).position.z(), 0.0) << seed;
  }
}

TEST(OwnedBody, StaysInItsWorkspace) {
  Table table;
  table.box(kEdge, {0, 0, 0}, kMatter);
  table.within(Vector3d::Constant(1), 1.0);
  BodyWorld& world = table.begin();
  ObjectMotion outside{{3, 0, 0}, Eigen::Quaterniond::Identity()};
  outside.velocity = {2, 0, 0};
  world.own(0, outside);
  for (int i = 0; i < 1000; ++i) {
    table.run(kStepTime);
    ASSERT_LE(table.state().position.cwiseAbs().maxCoeff(), 0.5 - 0.5 * kEdge + 1e-9);
  }
  world.disown(0);
  table.run(0.01);
  world.own(0, table.state());
  table.run(0.5);
  EXPECT_LE(table.state().position.cwiseAbs().maxCoeff(), 0.5 - 0.5 * kEdge + 1e-9);
}

TEST(OwnedBody, NeedsAUsableState) {
  Table table;
  table.box(kEdge, {0, 0, 1}, kMatter);
  BodyWorld& world = table.begin();
  world.disown(0);
  table.run(kStepTime);
  constexpr double kNot = std::numeric_limits<double>::quiet_NaN();
  ObjectMotion bad{{kNot, 0, 0}, Eigen::Quaterniond::Identity()};
  world.own(0, bad);
  bad.position = {0, 0, 1e9};
  world.own(0, bad);
  bad.position.z() = 1;
  bad.orientation.coeffs().setZero();
  world.own(0, bad);
  table.run(kStepTime);
  EXPECT_TRUE(table.state().carried);
  bad.orientation.setIdentity();
  bad.velocity = {1e5, 0, 0};
  bad.turn_rate = {0, 1e5, 0};
  world.own(0, bad);
  table.run(kStepTime);
  EXPECT_LE(table.state().position.x(), BodyWorld::kFastest * kStepTime + 1e-9);
  EXPECT_LE(table.state().velocity.norm(), BodyWorld::kFastest + 1e-6);
  EXPECT_LE(table.state().turn_rate.norm(), BodyWorld::kFastestTurn + 1e-6);
}

TEST(OwnedBody, WaitsWhileTheWorldIsFrozen) {
  Table table;
  table.box(kEdge, {0, 0, 1}, kMatter);
  BodyWorld& world = table.begin();
  ObjectMotion state{{0, 0, 2}, Eigen::Quaterniond::Identity()};
  state.velocity = {1, 0, 0};
  world.own(0, state);
  auto now = table.now();
  for (int i = 0; i < 100; ++i) world.advance_to(now += tables::kStep, true);
  EXPECT_EQ(table.state().position, state.position);
  EXPECT_TRUE(table.state().velocity.isZero(0.0));
  world.advance_to(now += tables::kStep);
  EXPECT_NEAR(table.state().velocity.x(), 1.0, 1e-12);
}

// More bodies than slots, a hundred of them of other peers.
struct Field {
  Field() {
    table.floor({0, 0.5, 0});
    for (std::uint32_t i = 0; i < kBodies; ++i)
      table.box(kEdge, {0.1 * (i % 15), 0.1 * (i / 15), 0.5 * kEdge}, kMatter);
    table.begin(mover);
    table.run(0.01);
    for (std::uint32_t i = 0; i < kLeft; ++i) table.world().disown(i);
    table.run(0.01);
  }
  static constexpr std::uint32_t kBodies = 150, kLeft = 100;
  std::shared_ptr<MovedBodies> mover = std::make_shared<MovedBodies>();
  Table table;
};

TEST(DisownedBodies, FollowTheirMoverWithoutSlots) {
  Field field;
  for (int step = 0; step < 30; ++step) {
    for (std::uint32_t i = 0; i < Field::kLeft; ++i) {
      const bool moves = step % 10 != 9 || i % 3 == 0;
      field.mover->of(i + 1).position.z() += moves ? 1e-3 : 0.0;
      field.mover->of(i + 1).velocity.z() = moves ? 1.0 : 0.0;
    }
    field.table.run(kStepTime);
    for (std::uint32_t i = 0; i < Field::kLeft; ++i) {
      const double off = field.table.state(i).position.z() - field.mover->of(i + 1).position.z();
      ASSERT_NEAR(off, 0.0, 1e-12) << i << " in step " << step;
    }
  }
}

TEST(DisownedBodies, CarryOthersWithoutSlots) {
  Field field;
  const std::uint32_t under = 99, on = 140;
  field.mover->of(under + 1).position = {5, 5, 0.5};
  field.table.run(kStepTime);
  field.table.world().order(
      {BodyAct::place, on, {{5, 5, 0.5 + 1.2 * kEdge}, Eigen::Quaterniond::Identity()}});
  field.table.run(0.5);
  EXPECT_NEAR(field.table.state(on).position.z(), 0.5 + kEdge, 1e-3);
}

TEST(OwnedBodies, ChangeOwnerAmongMoreThanSlots) {
  Field field;
  Table& table = field.table;
  BodyWorld& world = table.world();
  for (std::uint32_t i = 0; i < 100; ++i) {
    ASSERT_TRUE(table.state(i).carried);
    field.mover->of(i + 1).position.z() += 0.3;
  }
  table.run(kStepTime);
  for (std::uint32_t i = 0; i < 100; ++i) ASSERT_NEAR(table.state(i).position.z(), 0.32, 1e-9) << i;
  for (std::uint32_t i = 0; i < 100; ++i) {
    ObjectMotion up = table.state(i);
    up.velocity.z() = 1;
    world.own(i, up);
  }
  std::ptrdiff_t most = 0;
  for (int i = 0; i < 3000; ++i) {
    table.run(kStepTime);
    most = std::max(most, std::ranges::count_if(world.states(), &BodyState::awake));
  }
  EXPECT_EQ(most, 64);
  EXPECT_GT(world.crowded(), 0u);
  ASSERT_TRUE(world.published().update());
  const BodyStates& published = world.published().read();
  for (std::uint32_t i = 0; i < Field::kBodies; ++i) {
    EXPECT_FALSE(published.bodies[i].carried);
    EXPECT_EQ(apart(published.bodies[i], table.state(i)), 0.0) << i;
    EXPECT_GT(table.state(i).position.z(), 0.4 * kEdge) << i;
  }
}

}  // namespace
}  // namespace reckon::haptics::body_owner_modes_test
