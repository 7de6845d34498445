// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Bodies that collide at any angle and speed, against the closed form of an impulse.
#include "reckon/haptics/bodies/impacts.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <random>

#include "reckon/haptics/bodies/body_world.hpp"
#include "reckon/tests/support/soak.hpp"

namespace reckon::haptics::impacts_test {
namespace {

using Eigen::Vector3d;
using std::chrono::nanoseconds;

struct Thrown {
  Vector3d at, velocity;
  double mass = 0.1, radius = 0.02;
};

Scene scene_of(const std::array<Thrown, 2>& balls, double restitution) {
  Scene scene;
  scene.gravity.setZero();
  for (const Thrown& ball : balls) {
    SceneObject& object = scene.objects.emplace_back();
    object.name = "ball " + std::to_string(scene.objects.size());
    object.shape = SphereShape{ball.radius};
    object.pose.position = ball.at;
    object.matter = {ball.mass, 0.0, restitution};
  }
  return scene;
}

/// Two colliding balls, after `seconds`.
std::array<BodyState, 2> after(const std::array<Thrown, 2>& balls, double restitution,
                               double seconds) {
  const Scene scene = scene_of(balls, restitution);
  const EffectPlan plan(scene);
  BodyWorld world(plan, scene.gravity);
  nanoseconds now{1'000'000'000};
  world.advance_to(now);
  for (std::size_t i = 0; i < 2; ++i)
    world.push(i, balls[i].at, balls[i].mass / 1e-3 * balls[i].velocity);
  for (int i = 0; i < std::lround(1e3 * seconds); ++i)
    world.advance_to(now += std::chrono::milliseconds(1));
  return {world.states()[0], world.states()[1]};
}

// The speeds after the collision, in closed form; none if they miss.
std::optional<std::array<Vector3d, 2>> impulse(const std::array<Thrown, 2>& balls,
                                               double restitution) {
  const Vector3d apart = balls[1].at - balls[0].at, closing = balls[0].velocity - balls[1].velocity;
  const double reach = balls[0].radius + balls[1].radius;
  const double a = closing.squaredNorm(), b = apart.dot(closing);
  const double root = b * b - a * (apart.squaredNorm() - reach * reach);
  if (!(root > 0)) return std::nullopt;
  const double time = (b - std::sqrt(root)) / a;
  const Vector3d normal = (apart - time * closing).normalized();
  const double size =
      (1 + restitution) * closing.dot(normal) / (1 / balls[0].mass + 1 / balls[1].mass);
  return std::array<Vector3d, 2>{balls[0].velocity - size / balls[0].mass * normal,
                                 balls[1].velocity + size / balls[1].mass * normal};
}

double angle(const Vector3d& a, const Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b)) * 180 / std::numbers::pi;
}

TEST(Impacts, DeflectObliqueBallsAsTheImpulse) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  int hits = 0;
  double worst_angle = 0.0, worst_speed = 0.0, worst_momentum = 0.0, gained = -1.0;
  for (int i = 0; i < 600; ++i) {
    const double restitution = i % 3 == 0 ? 0.0 : 0.5 + 0.5 * any(random);
    std::array<Thrown, 2> balls;
    const double speed = 3.0 + 2.0 * any(random);
    for (std::size_t k = 0; k < 2; ++k) {
      balls[k].radius = 0.02 + 0.015 * any(random);
      balls[k].mass = std::pow(10.0, -1.0 + any(random));
    }
    balls[0].at = {-0.2, 0, 0};
    balls[0].velocity = {speed, 0, 0};
    const double reach = balls[0].radius + balls[1].radius;
    balls[1].at = {0, 0.95 * reach * any(random), 0};
    if (i % 2 == 0) balls[1].velocity = {0, 0, 0.2 * any(random)};
    const auto right = impulse(balls, restitution);
    if (!right) continue;
    ++hits;
    const std::array<BodyState, 2> got = after(balls, restitution, 0.4);
    Vector3d momentum = Vector3d::Zero();
    double before = 0.0, now = 0.0;
    for (std::size_t k = 0; k < 2; ++k) {
      const Vector3d& v = got[k].velocity;
      worst_speed = std::max(worst_speed, (v - (*right)[k]).norm() / speed);
      if ((*right)[k].norm() > 0.05 * speed)
        worst_angle = std::max(worst_angle, angle(v, (*right)[k]));
      momentum += balls[k].mass * (v - balls[k].velocity);
      before += 0.5 * balls[k].mass * balls[k].velocity.squaredNorm();
      now += 0.5 * balls[k].mass * v.squaredNorm();
    }
    worst_momentum = std::max(worst_momentum, momentum.norm());
    gained = std::max(gained, now - before);
  }
  std::printf("%d impacts: %.3g of the speed, %.3g deg, %.3g N s, gained %.3g J\n", hits,
              worst_speed, worst_angle, worst_momentum, gained);
  EXPECT_GT(hits, 500);
  EXPECT_LT(worst_speed, 0.02);
  EXPECT_LT(worst_angle, 2.0);
  EXPECT_LT(worst_momentum, 1e-8);
  EXPECT_LT(gained, 1e-9);
}

TEST(Impacts, CatchEveryFastPair) {
  std::mt19937 random(12);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  int passed = 0;
  for (int i = 0; i < 300; ++i) {
    std::array<Thrown, 2> balls;
    const double speed = i % 2 == 0 ? 20.0 : 50.0 + 45.0 * any(random);
    for (std::size_t k = 0; k < 2; ++k) {
      const double way = k == 0 ? -1.0 : 1.0;
      balls[k].radius = i % 2 == 0 ? 0.005 : 0.006 + 0.004 * any(random);
      balls[k].at = {way * (0.5 + 0.05 * any(random)), 0.002 * any(random), 0.002 * any(random)};
      balls[k].velocity = {-way * speed, 0, 0};
    }
    if (!impulse(balls, 1.0)) continue;
    const auto got = after(balls, 1.0, 0.1);
    passed += got[0].position.x() > got[1].position.x() ? 1 : 0;
  }
  EXPECT_EQ(passed, 0);
}

// A ball hits a box or a cylinder at rest, at any point: momentum is conserved, energy does not
// grow.
TEST(Impacts, KeepMomentumOfBoxesAndCylinders) {
  std::mt19937 random(13);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  double worst = 0.0, gained = -1.0;
  for (int i = 0; i < test::tries(80, 200); ++i) {
    Scene scene = scene_of({Thrown{{-0.2, 0, 0}, {}, 0.1, 0.015}, Thrown{}}, 0.6);
    SceneObject& other = scene.objects[1];
    if (i % 2 == 0) {
      other.shape = BoxShape{Vector3d(0.04, 0.06, 0.03)};
    } else {
      other.shape = CylinderShape{0.02, 0.05};
    }
    other.matter.mass = 0.2;
    other.matter.friction = scene.objects[0].matter.friction = 0.3;
    other.pose.orientation =
        Eigen::Quaterniond(any(random), any(random), any(random), 1).normalized();
    other.pose.position = {0, 0.02 * any(random), 0.02 * any(random)};
    const EffectPlan plan(scene);
    BodyWorld world(plan, scene.gravity);
    nanoseconds now{1'000'000'000};
    world.advance_to(now);
    const double speed = 5.0 + 4.0 * any(random);
    world.push(0, {-0.2, 0, 0}, {0.1 / 1e-3 * speed, 0, 0});
    double most = 0.0;
    for (int k = 0; k < 200; ++k) {
      world.advance_to(now += std::chrono::milliseconds(1));
      if (k == 0) most = world.energy();
      gained = std::max(gained, world.energy() - most);
      const Vector3d p = 0.1 * world.states()[0].velocity + 0.2 * world.states()[1].velocity;
      worst = std::max(worst, (p - Vector3d(0.1 * speed, 0, 0)).norm());
    }
  }
  EXPECT_LT(worst, 1e-6);
  EXPECT_LT(gained, 1e-9);
}

}  // namespace
}  // namespace reckon::haptics::impacts_test
