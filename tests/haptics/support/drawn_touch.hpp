// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Something to touch, drawn from a seed, and the motion of a hand about it.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <string>

#include "reckon/haptics/scene/scene.hpp"
#include "reckon/haptics/servo/servo_loop.hpp"
#include "reckon/pdu/seconds.hpp"

namespace reckon::test {

/// The main kind of object.
enum class TouchKind : std::uint8_t { walls, hands, effects, bodies };
inline constexpr std::array kTouchKinds{TouchKind::walls, TouchKind::hands, TouchKind::effects,
                                        TouchKind::bodies};

/// A floor some mm below the middle, and the objects of its kind. The hand rests in the middle,
/// where it touches nothing, roams about it, some 10 mm wide, and rests there again at the end.
class DrawnTouch {
 public:
  DrawnTouch(TouchKind kind, unsigned seed) : random_(seed), kind_(kind) {
    for (auto& axis : strokes_)
      for (auto& stroke : axis)
        stroke = {within(0.002, 0.008), scale(1, 15), within(0, 2 * std::numbers::pi)};
    add_floor();
    if (kind == TouchKind::walls) add_walls();
    if (kind == TouchKind::effects) add_effects();
    if (kind == TouchKind::bodies) add_bodies();
  }

  [[nodiscard]] const haptics::Scene& scene() const { return scene_; }

  /// The hand's goal [m], at rest until 0 and from `kRests` on.
  static constexpr double kRests = 4.0;  // [s]
  [[nodiscard]] Eigen::Vector3d hand(double t) const {
    Eigen::Vector3d place = middle_;
    const double share = std::clamp(2.0 * std::min(t, kRests - t), 0.0, 1.0);
    for (int i = 0; i < 3; ++i)
      for (const auto& [size, rate, phase] : strokes_[static_cast<std::size_t>(i)])
        place[i] += share * size * std::sin(rate * t + phase);
    return place;
  }

  /// Remote hands appear, disappear and are forgotten. Call it before each step of the servo.
  void play_others(haptics::ServoLoop& servo, std::chrono::nanoseconds now) {
    if (kind_ != TouchKind::hands || now < next_others_) return;
    const double t = pdu::to_seconds(now);
    next_others_ = now + std::chrono::microseconds(static_cast<int>(within(5e3, 200e3)));
    haptics::ContactSet set;
    set.count = t < kRests ? static_cast<std::size_t>(within(0, 2.99)) : 0;
    for (std::size_t i = 0; i < set.count; ++i) {
      haptics::RemoteHand& hand = set.hands[i];
      hand.id = {1, 2, static_cast<std::uint16_t>(3 + i)};
      hand.state.algorithm = pdu::DeadReckoningAlgorithm::fpw;
      hand.state.position = {within(-0.03, 0.03), within(-0.03, 0.03), within(-0.01, 0.03)};
      hand.state.velocity = {within(-0.1, 0.1), within(-0.1, 0.1), within(-0.1, 0.1)};
      hand.state_time = now;
      hand.model.kind = pdu::ForceModelKind::sphere;
      hand.model.k1 = scale(50, 3000);
      hand.model.damping = within(0, 1);
      hand.model.radius = within(0.005, 0.03);
      hand.valid_until = now + std::chrono::seconds(1);
      hand.version = ++version_;
    }
    servo.contacts().write(set);
  }

 private:
  double within(double least, double most) {
    return std::uniform_real_distribution<double>(least, most)(random_);
  }
  double scale(double least, double most) {
    return std::exp(within(std::log(least), std::log(most)));
  }

  haptics::SceneObject& add(const std::string& name, const haptics::Shape& shape) {
    haptics::SceneObject& object = scene_.objects.emplace_back();
    object.name = name + " " + std::to_string(scene_.objects.size());
    object.shape = shape;
    object.effects.of<haptics::SpringDamper>() = {scale(50, 20'000), within(0, 1)};
    return object;
  }
  void add_floor() {
    haptics::SceneObject& floor = add("floor", haptics::PlaneShape{});
    floor.pose.position.z() = -within(0.001, 0.006);
    floor.matter.friction = 0.5;
  }
  void add_walls() {
    for (int i = 0; i < 2; ++i) {
      const Eigen::Vector3d way = Eigen::Vector3d(within(-1, 1), within(-1, 1), within(-0.2, 1));
      haptics::SceneObject& wall = add("wall", haptics::PlaneShape{way.normalized()});
      wall.pose.position = -within(0.002, 0.01) * way.normalized();
      if (i == 0) wall.effects.of<haptics::StickSlipFriction>() = {0.6, 0.4};
    }
    const double radius = within(0.005, 0.02);
    const Eigen::Vector3d way = Eigen::Vector3d(within(-1, 1), within(-1, 1), -1).normalized();
    add("ball", haptics::SphereShape{radius}).pose.position = (radius + 0.002) * way;
  }
  void add_effects() {
    haptics::DeclaredEffects& floor = scene_.objects.front().effects;
    floor.of<haptics::StickSlipFriction>() = {within(0.4, 0.8), within(0.1, 0.4)};
    if (within(0, 1) < 0.5) floor.of<haptics::Texture>() = {2e-4, 0.004, 0.006, 0.0};
    if (within(0, 1) < 0.5) floor.declare<haptics::SurfaceDrag>();
    haptics::SceneRegion& region = scene_.regions.emplace_back();
    region.name = "about";
    region.shape = haptics::SphereShape{0.02};
    if (within(0, 1) < 0.5) region.effects.declare<haptics::Viscosity>() = {scale(0.5, 20), 0.0};
    if (within(0, 1) < 0.5) region.effects.declare<haptics::DryFriction>() = {0.5, 150.0};
    if (within(0, 1) < 0.5) region.effects.declare<haptics::PointSpring>() = {scale(20, 300)};
    if (within(0, 1) < 0.5) region.effects.declare<haptics::Attraction>();
    region.effects.declare<haptics::Oscillation>() = {0.2, 0.0, 0.4, scale(5, 200)};
  }
  // On the floor, below the middle.
  void add_bodies() {
    const double floor = scene_.objects.front().pose.position.z();
    for (int i = 0; i < 3; ++i) {
      const double edge = within(0.012, 0.025);
      haptics::SceneObject& cube = add("cube", haptics::BoxShape{Eigen::Vector3d::Constant(edge)});
      cube.effects.of<haptics::SpringDamper>() = {scale(50, 500), 0.0};
      cube.matter.mass = scale(0.02, 1.0);
      cube.matter.friction = 0.5;
      cube.pose.position = {0.026 * (i - 1), within(-0.01, 0.01), floor + 0.5 * edge};
      if (i == 1) middle_.z() = floor + edge + 0.003;
    }
  }

  std::mt19937_64 random_;
  TouchKind kind_;
  haptics::Scene scene_;
  std::array<std::array<std::array<double, 3>, 2>, 3> strokes_{};
  Eigen::Vector3d middle_ = Eigen::Vector3d::Zero();
  std::chrono::nanoseconds next_others_{0};
  std::uint32_t version_ = 0;
};

/// Energy that a hand received through its contacts, minus the energy it gave [J].
inline double transferred(const haptics::ServoSnapshot& step) {
  double sum = 0.0;
  for (std::size_t i = 0; i < step.count; ++i)
    sum += step.contacts[i].received - step.contacts[i].given;
  return sum;
}

}  // namespace reckon::test
