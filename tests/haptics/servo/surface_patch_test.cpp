// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A mesh that feels otherwise from place to place: which patch is felt, how a hand goes over a
// border, and that nobody gets energy out of one.
#include <gtest/gtest.h>

#include <cstdio>
#include <random>

#include "reckon/haptics/servo/servo_loop.hpp"
#include "reckon/tests/support/mesh_text.hpp"

namespace reckon::haptics {
namespace {

using Eigen::Vector3d;
using std::chrono::nanoseconds;
using namespace std::chrono_literals;
using test::TemporaryMesh;

constexpr double kPeriod = 1e-3;   // [s]
constexpr double kDamping = 1.0;   // [N s/m], of the device
constexpr double kSoft = 200.0;    // [N/m], where x < 0
constexpr double kHard = 900.0;    // [N/m], where x > 0

// A slab of 200 x 100 x 20 mm whose top is at z = 0: soft where x < 0, hard where x > 0, its sides
// and its bottom of no material.
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
  return {{"soft", {kSoft, 0.0}, rough(friction_soft)}, {"hard", {kHard, 0.0}, rough(friction_hard)}};
}

/// Goes where it is told, and keeps books of its own: what the force took from whoever moves it,
/// and what its sure damping takes.
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

  /// One servo step after the finger went to p.
  const ServoSnapshot& step(const Vector3d& p) {
    const Vector3d dx = p - finger_.position;
    const Vector3d before = finger_.held;
    energy += -before.dot(dx) + kDamping * dx.squaredNorm() / kPeriod;
    least = std::min(least, energy);
    finger_.position = p;
    servo.step(now_ += 1ms);
    servo.snapshots().update();
    largest_step = std::max(largest_step, (finger_.held - before).norm());
    return servo.snapshots().read();
  }

  /// In a straight line at `speed` [m/s].
  void go(const Vector3d& to, double speed) {
    const Vector3d from = finger_.position;
    const int steps = std::max(1, static_cast<int>(std::ceil((to - from).norm() / (speed * kPeriod))));
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

 public:
  ServoLoop servo;
  double energy = 0.0, least = 0.0;  // [J]
  double largest_step = 0.0;         // [N]
};

TEST(SurfacePatch, IsNumberedAsTheFileSaysItsNameWhateverASceneDeclaresFirst) {
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

// The face that is touched first is felt as it is, without a blend.
TEST(SurfacePatch, IsFeltAsItIsFromTheFirstTouchOn) {
  const TemporaryMesh mesh(".obj", kSlab);
  Bench bench(slab(mesh, soft_and_hard()));
  for (const double x : {-0.03, 0.03, -0.03}) {
    bench.go({x, 0, 0.01}, 0.5);
    bench.go({x, 0, -0.003}, 0.1);
    EXPECT_NEAR(bench.force().z(), (x < 0 ? kSoft : kHard) * 0.003, 1e-3);
    bench.go({x, 0, 0.01}, 0.5);
  }
}

// Without a blend the force would step by 700 N/m x depth: 0.7 to 4.2 N.
TEST(SurfacePatch, ABorderIsCrossedWithoutAStepInTheForce) {
  const TemporaryMesh mesh(".obj", kSlab);
  double worst = 0.0, change = 0.0;
  for (const double depth : {0.001, 0.003, 0.006}) {
    for (const double speed : {0.02, 0.1, 0.3, 0.5}) {
      for (const double mu : {0.0, 0.6}) {
        Bench bench(slab(mesh, soft_and_hard(mu, 0.5 * mu)));
        for (int i = 0; i < 4; ++i) bench.go({-0.06, 0.01 * (i % 2), 0.05}, 0.5);
        bench.go({-0.06, 0, -depth}, 0.05);
        bench.go({-0.05, 0, -depth}, speed);
        bench.largest_step = 0.0;
        const double soft = bench.force().norm();
        bench.go({0.05, 0, -depth}, speed);
        bench.rest(100);
        change = std::max(change, bench.force().norm() - soft);
        bench.go({0.04, 0, -depth}, speed);
        worst = std::max(worst, bench.largest_step);
        bench.largest_step = 0.0;
        bench.go({-0.05, 0, -depth}, speed);
        bench.rest(100);
        EXPECT_LE(bench.largest_step, 0.2) << depth << " m, " << speed << " m/s, back";
        worst = std::max(worst, bench.largest_step);
        EXPECT_LE(worst, 0.2) << depth << " m, " << speed << " m/s, friction " << mu;
        EXPECT_GE(bench.least, -1e-9);
      }
    }
  }
  EXPECT_GT(change, 2.0) << "[N]; else nothing is crossed";
  std::printf("largest step %.3f N, of a change of %.1f N\n", worst, change);
}

// Spring k x depth, 100 ms after the hand came to rest.
TEST(SurfacePatch, TheForceIsRightATenthOfASecondAfterTheHandCameToRest) {
  const TemporaryMesh mesh(".obj", kSlab);
  double worst = 0.0;
  for (const double depth : {0.001, 0.002, 0.003, 0.005}) {
    for (const double speed : {0.03, 0.1, 0.3}) {
      Bench bench(slab(mesh, soft_and_hard()));
      bench.go({-0.03, 0, 0.02}, 0.2);
      bench.go({-0.03, 0, -depth}, 0.1);
      for (int i = 0; i < 4; ++i) {
        const double x = i % 2 == 0 ? 0.03 : -0.03;
        bench.go({x, 0, -depth}, speed);
        bench.rest(100);
        const double right = (x < 0 ? kSoft : kHard) * depth;
        std::printf("depth %.0f mm speed %.2f i %d: %.4f of %.4f N, walls %.3f s\n", 1e3 * depth, speed, i, bench.force().z(), right, bench.snapshot().tally.walls.seconds);
        worst = std::max(worst, std::abs(bench.force().z() - right) / right);
      }
    }
  }
  EXPECT_LE(worst, 0.01);
}

}  // namespace
}  // namespace reckon::haptics
