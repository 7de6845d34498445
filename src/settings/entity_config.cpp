// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/settings/entity_config.hpp"

#include <numbers>

namespace reckon::peer {

namespace {

/// From north, east and down to S; its own inverse.
Eigen::Quaterniond from_north_east_down() {
  return {0.0, std::numbers::sqrt2 / 2, std::numbers::sqrt2 / 2, 0.0};
}

}  // namespace

Eigen::Quaterniond orientation_of(const Attitude& attitude) noexcept {
  const auto turn = [](double angle, const Eigen::Vector3d& axis) {
    return Eigen::Quaterniond(Eigen::AngleAxisd(angle, axis));
  };
  return (from_north_east_down() * turn(attitude.heading, Eigen::Vector3d::UnitZ()) *
          turn(attitude.pitch, Eigen::Vector3d::UnitY()) *
          turn(attitude.roll, Eigen::Vector3d::UnitX()))
      .normalized();
}

Eigen::Quaterniond device_orientation_of(const Attitude& attitude) noexcept {
  return (orientation_of(attitude) * from_north_east_down().conjugate()).normalized();
}

}  // namespace reckon::peer
