// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/passivity/force_gate.hpp"

#include <algorithm>
#include <cmath>

namespace reckon::haptics {
namespace {

Eigen::Vector3d tangential(const Eigen::Vector3d& v, const Eigen::Vector3d& normal) {
  return v - v.dot(normal) * normal;
}

}  // namespace

void ForceGate::reset(const Eigen::Vector3d& probe) noexcept {
  ledger_.clear();
  theta_ = ContactParameters{};
  state_ = State{};
  force_.setZero();
  probe_ = probe;
}

void ForceGate::release() noexcept {
  ledger_.book(state_.energy);
  theta_.gain = 0.0;
  state_ = evaluate(theta_, Eigen::Vector3d::Zero(), false);
}

// Projecting the bristle on the present tangent plane and cutting it at the friction limit only
// ever lower the energy.
ForceGate::State ForceGate::evaluate(const ContactParameters& theta, const Eigen::Vector3d& bristle,
                                     bool slipping) const noexcept {
  State s;
  s.geometry = haptics::geometry(theta, probe_);
  const SpringLoad load = normal_load(theta, s.geometry.depth);
  s.normal_force = load.force;
  s.energy = load.energy;
  const double stiffness = bristle_stiffness(theta);
  if (!(load.force > 0) || stiffness <= 0 || theta.static_friction <= 0) return s;

  s.bristle = tangential(bristle, s.geometry.normal);
  const double pull = stiffness * s.bristle.norm();
  const double stick = theta.static_friction * load.force;
  const double slide = theta.kinetic_friction * load.force;
  // Sliding ends only when the motion turns round and the bristle slackens.
  s.slipping = slipping ? pull > slide * (1.0 - 1e-9) : pull > stick;
  if (s.slipping && pull > slide) s.bristle *= slide / pull;
  s.energy += 0.5 * stiffness * s.bristle.squaredNorm();
  return s;
}

// The state at other parameters: the bristle's foot goes with the surface.
ForceGate::State ForceGate::moved(const ContactParameters& theta) const noexcept {
  return evaluate(theta, state_.bristle - (theta.point - theta_.point), state_.slipping);
}

void ForceGate::settle(const Eigen::Vector3d& probe, double damping_share, double dt) noexcept {
  const Eigen::Vector3d dx = probe - probe_;
  probe_ = probe;
  // Only motion in the old tangent plane stretches the bristle: the normal spring has the rest.
  const State next =
      evaluate(theta_, state_.bristle + tangential(dx, state_.geometry.normal), state_.slipping);
  const double absorbed = -force_.dot(dx);
  ledger_.book(absorbed - (next.energy - state_.energy) + damping_share * dx.squaredNorm() / dt);
  state_ = next;
  settle_debt();
}

// A late sample or an edge of the contact region can cost more than the ledger holds. Lowering the
// gain gives that much back at once; storage is proportional to it.
void ForceGate::settle_debt() noexcept {
  const double debt = ledger_.debt();
  if (debt <= 0) return;
  const double keep = debt < state_.energy ? 1.0 - debt / state_.energy : 0.0;
  ledger_.book(state_.energy * (1.0 - keep));
  theta_.gain *= keep;
  state_.energy *= keep;
  state_.normal_force *= keep;
}

double ForceGate::move(const ContactParameters& target) noexcept {
  if (!is_usable(target)) return 0.0;
  if (target.kind != theta_.kind) {
    release();
    theta_ = target;
    theta_.gain = 0.0;
    state_ = evaluate(theta_, Eigen::Vector3d::Zero(), false);
  }
  const auto affordable = [this](const State& s) {
    return s.energy - state_.energy <= std::max(0.0, ledger_.level());
  };
  double fraction = 1.0;
  ContactParameters theta = target;
  State next = moved(theta);
  if (!affordable(next)) {
    double blocked = 1.0;
    fraction = 0.0;
    for (int i = 0; i < 40; ++i) {
      const double middle = 0.5 * (fraction + blocked);
      (affordable(moved(between(theta_, target, middle))) ? fraction : blocked) = middle;
    }
    if (fraction == 0.0) return 0.0;
    theta = between(theta_, target, fraction);
    next = moved(theta);
  }
  ledger_.book(state_.energy - next.energy);
  theta_ = theta;
  state_ = next;
  return fraction;
}

double ForceGate::shortfall(const ContactParameters& target) const noexcept {
  if (!is_usable(target)) return 0.0;
  return std::max(0.0, moved(target).energy - state_.energy - ledger_.level());
}

const Eigen::Vector3d& ForceGate::render(double damper, double damping_share, double dt) noexcept {
  const Eigen::Vector3d& n = state_.geometry.normal;
  force_ = state_.normal_force * n - bristle_stiffness(theta_) * state_.bristle;
  const double spare = damping_share / dt - 0.5 * slope_bound(theta_);
  if (!(state_.geometry.depth > 0) || !(spare > 0) || !std::isfinite(damper)) return force_;
  const double most = ledger_.coverable_force(spare);
  const double wanted = std::max(theta_.gain * damper, -state_.normal_force);
  force_ += std::clamp(wanted, -most, most) * n;
  return force_;
}

void ForceGate::attenuate(double factor) noexcept {
  const double keep = std::clamp(factor, 0.0, 1.0);
  ledger_.book(state_.energy * (1.0 - keep));
  theta_.gain *= keep;
  state_.energy *= keep;
  state_.normal_force *= keep;
  force_ *= keep;
}

double ForceGate::credit(double energy) noexcept {
  const double fits = energy > 0 ? std::min(energy, ledger_.room()) : 0.0;
  ledger_.book(fits);
  return fits;
}

double ForceGate::give(double wanted) noexcept {
  const double gift = wanted > 0 ? std::min(0.9 * std::max(0.0, ledger_.level()), wanted) : 0.0;
  ledger_.spend(gift);
  return gift;
}

}  // namespace reckon::haptics
