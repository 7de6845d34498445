// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// WGS84: from latitude and longitude to the geocentric frame W of the wire, and from W to the scene
// frame S. S is the tangent plane of the ellipsoid at the scene's origin (x east, y north, z up).
#pragma once

#include <Eigen/Geometry>

namespace reckon::deadreckon {

/// Orientation on the wire: W is rotated about z by psi, then about the new y by theta, then about
/// the new x by phi, which gives the body axes (x forward, y right, z down). [rad]
struct Euler {
  double psi = 0;
  double theta = 0;
  double phi = 0;
};

/// Unit quaternion, body to reference, for these angles. Any finite angles.
[[nodiscard]] Eigen::Quaterniond quaternion_from_euler(const Euler& euler) noexcept;

/// Angles of unit q: psi and phi in (-pi, pi], theta in [-pi/2, pi/2]. Accurate near theta = +-pi/2
/// too. Exactly there only psi -+ phi is defined, and phi is set to 0.
[[nodiscard]] Euler euler_from_quaternion(const Eigen::Quaterniond& q) noexcept;

/// Geocentric position [m] from geodetic coordinates: latitude [rad] north, longitude [rad] east,
/// height [m] above the WGS84 ellipsoid.
[[nodiscard]] Eigen::Vector3d geocentric_position(double latitude, double longitude,
                                                  double height) noexcept;

/// The scene frame S, fixed at construction; all conversions are one rotation and one translation.
class LocalFrame {
 public:
  /// Origin: latitude [rad] in [-pi/2, pi/2], longitude [rad], height [m] within +-1e8.
  /// @throws std::invalid_argument with the value outside these ranges.
  LocalFrame(double latitude, double longitude, double height);

  /// A point of S [m] in geocentric coordinates [m].
  [[nodiscard]] Eigen::Vector3d world_from_scene(const Eigen::Vector3d& point) const noexcept {
    return origin_ + rotation_ * point;
  }
  /// A geocentric point [m] in S [m]; 1 nm of rounding near the earth's surface.
  [[nodiscard]] Eigen::Vector3d scene_from_world(const Eigen::Vector3d& point) const noexcept {
    return rotation_.transpose() * (point - origin_);
  }
  /// A free vector (velocity, acceleration, force).
  [[nodiscard]] Eigen::Vector3d world_from_scene_vector(const Eigen::Vector3d& v) const noexcept {
    return rotation_ * v;
  }
  [[nodiscard]] Eigen::Vector3d scene_from_world_vector(const Eigen::Vector3d& v) const noexcept {
    return rotation_.transpose() * v;
  }
  /// Body-to-scene quaternion to body-to-world, and back.
  [[nodiscard]] Eigen::Quaterniond world_from_scene(const Eigen::Quaterniond& q) const noexcept {
    return quaternion_ * q;
  }
  [[nodiscard]] Eigen::Quaterniond scene_from_world(const Eigen::Quaterniond& q) const noexcept {
    return quaternion_.conjugate() * q;
  }

  /// Origin of S in W [m].
  [[nodiscard]] const Eigen::Vector3d& origin() const noexcept { return origin_; }
  /// S to W; its columns are east, north and up.
  [[nodiscard]] const Eigen::Matrix3d& rotation() const noexcept { return rotation_; }

 private:
  Eigen::Vector3d origin_;
  Eigen::Matrix3d rotation_;
  Eigen::Quaterniond quaternion_;
};

}  // namespace reckon::deadreckon
