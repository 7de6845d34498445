// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Rotation vectors: the exponential map, its inverse and their rates, safe at zero angle.
#pragma once

#include <Eigen/Geometry>
#include <numbers>

namespace reckon::deadreckon {

/// An angle in degrees, for people to read.
[[nodiscard]] constexpr double in_degrees(double radians) noexcept {
  return radians * (180.0 / std::numbers::pi);
}

/// Unit quaternion of the rotation by |v| rad about v. Exact at zero, any finite angle.
[[nodiscard]] Eigen::Quaterniond exponential(const Eigen::Vector3d& rotation_vector) noexcept;

/// Rotation vector [rad] of unit q by the shorter way, so that exponential(v) is q or -q; |v| <=
/// pi.
[[nodiscard]] Eigen::Vector3d logarithm(const Eigen::Quaterniond& q) noexcept;

/// Angle [rad] in [0, pi] between two orientations; q and -q are the same orientation. The arc
/// tangent is accurate for small angles, where an arc cosine of |a.b| has 1e-8 rad of noise.
[[nodiscard]] double angle_between(const Eigen::Quaterniond& a,
                                   const Eigen::Quaterniond& b) noexcept;

/// Angular velocity, in the axes of the rotated frame, of exponential(v) while v changes at `rate`
/// (the right Jacobian of the rotation group times the rate).
[[nodiscard]] Eigen::Vector3d angular_velocity_of(const Eigen::Vector3d& rotation_vector,
                                                  const Eigen::Vector3d& rate) noexcept;

/// Inverse of angular_velocity_of: the rate of v that gives this angular velocity. Needs |v| < 2
/// pi.
[[nodiscard]] Eigen::Vector3d rate_of_rotation_vector(
    const Eigen::Vector3d& rotation_vector, const Eigen::Vector3d& angular_velocity) noexcept;

}  // namespace reckon::deadreckon
