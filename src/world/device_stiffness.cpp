// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/world/device_stiffness.hpp"

#include <cmath>

#include "reckon/haptics/servo/servo_loop.hpp"
#include "reckon/peer/drivers/device_config.hpp"
#include "reckon/peer/settings/hand_config.hpp"

namespace reckon::peer {
namespace {

// To twelve digits: a wall of 475 N/m is not softened by a limit that differs from 475 in the last
// bit.
double rounded(double value) {
  if (!(value > 0) || !std::isfinite(value)) return value;
  const double scale = std::pow(10.0, 11 - std::floor(std::log10(value)));
  return std::round(value * scale) / scale;
}

}  // namespace

double DeviceStiffness::straight_from() const noexcept {
  if (!(hand_k3 > 0) || !std::isfinite(hand_limit())) return kNoLimit;
  return std::sqrt(std::max(0.0, hand_limit() - hand_asked) / (3.0 * hand_k3));
}

DeviceStiffness stiffness_of(const haptics::ServoLoop& servo, const HandModel& hand) noexcept {
  DeviceStiffness device;
  device.walls_asked = servo.static_stiffness();
  device.regions_asked = servo.region_stiffness();
  device.walls = rounded(servo.static_stiffness_limit());
  device.regions = rounded(servo.region_stiffness_limit());
  device.hand_asked = hand.k1;
  device.hand_k3 = hand.k3;
  device.hand_damping = hand.damping;
  device.hands = rounded(servo.remote_stiffness_limit());
  device.bodies = rounded(servo.body_stiffness_limit());
  device.force = servo.force_limit();
  device.damping = servo.damping();
  return device;
}

}  // namespace reckon::peer
