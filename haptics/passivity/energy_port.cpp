// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/passivity/energy_port.hpp"

#include <algorithm>
#include <cmath>

namespace reckon::haptics {
namespace {

constexpr int kHalvings = 20;

}  // namespace

// Writes the chosen force: it was written at the beginning of the sample that ends now.
template <int axes>
void EnergyPortOf<axes>::pass() noexcept {
  if (reads_in_steps()) {
    const Force before = at_handle();
    held_.write(chosen_);
    shaken_.write(shaking_);
    allowance_ += unsure_ * (at_handle() - before).norm();
  } else {
    held_.write(chosen_);
    if (shakes_for_ > 0) shaken_.write(shaking_);
  }
  if (doubtful_ > 0) --doubtful_;
  commit();
}

// The hand may take |q|^2 T / (4 b) from each pending force q, independent of later bookings and
// forces.
template <int axes>
void EnergyPortOf<axes>::commit() noexcept {
  if (held_.delay() == 0) return;
  const double squares = held_.under_way(Force::Zero()).squares;
  committed_ = squares > 0 ? squares * period_ / (4.0 * rest_share() * damping()) : 0.0;
}

template <int axes>
void EnergyPortOf<axes>::keep_in_mind(double dt) noexcept {
  const Force& force = held_.at_handle();
  time_ += dt;
  impulse_ += dt * force;
  squares_ += dt * force.squaredNorm();
  if (shakes_for_ == 0) return;
  shake_impulse_ += dt * shaken_.at_handle();
  shake_squares_ += dt * shaken_.at_handle().squaredNorm();
}

// hold() assumed the damping loss of dx within its own dt.
template <int axes>
void EnergyPortOf<axes>::note_late(const Force& dx, double dt) noexcept {
  if (!(period_ > 0) || !(dt > period_)) return;
  const double way = dx.norm() + 2.0 * unsure_;
  late_ += damping() * way * way * (1.0 / period_ - 1.0 / dt);
}

template <int axes>
void EnergyPortOf<axes>::pose(double damping, double resolution) noexcept {
  sure_.pose(damping, resolution);
  dampings_[next_damping_] = damping;
  next_damping_ = next_damping_ + 1 == dampings_.size() ? 0 : next_damping_ + 1;
  damping_ = *std::ranges::min_element(dampings_);
  unsure_ = std::max(here_, half_diagonal(resolution));
  here_ = half_diagonal(resolution);
}

template <int axes>
void EnergyPortOf<axes>::settle(const Force& dx, double dt, double took, double held) noexcept {
  pass();
  note_late(dx, dt);
  if (missed_) {
    keep_in_mind(dt);
    settle_missed(dx, took, held);
    return;
  }
  const double whole = -held_.at_handle().dot(dx);
  const double work = whole > 0 ? held * whole : whole;
  const double lost = took > 0 ? sure_.move(dx, took) : 0.0;
  const double sure = (doubtful_ > 0 ? std::min(0.0, work) : work) + lost;
  absorb(sure);
  take_back(sure);
  if (shakes_for_ > 0) settle_shake(dx, held);
  forgo_loss(lost);
}

// The bucket pays for the work of an oscillation. If a motion takes more than the bucket has, E
// pays the rest: the damping of that motion has added at least as much to E.
template <int axes>
void EnergyPortOf<axes>::settle_shake(const Force& dx, double held) noexcept {
  const double work = shaken_.at_handle().dot(dx);
  if (work > 0) {
    EnergyLedger::shake(work);
  } else if (doubtful_ == 0) {
    EnergyLedger::shake(held * work);
  }
}

// Lower bound of the energy for unknown motion. Forces g_j are held for t_j each, within a time t
// in which the hand moved by D. The least of sum (b |dx_j|^2 / t_j - g_j dx_j) is b |D|^2 / t - m D
// - sum t_j |g_j - m|^2 / (4 b), with m the mean of the forces. For partly held forces it is - sum
//   t_j |g_j|^2 / (4 b), for any motion.
template <int axes>
void EnergyPortOf<axes>::settle_missed(const Force& dx, double took, double held) noexcept {
  const double spread = squares_ - impulse_.squaredNorm() / time_;
  const double pays = rest_share() * damping();
  const double work =
      -impulse_.dot(dx) / time_ - (pays > 0 ? std::max(0.0, spread) / (4.0 * pays) : 0.0);
  sure_.begin();
  const double lost = sure_.move(dx, std::max(time_, took));
  const double in_part = pays > 0 ? -squares_ / (4.0 * pays) : 0.0;
  const double sure = held < 1.0 ? in_part : std::min(0.0, work) + lost;
  absorb(sure);
  take_back(sure);
  if (shake_squares_ > 0) {
    const double way = std::max(0.0, shake_impulse_.dot(dx) / time_);
    EnergyLedger::shake(way + shake_squares_ / (4.0 * kShakeShare * damping()));
  }
  time_ = squares_ = shake_squares_ = 0.0;
  impulse_.setZero();
  shake_impulse_.setZero();
  missed_ = false;
}

template <int axes>
void EnergyPortOf<axes>::miss(double dt) noexcept {
  pass();
  keep_in_mind(dt);
  missed_ = true;
  doubtful_ = held_.delay() + 1;
}

template <int axes>
void EnergyPortOf<axes>::follow(const Force& change, const Force& dx) noexcept {
  if (!reads_in_steps()) return;
  const double length = dx.norm();
  const double step = length > 2.0 * unsure_ ? 2.0 * unsure_ / length : 1.0;
  absorb(-0.5 * step * change.dot(dx));
  allowance_ += unsure_ * change.norm();
}

template <int axes>
void EnergyPortOf<axes>::clear() noexcept {
  written_off_ += std::min(late_, debt());
  late_ = 0.0;
  absorb(-std::max(0.0, level_));
  level_ = booked_ = unearned_ = 0.0;
  region_loan().forget_due();
  sure_.begin();
  drop_force();
}

template <int axes>
void EnergyPortOf<axes>::drop_force() noexcept {
  held_.drop();
  shaken_.drop();
  chosen_.setZero();
  shaking_.setZero();
  commit();
}

// @param walls remaining share of the walls
template <int axes>
SplitBoundOf<axes> EnergyPortOf<axes>::bound_of(const Load& load, double walls,
                                                double dt) const noexcept {
  SplitBoundOf<axes> bound;
  bound.energy = std::max(0.0, level_ + (1.0 - walls) * load.walls_stored);
  bound.stored = load.stored;
  bound.springs = load.springs;
  bound.spare = rest_share() * damping() / dt - 0.5 * samples_ * walls * load.walls_slope;
  bound.half_slope = 0.5 * samples_ * load.springs_slope;
  if (held_.delay() > 0) bound.under_way = held_.under_way(walls * load.walls);
  return bound;
}

template <int axes>
PortHoldOf<axes> EnergyPortOf<axes>::hold(const Load& load, double dt) noexcept {
  Hold out;
  period_ = dt;
  shaking_.setZero();
  if (!load.shake.isZero(0.0)) {
    shakes_for_ = held_.delay() + 2;
  } else if (shakes_for_ > 0) {
    --shakes_for_;
  }
  commit();
  late_ = std::min(late_, debt());
  late_cost_ = std::max(late_cost_, written_off_ + late_);
  SplitBoundOf<axes> bound = bound_of(load, 1.0, dt);
  if (const auto whole = largest_weight(bound, load.springs + load.extra)) {
    out.weight = *whole;
  } else if (!choose_part(load, bound, out)) {
    lower_walls(load, dt, out);
    bound = bound_of(load, out.walls, dt);
  }
  booked_ = out.weight * load.stored;
  const Force shown = out.springs * load.springs + out.extra * load.extra;
  const double rests = bound.rests(shown, out.weight);
  const double pays = bound.spare - out.weight * bound.half_slope;
  const double reserved = rests > 0 ? rests / (4.0 * pays) : 0.0;
  const double left = std::clamp(unearned_, 0.0, std::max(0.0, level_));
  pushed_ = std::min(kMostKept, pushed_ + unearned_ - left);
  unearned_ = left;
  const double kept = std::min(kMostKept, kReceivedAtOnce + level_ - unearned_);
  const double thrown_away = std::max(0.0, level_ - booked_ - std::max(kept, reserved));
  level_ -= thrown_away;
  // The hand's surplus repays the loan for regions.
  if (region_loan().owed() > 0) region_loan().repay(std::max(0.0, thrown_away - unearned_));
  unearned_ = std::max(0.0, unearned_ - thrown_away);
  chosen_ = out.force = out.walls * load.walls + shown;
  return out;
}

// Reduces forces without storage first.
// @return false if the unchanged walls leave no energy for the pending forces.
template <int axes>
bool EnergyPortOf<axes>::choose_part(const Load& load, const SplitBoundOf<axes>& bound,
                                     Hold& out) const noexcept {
  const auto with_extra = [&](double share) {
    return largest_weight(bound, load.springs + share * load.extra);
  };
  auto weight = with_extra(0.0);
  out.extra = 0.0;
  double high = 1.0;
  for (int i = 0; weight && i < kHalvings; ++i) {
    const double middle = 0.5 * (out.extra + high);
    const auto there = with_extra(middle);
    (there ? out.extra : high) = middle;
    if (there) weight = there;
  }
  if (weight) {
    out.weight = *weight;
    return true;
  }
  if (const auto most = strongest(bound)) {
    out.weight = most->weight;
    out.springs = most->share;
    return true;
  }
  out.springs = 0.0;
  weight = largest_weight(bound, Force::Zero());
  out.weight = weight.value_or(0.0);
  return weight.has_value() || held_.delay() == 0;
}

// The pending forces were paid for when they were chosen, with all storage of the walls. So the
// shares of the walls that still pay for them form an interval that starts at 0.
template <int axes>
void EnergyPortOf<axes>::lower_walls(const Load& load, double dt, Hold& out) const noexcept {
  out.walls = 0.0;
  out.weight = 0.0;
  double high = 1.0;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (out.walls + high);
    const SplitBoundOf<axes> bound = bound_of(load, middle, dt);
    const bool answered =
        bound.spare > 0 && bound.rests(Force::Zero(), 0.0) <= 4.0 * bound.spare * bound.energy;
    (answered ? out.walls : high) = middle;
  }
}

template <int axes>
bool EnergyPortOf<axes>::hold_instead(const Load& load, const Force& force, double dt) noexcept {
  const auto weight = largest_weight(bound_of(load, 1.0, dt), force - load.walls);
  if (!weight) return false;
  booked_ = *weight * load.stored;
  chosen_ = force;
  return true;
}

// Any motion x takes at most f x, of which its damping pays kShakeShare: |f|^2 / (4 c) remains.
template <int axes>
const typename EnergyPortOf<axes>::Force& EnergyPortOf<axes>::shake(const Load& load,
                                                                    double dt) noexcept {
  const double asked = load.shake.squaredNorm();
  if (!(asked > 0) || !load.shake.allFinite()) return shaking_;
  const double under_way = shaken_.delay() > 0 ? shaken_.under_way(Force::Zero()).squares : 0.0;
  const double most = 4.0 * kShakeShare * damping() / dt * oscillations().level() - under_way;
  const double share = std::min(oscillations().share(), std::sqrt(std::max(0.0, most) / asked));
  return shaking_ = share * load.shake;
}

template class EnergyPortOf<3>;
template class EnergyPortOf<6>;

}  // namespace reckon::haptics
