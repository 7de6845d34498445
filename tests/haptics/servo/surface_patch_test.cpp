// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A mesh with different patches: the patch that is felt, the crossing of a border, and the absence
// of energy gain.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <optional>
#include <random>
#include <utility>
#include <vector>

#include "reckon/haptics/devices/simulated_device.hpp"
#include "reckon/haptics/servo/servo_loop.hpp"
#include "reckon/tests/support/mesh_text.hpp"
#include "reckon/tests/support/soak.hpp"

namespace reckon::haptics {
namespace {

using Eigen::Vector3d;
using std::chrono::nanoseconds;
using namespace std::chrono_literals;
using test::TemporaryMesh;

constexpr double kPeriod = 1e-3;  // [s]
constexpr double kDamping = 1.0;  // [N s/m], of the device
constexpr double kSoft = 200.0;   // [N/m], for x < 0
constexpr double kHard = 900.0;   // [N/m], for x > 0

// A slab of 200 x 100 x 20 mm with its top at z = 0: soft for x < 0, hard for x > 0, its sides and
// its bottom without a material.
const char* const kSlab =
    "v -0.1 -0.05 0\nv 0 -0.05 0\nv 0.1 -0.05 0\nv -0.1 0.05 0\nv 0 0.05 0\nv 0.1 0.05 0\n"
    "v -0.1 -0.05 -0.02\nv 0 -0.05 -0.02\nv 0.1 -0.05 -0.02\n"
    "v -0.1 0.05 -0.02\nv 0 0.05 -0.02\nv 0.1 0.05 -0.02\n"
    "f 7 10 11 8\nf 8 11 12 9\nf 1 7 8 2\nf 2 8 9 3\nf 4 5 11 10\nf 5 6 12 11\nf 1 4 10 7\n"
    "f 3 9 12 6\n"
    "usemtl soft\nf 1 2 5 4\nusemtl hard\nf 2 3 6 5\n";

Scene slab(const TemporaryMesh& mesh, std::vector<SurfacePatch> patches) {
  Scene scene;
  scene.objects.resize(1);
  scene.objects[0].name = "slab";
  scene.objects[0].shape = MeshShape{mesh.path(), 0.0, false};
  scene.objects[0].patches = std::move(patches);
  return scene;
}

std::vector<SurfacePatch> soft_and_hard(double friction_soft = 0.0, double friction_hard = 0.0) {
  const auto rough = [](double mu) {
    return mu > 0 ? std::optional(Friction{mu, mu}) : std::nullopt;
  };
  return {{"soft", {kSoft, 0.0}, rough(friction_soft)},
          {"hard", {kHard, 0.0}, rough(friction_hard)}};
}

/// Moves as commanded, and keeps its own ledger: the energy that the force took from its mover, and
/// the loss of its sure damping.
class Finger : public HapticDevice {
 public:
  [[nodiscard]] DeviceLimits limits() const noexcept override {
    DeviceLimits limits;
    limits.max_force = 50.0;
    limits.damping = kDamping;
    limits.max_speed = 100.0;
    return limits;
  }
  [[nodiscard]] DeviceSample read(nanoseconds) noexcept override {
    DeviceSample sample;
    sample.position = position;
    sample.ok = true;
    return sample;
  }
  void write(const Vector3d& force, nanoseconds) noexcept override { held = force; }

  Vector3d position{0, 0, 0.05};
  Vector3d held = Vector3d::Zero();
};

class Bench {
 public:
  explicit Bench(const Scene& scene, ServoConfig config = {})
      : servo(finger_, EffectPlan(scene), config) {
    step(finger_.position);
  }

  /// One servo step after the finger moved to p.
  const ServoSnapshot& step(const Vector3d& p) {
    const Vector3d dx = p - finger_.position;
    const Vector3d before = finger_.held;
    energy += -before.dot(dx) + kDamping * dx.squaredNorm() / kPeriod;
    least = std::min(least, energy);
    finger_.position = p;
    servo.step(now_ += 1ms);
    servo.snapshots().update();
    const Vector3d change = finger_.held - before;
    largest_step = std::max(largest_step, change.norm());
    largest_bend = std::max(largest_bend, (change - change_).norm());
    change_ = change;
    return servo.snapshots().read();
  }

  /// In a straight line at `speed` [m/s].
  void go(const Vector3d& to, double speed) {
    const Vector3d from = finger_.position;
    const int steps =
        std::max(1, static_cast<int>(std::ceil((to - from).norm() / (speed * kPeriod))));
    for (int i = 1; i <= steps; ++i) step(from + (to - from) * i / steps);
  }
  void rest(int steps) {
    for (int i = 0; i < steps; ++i) step(finger_.position);
  }
  [[nodiscard]] const Vector3d& force() const { return finger_.held; }
  [[nodiscard]] const ServoSnapshot& snapshot() { return servo.snapshots().read(); }

 private:
  Finger finger_;
  nanoseconds now_{0};
  Vector3d change_ = Vector3d::Zero();  // [N], in the last step

 public:
  ServoLoop servo;
  double energy = 0.0, least = 0.0;  // [J]
  double largest_step = 0.0;         // [N], of the force
  double largest_bend = 0.0;         // [N], difference of two consecutive steps
};

TEST(SurfacePatch, IsNumberedInTheOrderOfTheFile) {
  const TemporaryMesh mesh(".obj", kSlab);
  std::vector<SurfacePatch> turned = soft_and_hard();
  std::swap(turned[0], turned[1]);
  Bench one(slab(mesh, soft_and_hard())), other(slab(mesh, turned));
  for (Bench* peer : {&one, &other}) {
    peer->go({-0.03, 0.01, -0.002}, 0.2);
    EXPECT_EQ(peer->snapshot().mesh_patch, 1u);
    peer->go({0.03, 0.01, -0.002}, 0.2);
    EXPECT_EQ(peer->snapshot().mesh_patch, 2u);
    peer->go({0.097, 0.01, -0.008}, 0.2);
    peer->go({0.097, 0.01, -0.009}, 0.2);
    EXPECT_EQ(peer->snapshot().mesh_patch, 2u);
    peer->go({0.03, 0.01, 0.01}, 0.2);
    EXPECT_EQ(peer->snapshot().mesh_patch, 0u) << "touches nothing";
    peer->go({0.11, 0.01, 0.01}, 0.2);
    peer->go({0.11, 0.01, -0.01}, 0.2);
    peer->go({0.098, 0.01, -0.01}, 0.2);
    EXPECT_EQ(peer->snapshot().mesh_patch, 0u) << "a side, of no material";
    EXPECT_NEAR(peer->force().x(), 800.0 * 0.002, 1e-3) << "as the object itself";
  }
}

// The face that is touched first is felt without a blend.
TEST(SurfacePatch, IsFeltUnblendedFromTheFirstTouch) {
  const TemporaryMesh mesh(".obj", kSlab);
  Bench bench(slab(mesh, soft_and_hard()));
  for (const double x : {-0.03, 0.03, -0.03}) {
    bench.go({x, 0, 0.01}, 0.5);
    bench.go({x, 0, -0.003}, 0.1);
    EXPECT_NEAR(bench.force().z(), (x < 0 ? kSoft : kHard) * 0.003, 1e-3);
    bench.go({x, 0, 0.01}, 0.5);
  }
}

// A probe with a radius, in the edge between the slab and a wall along it: both hold the contact
// point, each with its own spring.
TEST(SurfacePatch, IsFeltBesideAnotherObject) {
  const TemporaryMesh mesh(".obj", kSlab);
  constexpr double kRadius = 0.002;
  Scene scene = slab(mesh, soft_and_hard());
  SceneObject& wall = scene.objects.emplace_back();
  wall.name = "wall";
  wall.shape = PlaneShape{Vector3d::UnitY()};
  wall.effects.of<SpringDamper>() = {400.0, 0.0};
  Bench bench(scene, {.contact_radius = kRadius});
  bench.go({-0.03, 0.02, 0.05}, 0.2);
  bench.go({-0.03, 0.02, kRadius - 0.003}, 0.1);
  EXPECT_NEAR(bench.force().z(), kSoft * 0.003, 1e-3);
  bench.go({-0.03, kRadius - 0.002, kRadius - 0.003}, 0.1);
  for (const double x : {0.03, -0.03}) {
    bench.go({x, kRadius - 0.002, kRadius - 0.003}, 0.1);
    bench.rest(100);
    EXPECT_NEAR(bench.force().y(), 400.0 * 0.002, 1e-3);
    EXPECT_NEAR(bench.force().z(), (x < 0 ? kSoft : kHard) * 0.003, 0.01);
    EXPECT_EQ(bench.snapshot().mesh_patch, x < 0 ? 1u : 2u);
  }
  EXPECT_GE(bench.least, -1e-9);
}

// Without a blend the force would step by 700 N/m x depth: 0.7 to 4.2 N. At the beginning of a
// stroke with friction the motion itself stretches the spring by more: that part is skipped.
TEST(SurfacePatch, BorderIsCrossedWithoutAForceStep) {
  const TemporaryMesh mesh(".obj", kSlab);
  double worst = 0.0, change = 0.0;
  for (const double depth : {0.001, 0.003, 0.006}) {
    for (const double speed : {0.02, 0.1, 0.3, 0.5}) {
      for (const double mu : {0.0, 0.6}) {
        Bench bench(slab(mesh, soft_and_hard(mu, 0.5 * mu)));
        for (int i = 0; i < 4; ++i) bench.go({-0.06, 0.01 * (i % 2), 0.05}, 0.5);
        bench.go({-0.06, 0, -depth}, 0.05);
        double before = bench.force().norm();
        for (const double x : {0.06, -0.06, 0.06}) {
          bench.go({-0.5 * x, 0, -depth}, speed);
          bench.largest_step = bench.largest_bend = 0.0;
          bench.go({x, 0, -depth}, speed);
          bench.rest(100);
          worst = std::max(worst, bench.largest_step);
          EXPECT_LE(bench.largest_step, 0.2)
              << depth << " m, " << speed << " m/s, friction " << mu << ", to " << x;
          // The rate continues without a step: dt/lag of it per sample, twice.
          EXPECT_LE(bench.largest_bend, 0.01 * 1.2 * 700.0 * depth)
              << depth << " m, " << speed << " m/s, friction " << mu << ", to " << x;
          change = std::max(change, std::abs(bench.force().norm() - before));
          before = bench.force().norm();
        }
        EXPECT_GE(bench.least, -1e-9);
      }
    }
  }
  EXPECT_GT(change, 4.0) << "[N]; else nothing is crossed";
  std::printf("largest step %.3f N, of a change of %.1f N\n", worst, change);
}

// Spring k x depth, 100 ms after the hand came to rest. The loss of the device's friction on the
// way there pays for it.
TEST(SurfacePatch, ForceIsCorrectATenthSecondLater) {
  const TemporaryMesh mesh(".obj", kSlab);
  double worst = 0.0;
  for (const double depth : {0.001, 0.002, 0.003, 0.005}) {
    for (const double speed : {0.03, 0.1, 0.3}) {
      Bench bench(slab(mesh, soft_and_hard()));
      bench.go({-0.03, 0, 0.02}, 0.2);
      bench.go({-0.03, 0, -depth}, 0.1);
      for (const double x : {0.03, -0.03, 0.03, 0.005, -0.005, 0.005}) {
        bench.go({x, 0, -depth}, speed);
        bench.rest(100);
        const double right = (x < 0 ? kSoft : kHard) * depth;
        EXPECT_NEAR(bench.force().z(), right, 0.01 * right) << depth << " m, " << speed << " m/s";
        EXPECT_NEAR(bench.force().head<2>().norm(), 0.0, 1e-9);
        worst = std::max(worst, std::abs(bench.force().z() - right) / right);
      }
      EXPECT_EQ(bench.snapshot().tally.walls.seconds, 0.0);
    }
  }
  std::printf("off by %.2f %% at most\n", 100.0 * worst);
}

// A hand with a grip, to and fro over the border, then at rest on either side: springs in series.
TEST(SurfacePatch, HeldDeviceRestsWithItsSidesForce) {
  const TemporaryMesh mesh(".obj", kSlab);
  constexpr double kDepth = 0.012;  // [m], of the grip's target
  for (const double end : {-0.02, 0.02}) {
    SimulatedDeviceConfig config;
    config.start = {end, 0, 0.03};
    SimulatedDevice device(config, [end](double t) {
      HandTarget hand;
      hand.position.x() = t < 3.0 ? end * std::cos(2.0 * std::numbers::pi * t) : end;
      hand.position.z() = std::max(-kDepth, 0.03 - 0.1 * t);
      return hand;
    });
    ServoLoop servo(device, EffectPlan(slab(mesh, soft_and_hard(0.2, 0.1))), {});
    double least = 0.0, largest_step = 0.0;
    for (int i = 0; i <= 3100; ++i) {
      const Vector3d before = device.force();
      servo.step(i * 1ms);
      least = std::min(least, device.port_work() + device.damping_loss());
      largest_step = std::max(largest_step, (device.force() - before).norm());
    }
    const double stiffness = end < 0 ? kSoft : kHard;
    const double right = kDepth / (1.0 / stiffness + 1.0 / config.hand_stiffness);
    EXPECT_NEAR(device.force().z(), right, 0.01 * right) << "at " << end;
    EXPECT_GE(least, -1e-9);
    EXPECT_LE(largest_step, 0.2);
  }
}

// A hand that did almost no work before it crosses the border has put in too little for the hard
// side: it feels the paid part, this is reported, and it feels the full force after it has pressed
// again.
TEST(SurfacePatch, UnpaidForceIsNotRenderedButReported) {
  const TemporaryMesh mesh(".obj", kSlab);
  constexpr double kDepth = 0.008;
  Bench bench(slab(mesh, soft_and_hard()));
  bench.go({-0.002, 0, 0.0505}, 0.02);
  // Lowered so slowly that the device's friction takes nothing.
  bench.go({-0.002, 0, -kDepth}, 1e-3);
  bench.go({0.002, 0, -kDepth}, 1e-3);
  bench.rest(200);
  const double lacking = bench.force().z();
  EXPECT_GT(lacking, 1.01 * kSoft * kDepth);
  EXPECT_LT(lacking, 0.9 * kHard * kDepth);
  const Shortfall& told = bench.snapshot().tally.walls;
  EXPECT_GT(told.seconds, 0.2);
  EXPECT_NEAR(told.asked, kHard * kDepth, 0.05 * kHard * kDepth);
  bench.go({0.002, 0, 0.01}, 0.1);
  bench.go({0.002, 0, -kDepth}, 0.1);
  EXPECT_NEAR(bench.force().z(), kHard * kDepth, 0.01 * kHard * kDepth);
  EXPECT_GE(bench.least, -1e-9);
}

// 700 N/m more at 5 mm would be 8.75 mJ a round if growing springs were free. Rounds that take it:
// down on the soft side, over the border, up on the hard one; every fourth stroke is random.
TEST(SurfacePatch, StrokesOverABorderMakeNoEnergy) {
  const TemporaryMesh mesh(".obj", kSlab);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(0.0, 1.0);
  for (const double mu : {0.0, 0.5}) {
    Bench bench(slab(mesh, soft_and_hard(mu, 0.3 * mu)));
    bench.go({-0.001, 0, 0.0005}, 0.01);
    const int strokes = test::tries(8'000, 50'000);
    int crossings = 0;
    double x = -0.001, depth = 0.0, most = 0.0;
    for (int stroke = 0; stroke < strokes; ++stroke) {
      const double before = x;
      const double reach = 0.0005 + 0.001 * any(random);
      if (stroke % 4 == 0) depth = 0.003 + 0.003 * any(random);
      if (stroke % 4 == 1) x = reach;
      if (stroke % 4 == 2) depth = -0.0005 + 0.001 * any(random);
      if (stroke % 4 == 3) x = -reach;
      if (any(random) < 0.25) {
        x = 0.003 * (any(random) - 0.5);
        depth = 0.006 * any(random);
      }
      bench.go({x, 0.001 * any(random), -depth}, 0.02 * std::pow(10.0, any(random)));
      if (x * before < 0) ++crossings;
      most = std::max(most, bench.force().norm());
    }
    EXPECT_GE(bench.least, -1e-9) << "[J], friction " << mu;
    EXPECT_GE(bench.snapshot().port_energy_min, -1e-9);
    EXPECT_GT(crossings, strokes / 5 * 2);
    EXPECT_GT(most, 4.0) << "[N]";
    std::printf("friction %.1f: least energy %.2g J in %d crossings, up to %.1f N\n", mu,
                bench.least, crossings, most);
  }
}

// The most profitable hand: slow, down on the soft side, up on the hard one, and back through the
// air. Without the bound each round would give it 5 mJ.
TEST(SurfacePatch, BestRoundForAThiefGainsNothing) {
  const TemporaryMesh mesh(".obj", kSlab);
  Bench bench(slab(mesh, soft_and_hard()));
  bench.go({-0.001, 0, 0.0005}, 0.01);
  double gained = 0.0;
  for (int round = 0; round < 100; ++round) {
    const double before = bench.energy;
    bench.go({-0.001, 0, -0.004}, 0.01);
    bench.go({0.001, 0, -0.004}, 0.01);
    bench.rest(50);
    bench.go({0.001, 0, 0.0005}, 0.01);
    bench.go({-0.001, 0, 0.0005}, 0.01);
    gained = std::max(gained, before - bench.energy);
  }
  EXPECT_GE(bench.least, -1e-9);
  EXPECT_GE(bench.energy, -1e-9) << "over all rounds";
  std::printf("most of a round %.3g J, least energy %.2g J\n", gained, bench.least);
}

}  // namespace
}  // namespace reckon::haptics
