// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/polhem/polhem_kinematics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace reckon::haptics {
namespace {

using Eigen::AngleAxisd;
using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr double kNearAxis = 0.03;       // [m]
constexpr double kNearLine = 0.2588190;  // sine of 15 degrees

double count_step(const PolhemArm& arm, std::size_t joint) noexcept {
  return arm.encoder_signs[joint] * kTurn / (arm.counts_per_turn * arm.ratios[joint]);
}

}  // namespace

Vector3d polhem_angles_at(const PolhemArm& arm,
                          const std::array<std::int32_t, 3>& counts) noexcept {
  Vector3d angles;
  for (std::size_t i = 0; i < 3; ++i)
    angles[static_cast<Eigen::Index>(i)] = count_step(arm, i) * counts[i];
  return angles;
}

std::array<std::int32_t, 3> polhem_counts_at(const PolhemArm& arm,
                                             const Vector3d& angles) noexcept {
  constexpr double kMost = std::numeric_limits<std::int32_t>::max();
  std::array<std::int32_t, 3> counts{};
  for (std::size_t i = 0; i < 3; ++i) {
    const double count = angles[static_cast<Eigen::Index>(i)] / count_step(arm, i);
    counts[i] = static_cast<std::int32_t>(std::lround(std::clamp(count, -kMost, kMost)));
  }
  return counts;
}

Vector3d polhem_count_steps(const PolhemArm& arm) noexcept {
  return {std::abs(count_step(arm, 0)), std::abs(count_step(arm, 1)), std::abs(count_step(arm, 2))};
}

std::optional<PolhemPose> polhem_pose(const PolhemArm& arm, const Vector3d& angles) noexcept {
  const double cos_a = std::cos(angles[0]), sin_a = std::sin(angles[0]);
  const double cos_b = std::cos(angles[1]), sin_b = std::sin(angles[1]);
  const double cos_c = std::cos(angles[2]), sin_c = std::sin(angles[2]);
  const double out = arm.upper * sin_b + arm.fore * sin_c;
  // Sine of the angle between the links; written so that not-a-number is refused.
  const double bend = sin_b * cos_c + cos_b * sin_c;
  if (!(out > kNearAxis) || !(bend > kNearLine) || !std::isfinite(cos_a)) return std::nullopt;

  PolhemPose pose;
  pose.position = {cos_a * out, sin_a * out, arm.base + arm.upper * cos_b - arm.fore * cos_c};
  pose.jacobian << -sin_a * out, cos_a * arm.upper * cos_b, cos_a * arm.fore * cos_c,  //
      cos_a * out, sin_a * arm.upper * cos_b, sin_a * arm.fore * cos_c,                //
      0.0, -arm.upper * sin_b, arm.fore * sin_c;
  return pose;
}

std::optional<Vector3d> polhem_angles(const PolhemArm& arm, const Vector3d& position) noexcept {
  const double out = std::hypot(position.x(), position.y());
  const double up = position.z() - arm.base;
  const double far = (out * out + up * up - arm.upper * arm.upper - arm.fore * arm.fore) /
                     (2.0 * arm.upper * arm.fore);
  // B + C: pi if the links are in line outwards, 0 if the fore link is folded back.
  const double both = std::acos(-far);
  const double along = arm.upper - arm.fore * std::cos(both);
  const double across = arm.fore * std::sin(both);
  const double b = std::atan2(out, up) - std::atan2(across, along);
  const Vector3d angles(std::atan2(position.y(), position.x()), b, both - b);
  if (!angles.allFinite()) return std::nullopt;
  return angles;
}

Eigen::Quaterniond polhem_orientation(const PolhemArm& arm, const Vector3d& angles,
                                      const std::array<std::int16_t, 3>& gimbal) noexcept {
  const auto gimbal_angle = [&](std::size_t i) {
    return arm.gimbal_signs[i] * gimbal[i] * kTurn / arm.gimbal_counts_per_turn;
  };
  const Eigen::Quaterniond turned = AngleAxisd(angles[0], Vector3d::UnitZ()) *
                                    AngleAxisd(kTurn / 4.0 - angles[2], Vector3d::UnitY()) *
                                    AngleAxisd(gimbal_angle(0), Vector3d::UnitX()) *
                                    AngleAxisd(gimbal_angle(1), Vector3d::UnitY()) *
                                    AngleAxisd(gimbal_angle(2), Vector3d::UnitX());
  // The arm's axes in D: a quarter turn about z.
  const Eigen::Quaterniond axes(AngleAxisd(-kTurn / 4.0, Vector3d::UnitZ()));
  return (axes * turned * axes.conjugate()).normalized();
}

Vector3d polhem_hold_up(const PolhemWeights& weights, const Vector3d& angles) noexcept {
  return {0.0, -weights.upper * std::sin(angles[1]), weights.fore * std::sin(angles[2])};
}

Vector3d polhem_currents(const PolhemArm& arm, const Vector3d& torques) noexcept {
  Vector3d currents;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    currents[k] = arm.motor_signs[i] * torques[k] / (arm.ratios[i] * arm.torque_constants[i]);
  }
  return currents;
}

Vector3d polhem_torques_of(const PolhemArm& arm, const Vector3d& currents) noexcept {
  Vector3d torques;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    torques[k] = arm.motor_signs[i] * currents[k] * arm.ratios[i] * arm.torque_constants[i];
  }
  return torques;
}

}  // namespace reckon::haptics
