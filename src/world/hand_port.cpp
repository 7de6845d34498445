// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/world/hand_port.hpp"

#include <algorithm>
#include <span>
#include <utility>

#include "reckon/aoim/groups/body_owners.hpp"
#include "reckon/pdu/seconds.hpp"

namespace reckon::peer {
namespace {

using std::chrono::nanoseconds;

// Body axes of a hand in the scene: forward = east, right = south, down = -up.
// Three-degree-of-freedom devices do not turn, so this never changes.
const Eigen::Quaterniond kHandOrientation(0.0, 1.0, 0.0, 0.0);

// Time constant [s] of the velocity along the normal that is sent while hands touch. Below it two
// hands of 0.1 kg over 500 N/m ring at 16 Hz, above it they lag behind a common motion;
// docs/measurements/touch.md has the table.
constexpr double kContactSmoothing = 0.05;
// The time constant is halved for a hand that slides over another at this speed [m/s], and divided
// by three at twice the speed. In this case the motion along the normal follows the shape of the
// other hand instead of the spring.
constexpr double kSliding = 0.01;
// The same for a hand that touches or holds a body, for all directions. Its faster motion answers
// the other hands at that body, and is not predicted.
constexpr double kBodySmoothing = 0.08;
// For a hand that touches a body, holds none, and has no hand of another peer nearby: greatest
// error of its handle over kHandleMiss, and longest silence.
constexpr double kAlone = 10.0;
constexpr std::chrono::milliseconds kAlonePeriod{300};
constexpr double kBlowSpeed = 0.15;        // [m/s]; slower is a press
constexpr double kLeastSmoothing = 0.001;  // [s], a step of a servo
// A hand that slides at this speed [m/s] or faster is sent by its thresholds only. Begin and end of
// a touch hardly change its motion, and its updates deliver the accounts in time.
constexpr double kGliding = 0.1;
constexpr std::chrono::milliseconds kGlidingAccounts{40};
// A hand that rubs at this speed [m/s] or faster also sends its acceleration, fully from twice that
// speed on, if the acceleration is well above its noise: a hand feels noise more than lag. With
// velocities only, the reaction comes back through a stiff contact too late. The hands then
// continue to swing at 18 Hz, and only an update of both every 8 ms would prevent that. Without
// sliding, the spring determines the acceleration.
constexpr double kRubbing = 0.015;
constexpr double kSureInContact = 4.0;
// The sent acceleration is extrapolated by this time [s], about half of the interval to the next
// update. The extrapolated part is at most half of it, because the acceleration changes abruptly
// when hands meet and part.
constexpr double kAhead = 0.004;
constexpr double kGuessed = 0.5;
// A free hand sends the servo's acceleration, unless the last velocities differ from it by more
// than their noise and by more than this [m/s^2]: a millimetre in 70 ms.
constexpr double kSteady = 0.4;

// 0 if `size` is at most `doubt`, 1 if it is twice as much.
double sure_share(double size, double doubt) {
  return doubt > 0 ? std::clamp(size / doubt - 1.0, 0.0, 1.0) : 1.0;
}

// True for a hand: a body without a person feels nothing.
bool is_felt(const haptics::ContactAccount& contact) {
  return contact.has_device && contact.ungated_force.squaredNorm() > 0.0;
}

std::span<const haptics::ContactAccount> contacts(const haptics::ServoSnapshot& snapshot) {
  return {snapshot.contacts.data(), snapshot.count};
}

}  // namespace

pdu::EntityType hand_type() noexcept {
  pdu::EntityType type{};
  type.kind = pdu::EntityKind::life_form;
  type.domain = pdu::EntityDomain::land;
  return type;
}

void HandPort::tell(OwnedEntity& entity) noexcept {
  const haptics::ServoSnapshot& snapshot = servo();
  trend_.note(snapshot.time, snapshot.velocity);
  at_body_ = snapshot.tally.at_bodies > std::exchange(at_bodies_, snapshot.tally.at_bodies) ||
             snapshot.held.number > 0;
  note_touch(entity);
  smooth_velocity();
  read_accounts(entity.id());

  entity.move(truth());
  if (TouchSide* touch = entity.touch(); touch != nullptr && !entity.is_frozen()) {
    touch->move_point(orientation().conjugate() * (snapshot.device - snapshot.scp));
    touch->soften(snapshot.softening);
    if (touch->hold(snapshot.held.number, snapshot.held.stiffness)) entity.felt_event();
  }
  consider_accounts(entity);
  if (touching_) felt_at_ = snapshot.time;
  const nanoseconds doubled =
      std::max<nanoseconds>(kAfterTouchPeriod, entity.last_built() - felt_at_);
  const nanoseconds apart = touching_ ? kContactPeriod : doubled;
  const nanoseconds longest = snapshot.time < blow_until_ ? kBlowPeriod : apart;
  const bool silent = snapshot.time - entity.last_built() >= longest;
  if (silent && snapshot.time - felt_at_ < kAfterTouch) entity.felt_event();
  if (at_body_) keep_handle(entity);
  if (presses_body_ && snapshot.time - entity.last_built() >= kBodyPeriod) entity.felt_event();
}

// When hands meet head-on, their velocity of approach vanishes; when one slides over the other,
// most of it remains.
void HandPort::note_touch(OwnedEntity& entity) noexcept {
  sliding_ = 0.0;
  bool touching = false;
  for (const haptics::ContactAccount& contact : contacts(servo())) {
    if (contact.has_device) sliding_ = std::max(sliding_, contact.sliding);
    touching = touching || is_felt(contact);
  }
  if (touching == touching_) return;
  touching_ = touching;
  contact_velocity_ =
      (sliding_ < kGliding ? 0.0 : sliding_ / (sliding_ + kSliding)) * servo().velocity;
  if (sliding_ >= kGliding) return;
  entity.felt_event();
  if (touching && servo().velocity.norm() > kBlowSpeed) blow_until_ = servo().time + kBlow;
}

void HandPort::consider_accounts(OwnedEntity& entity) noexcept {
  const std::chrono::nanoseconds now = servo().time;
  const bool in_time = touching_ && sliding_ >= kGliding;
  if (!in_time || now - entity.last_built() >= kGlidingAccounts)
    entity.consider_accounts(now, accounts());
}

// The peers that simulate a body compute the force of a hand at it from the place of the handle. If
// no other hand is nearby and the hand holds no body, nobody feels an error of this place.
void HandPort::keep_handle(OwnedEntity& entity) const noexcept {
  if (entity.is_frozen() || entity.touch() == nullptr) return;
  const nanoseconds silence = servo().time - entity.last_built();
  if (silence < kAtBodyGap) return;
  const bool is_alone = servo().count == 0 && servo().held.number == 0;
  const double most = is_alone ? kAlone * kHandleMiss : kHandleMiss;
  const nanoseconds longest = is_alone ? kAlonePeriod : kAtBodyPeriod;
  const deadreckon::Pose truth{servo().scp, orientation()};
  if (silence >= longest || entity.touch()->point_miss(truth, pdu::to_seconds(servo().time)) > most)
    entity.felt_event();
}

// Without a rotation, the axes of a tool are the axes of S.
Eigen::Quaterniond HandPort::orientation() const noexcept {
  const haptics::ToolState& tool = servo().tool;
  return tool.turns ? tool.orientation * kHandOrientation : kHandOrientation;
}

EntityTruth HandPort::truth() const noexcept {
  EntityTruth truth;
  truth.time = servo().time;
  truth.position = servo().scp;
  truth.orientation = orientation();
  if (servo().tool.turns)
    truth.angular_velocity = truth.orientation.conjugate() * servo().tool.turn_rate;
  truth.velocity = servo().velocity;
  truth.acceleration = touching_ ? lasting_acceleration() : free_acceleration();
  if (at_body_) truth.acceleration.setZero();
  if (touching_ || at_body_) truth.lasting_velocity = lasting_velocity();
  return truth;
}

void HandPort::note_near(OwnedEntity& entity) const noexcept {
  if (servo().time - entity.last_built() >= kContactPeriod) entity.felt_event();
}

void HandPort::smooth_velocity() noexcept {
  const haptics::ServoSnapshot& snapshot = servo();
  double sliding = 0.0;
  for (const haptics::ContactAccount& contact : contacts(snapshot)) {
    if (is_felt(contact)) sliding = std::max(sliding, contact.sliding);
  }
  const double shape = (1.0 + sure_share(sliding, kRubbing)) * sliding / kSliding;
  const double tau =
      at_body_ ? kBodySmoothing : std::max(kLeastSmoothing, kContactSmoothing / (1.0 + shape));
  const double dt = std::clamp(pdu::to_seconds(snapshot.time - last_seen_), 0.0, kContactSmoothing);
  last_seen_ = snapshot.time;
  const double share = touching_ || at_body_ ? dt / (tau + dt) : 1.0;
  contact_velocity_ += share * (snapshot.velocity - contact_velocity_);
}

// While hands touch, the fast part of the motion of each along the normal is caused by the other.
// An extrapolation of this part would come back through the contact too late for a spring force,
// and the pair would oscillate until its ledgers are empty. The slow part is common to both and is
// predicted. Perpendicular to the normal there is no spring.
Eigen::Vector3d HandPort::lasting_velocity() const noexcept {
  if (at_body_) return contact_velocity_;
  Eigen::Vector3d velocity = servo().velocity;
  for (const haptics::ContactAccount& contact : contacts(servo())) {
    if (!is_felt(contact)) continue;
    const Eigen::Vector3d normal = contact.ungated_force.normalized();
    velocity -= normal.dot(velocity - contact_velocity_) * normal;
  }
  return velocity;
}

Eigen::Vector3d HandPort::free_acceleration() const noexcept {
  const Eigen::Vector3d steady = servo().acceleration;
  const Eigen::Vector3d ahead = trend_.acceleration() - steady;
  if (trend_.acceleration().isZero(0)) return steady;
  return steady + sure_share(ahead.norm(), kSteady + trend_.doubt()) * ahead;
}

// If a hand slides over another, the shape of both bends its path.
Eigen::Vector3d HandPort::lasting_acceleration() const noexcept {
  const double size = trend_.acceleration().norm();
  const double sure = sure_share(size, kSureInContact * trend_.doubt());
  Eigen::Vector3d change = trend_.acceleration_in(kAhead) - trend_.acceleration();
  change *= std::min(1.0, kGuessed * size / std::max(change.norm(), 1e-9));
  return sure * sure_share(sliding_, kRubbing) * (trend_.acceleration() + change);
}

void HandPort::read_accounts(const pdu::EntityId& own) noexcept {
  const haptics::ServoSnapshot& snapshot = servo();
  account_count_ = std::min(snapshot.count, accounts_.size());
  presses_body_ = false;
  const std::size_t contacts = account_count_;
  for (std::size_t i = 0; i < contacts; ++i) {
    const haptics::ContactAccount& contact = snapshot.contacts[i];
    const bool body = !contact.has_device && contact.id.simulation() != own.simulation() &&
                      !contact.ungated_force.isZero();
    accounts_[i] = {contact.id, contact.given, contact.need, contact.spring_need, body};
    presses_body_ |= body;
  }
  if (snapshot.tally.body_energy != 0.0 && account_count_ < accounts_.size())
    accounts_[account_count_++] = {aoim::kAllBodies, snapshot.tally.body_energy, 0.0, 0.0, true};
}

}  // namespace reckon::peer
