// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Boxes of 50 g that fall into a pile between walls, and hands that sweep through it.
#pragma once

#include <Eigen/Geometry>
#include <chrono>
#include <cmath>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "reckon/haptics/bodies/body_world.hpp"
#include "reckon/haptics/devices/simulated_device.hpp"
#include "reckon/haptics/servo/servo_loop.hpp"

namespace reckon::test {

/// @tparam Device a SimulatedDevice
template <class Device = haptics::SimulatedDevice>
class HandsInAPile {
 public:
  HandsInAPile(int boxes, int hands, unsigned seed = 3) {
    using Eigen::Vector3d;
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    haptics::Scene scene;
    add(scene, haptics::PlaneShape{Vector3d::UnitZ()}, Vector3d::Zero());
    const int side = boxes <= 8 ? 2 : boxes <= 27 ? 3 : 4;
    const double half = 0.025 * side + 0.03;  // [m], between the walls
    for (const double x : {-1.0, 1.0}) {
      add(scene, haptics::BoxShape{{0.01, 2 * half, 0.3}}, {x * (half + 0.005), 0, 0.1});
      add(scene, haptics::BoxShape{{2 * half, 0.01, 0.3}}, {0, x * (half + 0.005), 0.1});
    }
    const Vector3d middle(0.025 * (side - 1), 0.025 * (side - 1), -0.03);
    for (int i = 0; i < boxes; ++i) {
      const Vector3d cell(i % side, i / side % side, i / (side * side));
      const Vector3d off(0.004 * any(random), 0.004 * any(random), 0);
      haptics::SceneObject& box =
          add(scene, haptics::BoxShape{Vector3d::Constant(0.04)}, 0.05 * cell + off - middle);
      box.pose.orientation =
          Eigen::Quaterniond(1, 0.2 * any(random), 0.2 * any(random), 0).normalized();
      box.matter = {0.05, 0.5, 0.0};
    }
    plan = std::make_shared<const haptics::EffectPlan>(scene);
    world = haptics::make_bodies(*plan, scene);
    for (int hand = 0; hand < hands; ++hand) add_hand(0.7 * half, 3.0 * hand);
  }
  void step() {
    now += std::chrono::milliseconds(1);
    for (const auto& servo : servos) servo->step(now);
  }

  std::shared_ptr<const haptics::EffectPlan> plan;
  std::shared_ptr<haptics::BodyWorld> world;
  std::vector<std::unique_ptr<Device>> devices;
  std::vector<std::unique_ptr<haptics::ServoLoop>> servos;
  std::chrono::nanoseconds now{1'000'000'000};

 private:
  static haptics::SceneObject& add(haptics::Scene& scene, const auto& shape,
                                   const Eigen::Vector3d& at) {
    haptics::SceneObject& object = scene.objects.emplace_back();
    object.name = "object " + std::to_string(scene.objects.size());
    object.shape = shape;
    object.pose.position = at;
    object.effects.template of<haptics::SpringDamper>() = {400.0, 0.0};
    return object;
  }
  void add_hand(double reach, double phase) {
    haptics::SimulatedDeviceConfig config;
    config.damping = 1.0;
    config.hand_stiffness = 300;
    config.start = {0, 0, 0.3};
    const auto swept = [=](double t) {
      const double angle = 2.1 * t + phase;
      return haptics::HandTarget{{reach * std::cos(angle), reach * std::sin(1.37 * angle),
                                  t < 1 ? 0.3 - 0.27 * t : 0.03 + 0.02 * std::sin(3 * t)}};
    };
    devices.push_back(std::make_unique<Device>(config, swept));
    servos.push_back(
        std::make_unique<haptics::ServoLoop>(*devices.back(), plan, haptics::ServoConfig{}, world));
  }
};

}  // namespace reckon::test
