// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A device that renders springs itself, with its session and its servo, all on the clock of its
// model.
#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <functional>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "reckon/haptics/evdev/evdev_device.hpp"
#include "reckon/haptics/evdev/evdev_loop.hpp"
#include "reckon/haptics/servo/servo_loop.hpp"
#include "reckon/tests/haptics/support/evdev_model.hpp"
#include "reckon/tests/support/allocation_guard.hpp"

namespace reckon::test {

/// Of 1,000 N/m.
inline haptics::SceneObject solid(const std::string& name, const haptics::Shape& shape,
                                  const Eigen::Vector3d& at) {
  haptics::SceneObject object;
  object.name = name;
  object.shape = shape;
  object.pose.position = at;
  object.effects.of<haptics::SpringDamper>().stiffness = 1'000;
  return object;
}
/// Solid for x below -20 mm.
inline haptics::Scene one_wall() {
  haptics::Scene scene;
  scene.objects.push_back(
      solid("wall", haptics::PlaneShape{Eigen::Vector3d::UnitX()}, {-0.02, 0, 0}));
  return scene;
}
/// Free from -20 to 20 mm along x and y.
inline haptics::Scene four_walls() {
  using haptics::PlaneShape, Eigen::Vector3d;
  haptics::Scene scene = one_wall();
  scene.objects.push_back(solid("right", PlaneShape{-Vector3d::UnitX()}, {0.02, 0, 0}));
  scene.objects.push_back(solid("front", PlaneShape{Vector3d::UnitY()}, {0, -0.02, 0}));
  scene.objects.push_back(solid("back", PlaneShape{-Vector3d::UnitY()}, {0, 0.02, 0}));
  return scene;
}

/// Four walls, and a post in a corner.
inline haptics::Scene room_with_post() {
  haptics::Scene scene = four_walls();
  scene.objects.push_back(
      solid("post", haptics::BoxShape{Eigen::Vector3d::Constant(0.008)}, {0.01, 0.01, 0}));
  return scene;
}

/// Strokes along both axes, and a rest in the middle, where nothing is touched.
struct RoamingHand {
  /// @param least, most size of a stroke [m]  @param fastest [rad/s]  @param from start of the rest
  RoamingHand(unsigned seed, double least, double most, double fastest, double from)
      : random(seed), rests_from(from) {
    for (auto& axis : strokes)
      for (auto& stroke : axis) stroke = {within(least, most), within(2, fastest), within(0, 6.3)};
  }
  double within(double from, double to) {
    return std::uniform_real_distribution<double>(from, to)(random);
  }
  std::array<double, 2> operator()(double t) const {
    std::array<double, 2> place{};
    const double share = std::clamp(rests_from - t, 0.0, 1.0);
    for (std::size_t i = 0; i < 2; ++i)
      for (const auto& [size, rate, phase] : strokes[i])
        place[i] += share * size * std::sin(rate * t + phase);
    return place;
  }
  std::mt19937 random;
  double rests_from;  // [s]
  std::array<std::array<std::array<double, 3>, 3>, 2> strokes{};
};

/// The servo steps every millisecond, beside the session.
template <class Model>
class PluggedEvents {
 public:
  using Hand = std::function<typename Model::Places(double)>;

  /// @param idle passes if a step of the session takes no time
  template <class Options>
  PluggedEvents(const Options& options, Hand hand, const haptics::Scene& scene,
                haptics::EvdevSettings chosen, std::chrono::nanoseconds idle = {})
      : model(options, std::move(hand)),
        settings(std::move(chosen)),
        device(exchange, haptics::evdev_limits(settings)),
        servo(device, haptics::EffectPlan(scene), servo_config()),
        idle_(idle) {
    model.beside([this](std::chrono::nanoseconds now) {
      if (now < next_step_) return;
      next_step_ += std::chrono::milliseconds(1);
      if (servo_runs) step_servo(now);
    });
    start();
  }

  /// Replaces the present session.
  void start() {
    loop = std::make_unique<haptics::EvdevLoop>(exchange, settings, calls_of(model),
                                                [this] { return model.now(); });
  }
  void run(std::chrono::nanoseconds time) {
    for (const auto end = model.now() + time; model.now() < end;) {
      const auto before = model.now();
      loop->step(std::chrono::milliseconds(1));
      for (std::string& notice : loop->take_notices()) notices.push_back(std::move(notice));
      if (model.now() == before && idle_.count() > 0) model.pass(idle_);
    }
  }
  /// The program does nothing, and the device continues.
  void hang(std::chrono::nanoseconds time) {
    servo_runs = false;
    model.pass(time);
    servo_runs = true;
  }
  [[nodiscard]] const haptics::ServoSnapshot& last() { return servo.snapshots().read(); }
  /// Steps since the last call without a known position of the hand.
  [[nodiscard]] int steps_without() { return std::exchange(steps_without_, 0); }

  haptics::ForceStop stop;
  Model model;
  haptics::EvdevSettings settings;
  haptics::EvdevExchange exchange;
  haptics::EvdevDevice device;
  haptics::ServoLoop servo;
  std::unique_ptr<haptics::EvdevLoop> loop;
  std::vector<std::string> notices;
  bool servo_runs = true;
  std::size_t allocations = 0;  // of the servo

 private:
  haptics::ServoConfig servo_config() {
    haptics::ServoConfig config;
    config.stop = &stop;
    config.stop_button = 1;
    return config;
  }
  void step_servo(std::chrono::nanoseconds now) {
    const AllocationGuard guard;
    servo.step(now);
    allocations += guard.count();
    servo.snapshots().update();
    if (!last().enabled) ++steps_without_;
  }

  std::chrono::nanoseconds idle_, next_step_{0};
  int steps_without_ = 0;
};

/// An EvdevModel pressed into a wall by a hand, unless stated otherwise.
class PluggedWheel : public PluggedEvents<EvdevModel> {
 public:
  explicit PluggedWheel(const haptics::Scene& scene = one_wall(), Hand hand = pressing,
                        const EvdevModelOptions& options = {},
                        const haptics::EvdevSettings* chosen = nullptr)
      : PluggedEvents(options, std::move(hand), scene,
                      chosen != nullptr ? *chosen : settings_for(options)) {}

  /// Pushes into the wall and stays 10 mm behind it.
  static EvdevModel::Places pressing(double t) { return {-0.03 * std::min(1.0, 2 * t), 0}; }
};

}  // namespace reckon::test
