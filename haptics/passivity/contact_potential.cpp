// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/passivity/contact_potential.hpp"

#include <algorithm>
#include <cmath>

namespace reckon::haptics {
namespace {

constexpr double kFarthest = 1e6;   // [m]
constexpr double kStiffest = 1e12;  // [N/m], [N/m^3]: beyond it squares lose precision
constexpr double kInfinity = std::numeric_limits<double>::infinity();

SpringLoad hardening(double k1, double k3, double d) noexcept {
  return {d * (k1 + k3 * d * d), d * d * (0.5 * k1 + 0.25 * k3 * d * d)};
}

// Hardening spring up to the knee, linear beyond it.
SpringLoad with_knee(double k1, double k3, double slope, double knee, double d) noexcept {
  if (d <= knee) return hardening(k1, k3, d);
  const SpringLoad at = hardening(k1, k3, knee);
  const double e = d - knee;
  return {at.force + slope * e, at.energy + e * (at.force + 0.5 * slope * e)};
}

// Depth at which the hardening spring reaches `force`, by Newton's method from above on a convex
// function.
double depth_of_force(double k1, double k3, double force) noexcept {
  const double by_k1 = k1 > 0 ? force / k1 : kInfinity;
  const double by_k3 = k3 > 0 ? std::cbrt(force / k3) : kInfinity;
  double d = std::min(by_k1, by_k3);
  for (int i = 0; i < 20 && k3 > 0; ++i) {
    const double step = (d * (k1 + k3 * d * d) - force) / (k1 + 3 * k3 * d * d);
    if (!(step > 1e-15 * d)) break;
    d -= step;
  }
  return d;
}

bool is_plane(pdu::ForceModelKind kind) noexcept {
  return kind == pdu::ForceModelKind::plane || kind == pdu::ForceModelKind::spring_damper_region;
}

bool is_within(double value, double most) noexcept { return value >= 0 && value <= most; }

bool near(const Eigen::Vector3d& point) noexcept {
  return std::abs(point.x()) <= kFarthest && std::abs(point.y()) <= kFarthest &&
         std::abs(point.z()) <= kFarthest;
}

}  // namespace

bool is_sphere(pdu::ForceModelKind kind) noexcept {
  return kind == pdu::ForceModelKind::sphere || kind == pdu::ForceModelKind::field;
}

SpringLoad bounded_spring(double k1, double k3, double slope_limit, double force_limit,
                          double depth) noexcept {
  if (!(depth > 0) || slope_limit <= 0) return {};
  if (k1 >= slope_limit) k3 = 0;  // linear from the start
  k1 = std::min(k1, slope_limit);
  const double knee = k3 > 0 ? std::sqrt((slope_limit - k1) / (3 * k3)) : kInfinity;
  const SpringLoad free = with_knee(k1, k3, slope_limit, knee, depth);
  if (free.force <= force_limit) return free;

  const double knee_force = k3 > 0 ? hardening(k1, k3, knee).force : kInfinity;
  const double d = force_limit > knee_force ? knee + (force_limit - knee_force) / slope_limit
                                            : depth_of_force(k1, k3, force_limit);
  const SpringLoad at = with_knee(k1, k3, slope_limit, knee, d);
  return {force_limit, at.energy + force_limit * (depth - d)};
}

ContactPlace place(const deadreckon::ForceModel& model, const deadreckon::Pose& pose) noexcept {
  ContactPlace at{pose.position + pose.orientation * model.point, pose.orientation * model.normal};
  const double length = at.normal.norm();
  if (length > 0) at.normal /= length;
  return at;
}

ContactParameters parameters(const deadreckon::ForceModel& model, const deadreckon::Pose& pose,
                             double probe_radius) noexcept {
  ContactParameters theta;
  theta.kind = model.kind;
  const ContactPlace at = place(model, pose);
  theta.point = at.point;
  theta.normal = at.normal;
  theta.reach = probe_radius;
  if (is_sphere(model.kind)) theta.reach = model.radius;
  if (model.kind == pdu::ForceModelKind::sphere) theta.reach += probe_radius;
  theta.patch = model.radius + probe_radius;
  theta.k1 = model.k1;
  theta.k3 = model.k3;
  theta.static_friction = std::max(model.static_friction, model.kinetic_friction);
  theta.kinetic_friction = model.kinetic_friction;
  theta.gain = 1.0;
  return theta;
}

ContactGeometry geometry(const ContactParameters& theta, const Eigen::Vector3d& probe) noexcept {
  const Eigen::Vector3d r = probe - theta.point;
  if (is_sphere(theta.kind)) {
    const double distance = r.norm();
    const bool centred = !(distance > 0);
    return {theta.reach - distance, centred ? theta.normal : Eigen::Vector3d(r / distance)};
  }
  if (!is_plane(theta.kind)) return {};
  const double height = r.dot(theta.normal);
  const ContactGeometry face{theta.reach - height, theta.normal};
  if (theta.kind == pdu::ForceModelKind::plane) return face;
  const Eigen::Vector3d lateral = r - height * theta.normal;
  const deadreckon::PegDepth peg =
      deadreckon::peg_depth(face.depth, theta.patch, theta.normal, lateral);
  return {peg.depth, peg.normal, peg.slope};
}

SpringLoad normal_load(const ContactParameters& theta, double depth) noexcept {
  const SpringLoad full =
      bounded_spring(theta.k1, theta.k3, theta.slope_limit, theta.force_limit, depth);
  return {theta.gain * full.force, theta.gain * full.energy};
}

bool is_usable(const ContactParameters& theta) noexcept {
  return near(theta.point) && is_within(theta.normal.squaredNorm(), 1.0 + 1e-9) &&
         is_within(theta.reach, kFarthest) && is_within(theta.patch, kFarthest) &&
         is_within(theta.k1, kStiffest) && is_within(theta.k3, kStiffest) &&
         is_within(theta.static_friction, 100.0) &&
         is_within(theta.kinetic_friction, theta.static_friction);
}

}  // namespace reckon::haptics
