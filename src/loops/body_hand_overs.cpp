// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/loops/body_hand_overs.hpp"

#include <algorithm>
#include <cmath>

#include "reckon/deadreckon/motion/drm.hpp"
#include "reckon/pdu/random/split_mix.hpp"
#include "reckon/pdu/seconds.hpp"

namespace reckon::peer {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;

constexpr double kLongestTransit = 0.5;  // [s] that a granted state is extrapolated
constexpr double kSeenJump = 0.001;      // [m]
constexpr double kUsualOff = 0.005;      // [m]
// The new owner of a body that we gave away states it within this time, or it stands still.
constexpr nanoseconds kSilence = milliseconds(500);
// A moving body comes to rest if its owner sends nothing for this time.
constexpr nanoseconds kSilentOwner = milliseconds(1000);

ObjectState state_of(const haptics::ObjectMotion& motion, nanoseconds utc) noexcept {
  ObjectState state;
  state.utc = utc;
  for (int i = 0; i < 3; ++i) {
    const auto place = static_cast<std::size_t>(i);
    state.position[place] = motion.position[i];
    state.velocity[place] = motion.velocity[i];
    state.turn_rate[place] = motion.turn_rate[i];
  }
  state.orientation = {motion.orientation.w(), motion.orientation.x(), motion.orientation.y(),
                       motion.orientation.z()};
  return state;
}

}  // namespace

std::uint32_t number_of(const WorldId& world) noexcept {
  const std::uint64_t both = std::uint64_t{world.founded} << 32 | world.founder;
  return static_cast<std::uint32_t>(pdu::split_mix(both) >> 32 | 1U);
}

void BodyHandOvers::take_answers(const Pass& pass) noexcept {
  pass_ = pass;
  take_ends();
  finish_yields();
}

void BodyHandOvers::note(const OwnershipEvent& event) noexcept {
  if (event.kind == OwnershipEvent::Kind::gained) {
    if (event.cause == OwnerChange::granted) granted_ |= event.objects;
  } else if (event.kind == OwnershipEvent::Kind::lost) {
    granted_ &= ~event.objects;
  } else if (event.kind == OwnershipEvent::Kind::yield) {
    // The protocol has as many transactions as there are places.
    const auto free = std::ranges::find(yields_, 0U, &Yield::transaction);
    if (free != yields_.end()) *free = {event.transaction, 0, event.objects};
  }
}

void BodyHandOvers::send_orders(const Pass& pass) noexcept {
  pass_ = pass;
  send_yields();
  send_changes();
}

// A body that this peer does not simulate, because it has no lease, is given as it stands.
void BodyHandOvers::send_yields() noexcept {
  std::array<haptics::BodyOrder, haptics::BodyExchange::kMostOrders> orders{};
  for (Yield& yield : yields_) {
    if (yield.transaction == 0 || yield.serial != 0) continue;
    std::size_t count = 0;
    for (std::size_t i = 0; i < yield.objects.size() && count < orders.size(); ++i) {
      if (!yield.objects[i]) continue;
      const haptics::ObjectMotion motion = stages_.bodies.motion_now(i, stages_.remote, pass_.now);
      protocol_.set_state(i, state_of(motion, pass_.utc));
      orders[count++] = {haptics::BodyAct::disown, static_cast<std::uint32_t>(i)};
    }
    yield.serial = world_->exchange().send(std::span(orders).first(count));
    if (yield.serial == 0) return;
    for (std::size_t i = 0; i < yield.objects.size(); ++i) {
      if (yield.objects[i]) sent_[i] = yield.serial;
    }
  }
}

void BodyHandOvers::take_ends() noexcept {
  haptics::BodyEnd end;
  while (world_->exchange().take_end(end)) {
    const auto yield = std::ranges::find(yields_, end.serial, &Yield::serial);
    if (yield == yields_.end()) continue;
    yield->objects.reset(end.body);
    if (!end.was_owned) continue;
    const nanoseconds utc = pass_.utc - (pass_.now - end.time);
    ObjectState state = state_of(end.state, utc);
    const Eigen::Vector3d& acceleration = stages_.bodies.acceleration_of(end.body);
    std::ranges::copy(acceleration, state.acceleration.begin());
    protocol_.set_state(end.body, state);
    stages_.bodies.leave(end, pass_, own_record(end.body), stages_.owned, stages_.remote);
    left_at_[end.body] = pass_.now;
  }
}

void BodyHandOvers::finish_yields() noexcept {
  for (Yield& yield : yields_) {
    if (yield.transaction == 0 || yield.serial == 0 || yield.objects.any()) continue;
    protocol_.yielded(yield.transaction, pass_.now);
    yield = {};
  }
}

// The state of a grant, moved on by the time since. A body that is shown a little elsewhere goes on
// from there, so that nobody sees it jump.
haptics::ObjectMotion BodyHandOvers::granted_motion(std::size_t object) const noexcept {
  const ObjectState& state = protocol_.granted_state(object);
  haptics::ObjectMotion motion;
  motion.position = {state.position[0], state.position[1], state.position[2]};
  motion.orientation = Eigen::Quaterniond(state.orientation[0], state.orientation[1],
                                          state.orientation[2], state.orientation[3]);
  motion.velocity = {state.velocity[0], state.velocity[1], state.velocity[2]};
  motion.turn_rate = {state.turn_rate[0], state.turn_rate[1], state.turn_rate[2]};
  const double age = std::clamp(pdu::to_seconds(pass_.utc - state.utc), 0.0, kLongestTransit);
  const Eigen::Vector3d acceleration(state.acceleration[0], state.acceleration[1],
                                     state.acceleration[2]);
  motion.position += age * motion.velocity + 0.5 * age * age * acceleration;
  motion.velocity += age * acceleration;
  const double angle = age * motion.turn_rate.norm();
  if (angle > 0.0) {
    const Eigen::AngleAxisd turn(angle, motion.turn_rate.normalized());
    motion.orientation = (turn * motion.orientation).normalized();
  }
  const RemoteEntity* row = stages_.remote.find(body_id(object));
  if (row == nullptr) return motion;
  const haptics::ObjectMotion shown = peer::motion_of(row->shown(pass_.now));
  const double off = (shown.position - motion.position).norm();
  // What dead reckoning without acceleration misses until the grant arrives, also after a lost
  // update, and some thresholds.
  const double usual = kUsualOff + 0.5 * acceleration.norm() * 9 * age * age;
  if (off > kSeenJump && off < usual) motion.position = shown.position;
  return motion;
}

haptics::BodyOrder BodyHandOvers::order_for(std::size_t body, haptics::BodyAct act) const noexcept {
  haptics::BodyOrder order;
  order.body = static_cast<std::uint32_t>(body);
  order.act = act;
  const bool begins = act == haptics::BodyAct::own || act == haptics::BodyAct::adopt ||
                      act == haptics::BodyAct::copy;
  if (begins) {
    order.state = granted_[body] ? granted_motion(body)
                                 : stages_.bodies.motion_now(body, stages_.remote, pass_.now);
  }
  order.delay = delays_[body];
  return order;
}

// The order that brings the world to the right mode; none: it is there.
std::optional<haptics::BodyAct> BodyHandOvers::act_for(
    std::size_t body, const haptics::BodyState& state) const noexcept {
  if (protocol_.owns(body, pass_.now)) {
    if (state.is_owned() || !can_own(body)) return std::nullopt;
    return granted_[body] ? haptics::BodyAct::own : haptics::BodyAct::adopt;
  }
  if (state.is_owned()) return haptics::BodyAct::disown;
  if (state.copied && !copies(body)) return haptics::BodyAct::follow;
  const bool begins = copies(body) && !granted_[body] &&
                      (!state.copied || std::isinf(delays_[body]) != undrawn_[body]) &&
                      stages_.remote.find(body_id(body)) != nullptr;
  return begins ? std::optional(haptics::BodyAct::copy) : std::nullopt;
}

// The world simulates what this peer may move now, and nothing else.
void BodyHandOvers::send_changes() noexcept {
  const haptics::BodyStates* all = stages_.bodies.states();
  if (all == nullptr) return;
  std::array<haptics::BodyOrder, haptics::BodyExchange::kMostOrders> orders{};
  std::size_t count = 0;
  const auto flush = [&] {
    const std::uint64_t serial = world_->exchange().send(std::span(orders).first(count));
    for (const haptics::BodyOrder& order : std::span(orders).first(count)) {
      sent_[order.body] = serial;
      if (serial == 0) continue;
      if (order.act == haptics::BodyAct::copy) undrawn_[order.body] = std::isinf(order.delay);
      if (order.act == haptics::BodyAct::own) granted_.reset(order.body);
    }
    count = 0;
    return serial != 0;
  };
  const std::size_t size = std::min(protocol_.table().size(), all->bodies.size());
  for (std::size_t i = 0; i < size; ++i) {
    if (sent_[i] > all->serial) continue;  // on its way
    const auto act = act_for(i, all->bodies[i]);
    if (!act) continue;
    orders[count++] = order_for(i, *act);
    if (count == orders.size() && !flush()) return;
  }
  if (count > 0) flush();
}

// Only our last state shows a body whose new owner failed at once.
void BodyHandOvers::doubt_left(nanoseconds now) noexcept {
  for (std::size_t i = 0; i < protocol_.table().size(); ++i) {
    if (left_at_[i] == nanoseconds(0) || now - left_at_[i] < kSilence) continue;
    left_at_[i] = nanoseconds(0);
    const RemoteEntity* row = stages_.remote.find(body_id(i));
    if (row != nullptr && row->epoch == epoch_) stages_.remote.doubt(body_id(i), now);
  }
}

void BodyHandOvers::doubt_silent(nanoseconds now) noexcept {
  for (const Voter& voter : protocol_.acts().decided().roll.voters()) {
    if (!protocol_.is_silent(voter.epoch, kSilentOwner, now)) continue;
    for (std::size_t i = 0; i < protocol_.table().size(); ++i) {
      if (protocol_.tenure(i).owner != voter.epoch) continue;
      const RemoteEntity* row = stages_.remote.find(body_id(i));
      if (row != nullptr && row->epoch == voter.epoch && now - row->last_heard > kSilentOwner &&
          !deadreckon::stands_still(row->state.motion()))
        stages_.remote.doubt(row->id, now);
    }
  }
}

pdu::OwnershipRecord BodyHandOvers::own_record(std::size_t body) const noexcept {
  pdu::OwnershipRecord record;
  record.owner = epoch_;
  record.version = protocol_.tenure(body).version;
  record.world = number_of(protocol_.world());
  return record;
}

}  // namespace reckon::peer
