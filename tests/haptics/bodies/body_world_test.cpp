// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Bodies that no hand holds, against closed forms.
#include "reckon/haptics/bodies/body_world.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <random>
#include <stdexcept>
#include <string>
#include <thread>

#include "reckon/haptics/bodies/contact_islands.hpp"
#include "reckon/tests/support/scratch_folder.hpp"

namespace reckon::haptics {
namespace {

using Eigen::Vector3d;
using std::chrono::nanoseconds;

constexpr nanoseconds kStep = std::chrono::milliseconds(1);
constexpr double kG = 9.81;

/// Objects of a scene, and its world on a clock that is stepped.
class Table {
 public:
  /// What is returned lasts until the next one is added.
  SceneObject& box(double edge, const Vector3d& at, Matter matter) {
    SceneObject& object = scene_.objects.emplace_back();
    object.name = "box " + std::to_string(scene_.objects.size());
    object.shape = BoxShape{Vector3d::Constant(edge)};
    object.pose.position = at;
    object.matter = matter;
    return object;
  }
  SceneObject& ball(double radius, const Vector3d& at, Matter matter) {
    SceneObject& object = box(1.0, at, matter);
    object.shape = SphereShape{radius};
    return object;
  }
  SceneObject& floor(Matter matter = {}) {
    SceneObject& object = box(1.0, Vector3d::Zero(), matter);
    object.shape = PlaneShape{Vector3d::UnitZ()};
    return object;
  }
  void without_gravity() { scene_.gravity.setZero(); }
  void within(const Vector3d& size, double restitution) {
    scene_.work_space.size = size;
    scene_.work_space.restitution = restitution;
  }
  BodyWorld& begin() {
    plan_.emplace(scene_);
    world_ = std::make_unique<BodyWorld>(*plan_, scene_.gravity, nullptr, scene_.work_space);
    world_->advance_to(now_);
    return *world_;
  }
  void run(double seconds, nanoseconds step = kStep) {
    const auto steps = std::llround(seconds / (1e-9 * static_cast<double>(step.count())));
    for (long i = 0; i < steps; ++i) world_->advance_to(now_ += step);
  }
  [[nodiscard]] const BodyState& state(std::size_t body = 0) const {
    return world_->states()[body];
  }

 private:
  Scene scene_;
  std::optional<EffectPlan> plan_;
  std::unique_ptr<BodyWorld> world_;
  nanoseconds now_{1'000'000'000};
};

TEST(BodyWorld, AFreeBodyFallsAsTheClosedFormSays) {
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

TEST(BodyWorld, APushGivesForceTimesTimeAndItsWorkIsToldToTheServo) {
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

TEST(BodyWorld, AHeavierOneThatIsHitGoesOnAndTheLighterComesBack) {
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

// As a servo's thread ends before its world does, and another may go on with it.
TEST(BodyWorld, StepsInThreadsThatEndBeforeIt) {
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
TEST(BodyWorld, BoxesThatMeetFaceToFacePartByTheirMassesAndRestitution) {
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
TEST(BodyWorld, ABoxSlidesWithItsFrictionWhateverItsWay) {
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

TEST(BodyWorld, ABoxStaysWhereItsFrictionHoldsIt) {
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

TEST(BodyWorld, AStackOfFiveComesToRestAndSleeps) {
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

// More contacts than the exact solver is asked for.
TEST(BodyWorld, ARowThatTouchesFallsAsleepTogether) {
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
  EXPECT_GT(world.approximated(), 500U);
  EXPECT_LT(alone, 500) << "parts of the row that do not touch, but none is woken for ever";
  for (const BodyState& state : world.states()) {
    EXPECT_FALSE(state.awake);
    EXPECT_NEAR(state.position.z(), 0.02, 3e-5);
  }
}

TEST(ContactIslands, CountByWhatTouches) {
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

TEST(BodyWorld, AHeavyBoxDoesNotSinkIntoALightOne) {
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
    // What the weight of all is worth over the depth at which contacts rest, 10 um.
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

TEST(BodyWorld, ABallThatBouncesNeverRisesHigher) {
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
      highest = std::max(highest, table.state().position.z());
    }
    EXPECT_LE(highest, before + 1e-9) << "bounce " << i;
    EXPECT_GT(highest, 0.02 + 0.9 * (before - 0.02))
        << "bounce " << i << ": the greater of 1 and 0.9";
  }
}

TEST(BodyWorld, ABulletDoesNotPassAThinWall) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  int passed = 0;
  for (int shot = 0; shot < 10'000; ++shot) {
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
    // Behind the wall, in its own axes.
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

TEST(BodyWorld, IsTheSameTwice) {
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

TEST(BodyWorld, LiesOnAMesh) {
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

// A ball between the walls of a work space: each rebound leaves the square of the restitution, of
// each axis, and nothing is ever outside.
TEST(BodyWorld, KeepsBodiesWithinTheWorkSpace) {
  for (const double e : {1.0, 0.9}) {
    for (const double speed : {0.5137, 20.31, 150.7}) {
      Table table;
      table.without_gravity();
      table.within({0.4, 0.3, 0.5}, e);
      table.ball(0.02, Vector3d::Zero(), {0.1});
      BodyWorld& world = table.begin();
      world.push(0, Vector3d::Zero(), 0.1 * speed / 1e-3 * Vector3d::UnitX());
      table.run(0.001);
      const double begin = world.energy();
      int rebounds = 0;
      for (int i = 0; i < 2000; ++i) {
        const double before = table.state().velocity.x(), at = table.state().position.x();
        table.run(0.001);
        const Vector3d& p = table.state().position;
        ASSERT_LE(std::abs(p.x()), 0.18 + 1e-15) << speed;
        // Walls that it met in this step, from where it was.
        double v = before, x = at, left = 1e-3;
        while (v != 0 && (v > 0 ? 0.18 - x : x + 0.18) < std::abs(v) * left) {
          left -= (v > 0 ? 0.18 - x : x + 0.18) / std::abs(v);
          x = v > 0 ? 0.18 : -0.18;
          v *= -e;
          ++rebounds;
        }
        ASSERT_NEAR(world.energy() / (begin * std::pow(e, 2 * rebounds)), 1.0, 1e-9) << rebounds;
      }
      EXPECT_GT(rebounds, 1);
    }
  }
}

TEST(BodyWorld, HoldsTumblingBoxesInTheWorkSpaceTooWithWeight) {
  Table table;
  table.within({0.4, 0.3, 0.5}, 0.7);
  for (int i = 0; i < 8; ++i)
    table.box(0.04, Vector3d(0.05 * (i % 4) - 0.08, 0.06 * (i / 4), 0), {0.1});
  BodyWorld& world = table.begin();
  for (std::size_t i = 0; i < 8; ++i)
    world.push(i, table.state(i).position + Vector3d(0, 0.01, 0.02),
               Vector3d(40.0 - 9.0 * static_cast<double>(i), 30, 50));
  double last = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 5000; ++i) {
    table.run(0.001);
    ASSERT_LE(world.energy(), last + 1e-3) << i;
    last = std::min(last, world.energy());
    for (std::size_t k = 0; k < 8; ++k)
      ASSERT_TRUE((table.state(k).position.array().abs() <= Eigen::Array3d(0.2, 0.15, 0.25)).all());
  }
}

TEST(BodyWorld, SlowsABodyByItsDrag) {
  Table table;
  table.ball(0.02, {0, 0, 1}, {0.1, 0.5, 0.0, 0.05});
  table.begin();
  table.run(1.0);
  const double c = 0.5, t = 1.0;
  EXPECT_NEAR(table.state().velocity.z(), -kG / c * (1 - std::exp(-c * t)), 1e-9);
  EXPECT_NEAR(table.state().position.z(), 1 - kG / c * (t - (1 - std::exp(-c * t)) / c), 1e-9);
}

TEST(BodyWorld, RefusesWhatCannotMoveByName) {
  Table plane;
  plane.floor({1.0});
  EXPECT_THROW(plane.begin(), std::invalid_argument);
}

}  // namespace
}  // namespace reckon::haptics
