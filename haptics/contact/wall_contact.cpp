// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/contact/wall_contact.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "reckon/haptics/contact/energy_exchange.hpp"

namespace reckon::haptics {
namespace {

constexpr double kRampSeconds = 0.1;
constexpr double kFadeSeconds = 0.5;
constexpr double kHideAfter = 0.5;  // [s] after the end of the loan
constexpr double kHiccup =
    0.05;  // share of the storage that a late sample may cost without a drop of the contact

}  // namespace

WallContact::WallContact(const EffectPlan& plan, double stiffness_cap, double radius)
    : solver_(plan, radius, stiffness_cap), cap_(stiffness_cap) {}

void WallContact::reset(const Eigen::Vector3d& device) noexcept {
  result_ = solver_.reset(device);
  measure_stiffness();
  gain_ = result_.in_contact ? 0.0 : 1.0;
  fades_in_ = result_.in_contact;
  lent_ = 0.0;
  force_.setZero();
}

void WallContact::resume(const Eigen::Vector3d& from, const Eigen::Vector3d& device,
                         EnergyLedger& ledger) noexcept {
  ledger.book(booked());
  reset(from);
  result_ = solver_.step(device);
  measure_stiffness();
  gain_ = most_gain();
  fades_in_ = false;
  ledger.book(-booked());
}

void WallContact::measure_stiffness() noexcept {
  stiffness_ = 0.0;
  for (const std::uint32_t i : result_.touched) {
    stiffness_ = std::max(stiffness_, solver_.stiffness_of(i));
  }
}

Eigen::Vector3d WallContact::move(const Eigen::Vector3d& device, double dt,
                                  EnergyLedger& ledger) noexcept {
  const double before = stored();
  const Eigen::Vector3d force = result_.force;
  result_ = solver_.step(device, dt);
  measure_stiffness();
  ledger.book(before - stored() - gain_ * solver_.lost());
  if (solver_.placed() > 0 || lent_ != 0.0) {
    take_from_carried(ledger);
    lend_for_motion(ledger);
  }
  return gain_ * (result_.force - force);
}

// A surface that moves by itself is a source of energy like any other: its gift is bounded, and
// beyond the bound the wall becomes soft. Energy that it takes is lost.
void WallContact::take_from_carried(EnergyLedger& ledger) noexcept {
  const double work = gain_ * solver_.carried_work();
  if (work > 0) {
    carried_ += ledger.credit(work, work);
  } else {
    ledger.give_back(-work);
    carried_ += work;
  }
}

// The velocity of a body under a held force lags its position by half a step. While it approaches,
// spring and body have T F v / 2 more energy than was put in, and as much less while it recedes.
// This energy is lent, and is back when they separate.
void WallContact::lend_for_motion(EnergyLedger& ledger) noexcept {
  double lent = 0.0;
  for (const std::uint32_t i : result_.touched) {
    const ObjectContact& contact = result_.objects[i];
    lent += solver_.ahead_of(i) * contact.force.dot(solver_.velocity_of(i, contact.scp));
  }
  ledger.book(gain_ * (lent - lent_));
  lent_ = lent;
}

void WallContact::settle(double dt, EnergyLedger& ledger) noexcept {
  // A late sample, or an object entered with the gain of fewer objects, may leave a debt.
  const double debt = ledger.debt();
  if (debt > 0) {
    if (debt > kHiccup * stored()) drop();
    scale_gain(debt < booked() ? 1.0 - debt / booked() : 0.0, ledger);
  }
  const double most = most_gain();
  if (gain_ > most) scale_gain(most / gain_, ledger);
  follow_patches(dt, ledger);
  raise_gain(dt, ledger);
  hide_rest(dt, ledger);
}

// Nobody put in the storage that a stretched spring gains when its stiffness grows. The ledger pays
// for it, first from the energy of the sample.
void WallContact::follow_patches(double dt, EnergyLedger& ledger) noexcept {
  share_ = patch_share_ = 1.0;
  if (!solver_.on_patches() || !(gain_ > 0)) return;
  const double before = stored();
  result_ = solver_.follow_patches(dt, std::max(0.0, ledger.level()) / gain_);
  ledger.book(before - stored());
  measure_stiffness();
  share_ = patch_share_ = solver_.patch_share();
}

double WallContact::most_gain() const noexcept {
  return stiffness_ > 0 ? std::min(1.0, cap_ / stiffness_) : 1.0;
}

void WallContact::scale_gain(double factor, EnergyLedger& ledger) noexcept {
  ledger.book(booked() * (1.0 - factor));
  gain_ *= factor;
}

void WallContact::raise_gain(double dt, EnergyLedger& ledger) noexcept {
  const double full = result_.stored_energy;
  const double most = most_gain();
  if (!(full > 0)) {
    gain_ = most;
    fades_in_ = false;
    return;
  }
  const double wanted = std::min(most - gain_, dt / (fades_in_ ? kFadeSeconds : kRampSeconds));
  const double rise = std::clamp(ledger.level() / full, 0.0, std::max(0.0, wanted));
  ledger.book(-rise * (full - lent_));
  gain_ += rise;
  if (rise < wanted) share_ *= gain_ / most;
  if (!(gain_ < most)) fades_in_ = false;
}

// A full spring stores less at the same force than a weaker one over the whole depth, so this only
// frees energy.
void WallContact::hide_rest(double dt, EnergyLedger& ledger) noexcept {
  shown_depth_ = solver_.shown_depth();
  share_ *= shown_depth_;
  const double most = most_gain();
  const bool ended = fades_in_ && gain_ < most && ledger.owed() >= (1.0 - 1e-6) * kGreatestLoan;
  without_loan_ = ended ? without_loan_ + dt : 0.0;
  if (!ended || without_loan_ < kHideAfter) return;
  const double before = booked();
  result_ = solver_.hide(gain_ / most);
  gain_ = most;
  fades_in_ = false;
  ledger.book(before - booked());
}

// The effects' forces have no storage, and the port limits them. Here they are limited so that the
// sum never pulls the hand to the surface.
void WallContact::load(const Eigen::Vector3d& velocity, double dt, PortLoad& load) noexcept {
  extra_.setZero();
  effects_.setZero();
  not_pulling_ = 1.0;
  force_ = gain_ * result_.force;
  if (result_.objects.empty()) return;
  load.walls += force_;
  load.walls_slope += gain_ * stiffness_;
  load.walls_stored += stored();
  effects_ = gain_ * solver_.effect_force(velocity, dt, gain_);
  const Eigen::Vector3d wanted = effects_ + change_;
  const double size = wanted.norm();
  const double spring = force_.norm();
  const bool is_known = !result_.in_contact || spring > 0;  // else a pull cannot be recognised
  if (!(size > 0) || !std::isfinite(size) || !is_known) {
    effects_.setZero();
    not_pulling_ = 0.0;
    return;
  }
  const double along = spring > 0 ? wanted.dot(force_) / spring : 0.0;
  if (along < 0) not_pulling_ = std::min(1.0, spring / -along);
  extra_ = not_pulling_ < 1.0 ? Eigen::Vector3d(not_pulling_ * wanted) : wanted;
  load.extra += extra_;
}

void WallContact::attenuate(double factor, EnergyLedger& ledger) noexcept {
  const double keep = std::clamp(factor, 0.0, 1.0);
  scale_gain(keep, ledger);
  force_ *= keep;
}

}  // namespace reckon::haptics
