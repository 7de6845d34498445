// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A servo on a simulated device that a test steps by hand, and the objects that it presses.
#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>

#include "reckon/haptics/devices/simulated_device.hpp"
#include "reckon/haptics/servo/servo_loop.hpp"

namespace reckon::haptics::bench {

using Eigen::Vector3d;
using std::chrono::nanoseconds;
using namespace std::chrono_literals;

inline constexpr double kPassive = -1e-9;  ///< [J], rounding

/// A plane at z = 0 of `stiffness` [N/m] and `damping` [N s/m].
inline Scene floor(double stiffness, double damping = 0.0) {
  SceneObject object;
  object.name = "floor";
  object.shape = PlaneShape{};
  object.effects.of<SpringDamper>() = {stiffness, damping};
  Scene scene;
  scene.objects.push_back(object);
  return scene;
}

/// A remote hand at rest: a sphere of 20 mm, `k1` [N/m], valid for 100 s.
inline RemoteHand sphere(const Vector3d& centre, double k1, std::uint32_t version = 1) {
  RemoteHand hand;
  hand.id = {1, 2, 3};
  hand.state.algorithm = pdu::DeadReckoningAlgorithm::fpw;
  hand.state.position = centre;
  hand.model.kind = pdu::ForceModelKind::sphere;
  hand.model.k1 = k1;
  hand.model.radius = 0.02;
  hand.valid_until = 100s;
  hand.version = version;
  return hand;
}

/// A set of one hand.
inline ContactSet only(const RemoteHand& hand) {
  ContactSet set;
  set.count = 1;
  set.hands[0] = hand;
  return set;
}

/// A servo on a simulated device, stepped by hand.
class Bench {
 public:
  explicit Bench(const Scene& scene = {}, SimulatedDeviceConfig device_config = {},
                 HandScript script = {}, ServoConfig config = {})
      : device(device_config, std::move(script)), servo(device, EffectPlan(scene), config) {}

  const ServoSnapshot& run(nanoseconds duration, nanoseconds period = 1ms) {
    for (const nanoseconds end = now + duration; now < end; now += period) {
      servo.step(now);
      servo.snapshots().update();
      const ServoSnapshot& s = servo.snapshots().read();
      const double lent = s.loan + s.source_energy();
      least = std::min(least, device.port_work() + device.damping_loss() + transferred() + lent);
      peak = std::max(peak, device.force().norm());
    }
    return servo.snapshots().read();
  }

  [[nodiscard]] double transferred() {
    double sum = 0;
    const ServoSnapshot& s = servo.snapshots().read();
    for (std::size_t i = 0; i < s.count; ++i) sum += s.contacts[i].received - s.contacts[i].given;
    return sum;
  }

  SimulatedDevice device;
  ServoLoop servo;
  nanoseconds now{0};
  double least = 0;  ///< [J], of the device's own ledger with loans
  double peak = 0;   ///< [N]
};

/// Comes down from z = `from` at 50 mm/s and presses to -`depth` [m].
inline HandScript presses(double depth, double from = 0.03) {
  return [=](double t) {
    HandTarget hand;
    hand.position.z() = std::max(-depth, from - 0.05 * t);
    return hand;
  };
}

/// A device that starts at height `z` [m].
inline SimulatedDeviceConfig at(double z, double resolution = 0.0) {
  SimulatedDeviceConfig config;
  config.start.z() = z;
  config.resolution = resolution;
  return config;
}

}  // namespace reckon::haptics::bench
