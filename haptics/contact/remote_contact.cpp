// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/contact/remote_contact.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "reckon/deadreckon/motion/acceleration_trust.hpp"
#include "reckon/haptics/contact/hand_record.hpp"
#include "reckon/haptics/contact/surface_push.hpp"

namespace reckon::haptics {
namespace {

using std::chrono::nanoseconds;

constexpr double kEngageMargin = 0.005;  // [m], a hand within this distance exchanges energy
constexpr double kNearAge = 0.018;       // [s], with a lower delay a shortage is shared
constexpr double kSpareShare = 0.001;   // [J], beyond a contact's greatest need: passed on, or lost
constexpr double kDeepestGuess = 0.75;  // of the reach, for extrapolation alone
constexpr double kCalmRate = 200.0;     // [N/s], for a surface that is not where it is shown
constexpr double kReleaseRate = 400.0;  // [N/s], for a surface that is elsewhere
constexpr double kShallow = 0.001;      // [m], below which a change of a spring is hardly felt
constexpr double kReshape = 0.1;        // [s], time constant of a change of the spring
constexpr double kReshaped = 0.3;       // [s], after which the old spring has gone

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Difference of two untrusted times, without overflow.
double seconds_between(nanoseconds from, nanoseconds to) {
  return 1e-9 * (static_cast<double>(to.count()) - static_cast<double>(from.count()));
}

}  // namespace

void RemoteContact::begin(const RemoteHand& hand, PairAccount& account,
                          const StepContext& step) noexcept {
  *this = RemoteContact{};
  account_ = &account;
  spring_.reset(step.probe);
  hand_.id = hand.id;
  account.open(hand.id, hand.epoch, hand.given_to_us);
  accept(hand, step);
}

void RemoteContact::accept(const RemoteHand& hand, const StepContext& step) noexcept {
  account_->receive(hand.epoch, hand.given_to_us);
  answer_ = true;
  hand_.version = hand.version;
  hand_.need = hand.need;
  hand_.spring_need = hand.spring_need;
  asked_ = std::isfinite(hand.need) ? std::max(0.0, hand.need) : 0.0;
  hand_.valid_until = hand.valid_until;
  unsound_ = !is_sound(hand);
  if (unsound_) return;  // the last good record goes on until it expires

  const double interval = seconds_between(hand_.state_time, hand.state_time);
  const Eigen::Vector3d expected = full_.point;
  const bool known = usable_;
  if (known && touching() && is_reshaped(hand_.model, hand.model)) reshaping_ = kReshaped;
  hand_ = hand;
  usable_ = true;
  damping_ = std::min(hand.model.damping, 0.5 * step.damping);
  if (predicted_at_.count() == 0) predicted_at_ = step.now;
  blow_.receive(hand.state, hand.state_time);
  const ContactParameters stated = target_at(stated_pose(), step);
  stated_point_ = stated.point;
  if (!touching() || haptics::geometry(stated, step.probe).depth < 0) expect_blow(step);
  pose_ = pose_now();
  full_ = target_at(pose_, step);
  stop_before_centre(full_.point, step.probe);
  if (known && interval > 0) {
    const double age = seconds_between(hand.state_time, step.now);
    const double miss = touching() ? (full_.point - expected).norm() : 0.0;
    tracker_.learn(age, interval, miss);
  } else if (!known) {
    tracker_.learn(seconds_between(hand.state_time, step.now), 0.0, 0.0);
  }
}

// Observes the work of the moving surface on our spring. Positive work counts in full even if the
// spring is only partly held, because a hand that lacks energy would otherwise never credit
// anybody. Negative work counts only for the held share.
void RemoteContact::show(const ContactParameters& target) noexcept {
  const SurfacePush before(spring_);
  spring_.move(target);
  const SurfacePush after(spring_);
  const double work = work_between(before, after);
  account_->see(work > 0 ? work : share_ * work);
}

// Pose as stated by the owner.
deadreckon::Pose RemoteContact::stated_pose() const noexcept {
  return deadreckon::extrapolate(hand_.state, 0.0);
}

// @param before [s], evaluates the same record earlier by this
deadreckon::Pose RemoteContact::pose_now(double before) const noexcept {
  if (blow_.behind() > 0) return blow_.pose(predicted_at_, before);
  const double age = seconds_between(hand_.state_time, predicted_at_) - before;
  return hand_.has_device ? hand_pose(hand_.state, age)
                          : deadreckon::extrapolate_trusted(hand_.state, age);
}

ContactParameters RemoteContact::target_at(const deadreckon::Pose& pose,
                                           const StepContext& step) const noexcept {
  ContactParameters theta = parameters(hand_.model, pose, step.probe_radius);
  theta.force_limit = step.force_limit;
  // Damping that the damper uses cannot also carry a spring.
  const double left = step.damping > 0 ? 1.0 - damping_ / step.damping : 1.0;
  const double most = left * (hand_.has_device ? step.stiffness_limit : step.body_stiffness_limit);
  theta.slope_limit = step.softening * most;
  theta.k1 = step.softening * std::min(theta.k1, most);
  theta.k3 *= step.softening;
  return theta;
}

// Extrapolation does not include touches: a hand that ours stops would continue through the middle
// of ours, and pull from there. Only the owner's states show on which side the hand is.
void RemoteContact::stop_before_centre(Eigen::Vector3d& centre,
                                       const Eigen::Vector3d& probe) const noexcept {
  if (!hand_.has_device || !is_sphere(full_.kind)) return;
  const Eigen::Vector3d away = probe - stated_point_;
  const double distance = away.norm();
  if (!(distance > 0)) return;
  double deepest = kDeepestGuess * full_.reach;
  if (blow_.is_guessed(seconds_between(hand_.state_time, predicted_at_))) {
    const double closing = std::max(0.0, away.dot(pose_.velocity) / distance);
    const double stated = std::max(0.0, full_.reach - distance);
    deepest = std::min(deepest, Blow::deepest_guess(stated, closing, full_.k1));
  }
  const double nearest = std::min(distance, full_.reach - deepest);
  const double beyond = nearest - (probe - centre).dot(away) / distance;
  if (beyond > 0) centre -= beyond / distance * away;
}

void RemoteContact::predict(const StepContext& step, bool frozen) noexcept {
  if (!frozen || predicted_at_.count() == 0) predicted_at_ = step.now;
  reshaping_ = std::max(0.0, reshaping_ - step.dt);
  const double late = seconds_between(hand_.valid_until, predicted_at_);
  const double valid = usable_ ? std::clamp(1.0 - late / kRamp, 0.0, 1.0) : 0.0;
  fade_ = leaving_ || apart_ ? std::max(0.0, fade_ - step.dt / kRamp) : valid;
  if (!usable_) return;

  const double moved = frozen ? 0.0 : blow_.move_on(step.dt, touching());
  pose_ = pose_now();
  before_ = place(hand_.model, pose_now(moved));
  full_ = target_at(pose_, step);
  stop_before_centre(before_.point, step.probe);
  stop_before_centre(full_.point, step.probe);
  full_.gain = fade_;
  showable_ = haptics::is_usable(full_);
  there_ = haptics::geometry(full_, step.probe);
  const SpringLoad load = normal_load(full_, there_.depth);
  coming_ = load.force * there_.normal;
  if (!coming_.allFinite()) coming_.setZero();
  coming_store_ = std::isfinite(load.energy) ? load.energy : 0.0;
  ungated_ = fade_ *
             deadreckon::evaluate(hand_.model, pose_, step.probe, step.velocity, step.probe_radius);
}

void RemoteContact::advance(const StepContext& step) noexcept {
  if (showable_) {
    follow(step);
  } else {
    fade_out(step);
  }
  if (!engaged()) began_inside_ = false;
}

// Whether the surface has moved to another place. If it were followed, it would be shown meanwhile
// at a distant place, or on the other side of our hand, where it would pull the wrong way.
bool RemoteContact::is_elsewhere(const ContactParameters& shown) const noexcept {
  if ((full_.point - shown.point).norm() > kTeleport) return true;
  return touching() && there_.depth > 0 && there_.normal.dot(spring_.geometry().normal) < 0;
}

void RemoteContact::expect_blow(const StepContext& step) noexcept {
  if (!hand_.has_device) return;
  const Eigen::Vector3d away = step.probe - stated_point_;
  const double closing = away.dot(stated_pose().velocity) / away.norm();
  blow_.expect(closing, std::max(tracker_.age(), seconds_between(hand_.state_time, step.now)));
}

// In a blow the surface recedes as fast as updates state.
void RemoteContact::recede(ContactParameters& target, const StepContext& step) noexcept {
  if (!blow_.is_on() || !hand_.has_device || !is_sphere(target.kind)) return;
  const Eigen::Vector3d& normal = spring_.geometry().normal;
  const double excess = normal.dot(target.point - full_.point);
  if (excess <= 0) return;
  const double take = blow_.release(step.dt);
  target.point -= take * excess * normal;
  tracker_.hold_back(normal, (full_.point - before_.point) / step.dt, take);
}

// Greatest share of the difference to the prediction that is taken in this step: a jump is felt as
// a push, not as a blow. The spring of a hand changes separately and slowly; the spring of a body
// changes with its position.
double RemoteContact::calm_share(const ContactParameters& shown,
                                 const StepContext& step) const noexcept {
  const Eigen::Vector3d normal = spring_.normal_force() * spring_.geometry().normal;
  const double faded = full_.gain > 0 ? shown.gain / full_.gain : 0.0;
  double away = std::abs(std::min(0.0, there_.depth) - std::min(0.0, spring_.geometry().depth));
  if (!is_sphere(full_.kind)) {
    const double lever = (spring_.probe() - shown.point).norm();
    away += lever * (full_.normal - shown.normal).norm();
  }
  double missing = (faded * coming_ - normal).norm();
  if (std::max(shown.k3, full_.k3) > 0) {  // steeper at the deep end than in between
    const double here = std::max(0.0, spring_.geometry().depth);
    const double there = std::max(0.0, there_.depth);
    const double deepest = std::max(here, there);
    const double slope = std::max(slope_at(shown, deepest), slope_at(full_, deepest));
    missing = std::max(missing, shown.gain * slope * std::abs(there - here));
  }
  missing += shown.gain * std::max(shown.k1, full_.k1) * away;
  // A ball that passes the hand presses it on the way by more than at either end.
  if (is_sphere(full_.kind) && passes(shown.point, full_.point, full_.reach, spring_.probe())) {
    const double slope = std::max(slope_bound(shown), slope_bound(full_));
    missing = std::max(missing, slope * (full_.point - shown.point).norm());
  }
  const double share = std::min(1.0, kCalmRate * step.dt / std::max(missing, 1e-3));
  return reshaping_ > 0 && !hand_.has_device ? std::min(share, step.dt / kReshape) : share;
}

void RemoteContact::follow(const StepContext& step) noexcept {
  const ContactParameters& shown = spring_.parameters();
  const bool apart = !touching() && !(there_.depth > 0 && full_.gain > 0);
  const bool fresh = shown.kind != full_.kind;
  const bool elsewhere = !fresh && is_elsewhere(shown);
  if (elsewhere && !release(step)) return;
  const Eigen::Vector3d velocity = (full_.point - before_.point) / step.dt;
  blow_.pass(step.dt);
  if (apart) {
    const Eigen::Vector3d& normal = there_.normal;
    blow_.see(normal.dot(velocity - step.velocity), -normal.dot(step.velocity));
    lost_ = fade_ <= 0;
    began_inside_ = false;
    tracker_.snap(velocity);
    spring_.move(full_);
    return;
  }

  ContactParameters target = full_;
  target.gain = std::min(full_.gain, shown.gain + step.dt / kRamp);
  if (fresh || shown.gain <= 0) {
    began_inside_ = began_inside_ || lost_;
    lost_ = false;
    tracker_.snap(elsewhere ? Eigen::Vector3d(Eigen::Vector3d::Zero()) : velocity);
    target.gain = 0.0;
    spring_.move(target);
    target.gain = std::min(full_.gain, step.dt / kRamp);
  } else {
    const bool alone = step.engaged <= 1 && hand_.neighbours <= 1;
    const bool in_want = began_inside_ || step.softening < 1.0;
    Following how{alone && !in_want, full_.k1, 1.0};
    how.in_row = !alone && hand_.has_device;
    how.played = blow_.behind() > 0;
    how.share = calm_share(shown, step);
    const double take = std::min(how.share, step.dt / tracker_.time_constant(how));
    // A body that nobody holds may change all at once. While untouched it changes before it is
    // felt, because an outdated stiffness would be met first. A hand changes its stiffness slowly.
    const bool leaps = !hand_.has_device;
    const bool at_once = leaps && !touching();
    const double part = leaps ? take : std::min(take, step.dt / kReshape);
    const double deep = std::max(kShallow, spring_.geometry().depth);
    const double most = at_once ? kInfinity : kCalmRate * step.dt / deep;
    const auto slew = [at_once, part](double from, double to, double farthest) {
      return at_once ? to : from + std::clamp(part * (to - from), -farthest, farthest);
    };
    target.k1 = slew(shown.k1, full_.k1, leaps ? kInfinity : most);
    if (leaps && touching() && target.k1 > 0) how.weight = full_.k1 / target.k1;
    target.point = tracker_.follow(before_.point, full_.point, shown.point, step.dt, how);
    recede(target, step);
    const Eigen::Vector3d normal = full_.normal + (1 - take) * (shown.normal - before_.normal);
    if (normal.norm() > 1e-9) target.normal = normal.normalized();
    target.reach = shown.reach + take * (full_.reach - shown.reach);
    target.patch = shown.patch + take * (full_.patch - shown.patch);
    target.k3 = slew(shown.k3, full_.k3, most / (deep * deep));
    target.static_friction = slew(shown.static_friction, full_.static_friction, kInfinity);
    target.kinetic_friction = slew(shown.kinetic_friction, full_.kinetic_friction, kInfinity);
  }
  show(target);
}

// Removes the force of a surface that is no longer there within some ms. Returns whether it is
// gone.
bool RemoteContact::release(const StepContext& step) noexcept {
  const double felt = spring_.force().norm(), most = kReleaseRate * step.dt;
  if (felt <= most) {
    spring_.release();
    return true;
  }
  fade_to(spring_.parameters().gain * (1.0 - most / felt));
  return false;
}

// For a prediction beyond the world: the shown surface fades like an expired model.
void RemoteContact::fade_out(const StepContext& step) noexcept {
  fade_to(std::max(0.0, spring_.parameters().gain - step.dt / kRamp));
}

void RemoteContact::fade_to(double gain) noexcept {
  ContactParameters target = spring_.parameters();
  target.gain = gain;
  show(target);
}

// The surface translates and rotates with its body.
Eigen::Vector3d RemoteContact::slip(const StepContext& step) const noexcept {
  const Eigen::Vector3d arm = step.probe - pose_.position;
  const Eigen::Vector3d spin = pose_.orientation * pose_.angular_velocity;
  return step.velocity - (pose_.velocity + spin.cross(arm));
}

Eigen::Vector3d RemoteContact::damper(const StepContext& step) const noexcept {
  if (!touching() || !(damping_ > 0)) return Eigen::Vector3d::Zero();
  const Eigen::Vector3d& n = spring_.geometry().normal;
  const double wanted = -spring_.parameters().gain * damping_ * n.dot(slip(step));
  if (!std::isfinite(wanted)) return Eigen::Vector3d::Zero();
  return std::max(wanted, -spring_.normal_force()) * n;
}

bool RemoteContact::engaged() const noexcept {
  return touching() || (usable_ && fade_ > 0 && spring_.geometry().depth > -kEngageMargin);
}

double RemoteContact::greatest_force() const noexcept {
  return std::max(spring_.force().norm(), coming_.norm());
}

double RemoteContact::greatest_store() const noexcept {
  return std::max(spring_.stored(), coming_store_);
}

void RemoteContact::answer(EnergyLedger& ledger, EnergyDemand& own, double spare,
                           bool contested) noexcept {
  if (!answer_) return;
  answer_ = false;
  if (!engaged()) return;
  EnergyRequest request;
  request.need = hand_.need;
  request.spring_need = hand_.spring_need;
  request.most = first_tier(greatest_force(), spare);
  request.share = std::max(0.0, request.most + kSpareShare - account_->believed);
  request.contested = contested;
  request.near = tracker_.age() < kNearAge;
  own.level -= account_->give(ledger, gift(request, own));
}

void RemoteContact::give_for_a_blow(EnergyLedger& ledger, EnergyDemand& own, double dt) noexcept {
  if (!blow_.is_on() || !touching() || !hand_.has_device) return;
  const double wanted = blow_.gift(tracker_.age(), own.surplus(), dt);
  if (wanted > 0) own.level -= account_->give(ledger, wanted);
}

void RemoteContact::ask(double need, double spring_need) noexcept {
  need_ = need;
  spring_need_ = spring_need;
}

void RemoteContact::shown(double share, double ledger) noexcept {
  share_ = share;
  ledger_ = ledger;
}

void RemoteContact::forfeit(const Eigen::Vector3d& probe) noexcept {
  spring_.reset(probe);
  tracker_.snap(Eigen::Vector3d::Zero());
  lost_ = true;
}

bool RemoteContact::refused() const noexcept { return unsound_ || (usable_ && !showable_); }

ContactAccount RemoteContact::account(const StepContext& step, double extra) const noexcept {
  ContactAccount out;
  out.id = hand_.id;
  out.given = account_->given;
  out.received = account_->received;
  out.need = need_;
  out.spring_need = spring_need_;
  out.depth = spring_.geometry().depth;
  out.force = share_ * spring_.force();
  out.damper_force = extra * damper(step);
  out.asked_force = spring_.force();
  out.ungated_force = ungated_;
  out.stiffness_limit = full_.slope_limit;
  out.refused = refused();
  out.has_device = hand_.has_device;
  if (engaged()) {
    const Eigen::Vector3d& n = spring_.geometry().normal;
    const Eigen::Vector3d moves = slip(step);
    out.sliding = (moves - n.dot(moves) * n).norm();
  }
  out.ledger = ledger_;
  return out;
}

}  // namespace reckon::haptics
