// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tests/fuzz/owners/episodes.hpp"

#include <algorithm>
#include <array>

namespace reckon::fuzz::owners {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr Nanoseconds kSilence = seconds(3);  // of a peer that the others remove

template <std::size_t n>
FaultKind one_of(const std::array<FaultKind, n>& kinds, Dice& dice) {
  return kinds[dice.below(n)];
}

// In braces, because the draws must have an order.
struct Start {
  FaultKind kind;
  Nanoseconds at, lasts;
  std::size_t peer;
};

Fault fault_of(const Start& start) {
  Fault fault;
  fault.kind = start.kind;
  fault.at = start.at;
  fault.until = std::min(kHealed, start.at + start.lasts);
  fault.peer = start.peer;
  fault.other = start.peer == 0 ? 1 : 0;
  fault.side = 1U << start.peer;
  return fault;
}

std::size_t other_than(std::size_t peer, std::size_t peers, Dice& dice) {
  return (peer + 1 + dice.below(peers - 1)) % peers;
}

// No hand is at the object in this time.
void clear_touches(Plan& plan, std::size_t object, Nanoseconds from, Nanoseconds to) {
  std::erase_if(plan.touches, [&](const Touch& touch) {
    return touch.object == object && touch.to > from && touch.from < to;
  });
}

// A peer does not receive some others. When the chair is about to remove one of them, it fails
// too. Then two voters propose, or few learn the decision.
void add_dispute(Plan& plan, Dice& dice) {
  constexpr std::array kFirst{FaultKind::bridge, FaultKind::bridge, FaultKind::one_way,
                              FaultKind::partition, FaultKind::mute};
  constexpr std::array kSecond{FaultKind::mute,  FaultKind::mute,      FaultKind::choke,
                               FaultKind::crash, FaultKind::partition, FaultKind::one_way};
  const Nanoseconds at = kWarmUp + dice.between(seconds(1), seconds(10));
  const std::size_t lost = dice.below(plan.peers);
  Fault first =
      fault_of({one_of(kFirst, dice), at, seconds(4) + dice.between({}, seconds(4)), lost});
  if (first.kind == FaultKind::bridge) first.peer = other_than(lost, plan.peers, dice);
  plan.faults.push_back(first);
  const std::size_t chair = dice.chance(0.7) ? 0 : dice.below(plan.peers);
  Fault second =
      fault_of({one_of(kSecond, dice), at + kSilence + dice.between({}, milliseconds(700)),
                milliseconds(500) + dice.between({}, seconds(5)), chair});
  second.other = other_than(chair, plan.peers, dice);
  plan.faults.push_back(second);
}

// The giver fails while its grant is on its way. The taker gets the grant and reaches nobody.
void add_stranded_grant(Plan& plan, Dice& dice) {
  constexpr std::array kTaker{FaultKind::choke, FaultKind::choke, FaultKind::mute,
                              FaultKind::partition, FaultKind::deaf};
  constexpr std::array kGiver{FaultKind::crash, FaultKind::leave, FaultKind::leave, FaultKind::mute,
                              FaultKind::restart};
  const Nanoseconds at = kWarmUp + dice.between(seconds(3), seconds(11));
  const std::size_t object = dice.below(plan.objects);
  const std::size_t giver = dice.below(plan.peers);
  const std::size_t taker = other_than(giver, plan.peers, dice);
  clear_touches(plan, object, at - seconds(3), at + seconds(5));
  plan.touches.push_back({at - seconds(2), at, giver, object});
  plan.touches.push_back({at - milliseconds(500), at + seconds(5), taker, object});
  const Nanoseconds way = plan.line.most + plan.step;
  // Half of the takers return while the others decide on the next owner.
  const Nanoseconds lasts = dice.chance(0.5) ? kSilence + dice.between({}, milliseconds(800))
                                             : dice.between(milliseconds(500), seconds(5));
  plan.faults.push_back(
      fault_of({one_of(kTaker, dice), at + dice.between({}, 2 * way), lasts, taker}));
  if (dice.chance(0.3)) return;
  plan.faults.push_back(fault_of({one_of(kGiver, dice), at + dice.between({}, 3 * way),
                                  seconds(3) + dice.between({}, seconds(5)), giver}));
}

// The taker of a grant passes the object on and leaves, and the giver learns that late.
void add_passed_grant(Plan& plan, Dice& dice) {
  if (plan.peers < 3) return add_dispute(plan, dice);
  const Nanoseconds at = kWarmUp + dice.between(seconds(3), seconds(14));
  const std::size_t object = dice.below(plan.objects);
  const std::size_t giver = dice.below(plan.peers);
  const std::size_t taker = other_than(giver, plan.peers, dice);
  std::size_t next = other_than(taker, plan.peers, dice);
  while (next == giver) next = other_than(taker, plan.peers, dice);
  const Nanoseconds way = plan.line.most + plan.step;
  clear_touches(plan, object, at - seconds(3), at + seconds(5));
  plan.touches.push_back({at - seconds(2), at, giver, object});
  plan.touches.push_back({at - milliseconds(500), at + 3 * way, taker, object});
  plan.touches.push_back({at, at + seconds(5), next, object});
  plan.faults.push_back(fault_of({dice.chance(0.5) ? FaultKind::choke : FaultKind::deaf,
                                  at + dice.between({}, 2 * way),
                                  seconds(1) + dice.between({}, milliseconds(1500)), giver}));
  plan.faults.push_back(
      fault_of({FaultKind::leave, at + 4 * way + dice.between({}, 4 * way), seconds(3), taker}));
}

// A newcomer receives a world whose voters fail before they admit it.
void add_orphan(Plan& plan, Dice& dice) {
  const Nanoseconds at = kWarmUp + dice.between(seconds(1), seconds(10));
  const std::size_t newcomer = dice.below(plan.peers);
  plan.faults.push_back(fault_of({FaultKind::restart, at, milliseconds(300), newcomer}));
  plan.faults.push_back(fault_of({FaultKind::choke, at, seconds(3), newcomer}));
  for (std::size_t i = 0; i < plan.peers; ++i) {
    if (i == newcomer) continue;
    plan.faults.push_back(fault_of(
        {FaultKind::crash, at + milliseconds(300) + dice.between({}, seconds(1)), kHealed, i}));
  }
}

// New voters start while only rounds reach the chair and another voter. The chair and the new
// voters do not receive that voter; a third voter does.
void add_stalled_admission(Plan& plan, Dice& dice) {
  if (plan.peers < 5) return add_dispute(plan, dice);
  const Nanoseconds at = kWarmUp + dice.between(seconds(1), seconds(10));
  for (std::size_t i = 3; i < plan.peers; ++i)
    plan.faults.push_back(
        fault_of({FaultKind::crash, {}, at + dice.between({}, milliseconds(50)), i}));
  const Nanoseconds composed = at + milliseconds(300) + dice.between({}, milliseconds(400));
  const std::size_t lost = 1 + dice.below(2);
  Fault bridge = fault_of({FaultKind::bridge, composed, seconds(7), lost});
  bridge.peer = 3 - lost;
  plan.faults.push_back(bridge);
  plan.faults.push_back(fault_of({FaultKind::choke, composed + dice.between({}, milliseconds(100)),
                                  seconds(2) + dice.between({}, seconds(1)), 0}));
  plan.faults.push_back(fault_of({FaultKind::choke, composed, seconds(6), lost}));
  plan.touches.push_back({at - seconds(2), at + seconds(6), lost, 0});
}

// Peers leave one after the other, over a good line.
void add_leaves(Plan& plan, Dice& dice) {
  plan.line.late = 0.0;
  plan.line.loss = std::min(plan.line.loss, 0.1);
  plan.line.most = std::min(plan.line.most, Nanoseconds(milliseconds(50)));
  plan.line.least = std::min(plan.line.least, plan.line.most);
  plan.leaves_only = true;
  for (Nanoseconds at = kWarmUp + seconds(4); at < kHealed - seconds(4); at += seconds(8)) {
    const Nanoseconds leaves = at + dice.between({}, seconds(2));
    plan.faults.push_back(fault_of({FaultKind::leave, leaves, seconds(2), dice.below(plan.peers)}));
  }
}

// Each as often as it must be to find the faults of plants.py.
constexpr std::array kEpisodes{add_dispute,           add_dispute,        add_dispute,
                               add_stranded_grant,    add_stranded_grant, add_stranded_grant,
                               add_stranded_grant,    add_stranded_grant, add_orphan,
                               add_stalled_admission, add_passed_grant,   add_leaves};
constexpr std::size_t kOf = 20;  // the other draws keep the faults

}  // namespace

void add_episode(Plan& plan, Dice& dice) {
  const std::size_t kind = dice.below(kOf);
  if (plan.faults.empty() || kind >= kEpisodes.size()) return;
  plan.faults.clear();
  kEpisodes[kind](plan, dice);
}

}  // namespace reckon::fuzz::owners
