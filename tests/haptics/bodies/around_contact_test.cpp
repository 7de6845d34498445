// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Effects around a contact: far bodies change nothing, passing bodies release a hand, and
// overlapping or pinched bodies give no energy.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "reckon/haptics/bodies/body_world.hpp"
#include "reckon/haptics/devices/simulated_device.hpp"
#include "reckon/haptics/servo/servo_loop.hpp"
#include "reckon/tests/support/soak.hpp"

namespace reckon::haptics::around_contact_test {
namespace {

using Eigen::Vector3d;
using std::chrono::nanoseconds;

constexpr nanoseconds kStep = std::chrono::milliseconds(1);

double ease(double t) {
  const double s = std::clamp(t, 0.0, 1.0);
  return s * s * (3.0 - 2.0 * s);
}

/// Objects of a scene.
class Stage {
 public:
  SceneObject& box(const std::string& name, const Vector3d& size, const Vector3d& at,
                   double mass = 0.0, double stiffness = 400) {
    SceneObject& object = scene.objects.emplace_back();
    object.name = name;
    object.shape = BoxShape{size};
    object.pose.position = at;
    object.effects.of<SpringDamper>() = {stiffness, 0.0};
    object.matter.mass = mass;
    return object;
  }
  SceneObject& ball(double radius, const Vector3d& at, double mass) {
    SceneObject& object = box("ball", Vector3d::Ones(), at, mass);
    object.shape = SphereShape{radius};
    return object;
  }
  SceneObject& floor() {
    SceneObject& object = box("floor", Vector3d::Ones(), Vector3d::Zero());
    object.shape = PlaneShape{Vector3d::UnitZ()};
    return object;
  }

  Scene scene;
};

/// Hands of one peer at a stage, on a clock that is stepped.
class Hands {
 public:
  using Path = std::function<Vector3d(double)>;

  Hands(const Stage& stage, const std::vector<Path>& paths, double max_force = 10.0,
        std::shared_ptr<ObjectMover> mover = nullptr)
      : plan_(std::make_shared<const EffectPlan>(stage.scene)),
        world(std::make_shared<BodyWorld>(*plan_, stage.scene.gravity, std::move(mover))) {
    for (const Path& path : paths) {
      SimulatedDeviceConfig config;
      config.mass = 0.1;
      config.damping = 1.0;
      config.hand_stiffness = 300;
      config.hand_damping = 3;
      config.max_force = max_force;
      config.max_speed = 5;
      config.start = path(0.0);
      devices_.push_back(std::make_unique<SimulatedDevice>(config, [path](double t) {
        HandTarget target;
        target.position = path(t);
        return target;
      }));
      servos_.push_back(std::make_unique<ServoLoop>(*devices_.back(), plan_, ServoConfig{}, world));
    }
  }
  void step() {
    for (const auto& servo : servos_) servo->step(now_);
    now_ += kStep;
  }
  [[nodiscard]] ServoSnapshot at(std::size_t hand = 0) {
    static_cast<void>(servos_[hand]->snapshots().update());
    return servos_[hand]->snapshots().read();
  }
  /// Energy that the hand's user and the device's damping took out of the scene [J].
  [[nodiscard]] double got(std::size_t hand = 0) const {
    return -(devices_[hand]->port_work() + devices_[hand]->damping_loss());
  }
  [[nodiscard]] const BodyState& body(std::size_t number) const { return world->states()[number]; }

 private:
  std::shared_ptr<const EffectPlan> plan_;
  std::vector<std::unique_ptr<SimulatedDevice>> devices_;
  std::vector<std::unique_ptr<ServoLoop>> servos_;
  nanoseconds now_{1'000'000'000};

 public:
  std::shared_ptr<BodyWorld> world;
};

// Two fingers close on a cube, carry it by 0.1 m, and a puck slides away on a smooth floor.
Stage carrying() {
  Stage stage;
  stage.floor().matter.friction = 0.0;
  SceneObject& cube = stage.box("cube", Vector3d::Constant(0.04), {0, 0, 0.02}, 0.05);
  cube.effects.of<StickSlipFriction>() = {0.9, 0.8};
  stage.ball(0.02, {0.3, 0, 0.02}, 0.1);
  return stage;
}

std::vector<Hands::Path> fingers() {
  const auto side = [](double way) {
    return [way](double t) {
      const double near = 0.04 - 0.032 * ease((t - 0.2) / 0.5);
      return Vector3d(way * near + 0.1 * ease((t - 0.9) / 2.0), 0, 0.02);
    };
  };
  const auto flick = [](double t) {
    return Vector3d(0.25 + 0.06 * ease((t - 0.1) / 0.2) - 0.1 * ease((t - 0.4) / 0.3), 0, 0.02);
  };
  return {side(-1), side(1), flick};
}

// Bodies at rest, falling, in a heap and carried, far away, by a seed.
void add_far_pile(Stage& stage, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> any(0.0, 1.0);
  for (int i = 0; i < 27; ++i) {
    SceneObject& cube = stage.box("far " + std::to_string(i), Vector3d::Constant(0.04),
                                  {46 + 0.06 * any(random), 0.06 * any(random), 0.05 + 0.07 * i},
                                  0.02 + 5.0 * any(random));
    cube.matter.restitution = seed % 2 == 0 ? 0.0 : 0.3 * any(random);
    cube.pose.orientation =
        Eigen::Quaterniond(1, any(random), any(random), any(random)).normalized();
  }
  for (int i = 0; i < 27; ++i)
    stage.box("heap", Vector3d::Constant(0.04),
              {44 + 0.04 * (i % 3), 0.04 * (i / 3 % 3), 0.03 + 0.04 * (i / 9)}, 0.1);
  stage.ball(0.02, {49, 0, 1.0 + 2.0 * any(random)}, 10.0);
  for (const double z : {0.02, 0.043}) stage.box("deep", Vector3d::Constant(0.04), {47, 3, z}, 0.5);
}

TEST(FarPile, ChangesNeitherForceNorMotionElsewhere) {
  for (unsigned seed = 1; seed <= test::tries(2U, 3U); ++seed) {
    const Stage alone = carrying();
    Stage crowded = carrying();
    add_far_pile(crowded, seed);
    Hands one(alone, fingers()), other(crowded, fingers());
    double force = 0.0, place = 0.0, most = 0.0;
    for (int i = 0; i < 3'000; ++i) {
      one.step();
      other.step();
      for (std::size_t hand = 0; hand < 3; ++hand) {
        force = std::max(force, (one.at(hand).force - other.at(hand).force).norm());
        most = std::max(most, one.at(hand).force.norm());
      }
      for (std::size_t body = 0; body < 2; ++body)
        place = std::max(place, (one.body(body).position - other.body(body).position).norm());
    }
    EXPECT_LE(force, 1e-3) << seed;
    EXPECT_LE(place, 1e-6) << seed;
    EXPECT_GT(most, 1.5) << "the fingers hold it";
    EXPECT_GT(other.world->approximated(), 20U) << "the pile is iterated";
  }
}

TEST(FarPile, LeavesFreeFallUnchanged) {
  Stage stage;
  stage.floor();
  stage.ball(0.02, {0, 0, 40}, 0.3);
  add_far_pile(stage, 4);
  Hands hands(stage, {[](double) { return Vector3d(0, -3, 1); }});
  for (int i = 0; i <= 2'500; ++i) hands.step();
  EXPECT_NEAR(hands.body(0).position.z(), 40 - 0.5 * 9.81 * 2.5 * 2.5, 1e-9);
}

// Kinetic energy, weight, and the energy stored to separate overlapping bodies.
TEST(FarPile, NeverGainsEnergy) {
  for (const unsigned seed : {5u, 6u}) {
    Stage stage;
    stage.floor();
    add_far_pile(stage, seed);
    stage.scene.objects.resize(stage.scene.objects.size() - 2);  // the objects that overlap at the
                                                                 // start
    Hands hands(stage, {[](double) { return Vector3d(0, -3, 1); }});
    double least = hands.world->energy();
    for (int i = 0; i < test::tries(2'000, 4'000); ++i) {
      hands.step();
      ASSERT_LE(hands.world->energy(), least + 1e-3) << seed << ", " << i;
      least = std::min(least, hands.world->energy());
    }
  }
}

// A hand rests on bodies that are pushed apart: the hand gets no energy from that.
TEST(Overlap, AtTheStartGivesAHandNothing) {
  for (const double mass : {0.05, 0.5, 3.0}) {
    for (const double deep : {0.004, 0.017}) {
      Stage stage;
      stage.floor();
      stage.box("under", Vector3d::Constant(0.04), {0, 0, 0.02}, mass);
      stage.box("over", Vector3d::Constant(0.04), {0, 0, 0.06 - deep}, mass);
      stage.box("free", Vector3d::Constant(0.04), {0.5, 0, 0.6}, mass);
      const double top = 0.08 - deep;
      Hands hands(stage,
                  {[top](double t) { return Vector3d(0, 0, top + 0.02 - 0.025 * ease(t / 0.1)); }});
      double most = -1.0;
      for (int i = 0; i < 1'500; ++i) {
        hands.step();
        most = std::max(most, hands.got() - hands.at().loan);
        if (i != 100) continue;
        EXPECT_NEAR(hands.body(2).velocity.z(), -9.81 * 0.1, 1e-9) << "another is free";
      }
      EXPECT_LE(most, 1e-9) << mass << " kg, " << deep << " m deep";
    }
  }
}

/// A mover with a speed of 0.6 m/s.
class Paddle final : public ObjectMover {
 public:
  explicit Paddle(double from) : from_(from) {}
  ObjectMotion motion_of(std::uint32_t, nanoseconds now) noexcept override {
    const double t = 1e-9 * static_cast<double>(now.count()) - 1.0;
    ObjectMotion out;
    out.position = {from_ + 0.6 * std::clamp(t, 0.0, 0.5), 0, 0.05};
    if (t > 0 && t < 0.5) out.velocity.x() = 0.6;
    return out;
  }

 private:
  double from_;
};

TEST(CarriedPaddle, FlingsNoPinchedBody) {
  for (const double mass : {0.05, 1.0}) {
    for (const double turned : {0.0, 0.2, 0.7}) {
      Stage stage;
      stage.floor();
      SceneObject& paddle = stage.box("paddle", {0.02, 0.1, 0.1}, {-0.2, 0, 0.05});
      paddle.carried = true;
      stage.box("post", {0.1, 0.1, 0.1}, {0.1, 0, 0.05});
      SceneObject& cube = stage.box("cube", Vector3d::Constant(0.04), {0, 0.003, 0.021}, mass);
      cube.pose.orientation = Eigen::AngleAxisd(turned, Vector3d::UnitZ());
      Hands hands(stage, {[](double) { return Vector3d(0, -3, 1); }}, 10.0,
                  std::make_shared<Paddle>(-0.2));
      double fastest = 0.0;
      for (int i = 0; i < 1'500; ++i) {
        hands.step();
        fastest = std::max(fastest, hands.body(1).velocity.norm());
      }
      EXPECT_LE(fastest, 0.7) << mass << " kg turned by " << turned;
      EXPECT_GT(fastest, 0.5) << "the paddle takes it along";
    }
  }
}

TEST(PassingBody, ReleasesAHandThatItPassed) {
  for (const double mass : {0.5, 2.0, 5.0, 20.0}) {
    for (const double force : {3.0, 10.0}) {
      for (const double beside : {0.0, 0.03}) {
        if (9.81 * mass < 2.0 * force) continue;  // the hand holds it
        Stage stage;
        stage.box("box", Vector3d::Constant(0.1), {beside, 0, 0.25}, mass, 500);
        Hands hands(stage, {[](double) { return Vector3d::Zero(); }}, force);
        double felt = 0.0, last = 0.0;
        for (int i = 0; i < 2'000; ++i) {
          hands.step();
          const ServoSnapshot& step = hands.at();
          felt = std::max(felt, step.force.norm());
          // Its top is below the hand by the stretch of the greatest force, plus 60 mm.
          if (hands.body(0).position.z() + 0.05 > step.device.z() - force / 500 - 0.06) continue;
          if (i > 400) last = std::max(last, step.force.norm());
        }
        EXPECT_GT(felt, 0.3 * force);
        EXPECT_EQ(last, 0.0) << mass << " kg, " << force << " N, " << beside << " m beside";
        EXPECT_LE(hands.at().tally.passed, 1U);
        EXPECT_LE(hands.got() - hands.at().loan_most, mass * 9.81 * 0.3);
      }
    }
  }
}

// Sampled between two contacts, where the ball's speed and position belong together. The ball's
// additional energy is the energy given by the hand.
TEST(Rebound, FromAHandMakesNoEnergy) {
  for (const double mass : {0.02, 0.1, 0.3}) {
    for (const double drop : {0.03, 0.3}) {
      Stage stage;
      stage.ball(0.02, {0, 0, 0.02 + drop}, mass);
      Hands hands(stage, {[](double) { return Vector3d::Zero(); }});
      double most = -1.0;
      int rebounds = 0;
      bool pushed = false;
      for (int i = 0; i < 2'000; ++i) {
        hands.step();
        const BodyState& ball = hands.body(0);
        const bool pushes = hands.at().force.norm() > 0;
        rebounds += pushed && !pushes ? 1 : 0;
        if (!pushes && !pushed) {
          const double gained =
              mass * (0.5 * ball.velocity.squaredNorm() + 9.81 * (ball.position.z() - 0.02 - drop));
          most = std::max(most, gained + hands.got() - hands.at().loan);
        }
        pushed = pushes;
      }
      EXPECT_GE(rebounds, 1) << mass << " kg from " << drop << " m";
      EXPECT_LE(most, 1e-9) << mass << " kg from " << drop << " m";
    }
  }
}

TEST(PassingBody, ThinBoardStopsAPressedHand) {
  for (const double mass : {0.2, 5.0}) {
    for (const double stiffness : {200.0, 500.0, 1000.0}) {
      Stage stage;
      for (const double x : {-0.1, 0.1}) stage.box("post", {0.02, 0.1, 0.1}, {x, 0, -0.0525});
      stage.box("board", {0.24, 0.1, 0.005}, Vector3d::Zero(), mass, stiffness);
      // The grip of 300 N/m, stretched by 9 N beyond the depth of 9 N.
      const double goal = 0.0025 - 9.0 / stiffness - 9.0 / 300;
      Hands hands(stage, {[goal](double t) {
                    return Vector3d(0, 0, 0.03 + (goal - 0.03) * ease(t / 0.5));
                  }});
      for (int i = 0; i < test::tries(4'000, 10'000); ++i) hands.step();
      EXPECT_EQ(hands.at().tally.passed, 0U) << mass << " kg, " << stiffness << " N/m";
      EXPECT_NEAR(hands.at().force.z(), 9.0, 0.1) << mass << " kg, " << stiffness << " N/m";
    }
  }
}

}  // namespace
}  // namespace reckon::haptics::around_contact_test
