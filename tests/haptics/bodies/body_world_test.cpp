// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Bodies without a hand, against closed forms.
#include "reckon/haptics/bodies/body_world.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <random>
#include <stdexcept>
#include <string>
#include <thread>

#include "reckon/haptics/bodies/contact_islands.hpp"
#include "reckon/tests/haptics/support/body_table.hpp"
#include "reckon/tests/support/scratch_folder.hpp"
#include "reckon/tests/support/soak.hpp"

namespace reckon::haptics::body_world_test {
namespace {

using Eigen::Vector3d;
using std::chrono::nanoseconds;
using tables::kG;
using tables::kStep;
using tables::Table;

TEST(BodyWorld, FreeBodyFallsAsTheClosedForm) {
  for (const int microseconds : {1000, 250, 3000}) {
    Table table;
    table.ball(0.02, {0, 0, 10}, {0.3});
    BodyWorld& world = table.begin();
    table.run(0.9, std::chrono::microseconds(microseconds));
    EXPECT_NEAR(table.state().position.z(), 10 - 0.5 * kG * 0.81, 1e-9) << microseconds;
    EXPECT_NEAR(table.state().velocity.z(), -kG * 0.9, 1e-9);
    EXPECT_NEAR(world.energy(), 0.0, 1e-9) << "what it loses in height it gains in speed";
  }
}

TEST(BodyWorld, PushGivesImpulseAndReportsItsWork) {
  Table table;
  table.without_gravity();
  table.box(0.04, {0, 0, 0}, {0.5});
  BodyWorld& world = table.begin();
  nanoseconds now{1'000'000'000};
  double work = 0.0;
  for (int i = 0; i < 100; ++i) {
    const Vector3d at = world.states()[0].position + Vector3d(-0.02, 0.01, 0);
    const std::size_t push = world.push(0, at, {2, 0, 0});
    world.advance_to(now += kStep);
    work += world.work(push);
  }
  EXPECT_NEAR(world.states()[0].velocity.x(), 2 * 0.1 / 0.5, 1e-9);
  EXPECT_LT(world.states()[0].turn_rate.z(), -0.1) << "pushed beside its middle";
  EXPECT_NEAR(work, world.energy(), 0.01 * work);
  EXPECT_GE(work, world.energy()) << "no more than was given";
  world.advance_to(now += kStep);
  EXPECT_EQ(world.work(0), 0.0) << "a push lasts one period";
}

TEST(BodyWorld, LighterBodyReboundsFromAHeavierBody) {
  Table table;
  table.without_gravity();
  table.ball(0.02, {-0.1, 0, 0}, {1.0, 0.0, 1.0});
  table.ball(0.02, {0, 0, 0}, {2.0, 0.0, 1.0});
  BodyWorld& world = table.begin();
  nanoseconds now{1'000'000'000};
  world.push(0, {-0.1, 0, 0}, {1000, 0, 0});
  world.advance_to(now + kStep);
  EXPECT_NEAR(table.state(0).velocity.x(), 1.0, 1e-9);
  for (int i = 2; i < 200; ++i) world.advance_to(now + i * kStep);
  EXPECT_NEAR(table.state(0).velocity.x(), -1.0 / 3, 1e-8);
  EXPECT_NEAR(table.state(1).velocity.x(), 2.0 / 3, 1e-8);
}

// A servo's thread ends before its world does, and another thread may continue.
TEST(BodyWorld, StepsInThreadsThatEndFirst) {
  Table one, other, alone;
  for (Table* table : {&one, &other, &alone}) {
    table->floor({0.0, 0.5, 0.3});
    for (int i = 0; i < 4; ++i) table->box(0.04, {0.01 * i, 0, 0.03 + 0.06 * i}, {0.1, 0.5, 0.3});
    table->begin();
  }
  for (int turn = 0; turn < 4; ++turn) {
    std::thread([&] {
      for (int i = 0; i < 50; ++i) {
        one.run(0.001);
        other.run(0.001);
      }
    }).join();
    alone.run(0.05);
  }
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(one.state(i).position, alone.state(i).position) << i;
    EXPECT_EQ(other.state(i).position, alone.state(i).position) << i;
  }
}

// Four contacts at once.
TEST(BodyWorld, MeetingBoxesPartByMassAndRestitution) {
  for (const double restitution : {1.0, 0.5}) {
    Table table;
    table.without_gravity();
    table.box(0.04, {-0.1, 0, 0}, {1.0, 0.0, restitution});
    table.box(0.04, {0, 0, 0}, {2.0, 0.0, restitution});
    BodyWorld& world = table.begin();
    world.push(0, {-0.1, 0, 0}, {1000, 0, 0});
    table.run(0.2);
    EXPECT_NEAR(table.state(0).velocity.x(), (1.0 - 2.0 * restitution) / 3.0, 1e-8);
    EXPECT_NEAR(table.state(1).velocity.x(), (1.0 + restitution) / 3.0, 1e-8);
  }
}

// The friction of a pair is sqrt(0.8 x 0.2) = 0.4.
TEST(BodyWorld, BoxSlidesWithItsFriction) {
  for (const double way : {0.0, 0.4, 0.785, 1.9}) {
    Table table;
    table.floor({0.0, 0.8});
    table.box(0.04, {0, 0, 0.02}, {0.2, 0.2});
    BodyWorld& world = table.begin();
    table.run(0.1);
    nanoseconds now{1'100'000'000};
    const Vector3d push(std::cos(way), std::sin(way), 0);
    world.push(0, world.states()[0].position, 200 * push);
    world.advance_to(now += kStep);
    const double before = table.state().velocity.head<2>().norm();
    for (int i = 0; i < 100; ++i) world.advance_to(now += kStep);
    const double after = table.state().velocity.head<2>().norm();
    EXPECT_NEAR((before - after) / 0.1, 0.4 * kG, 0.01 * 0.4 * kG) << way;
  }
}

TEST(BodyWorld, BoxStaysWithinItsFriction) {
  for (const double share : {0.97, 1.03}) {
    Table table;
    table.floor({0.0, 0.5});
    table.box(0.04, {0, 0, 0.02}, {0.2, 0.5});
    BodyWorld& world = table.begin();
    nanoseconds now{1'000'000'000};
    for (int i = 0; i < 1000; ++i) {
      Vector3d at = world.states()[0].position;
      at.z() -= 0.018;
      world.push(0, at, {share * 0.5 * 0.2 * kG, 0, 0});
      world.advance_to(now += kStep);
    }
    if (share < 1) {
      EXPECT_LT(std::abs(table.state().position.x()), 1e-4);
    } else {
      EXPECT_GT(table.state().position.x(), 0.05);
    }
  }
}

TEST(BodyWorld, StackOfFiveRestsAndSleeps) {
  Table table;
  table.floor();
  for (int i = 0; i < 5; ++i) table.box(0.04, {0.001 * i, 0, 0.0205 + 0.0405 * i}, {0.1});
  BodyWorld& world = table.begin();
  table.run(1.5);
  const double top = table.state(4).position.z();
  table.run(1.0);
  EXPECT_LT(std::abs(table.state(4).position.z() - top), 1e-7);
  EXPECT_NEAR(top, 0.18, 3e-4);
  table.run(1.0);
  for (const BodyState& state : world.states()) EXPECT_FALSE(state.awake);
  const Vector3d rest = table.state(4).position;
  table.run(1.0);
  EXPECT_EQ(table.state(4).position, rest) << "no jitter at all";
  world.push(4, rest, {0.5, 0, 0});
  table.run(0.02);
  EXPECT_TRUE(table.state(4).awake) << "woken by a push";
}

// More contacts than the exact solver accepts.
TEST(BodyWorld, TouchingRowFallsAsleepTogether) {
  Table table;
  table.floor();
  for (int i = 0; i < 27; ++i) table.box(0.04, {0.04 * i, 0, 0.02}, {0.1});
  BodyWorld& world = table.begin();
  int alone = 0;
  for (int i = 0; i < 3'000; ++i) {
    table.run(0.001);
    const auto awake = std::ranges::count_if(world.states(), &BodyState::awake);
    alone += awake > 0 && awake < 27 ? 1 : 0;
  }
  EXPECT_GT(world.approximated(), 50U);
  EXPECT_LT(alone, 500) << "parts of the row that do not touch, but none is woken for ever";
  for (const BodyState& state : world.states()) {
    EXPECT_FALSE(state.awake);
    EXPECT_NEAR(state.position.z(), 0.02, 3e-5);
  }
}

TEST(ContactIslands, CountConnectedContacts) {
  ContactIslands<8> islands;
  EXPECT_EQ(islands.largest(), 0);
  islands.add(0, 4);
  islands.join(1, 2, 3);
  islands.join(3, 2, 2);
  islands.add(3, 1);
  EXPECT_EQ(islands.largest(), 6);
  EXPECT_EQ(islands.island_of(1), islands.island_of(3));
  EXPECT_NE(islands.island_of(0), islands.island_of(3));
  islands.join(0, 1, 1);
  EXPECT_EQ(islands.largest(), 11);
  islands.clear();
  EXPECT_EQ(islands.largest(), 0);
  EXPECT_NE(islands.island_of(1), islands.island_of(3));
}

TEST(BodyWorld, HeavyBoxDoesNotSinkIntoLightOne) {
  for (const double ratio : {100.0, 1e4}) {
    Table table;
    table.floor();
    table.box(0.04, {0, 0, 0.02}, {0.01});
    table.box(0.04, {0, 0, 0.06}, {0.01 * ratio});
    table.begin();
    table.run(1.0);
    EXPECT_NEAR(table.state(1).position.z(), 0.06, 1e-4) << ratio;
  }
}

TEST(BodyWorld, NoPileEverGainsEnergy) {
  for (unsigned seed = 1; seed <= 2; ++seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    Table table;
    table.floor({0.0, 0.5, 0.3});
    for (int i = 0; i < 27; ++i) {
      SceneObject& box = table.box(
          0.04, {0.075 * (i % 3), 0.075 * (i / 3 % 3), 0.1 + 0.075 * static_cast<double>(i / 9)},
          {0.02 + 0.1 * std::abs(any(random)), 0.5, 0.5 * std::abs(any(random))});
      box.pose.orientation = Eigen::Quaterniond(
          Eigen::AngleAxisd(any(random), Vector3d(any(random), any(random), 1.0).normalized()));
    }
    BodyWorld& world = table.begin();
    double energy = world.energy(), most = 0.0;
    for (int i = 0; i < 3000; ++i) {
      table.run(0.001);
      most = std::max(most, world.energy() - energy);
      energy = std::min(energy, world.energy());
    }
    // The weight of all bodies times the rest depth of contacts, 10 um.
    EXPECT_LT(most, 1e-4) << "seed " << seed;
    EXPECT_LT(energy, 0.0) << "they fell";
    for (const BodyState& state : world.states()) {
      EXPECT_GT(state.position.z(), 0.015) << "none is in the floor";
      EXPECT_LT(state.position.norm(), 2.0);
    }
    std::printf("seed %u: %.2g J taken out, %.2g J above the least, %d approximated\n", seed,
                world.taken_out(), most, static_cast<int>(world.approximated()));
  }
}

TEST(BodyWorld, BouncingBallNeverRisesHigher) {
  Table table;
  table.floor({0.0, 0.5, 1.0});
  table.ball(0.02, {0, 0, 0.52}, {0.1, 0.5, 0.9});
  table.begin();
  double highest = 0.0;
  for (int i = 0; i < 6; ++i) {
    const double before = i == 0 ? 0.52 : highest;
    while (table.state().velocity.z() <= 0) table.run(0.001);
    highest = 0.0;
    while (table.state().velocity.z() > 0) {
      table.run(0.001);
      const BodyState& now = table.state();  // plus the height of its kinetic energy
      highest = std::max(highest, now.position.z() + std::pow(now.velocity.z(), 2) / (2 * kG));
    }
    EXPECT_LE(highest, before + 1e-9) << "bounce " << i;
    EXPECT_GT(highest, 0.02 + 0.9 * (before - 0.02))
        << "bounce " << i << ": the greater of 1 and 0.9";
  }
}

TEST(BodyWorld, BulletDoesNotPassAThinWall) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  int passed = 0;
  for (int shot = 0; shot < test::tries(1'000, 10'000); ++shot) {
    Table table;
    table.without_gravity();
    SceneObject& wall = table.box(1.0, {0, 0, 0}, {});
    wall.shape = BoxShape{Vector3d(0.001, 1.0, 1.0)};
    const Eigen::Quaterniond turned(
        Eigen::AngleAxisd(0.5 * any(random), Vector3d(0, any(random), any(random)).normalized()));
    wall.pose.orientation = turned;
    const Vector3d from(-0.3 - 0.1 * std::abs(any(random)), 0.1 * any(random), 0.1 * any(random));
    if (shot % 2 == 0) {
      table.ball(0.005, from, {0.01});
    } else {
      table.box(0.01, from, {0.01});
    }
    BodyWorld& world = table.begin();
    nanoseconds now{1'000'000'000};
    const double speed = 100 * std::abs(any(random)) + 1;
    world.push(0, from, 0.01 * speed / 1e-3 * Vector3d(1, 0.2 * any(random), 0.2 * any(random)));
    // Behind the wall, in the wall's axes.
    const Vector3d normal = turned * Vector3d::UnitX();
    for (int i = 0; i < 600; ++i) {
      world.advance_to(now += (i % 20 == 0 ? 3 : 1) * kStep);
      if (normal.dot(world.states()[0].position) > 0.002) {
        ++passed;
        break;
      }
    }
  }
  EXPECT_EQ(passed, 0);
}

TEST(BodyWorld, IsDeterministic) {
  const auto run = [] {
    Table table;
    table.floor();
    for (int i = 0; i < 8; ++i)
      table.box(0.04, {0.01 * (i % 3), 0.012 * (i % 2), 0.05 + 0.05 * i}, {0.05});
    BodyWorld& world = table.begin();
    nanoseconds now{1'000'000'000};
    Vector3d sum = Vector3d::Zero();
    for (int i = 0; i < 2000; ++i) {
      world.push(static_cast<std::size_t>(i) % 8, world.states()[0].position, {0.1, 0.05, 0});
      world.advance_to(now += kStep);
      for (const BodyState& state : world.states()) sum += state.position + state.turn_rate;
    }
    return sum;
  };
  EXPECT_EQ(run(), run());
}

TEST(BodyWorld, RestsOnAMesh) {
  const test::ScratchFolder folder;
  const std::string file = folder.file("table.obj");
  std::ofstream(file) << "v -1 -1 -0.1\nv 1 -1 -0.1\nv 1 1 -0.1\nv -1 1 -0.1\n"
                         "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\n"
                         "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
  Table table;
  MeshShape mesh;
  mesh.file = file;
  table.floor().shape = mesh;
  table.box(0.04, {0.1, 0.05, 0.06}, {0.1});
  table.ball(0.03, {-0.3, 0.2, 0.06}, {0.2});
  table.begin();
  table.run(1.5);
  EXPECT_NEAR(table.state(0).position.z(), 0.02, 1e-4);
  EXPECT_NEAR(table.state(1).position.z(), 0.03, 1e-4);
}

}  // namespace
}  // namespace reckon::haptics::body_world_test
