// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/contact/remote_contact.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "reckon/deadreckon/motion/drm.hpp"

namespace reckon::haptics {
namespace {

using std::chrono::nanoseconds;

constexpr double kEngageMargin = 0.02;  // [m], a hand this near gets its share of damping
constexpr double kReserve = 0.001;      // [J], kept at hand while touching a hand near by
constexpr double kNearAge = 0.01;       // [s], updates younger than this come from near by
constexpr double kGreatestTotal = 1e6;  // [J], larger totals are nonsense

// Difference of two times that may be hostile, without overflow.
double seconds_between(nanoseconds from, nanoseconds to) {
  return 1e-9 * (static_cast<double>(to.count()) - static_cast<double>(from.count()));
}

bool is_sound(const RemoteHand& hand) {
  return deadreckon::is_finite(hand.state) && hand.model.point.allFinite() &&
         hand.model.normal.allFinite() && std::isfinite(hand.model.damping) &&
         hand.model.damping >= 0;
}

}  // namespace

void RemoteContact::begin(const RemoteHand& hand, PairAccount& account,
                          const StepContext& step) noexcept {
  *this = RemoteContact{};
  account_ = &account;
  gate_.reset(step.probe);
  hand_.id = hand.id;
  if (!account.used || account.id != hand.id) {
    account = PairAccount{};
    account.id = hand.id;
    account.used = true;
    account.epoch = hand.epoch;
    account.seen = std::isfinite(hand.given_to_us) ? std::max(0.0, hand.given_to_us) : 0.0;
  }
  accept(hand, step);
}

void RemoteContact::accept(const RemoteHand& hand, const StepContext& step) noexcept {
  credit(hand);
  answer_ = true;
  hand_.version = hand.version;
  hand_.need = hand.need;
  hand_.valid_until = hand.valid_until;
  if (!is_sound(hand)) return;  // the last good record goes on until it expires

  const double interval = seconds_between(hand_.state_time, hand.state_time);
  const Eigen::Vector3d expected = full_.point;
  const bool known = usable_;
  hand_ = hand;
  usable_ = true;
  if (predicted_at_.count() == 0) predicted_at_ = step.now;
  pose_ = pose_at(predicted_at_);
  full_ = target_at(pose_, step);
  if (known && interval > 0) {
    const double age = seconds_between(hand.state_time, step.now);
    tracker_.learn(age, interval, (full_.point - expected).norm());
  } else if (!known) {
    tracker_.learn(seconds_between(hand.state_time, step.now), 0.0, 0.0);
  }
}

// Totals only grow; loss and reordering can lose energy but not make any. A new epoch is a new life
// of the owner: its total starts anew and what was given before we heard of it is lost.
void RemoteContact::credit(const RemoteHand& hand) noexcept {
  const double total = hand.given_to_us;
  const bool sound = std::isfinite(total) && total >= 0 && total <= kGreatestTotal;
  if (hand.epoch != account_->epoch) {
    account_->epoch = hand.epoch;
    account_->seen = sound ? total : kGreatestTotal;
    return;
  }
  if (!sound || total <= account_->seen) return;
  account_->received += gate_.credit(total - account_->seen);
  account_->seen = total;
}

deadreckon::Pose RemoteContact::pose_at(nanoseconds time) const noexcept {
  return deadreckon::extrapolate(hand_.state, seconds_between(hand_.state_time, time));
}

ContactParameters RemoteContact::target_at(const deadreckon::Pose& pose,
                                           const StepContext& step) const noexcept {
  ContactParameters theta = parameters(hand_.model, pose, step.probe_radius);
  theta.force_limit = step.force_limit;
  return theta;
}

void RemoteContact::predict(const StepContext& step, bool frozen) noexcept {
  if (!frozen || predicted_at_.count() == 0) predicted_at_ = step.now;
  const double late = seconds_between(hand_.valid_until, predicted_at_);
  const double valid = usable_ ? std::clamp(1.0 - late / kRamp, 0.0, 1.0) : 0.0;
  fade_ = leaving_ ? std::max(0.0, fade_ - step.dt / kRamp) : valid;
  if (!usable_) return;

  const auto dt = nanoseconds(static_cast<std::int64_t>(frozen ? 0.0 : 1e9 * step.dt));
  pose_ = pose_at(predicted_at_);
  before_ = target_at(pose_at(predicted_at_ - dt), step);
  full_ = target_at(pose_, step);
  full_.gain = fade_;
  ungated_ = fade_ *
             deadreckon::evaluate(hand_.model, pose_, step.probe, step.velocity, step.probe_radius);
}

double RemoteContact::wanted_share(double stiffness_per_damping) const noexcept {
  if (!usable_ || !haptics::is_usable(full_) || fade_ <= 0) return 0.0;
  const double reach = kEngageMargin + kRamp * pose_.velocity.norm();
  const double depth =
      std::max(haptics::geometry(full_, gate_.probe()).depth, gate_.geometry().depth);
  if (!(depth > -reach) && !touching()) return 0.0;
  if (full_.k3 > 0) return std::numeric_limits<double>::infinity();
  return full_.k1 / stiffness_per_damping + hand_.model.damping;
}

void RemoteContact::grant(double own, double income, double stiffness_per_damping) noexcept {
  own_share_ = own;
  income_ = income;
  damping_ = std::min(hand_.model.damping, 0.5 * own);
  full_.slope_limit = stiffness_per_damping * (own - damping_);
}

void RemoteContact::advance(const StepContext& step) noexcept {
  if (usable_ && haptics::is_usable(full_)) {
    follow(step);
    short_ = step.transfer && !leaving_ ? gate_.shortfall(full_) : 0.0;
  } else {
    fade_out(step);
    short_ = 0.0;
  }
  if (answer_ && step.transfer) give();
  answer_ = false;
  need_ = need(step);
}

void RemoteContact::follow(const StepContext& step) noexcept {
  const ContactParameters& shown = gate_.parameters();
  const bool apart =
      !touching() && !(haptics::geometry(full_, step.probe).depth > 0 && full_.gain > 0);
  const bool fresh = shown.kind != full_.kind;
  if (!fresh && (full_.point - shown.point).norm() > kTeleport) gate_.release();
  const Eigen::Vector3d velocity = (full_.point - before_.point) / step.dt;
  if (apart) {
    tracker_.snap(velocity);
    gate_.move(full_);
    return;
  }

  ContactParameters target = full_;
  target.gain = std::min(full_.gain, shown.gain + step.dt / kRamp);
  if (fresh || shown.gain <= 0) {
    tracker_.snap(velocity);
    target.gain = 0.0;
    gate_.move(target);
    target.gain = std::min(full_.gain, step.dt / kRamp);
  } else {
    const double take = std::min(1.0, step.dt / tracker_.time_constant());
    const auto slew = [take](double from, double to) { return from + take * (to - from); };
    target.point = tracker_.follow(before_.point, full_.point, shown.point, step.dt);
    const Eigen::Vector3d normal = full_.normal + (1 - take) * (shown.normal - before_.normal);
    if (normal.norm() > 1e-9) target.normal = normal.normalized();
    target.reach = slew(shown.reach, full_.reach);
    target.patch = slew(shown.patch, full_.patch);
    target.k1 = slew(shown.k1, full_.k1);
    target.k3 = slew(shown.k3, full_.k3);
    target.static_friction = slew(shown.static_friction, full_.static_friction);
    target.kinetic_friction = slew(shown.kinetic_friction, full_.kinetic_friction);
  }
  gate_.move(target);
}

// A prediction that left the world: what is shown goes away as an expired model would.
void RemoteContact::fade_out(const StepContext& step) noexcept {
  ContactParameters target = gate_.parameters();
  target.gain = std::max(0.0, target.gain - step.dt / kRamp);
  gate_.move(target);
}

// Near by, energy is asked for before it is missed, so that a motion need not wait for the answer.
// Far away that only makes energy go to and fro.
double RemoteContact::need(const StepContext& step) const noexcept {
  const bool early = step.transfer && !leaving_ && touching() && tracker_.age() < kNearAge;
  return std::max(short_, early ? kReserve - gate_.ledger() : 0.0);
}

// Only a side that lacks nothing gives.
void RemoteContact::give() noexcept {
  if (short_ > 0 || !std::isfinite(hand_.need) || !(hand_.need > 0)) return;
  account_->given += gate_.give(hand_.need);
}

const Eigen::Vector3d& RemoteContact::render(const StepContext& step) noexcept {
  const Eigen::Vector3d& n = gate_.geometry().normal;
  const Eigen::Vector3d arm = step.probe - pose_.position;
  const Eigen::Vector3d spin = pose_.orientation * pose_.angular_velocity;
  const Eigen::Vector3d surface = pose_.velocity + spin.cross(arm);
  const double damper = -damping_ * n.dot(step.velocity - surface);
  return gate_.render(damper, share(), step.period);
}

void RemoteContact::forfeit(const Eigen::Vector3d& probe) noexcept {
  gate_.reset(probe);
  tracker_.snap(Eigen::Vector3d::Zero());
}

ContactAccount RemoteContact::account() const noexcept {
  ContactAccount out;
  out.id = hand_.id;
  out.given = account_->given;
  out.received = account_->received;
  out.need = need_;
  out.depth = gate_.geometry().depth;
  out.force = gate_.force();
  out.ungated_force = ungated_;
  out.ledger = gate_.ledger();
  return out;
}

}  // namespace reckon::haptics
