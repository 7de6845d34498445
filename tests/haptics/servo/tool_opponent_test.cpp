// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// An opponent that reports arbitrary poses gets no energy out of a servo of six axes.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstdio>
#include <random>
#include <stdexcept>
#include <vector>

#include "reckon/haptics/contact/tool.hpp"
#include "reckon/haptics/devices/simulated_device.hpp"
#include "reckon/haptics/scene/effect_plan.hpp"
#include "reckon/haptics/servo/servo_loop.hpp"
#include "reckon/tests/haptics/support/tool_scenes.hpp"

namespace reckon::haptics::tool_opponent_test {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;
using std::chrono::nanoseconds;
using turning::floor_at;
using turning::kPeriod;
using turning::turn;

/// A massless handle moved by an opponent. It puts in almost nothing: it presses and twists by
/// microns from the surface, and releases along the direction that takes most energy out of the
/// held force and torque.
class Opponent : public HapticDevice {
 public:
  /// @param start of the handle  @param claim its damping times this is the stated one
  Opponent(unsigned seed, const Vector3d& start, double claim)
      : random_(seed), claim_(claim), start_(start), position_(start) {
    damping_ = {0.3 + any(0, 1.5), 0.002 * std::pow(20.0, any(0, 1))};
  }

  [[nodiscard]] DeviceLimits limits() const noexcept override {
    DeviceLimits limits;
    limits.axes = 6;
    limits.max_force = 10.0;
    limits.max_torque = 0.5;
    limits.damping = claim_ * damping_.translation;
    limits.turn_damping = claim_ * damping_.rotation;
    limits.max_speed = 10.0;
    return limits;
  }
  [[nodiscard]] DeviceSample read(nanoseconds /*now*/) noexcept override {
    move();
    DeviceSample sample;
    sample.ok = true;
    sample.position = position_;
    sample.turn = {orientation_, Vector3d::Zero()};
    return sample;
  }
  void write(const Vector3d& /*force*/, nanoseconds /*now*/) noexcept override {}
  void write_wrench(const Vector3d& force, const Vector3d& torque, nanoseconds) noexcept override {
    force_ = force;
    torque_ = torque;
    felt_ = std::max(felt_, torque.norm());
  }
  /// Of all energy that it was given, and its damping loss [J].
  [[nodiscard]] double least() const { return least_; }
  [[nodiscard]] double felt() const { return felt_; }
  [[nodiscard]] double any(double from, double to) {
    return std::uniform_real_distribution<double>(from, to)(random_);
  }

 private:
  Vector3d way() { return {any(-1, 1), any(-1, 1), any(-1, 1)}; }
  void move() {
    constexpr double kT = 1e-3;
    Vector3d dx = Vector3d(0, 0, any(-5e-6, 0)) + 1e-6 * way(), turned = stray_ * way();
    if (press_-- <= 0) {
      dx = 0.5 * kT / damping_.translation * force_;
      turned = 0.5 * kT / damping_.rotation * torque_;
      if (press_ < -4) {
        press_ = static_cast<int>(any(1.0, 80.0));
        stray_ = 1e-4 * std::pow(0.01, any(0, 1));
        dx = 0.2 * (start_ - position_);
      }
    }
    const double angle = turned.norm();
    position_ += dx;
    if (angle > 0) orientation_ = (turn(angle, turned) * orientation_).normalized();
    energy_ += -force_.dot(dx) - torque_.dot(turned) +
               (damping_.translation * dx.squaredNorm() + damping_.rotation * angle * angle) / kT;
    least_ = std::min(least_, energy_);
  }

  std::mt19937 random_;
  double claim_;
  AxisDamping damping_;
  Vector3d start_, position_;
  Quaterniond orientation_ = Quaterniond::Identity();
  Vector3d force_ = Vector3d::Zero(), torque_ = Vector3d::Zero();
  double energy_ = 0.0, least_ = 0.0, felt_ = 0.0;
  double stray_ = 0.0;
  int press_ = 0;
};

struct Feat {
  double least = 0.0;
  double torque = 0.0;
};
Feat oppose(unsigned seed, double claim) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  std::vector<Vector3d> probes(1 + random() % 4);
  double lowest = 0.0;
  for (std::size_t i = 0; i < probes.size(); ++i) {
    probes[i] = 0.06 * Vector3d(any(random), any(random), any(random));
    if (random() % 2 == 0) probes[i].z() = probes[0].z();  // several touch at once
    lowest = i == 0 ? probes[0].z() : std::min(lowest, probes[i].z());
  }
  Opponent device(seed, {0, 0, 1e-6 - lowest}, claim);
  Scene scene;
  scene.objects = {floor_at(0.0, 5000.0)};
  ServoConfig config;
  config.probes = probes;
  ServoLoop servo(device, EffectPlan(scene), config);
  nanoseconds now{0};
  for (int i = 0; i < 4000; ++i) servo.step(now += kPeriod);
  return {device.least(), device.felt()};
}

TEST(ToolServo, OpponentGetsNoEnergy) {
  double least = 0.0, torque = 0.0;
  for (unsigned seed = 1; seed <= 100; ++seed) {
    const Feat one = oppose(seed, 1.0);
    EXPECT_GE(one.least, -1e-9) << "seed " << seed;
    least = std::min(least, one.least);
    torque = std::max(torque, one.torque);
  }
  EXPECT_GT(torque, 1e-3) << "nothing was tried";
  int won = 0;
  for (unsigned seed = 1; seed <= 20; ++seed) won += oppose(seed, 8.0).least < -1e-6 ? 1 : 0;
  EXPECT_GT(won, 10) << "an opponent that finds nothing where eight times the damping is believed";
  std::printf("least %.3g J, greatest torque %.3g N m\n", least, torque);
}

}  // namespace
}  // namespace reckon::haptics::tool_opponent_test
