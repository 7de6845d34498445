// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The spring of one contact as a potential S(x; theta) with bounded curvature, which a sampled
// device can render without generating energy. Frame S, SI units.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <limits>

#include "reckon/deadreckon/force/force_model.hpp"

namespace reckon::haptics {

/// Force and energy of a spring at one depth.
struct SpringLoad {
  double force = 0.0;   ///< [N]
  double energy = 0.0;  ///< [J]
};

/// Hardening spring f(d) = k1 d + k3 d^3. It continues with slope `slope_limit` where its own slope
/// would exceed that, and is constant from `force_limit` on. So 0 <= f' <= slope_limit everywhere:
/// S is convex, never falls with depth and has a bounded second derivative.
/// @param k1 [N/m] >= 0  @param k3 [N/m^3] >= 0  @param slope_limit [N/m] >= 0
/// @param force_limit [N] >= 0, may be infinite  @param depth [m]; no load for depth <= 0
[[nodiscard]] SpringLoad bounded_spring(double k1, double k3, double slope_limit,
                                        double force_limit, double depth) noexcept;

/// theta: all parameters of a contact's potential.
struct ContactParameters {
  pdu::ForceModelKind kind = pdu::ForceModelKind::none;
  Eigen::Vector3d point = Eigen::Vector3d::Zero();    ///< sphere centre or point of the plane [m]
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< unit, outwards; for planes
  double reach = 0.0;  ///< [m], depth where the probe's centre meets `point`: sum of radii
  double patch = 0.0;  ///< [m], same for the side of a region: its radius and the probe's
  double k1 = 0.0;     ///< [N/m]
  double k3 = 0.0;     ///< [N/m^3]
  double static_friction = 0.0;
  double kinetic_friction = 0.0;
  double gain = 0.0;         ///< [0, 1], scales force and energy alike
  double slope_limit = 0.0;  ///< [N/m]
  double force_limit = std::numeric_limits<double>::infinity();  ///< [N]
};

/// Whether the depth is measured from the surface of a sphere around the point.
[[nodiscard]] bool is_sphere(pdu::ForceModelKind kind) noexcept;

/// Place of a received model at a predicted pose, in frame S.
struct ContactPlace {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();    ///< as ContactParameters::point [m]
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< unit, as ContactParameters::normal
};
[[nodiscard]] ContactPlace place(const deadreckon::ForceModel& model,
                                 const deadreckon::Pose& pose) noexcept;

/// Parameters of a received model at a predicted pose, with gain 1. The caller sets the limits.
[[nodiscard]] ContactParameters parameters(const deadreckon::ForceModel& model,
                                           const deadreckon::Pose& pose,
                                           double probe_radius) noexcept;

/// Depth [m] (> 0 inside) and unit normal towards the probe, as in deadreckon::contact. For every
/// kind, depth is a concave function of the probe's position with slope 1, or less where the edge
/// of a region is rounded. With the bounded spring this gives S(x + dx) <= S(x) - f.dx + slope
/// |dx|^2 / 2, on which the gate's proof is based.
struct ContactGeometry {
  double depth = -std::numeric_limits<double>::infinity();
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
  double slope = 1.0;  ///< of depth against the normal, at most 1
};
[[nodiscard]] ContactGeometry geometry(const ContactParameters& theta,
                                       const Eigen::Vector3d& probe) noexcept;

/// Load of the spring along the normal, gain included.
[[nodiscard]] SpringLoad normal_load(const ContactParameters& theta, double depth) noexcept;

/// Slope of the normal force at that depth [N/m], without gain and force limit.
[[nodiscard]] inline double slope_at(const ContactParameters& theta, double depth) noexcept {
  return std::min(theta.k1 + 3 * theta.k3 * depth * depth, theta.slope_limit);
}

/// Smallest known upper bound of the slope of the normal force [N/m], gain included.
[[nodiscard]] inline double slope_bound(const ContactParameters& theta) noexcept {
  const double own = theta.k3 > 0 ? theta.slope_limit : theta.k1;
  return theta.gain * std::min(own, theta.slope_limit);
}

/// Stiffness of the friction bristle [N/m], gain included, <= slope_bound's limit.
[[nodiscard]] inline double bristle_stiffness(const ContactParameters& theta) noexcept {
  const double own = theta.k1 > 0 ? theta.k1 : 0.5 * theta.slope_limit;
  return theta.gain * std::min(own, theta.slope_limit);
}

/// Whether every number may be used: finite, coefficients >= 0, positions within 1e6 m.
[[nodiscard]] bool is_usable(const ContactParameters& theta) noexcept;

}  // namespace reckon::haptics
