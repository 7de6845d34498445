// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tests/fuzz/owners/plan.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "reckon/pdu/seconds.hpp"
#include "reckon/tests/fuzz/owners/episodes.hpp"
#include "reckon/tests/fuzz/search/dice.hpp"

namespace reckon::fuzz::owners {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

Line line_of(Dice& dice) {
  Line line;
  line.loss = std::min(0.4, 0.6 * dice.unit() * dice.unit());
  line.doubled = dice.chance(0.5) ? 0.1 * dice.unit() : 0.0;
  line.late = dice.chance(0.5) ? 0.1 * dice.unit() : 0.0;
  const double least = 0.05 * dice.unit() * dice.unit();
  line.least = pdu::from_seconds(0.0001 + least);
  line.most = line.least + pdu::from_seconds(0.15 * dice.unit() * dice.unit());
  return line;
}

void add_touches(Plan& plan, Dice& dice) {
  // In some, hand-overs are under way at each moment, so also at each fault.
  const bool is_dense = dice.chance(0.3);
  const Nanoseconds touch = is_dense ? milliseconds(300) : Nanoseconds(seconds(2));
  const Nanoseconds pause = is_dense ? milliseconds(300) : Nanoseconds(seconds(3));
  for (std::size_t peer = 0; peer < plan.peers; ++peer) {
    for (std::size_t object = 0; object < plan.objects; ++object) {
      if (plan.objects > 4 && dice.chance(0.6)) continue;
      Nanoseconds at = kWarmUp + dice.between({}, seconds(3));
      while (at < kHealed) {
        const Nanoseconds to = at + dice.between(milliseconds(100), touch);
        plan.touches.push_back({at, to, peer, object});
        at = to + dice.between(milliseconds(200), pause);
      }
    }
  }
  if (!plan.is_contested) return;
  for (std::size_t object = 0; object < plan.objects; ++object) {
    const Nanoseconds at = kWarmUp + dice.between(seconds(1), seconds(18));
    for (int i = 0; i < 2; ++i) {
      const Nanoseconds from = at + dice.between({}, milliseconds(100));
      plan.touches.push_back({from, from + seconds(1), dice.below(plan.peers), object});
    }
  }
}

void add_faults(Plan& plan, Dice& dice) {
  const std::size_t count = dice.below(6);
  for (std::size_t i = 0; i < count; ++i) {
    Fault fault;
    fault.kind = static_cast<FaultKind>(dice.below(kFaultKinds));
    fault.at = kWarmUp + dice.between(seconds(1), seconds(15));
    fault.until = std::min(kHealed, fault.at + dice.between(milliseconds(200), seconds(8)));
    fault.peer = dice.below(plan.peers);
    fault.other = dice.below(plan.peers);
    fault.side = 1 + static_cast<std::uint32_t>(dice.below((std::size_t{1} << plan.peers) - 2));
    if (fault.kind == FaultKind::restart) fault.until = fault.at + milliseconds(300);
    plan.faults.push_back(fault);
  }
}

}  // namespace

Plan plan_of(std::uint64_t seed) {
  Dice dice(mixed(seed, 77));
  Plan plan;
  plan.seed = seed;
  plan.peers = 2 + dice.below(6);
  plan.objects = dice.chance(0.05) ? 20 + dice.below(45) : 1 + dice.below(4);
  plan.island = dice.chance(0.3) ? 1 + dice.below(plan.objects) : 1;
  const std::size_t hosts = dice.chance(0.3) ? 1 + dice.below(plan.peers) : plan.peers;
  for (std::size_t i = 0; i < plan.peers; ++i) plan.hosts.push_back(i % hosts);
  plan.moves = dice.chance(0.5);
  plan.is_contested = !plan.moves || dice.chance(0.3);
  plan.step = dice.between(milliseconds(4), milliseconds(16));
  plan.line = line_of(dice);
  add_touches(plan, dice);
  add_faults(plan, dice);
  add_episode(plan, dice);
  return plan;
}

Plan calmed(Plan plan) {
  plan.line = {};
  plan.line.least = plan.line.most = milliseconds(1);
  return plan;
}

std::string text_of(const Plan& plan) {
  return fmt::format(
      "{} peers, {} objects, island of {}, loss {:.2f}, doubled {:.2f}, late {:.3f}, delay {:.1f} "
      "to {:.1f} ms{}{}",
      plan.peers, plan.objects, plan.island, plan.line.loss, plan.line.doubled, plan.line.late,
      1e3 * pdu::to_seconds(plan.line.least), 1e3 * pdu::to_seconds(plan.line.most),
      plan.moves ? ", moving" : "", plan.is_contested ? ", contested" : "");
}

std::string text_of(const Fault& fault) {
  static constexpr const char* kNames[] = {"crash", "restart", "pause", "partition", "one-way cut",
                                           "leave", "deaf",    "choke", "mute",      "bridge"};
  return fmt::format("{} at {:.2f} s until {:.2f} s: peer {}, other {}, side {:b}",
                     kNames[static_cast<std::size_t>(fault.kind)], pdu::to_seconds(fault.at),
                     pdu::to_seconds(fault.until), fault.peer, fault.other, fault.side);
}

}  // namespace reckon::fuzz::owners
