// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Which bodies this peer requests, keeps and copies, because hands or other bodies come to them.
#include <algorithm>
#include <limits>

#include "reckon/pdu/seconds.hpp"
#include "reckon/peer/loops/ownership_stage.hpp"

namespace reckon::peer {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;

// A body is requested when a hand will touch it within kAhead [s] plus kDelays times the least
// delay of its owner: the request, the grant, and their jitter.
constexpr double kAhead = 0.06;
constexpr double kDelays = 4.0;
constexpr double kUnknownDelay = 0.05;  // [s], before the first exchange of times
constexpr double kMostDelay = 0.25;     // [s]
// A hand that will touch a body within this time keeps it [s].
constexpr double kArrives = 0.06;
// The request ends so long after the hand has turned away.
constexpr nanoseconds kTurnsBack = milliseconds(200);
// A copy of a body begins when a hand will touch it within this time [s], and ends so long after
// the hand has left it. A copy follows its owner well at delays below kMostCopied [s].
constexpr double kCopied = 0.1;
constexpr nanoseconds kCopyEnds = milliseconds(200);
constexpr double kMostCopied = 0.11;
// An owner without a message for kOwnerFails has failed: a copy of its body goes on undrawn. After
// kNotAdopted the copy ends.
constexpr nanoseconds kOwnerFails = milliseconds(500), kNotAdopted = milliseconds(6000);
constexpr double kUndrawn = std::numeric_limits<double>::infinity();  // [s], delay of such a copy
// The least time between two changes of owner if hands of both peers approach a body.
constexpr nanoseconds kKeeps = milliseconds(300);

constexpr double kAtHand = 0.02;  // [m], from a body to a hand of another peer that is at it

}  // namespace

bool OwnershipStage::may_take(std::size_t object, std::uint32_t epoch) {
  if (epoch == epoch_) return hand_overs_.can_own(object);
  const auto id = parts_.aoim.presence().id_of(epoch);
  const auto source = parts_.aoim.presence().source_of(epoch);
  return id && source && parts_.remote.touch().admits(*id, true, *source);
}

bool OwnershipStage::is_busy(std::size_t object) {
  if (kept_[object]) return true;
  if (meets_senior(object)) return false;
  if (object < states().size() && states()[object].touched) return true;
  const bool is_new = reached_[object] && pass_.now - gained_at_[object] < kKeeps;
  return is_new || approach_.time_to(object) < kArrives;
}

// [s], the least.
double OwnershipStage::delay_to(std::uint32_t epoch) const noexcept {
  const auto known = parts_.time.peers().difference(epoch, pass_.now);
  if (!known) return kUnknownDelay;
  return std::clamp(0.5 * pdu::to_seconds(known->round_trip), 0.0, kMostDelay);
}

// Of two owners whose bodies will meet, one gets both: the one whose hand is at its body; if both
// or neither have one, the one that joined first.
bool OwnershipStage::should_unite(std::size_t body) noexcept {
  const Roll& roll = protocol_.acts().decided().roll;
  const std::size_t other = roll.index_of(owner_of(body).owner);
  if (other == Roll::kNone) return false;
  return is_busy(meetings_.own_of(body)) || roll.index_of(epoch_) < other;
}

// Whether a body of ours will meet one at a hand of a senior, which requests ours.
bool OwnershipStage::meets_senior(std::size_t object) const noexcept {
  const Roll& roll = protocol_.acts().decided().roll;
  const std::uint32_t asker = protocol_.asker_of(object);
  if (asker == 0 || !(roll.index_of(asker) < roll.index_of(epoch_))) return false;
  for (std::size_t i = 0; i < std::min(protocol_.table().size(), states().size()); ++i) {
    const bool meets = meetings_.own_of(i) == object && owner_of(i).owner == asker &&
                       meetings_.time_to(i) <= kAhead + kDelays * delay_to(asker);
    if (!meets) continue;
    bool is_at_hand = false;
    parts_.remote.visit_felt([&](const RemoteEntity& row) {
      if (row.epoch != asker || row.type.kind != pdu::EntityKind::life_form) return;
      const haptics::BodyState& body = states()[i];
      const Eigen::Vector3d apart = row.motion(pass_.now).position - body.position;
      const Eigen::Vector3d local = body.orientation.conjugate() * apart;
      is_at_hand |= world_->box(i).exteriorDistance(local) <= kAtHand;
    });
    if (is_at_hand) return true;
  }
  return false;
}

// [s], until a hand touches a body, as far as that is a reason to request it.
double OwnershipStage::time_to_touch(std::size_t body) const noexcept {
  if (!requests_at_touch_) return approach_.time_to(body);
  return states()[body].touched ? 0.0 : std::numeric_limits<double>::infinity();
}

// Requests the bodies that a hand touches or will touch, and those that a body of ours will meet.
void OwnershipStage::ask_ahead() noexcept {
  approach_.look(states());
  meetings_.look(states(), pass_.now);
  for (std::size_t i = 0; i < std::min(protocol_.table().size(), states().size()); ++i) {
    double time = time_to_touch(i);
    if (meetings_.time_to(i) < time && should_unite(i)) time = meetings_.time_to(i);
    const bool is_near = time <= kAhead + kDelays * kMostDelay && may_take(i, epoch_);
    if (is_near && time <= kAhead + kDelays * delay_to(owner_of(i).owner))
      reached_until_[i] = pass_.now + kTurnsBack;
    const bool is_reached = pass_.now < reached_until_[i];
    if (is_reached == reached_[i]) continue;
    reached_[i] = is_reached;
    if (is_reached) {
      protocol_.ask(i);
    } else if (!kept_[i]) {
      protocol_.withdraw(i);
    }
  }
}

// While a body belongs to another peer, a hand that touches it feels a copy, unless the delay is
// too long for it. The choice holds for a contact.
void OwnershipStage::choose_copies() noexcept {
  for (std::size_t i = 0; i < std::min(protocol_.table().size(), states().size()); ++i) {
    const bool is_felt =
        states()[i].touched || approach_.time_to(i) < kCopied || meetings_.is_beside(i);
    if (is_felt) felt_at_[i] = pass_.now;
    const bool was = hand_overs_.copies(i);
    const bool goes_on = is_felt || (was && pass_.now - felt_at_[i] < kCopyEnds);
    const std::uint32_t owner = owner_of(i).owner;
    const bool is_lost = protocol_.is_silent(owner, kNotAdopted, pass_.now);
    if (!goes_on || is_lost || protocol_.owns(i, pass_.now) || !hand_overs_.can_own(i)) {
      hand_overs_.copy(i, -1.0);
      continue;
    }
    const double delay = delay_to(owner);
    // A copy whose owner fails goes on by itself until a peer adopts the body.
    const bool is_left = protocol_.is_silent(owner, kOwnerFails, pass_.now);
    if (was || delay < kMostCopied) hand_overs_.copy(i, was && is_left ? kUndrawn : delay);
  }
}

}  // namespace reckon::peer
