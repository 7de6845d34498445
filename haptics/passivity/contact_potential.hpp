// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The spring of one contact as a potential S(x; theta) whose curvature is bounded: what a sampled
// device can render without making energy. Frame S, SI units.
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

/// Hardening spring f(d) = k1 d + k3 d^3, continued with slope `slope_limit` once its own slope
/// exceeds that, and constant from `force_limit` on. So 0 <= f' <= slope_limit everywhere: S is
/// convex and never falls with depth, and its second derivative is bounded.
/// @param k1 [N/m] >= 0  @param k3 [N/m^3] >= 0  @param slope_limit [N/m] >= 0
/// @param force_limit [N] >= 0, may be infinite  @param depth [m]; no load for depth <= 0
[[nodiscard]] SpringLoad bounded_spring(double k1, double k3, double slope_limit,
                                        double force_limit, double depth) noexcept;

/// theta: everything that shapes the potential of a contact.
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

/// Whether depth is the distance to the surface of a sphere round the point.
[[nodiscard]] bool is_sphere(pdu::ForceModelKind kind) noexcept;

/// Where a received model is at a predicted pose, in frame S.
struct ContactPlace {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();    ///< as ContactParameters::point [m]
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< unit, as ContactParameters::normal
};
[[nodiscard]] ContactPlace place(const deadreckon::ForceModel& model,
                                 const deadreckon::Pose& pose) noexcept;

/// Parameters of a received model at a predicted pose, gain 1, limits left to the caller.
[[nodiscard]] ContactParameters parameters(const deadreckon::ForceModel& model,
                                           const deadreckon::Pose& pose,
                                           double probe_radius) noexcept;

/// Depth [m] (> 0 inside) and unit normal towards the probe, as deadreckon::contact has them. For
/// every kind depth is a concave function of the probe's place with slope 1, less where the edge of
/// a region is rounded: with the bounded spring that makes S(x + dx) <= S(x) - f.dx + slope |dx|^2
/// / 2, which the gate's proof rests on.
struct ContactGeometry {
  double depth = -std::numeric_limits<double>::infinity();
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
  double slope = 1.0;  ///< of depth against the normal, at most 1
};
[[nodiscard]] ContactGeometry geometry(const ContactParameters& theta,
                                       const Eigen::Vector3d& probe) noexcept;

/// Spring along the normal, gain included.
[[nodiscard]] SpringLoad normal_load(const ContactParameters& theta, double depth) noexcept;

/// Slope of the normal force at that depth [N/m], without gain and without the limit of the force.
[[nodiscard]] inline double slope_at(const ContactParameters& theta, double depth) noexcept {
  return std::min(theta.k1 + 3 * theta.k3 * depth * depth, theta.slope_limit);
}

/// Least upper bound known of the slope of the normal force [N/m], gain included.
[[nodiscard]] inline double slope_bound(const ContactParameters& theta) noexcept {
  const double own = theta.k3 > 0 ? theta.slope_limit : theta.k1;
  return theta.gain * std::min(own, theta.slope_limit);
}

/// Stiffness of the friction bristle [N/m], gain included, <= slope_bound's limit.
[[nodiscard]] inline double bristle_stiffness(const ContactParameters& theta) noexcept {
  const double own = theta.k1 > 0 ? theta.k1 : 0.5 * theta.slope_limit;
  return theta.gain * std::min(own, theta.slope_limit);
}

/// True when every number may enter the books: finite, coefficients >= 0, positions within 1e6 m.
[[nodiscard]] bool is_usable(const ContactParameters& theta) noexcept;

}  // namespace reckon::haptics
