// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/servo/pressing_hands.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "reckon/deadreckon/motion/drm.hpp"
#include "reckon/haptics/servo/body_springs.hpp"
#include "reckon/pdu/seconds.hpp"

namespace reckon::haptics {
namespace {

using Eigen::Vector3d;
using std::chrono::nanoseconds;

// Damper of a contact, over sqrt(K m); more for each second of delay beyond kCalmDelay [s].
constexpr double kCalm = 1.0, kCalmer = 10.0, kCalmDelay = 0.05;
constexpr double kFollow = 0.005;   // [s], in which a new prediction is reached
constexpr double kSmoothing = 0.2;  // weight of a new delay
constexpr double kFarDelay = 0.1;   // [s], from which on no delay is predicted
constexpr double kLessAhead = 0.4;  // change of the predicted part, over the delay
// A hand that is farther from its prediction has jumped. So has a contact that is farther from the
// one that its owner states than kAstray plus the way of the hand since.
constexpr double kTeleport = 0.05;   // [m]
constexpr double kAstray = 0.015;    // [m]
constexpr double kSilent = 0.06;     // [s], usual time between two states
constexpr double kReachAhead = 0.3;  // [s], of motion that a search covers

}  // namespace

PressingHands::PressingHands(BodyWorld& world, std::shared_ptr<const EffectPlan> plan,
                             const ServoConfig& config, double loan)
    : world_(world),
      plan_(std::move(plan)),
      radius_(config.contact_radius),
      patch_(config.patch_radius),
      pad_(std::max(config.patch_radius, config.probe_radius)),
      period_(pdu::to_seconds(config.period)),
      loan_(loan),
      grab_(config.grab),
      number_(world.add_guest(*this)) {
  for (Hand& hand : slots_)
    hand.walls.emplace(*plan_, std::numeric_limits<double>::infinity(), radius_);
  body_of_.assign(plan_->objects().size(), kNoBody);
  for (std::uint32_t i = 0; i < world_.states().size(); ++i)
    body_of_[world_.states()[i].object] = i;
  pushes_.reserve(BodyWorld::kMostPushes);
}

// Inputs

bool PressingHands::is_pending() noexcept {
  is_fresh_ = hands_.update() || is_fresh_;
  return is_any_ || is_fresh_;
}

PressingHands::Hand* PressingHands::slot_of(const RemoteHand& hand) noexcept {
  const auto is_same = [&hand](const Hand& slot) {
    return slot.is_used && slot.record.id == hand.id && slot.record.epoch == hand.epoch;
  };
  const auto known = std::ranges::find_if(slots_, is_same);
  if (known != slots_.end()) return &*known;
  const auto free = std::ranges::find(slots_, false, &Hand::is_used);
  if (free == slots_.end()) return nullptr;
  free->is_used = free->restarts = true;
  free->given = hand.given_to_us;
  free->ledger = {};
  free->grab = {};
  free->ledger.borrow(loan_);
  return &*free;
}

void PressingHands::accept(Hand& hand, const RemoteHand& record, nanoseconds now) noexcept {
  const double delay = pdu::to_seconds(now - record.state_time);
  if (hand.restarts) {
    hand.delay = delay;
  } else if (hand.record.version != record.version) {
    hand.delay += kSmoothing * (delay - hand.delay);
  }
  hand.record = record;
  hand.ledger.book(record.given_to_us - std::exchange(hand.given, record.given_to_us));
}

void PressingHands::read(nanoseconds now) noexcept {
  is_fresh_ = hands_.update() || is_fresh_;
  if (!std::exchange(is_fresh_, false)) return;
  const std::span<const RemoteHand> list(hands_.read().hands.data(), hands_.read().count);
  for (Hand& hand : slots_) {
    hand.is_used = hand.is_used && std::ranges::any_of(list, [&](const RemoteHand& one) {
                     return one.id == hand.record.id && one.epoch == hand.record.epoch;
                   });
  }
  is_any_ = false;
  for (const RemoteHand& record : list) {
    Hand* const hand = slot_of(record);
    if (hand == nullptr) continue;
    accept(*hand, record, now);
    is_any_ = true;
  }
}

// From the hands that have it.
double PressingHands::take(double energy) noexcept {
  double taken = 0.0;
  for (Hand& hand : slots_) {
    if (!hand.is_used || taken == energy) continue;
    const double part = std::min(energy - taken, std::max(0.0, hand.ledger.level()));
    hand.ledger.book(-part);
    taken += part;
  }
  return taken;
}

// A step

// A ball around all hands.
HandReach PressingHands::reach() const noexcept {
  HandReach reach;
  double count = 0.0;
  for (const Hand& hand : slots_) {
    if (!hand.is_used) continue;
    reach.middle += hand.record.state.position;
    count += 1.0;
  }
  reach.middle /= count;
  for (const Hand& hand : slots_) {
    if (!hand.is_used) continue;
    const ContactResult& touched = hand.walls->result();
    const double depth = touched.in_contact ? (touched.scp - hand.place).norm() : 0.0;
    const double away = (hand.record.state.position - reach.middle).norm();
    const double speed = hand.record.state.velocity.norm();
    reach.radius = std::max(reach.radius, away + depth + radius_ + kTeleport + speed * kReachAhead);
    reach.speed = std::max(reach.speed, speed);
  }
  return reach;
}

// A body returns what a hand could not pay for.
void PressingHands::settle() noexcept {
  for (const Push& push : pushes_) {
    EnergyLedger& ledger = slots_[push.hand].ledger;
    const double work = world_.work(push.number);
    ledger.book(-work);
    const double debt = std::min(work, ledger.debt());
    if (debt > 0) ledger.book(world_.take_back(push.body, debt));
  }
  pushes_.clear();
}

deadreckon::Pose PressingHands::predicted(const Hand& hand, nanoseconds now) const noexcept {
  const double most = hand.record.model.surface > 0 ? 0.0 : kMostAhead;
  const double ahead = std::clamp(kLessAhead * (kFarDelay - hand.delay), 0.0, most);
  const double age = pdu::to_seconds(now - hand.record.state_time);
  return deadreckon::extrapolate(hand.record.state, age - std::max(0.0, hand.delay - ahead));
}

// A new prediction is reached within some ms, so that it strikes nothing.
void PressingHands::move(Hand& hand, nanoseconds now) noexcept {
  const auto put = [&](std::uint32_t body) {
    hand.walls->set_carried(body, world_.states()[body].carried);
    hand.walls->place(body, world_.states()[body], world_.state_before(body));
  };
  std::ranges::for_each(world_.near(number_, reach_, period_), put);
  // A body that was put elsewhere may be far from the hand that touched it.
  for (const std::uint32_t object : hand.walls->result().touched)
    if (body_of_[object] != kNoBody) put(body_of_[object]);
  const deadreckon::Pose pose = predicted(hand, now);
  const Vector3d there = pose.position + pose.orientation * hand.record.model.point;
  const double dt = last_ > nanoseconds(0) ? pdu::to_seconds(now - last_) : period_;
  const double astray = kAstray + pose.velocity.norm() * (hand.delay + kSilent);
  const bool is_known = !std::exchange(hand.restarts, false) &&
                        (hand.place - there).norm() <= kTeleport &&
                        (hand.record.model.surface > 0 ||
                         (hand.walls->result().scp - pose.position).norm() <= astray);
  if (is_known) {
    const Vector3d before = hand.place;
    hand.place += dt * pose.velocity;
    hand.place += std::min(1.0, dt / kFollow) * (there - hand.place);
    hand.velocity = (hand.place - before) / dt;
    hand.walls->move(hand.place, dt, hand.ledger);
  } else {
    hand.place = there;
    hand.velocity = pose.velocity;
    // The walls of a hand that was away still have the bodies at their old poses.
    const std::span<const BodyState> states = world_.states();
    for (std::uint32_t i = 0; i < states.size(); ++i) {
      hand.walls->set_carried(i, states[i].carried);
      hand.walls->place(i, states[i], states[i]);
    }
    hand.walls->resume(pose.position, there, hand.ledger);
  }
  hand.walls->settle(dt, hand.ledger);
  if (!is_known) hand.grab.release(hand.ledger);
  hold_body(hand, pose, dt);
}

// The grip point is where the owner of the hand shows it.
void PressingHands::hold_body(Hand& hand, const deadreckon::Pose& pose, double dt) noexcept {
  const std::size_t held = hand.record.model.surface;
  const bool may_hold =
      held > 0 && held <= world_.states().size() && !world_.states()[held - 1].carried;
  if (hand.grab.holds() && (!may_hold || hand.grab.body() != held - 1))
    hand.grab.release(hand.ledger);
  if (!may_hold) return;
  const BodyState& body = world_.states()[held - 1];
  const PlannedObject& object = plan_->objects()[body.object];
  GrabSpring spring = grab_.stiffness > 0 ? grab_ : object.grab;
  if (hand.record.model.grip > 0) spring.stiffness = hand.record.model.grip;
  if (!(spring.stiffness > 0)) return;
  constexpr double kNoCap = std::numeric_limits<double>::infinity();
  spring = held_by(spring, object.matter.mass, period_, kNoCap);
  if (!hand.grab.holds()) hand.grab.take(held - 1, spring, pose.position, body);
  hand.grab.place(body);
  hand.grab.stiffen(spring.stiffness, hand.ledger);
  hand.grab.move(hand.place, hand.ledger);
  hand.grab.settle(dt, hand.ledger);
}

void PressingHands::press(std::size_t number) noexcept {
  Hand& hand = slots_[number];
  const auto is_body = [this](std::uint32_t index) { return body_of_[index] != kNoBody; };
  const auto press = [&](std::uint32_t index, BodySpring spring) {
    spring.body = body_of_[index];
    if (world_.states()[spring.body].carried) return;
    spring.probe = number;
    spring.patch = patch_;
    const std::size_t push = world_.press(number_, spring);
    if (push == BodyWorld::kNoPush) return;
    const double stiffness = spring.gap > 0 ? 0.0 : spring.stiffness;
    pushes_.push_back({push, number, index, spring.body, stiffness, false, spring.point});
  };
  visit_body_springs(*hand.walls, is_body, hand.velocity, kSpringsAhead * period_, press);
}

void PressingHands::press_held(std::size_t number) noexcept {
  const Hand& hand = slots_[number];
  if (!hand.grab.holds()) return;
  BodySpring spring = spring_of(hand.grab, hand.velocity, pad_);
  spring.probe = number;
  const std::size_t push = world_.press(number_, spring);
  if (push == BodyWorld::kNoPush) return;
  const std::uint32_t object = world_.states()[spring.body].object;
  pushes_.push_back({push, number, object, spring.body, spring.stiffness, true, spring.point});
}

// The bodies get the whole predicted springs.
void PressingHands::hold() noexcept {
  for (const Push& push : pushes_) {
    const Hand& hand = slots_[push.hand];
    Vector3d rest = Vector3d::Zero();
    if (!push.grips) rest = -hand.walls->effects_of(push.object);
    if (push.stiffness > 0) {
      const double mass = plan_->objects()[push.object].matter.mass;
      const Vector3d moves = world_.states()[push.body].velocity_at(push.point);
      const double share = kCalm + kCalmer * std::max(0.0, hand.delay - kCalmDelay);
      const Vector3d calm = share * std::sqrt(push.stiffness * mass) * (hand.velocity - moves);
      // Without energy it only brakes the body.
      if (hand.ledger.level() > 0 || calm.dot(moves) < 0) rest += calm;
    }
    world_.hold(push.number, 1.0, rest);
  }
}

void PressingHands::step(nanoseconds now, bool frozen) noexcept {
  settle();
  read(now);
  reach_ = {};
  if (is_any_ && !frozen) {
    reach_ = reach();
    for (std::size_t i = 0; i < slots_.size(); ++i) {
      if (!slots_[i].is_used) continue;
      move(slots_[i], now);
      press(i);
      press_held(i);
    }
    world_.foresee(number_, period_);
    for (Hand& hand : slots_) {
      if (!hand.is_used) continue;
      PortLoad load;
      hand.walls->load(hand.velocity, period_, load);
      hand.walls->shown(1.0);
    }
    hold();
  }
  last_ = now;
  world_.written(number_, reach_);
}

}  // namespace reckon::haptics
