// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/passivity/contact_spring.hpp"

#include <algorithm>

namespace reckon::haptics {
namespace {

// [N/s], rate at which friction falls from sticking to sliding, so that breakaway is felt but not
// as a blow.
constexpr double kBreakAway = 100.0;

Eigen::Vector3d tangential(const Eigen::Vector3d& v, const Eigen::Vector3d& normal) {
  return v - v.dot(normal) * normal;
}

}  // namespace

void ContactSpring::reset(const Eigen::Vector3d& probe) noexcept {
  *this = ContactSpring{};
  probe_ = probe;
}

void ContactSpring::release() noexcept {
  theta_.gain = 0.0;
  contact_ = evaluate(theta_, Eigen::Vector3d::Zero(), false, 0.0);
}

// Projecting the bristle on the present tangent plane and limiting it to the friction limit can
// only lower the energy.
ContactSpring::ContactState ContactSpring::evaluate(const ContactParameters& theta,
                                                    const Eigen::Vector3d& bristle, bool slipping,
                                                    double fall) const noexcept {
  ContactState s;
  s.geometry = haptics::geometry(theta, probe_);
  const SpringLoad load = normal_load(theta, s.geometry.depth);
  s.normal_force = s.geometry.slope * load.force;
  s.force = s.normal_force * s.geometry.normal;
  s.energy = load.energy;
  const double stiffness = bristle_stiffness(theta);
  if (!(s.normal_force > 0) || stiffness <= 0 || theta.static_friction <= 0) return s;

  s.bristle = tangential(bristle, s.geometry.normal);
  const double pull = stiffness * s.bristle.norm();
  const double stick = theta.static_friction * s.normal_force;
  const double slide = theta.kinetic_friction * s.normal_force;
  // Sliding ends only when the motion reverses and the bristle slackens.
  s.slipping = slipping ? pull > slide * (1.0 - 1e-9) : pull > stick;
  if (s.slipping) {
    const double limit = std::clamp(this->pull() - fall, slide, stick);
    if (pull > limit) s.bristle *= limit / pull;
  }
  s.force -= stiffness * s.bristle;
  s.energy += 0.5 * stiffness * s.bristle.squaredNorm();
  return s;
}

// Only motion in the old tangent plane stretches the bristle. The normal spring takes the rest.
void ContactSpring::settle(const Eigen::Vector3d& probe, double dt) noexcept {
  const Eigen::Vector3d dx = probe - probe_;
  probe_ = probe;
  contact_ = evaluate(theta_, contact_.bristle + tangential(dx, contact_.geometry.normal),
                      contact_.slipping, kBreakAway * dt);
}

void ContactSpring::move(const ContactParameters& target) noexcept {
  if (!is_usable(target)) return;
  if (target.kind != theta_.kind) {
    theta_ = target;
    release();
    return;
  }
  const Eigen::Vector3d bristle = contact_.bristle - (target.point - theta_.point);
  contact_ = evaluate(target, bristle, contact_.slipping, 0.0);
  theta_ = target;
}

double ContactSpring::pull() const noexcept {
  return bristle_stiffness(theta_) * contact_.bristle.norm();
}

// Depth is concave in the probe's position, with a slope of at most 1 along the normal at the
// start. The normal spring is convex and rising. So its part is K n n^T for any length of dx. The
// bristle takes the rest of dx, whether it sticks or slides.
Eigen::Matrix3d ContactSpring::slope() const noexcept {
  if (!(contact_.energy > 0)) return Eigen::Matrix3d::Zero();
  const Eigen::Vector3d& n = contact_.geometry.normal;
  const double along = slope_bound(theta_);
  const double across = theta_.static_friction > 0 ? bristle_stiffness(theta_) : 0.0;
  return across * Eigen::Matrix3d::Identity() + (along - across) * n * n.transpose();
}

double ContactSpring::greatest_slope() const noexcept {
  if (!(contact_.energy > 0)) return 0.0;
  const double across = theta_.static_friction > 0 ? bristle_stiffness(theta_) : 0.0;
  return std::max(slope_bound(theta_), across);
}

}  // namespace reckon::haptics
