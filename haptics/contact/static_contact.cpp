// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/contact/static_contact.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace reckon::haptics {
namespace {

constexpr double kRampSeconds = 0.1;

}  // namespace

StaticContact::StaticContact(const EffectPlan& plan, double stiffness_cap, double ledger_limit)
    : plan_(plan), solver_(plan), cap_(stiffness_cap), ledger_(ledger_limit) {}

void StaticContact::reset(const Eigen::Vector3d& device) noexcept {
  ledger_.clear();
  result_ = solver_.reset(device);
  measure_stiffness();
  gain_ = result_.in_contact ? 0.0 : 1.0;
  force_.setZero();
  device_ = device;
}

void StaticContact::measure_stiffness() noexcept {
  stiffness_ = 0.0;
  for (const std::uint32_t i : result_.touched) stiffness_ += plan_.objects()[i].stiffness();
}

void StaticContact::settle(const Eigen::Vector3d& device, double damping_share,
                           double dt) noexcept {
  const Eigen::Vector3d dx = device - device_;
  const double before = stored();
  const double absorbed = -force_.dot(dx);
  device_ = device;
  result_ = solver_.step(device);
  measure_stiffness();
  ledger_.book(absorbed - (stored() - before) + damping_share * dx.squaredNorm() / dt);

  // A late sample, or an object entered with the gain of fewer objects, may leave a debt.
  const double debt = ledger_.debt();
  if (debt > 0) scale_gain(debt < stored() ? 1.0 - debt / stored() : 0.0);
  const double most = stiffness_ > 0 ? std::min(1.0, cap_ / stiffness_) : 1.0;
  if (gain_ > most) scale_gain(most / gain_);
  raise_gain(dt);
}

void StaticContact::scale_gain(double factor) noexcept {
  ledger_.book(stored() * (1.0 - factor));
  gain_ *= factor;
}

void StaticContact::raise_gain(double dt) noexcept {
  const double full = result_.stored_energy;
  const double most = stiffness_ > 0 ? std::min(1.0, cap_ / stiffness_) : 1.0;
  if (!(full > 0)) {
    gain_ = most;
    return;
  }
  const double wanted = std::min(most - gain_, dt / kRampSeconds);
  const double rise = std::clamp(ledger_.level() / full, 0.0, std::max(0.0, wanted));
  ledger_.spend(rise * full);
  gain_ += rise;
}

// With f of the springs and F of the effects held over a motion dx, the next settle() books
//   -(f + F).dx - (S(x + dx) - S(x)) + b |dx|^2 / dt  >=  -F.dx + c |dx|^2  >=  -F^2 / (4 c),
// for S(x + dx) <= S(x) - f.dx + K |dx|^2 / 2 leaves c = b / dt - K / 2 to pay for F, whatever F is
// and wherever the hand goes. So F is cut to what the ledger covers, and to where the sum would
// pull the hand to the surface.
const Eigen::Vector3d& StaticContact::render(const Eigen::Vector3d& velocity, double damping_share,
                                             double dt) noexcept {
  force_ = gain_ * result_.force;
  if (result_.objects.empty()) return force_;
  const Eigen::Vector3d wanted = gain_ * solver_.effect_force(velocity, dt);
  const double size = wanted.norm();
  const double spring = force_.norm();
  const double spare = damping_share / dt - 0.5 * gain_ * stiffness_;
  if (!(size > 0) || !std::isfinite(size) || !(spare > 0)) return force_;
  if (result_.in_contact && !(spring > 0)) return force_;  // what would be a pull is not known

  double share = std::min(1.0, ledger_.coverable_force(spare) / size);
  const double along = spring > 0 ? wanted.dot(force_) / spring : 0.0;
  if (along < 0) share = std::min(share, spring / -along);
  force_ += share * wanted;
  return force_;
}

void StaticContact::attenuate(double factor) noexcept {
  const double keep = std::clamp(factor, 0.0, 1.0);
  scale_gain(keep);
  force_ *= keep;
}

}  // namespace reckon::haptics
