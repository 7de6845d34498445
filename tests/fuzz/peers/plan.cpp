// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tests/fuzz/peers/plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string_view>

#include "reckon/pdu/seconds.hpp"

namespace reckon::fuzz {
namespace {

using std::chrono::hours;
using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr std::uint16_t kSite = 7;
constexpr nanoseconds kJump = milliseconds(8500);  // after the calm begins, when all is settled
constexpr std::array<std::string_view, kFaultKinds> kNames = {
    "kill",           "restart",      "good-bye and return",
    "pause",          "split",        "one-way cut",
    "clock step",     "flood",        "forged good-bye",
    "forged restart", "forged elder", "forged leap",
    "forged rename"};

// Few peers are drawn most often: such runs are fast, and their faults coincide.
std::size_t draw_peers(Dice& dice) {
  const double kind = dice.unit();
  if (kind < 0.70) return 2 + dice.below(5);
  if (kind < 0.99) return 5 + dice.below(12);
  return 17 + dice.below(kMostPeers - 19);
}

LossyLine draw_line(Dice& dice) {
  LossyLine line;
  if (dice.chance(0.6)) line.loss = 0.4 * dice.unit() * dice.unit();
  if (dice.chance(0.4)) line.duplicates = 0.2 * dice.unit();
  line.delay = pdu::from_seconds(1e-4 * std::pow(5000.0, dice.unit() * dice.unit()));
  if (dice.chance(0.5)) line.jitter = 2 * dice.unit();
  return line;
}

void draw_hosts(Plan& plan, Dice& dice) {
  const bool together = dice.chance(0.6);
  // All request one number, or each its own, or some share.
  const double kind = dice.unit();
  const std::size_t numbers = kind < 0.4 ? 1 : kind < 0.7 ? kMostPeers : 1 + dice.below(4);
  for (std::size_t i = 0; i < plan.hosts.size(); ++i) {
    Host& host = plan.hosts[i];
    host.wanted = {kSite, static_cast<std::uint16_t>(1 + i % numbers)};
    host.start = together ? seconds(1) : seconds(1) + dice.between({}, seconds(3));
    host.entities = 1 + dice.below(2);
    host.moves = plan.wide && dice.chance(0.4);
    host.keeps_port = dice.chance(0.5);
  }
}

Fault draw_fault(const Plan& plan, Dice& dice) {
  Fault fault;
  // All kinds are equally frequent, but strangers occur only in one seed of three.
  const bool strangers = mixed(plan.seed, 3) % 3 == 0;
  const auto honest = static_cast<std::size_t>(FaultKind::flood);
  fault.kind = static_cast<FaultKind>(dice.below(strangers ? kFaultKinds : honest));
  fault.at = dice.between(seconds(1), plan.faults_end);
  fault.peer = dice.below(plan.at_first);
  fault.side = dice.next();
  const nanoseconds longest =
      fault.kind == FaultKind::restart ? nanoseconds(seconds(3)) : nanoseconds(seconds(9));
  fault.until = std::min(fault.at + dice.between(milliseconds(20), longest), plan.faults_end);
  fault.step = dice.between(-hours(1), hours(1));
  fault.interval = dice.between(milliseconds(20), milliseconds(600));
  return fault;
}

// So much reordering that a hundred others overtake a datagram.
void draw_chatter(Plan& plan, Dice& dice) {
  if (!dice.chance(0.05) || plan.at_first > 8) return;
  plan.chatterer = dice.below(plan.at_first);
  plan.chatter_at = dice.between(seconds(2), plan.faults_end - seconds(1));
  plan.line.delay = milliseconds(20);
  plan.line.jitter = 8 + 8 * dice.unit();
}

// A late peer requests an ID in use. It cannot receive the owner; the owner replies, others receive
// it, then it pauses.
void draw_contest(Plan& plan, Dice& dice) {
  if (!dice.chance(0.08) || plan.at_first < 3) return;
  const std::size_t holder = dice.below(plan.at_first);
  const std::size_t late = (holder + 1 + dice.below(plan.at_first - 1)) % plan.at_first;
  Host& young = plan.hosts[late];
  young.wanted = plan.hosts[holder].wanted;
  young.start = plan.hosts[holder].start + dice.between(milliseconds(2500), seconds(4));
  plan.faults_end = std::max(plan.faults_end, young.start + seconds(5));
  Fault cut;
  cut.kind = FaultKind::one_way;
  cut.peer = holder;
  cut.side = std::uint64_t{1} << late;
  cut.at = young.start - milliseconds(50);
  cut.until = young.start + milliseconds(4500);
  Fault pause;
  pause.kind = FaultKind::pause;
  pause.peer = holder;
  pause.at = young.start + dice.between(milliseconds(300), milliseconds(900));
  pause.until = pause.at + dice.between(milliseconds(700), milliseconds(2000));
  plan.faults.insert(plan.faults.end(), {cut, pause});
}

void draw_probe(Plan& plan, Dice& dice) {
  plan.probe = dice.chance(0.5) ? Probe::newcomers : Probe::restart;
  plan.probed = plan.probe == Probe::newcomers ? 1 + dice.below(3) : dice.below(plan.at_first);
}

}  // namespace

Plan plan_of(std::uint64_t seed) {
  Dice dice(mixed(seed, 1));
  Plan plan;
  plan.seed = seed;
  plan.at_first = draw_peers(dice);
  plan.wide = dice.chance(0.3);
  draw_probe(plan, dice);
  plan.hosts.resize(plan.at_first + (plan.probe == Probe::newcomers ? plan.probed : 0));
  draw_hosts(plan, dice);
  plan.line = draw_line(dice);
  plan.faults_end = dice.between(seconds(4), seconds(14));
  const std::size_t faults = dice.below(9);
  for (std::size_t i = 0; i < faults; ++i) plan.faults.push_back(draw_fault(plan, dice));
  Dice more(mixed(seed, 7));
  draw_contest(plan, more);
  draw_chatter(plan, more);
  if (plan.wide) plan.jumper = more.below(plan.at_first);
  plan.jump_at = plan.faults_end + kJump;
  return plan;
}

Plan calmed(Plan plan) {
  plan.line = {};
  return plan;
}

bool cuts(const Fault& fault, std::size_t from, std::size_t to) noexcept {
  const auto inside = [&fault](std::size_t host) { return (fault.side >> (host % 64) & 1) != 0; };
  if (fault.kind == FaultKind::split) return inside(from) != inside(to);
  return fault.kind == FaultKind::one_way && fault.peer == from && inside(to);
}

bool has_forgery(const Plan& plan) noexcept {
  return std::any_of(plan.faults.begin(), plan.faults.end(), [](const Fault& fault) {
    return is_forgery(fault.kind) && fault.kind != FaultKind::flood;
  });
}

std::string text_of(const Fault& fault) {
  std::string text(kNames[static_cast<std::size_t>(fault.kind)]);
  if (fault.kind != FaultKind::split) text += fmt::format(" of peer {}", fault.peer);
  if (fault.kind == FaultKind::split || fault.kind == FaultKind::one_way)
    text += fmt::format(" side {:#x}", fault.side);
  if (fault.kind == FaultKind::clock_step)
    text += fmt::format(" by {:+.1f} s", pdu::to_seconds(fault.step));
  return text + fmt::format(", {:.3f} s to {:.3f} s", pdu::to_seconds(fault.at),
                            pdu::to_seconds(fault.until));
}

std::string text_of(const Plan& plan) {
  std::set<std::uint16_t> numbers;
  for (const Host& host : plan.hosts) numbers.insert(host.wanted.application);
  return fmt::format(
             "{} peers want {} numbers{}; loss {:.0f} %, copies {:.0f} %, delay {:.1f} ms and up "
             "to "
             "{:.1f} "
             "times as much, until {:.3f} s; then {}",
             plan.at_first, numbers.size(), plan.wide ? ", many cells" : "", 100 * plan.line.loss,
             100 * plan.line.duplicates, 1e3 * pdu::to_seconds(plan.line.delay), plan.line.jitter,
             pdu::to_seconds(plan.faults_end),
             plan.probe == Probe::newcomers ? fmt::format("{} newcomers", plan.probed)
                                            : fmt::format("a restart of peer {}", plan.probed)) +
         (plan.jumper == kNobody ? "" : fmt::format("; peer {} jumps", plan.jumper)) +
         (plan.chatterer == kNobody ? "" : fmt::format("; peer {} chatters", plan.chatterer));
}

}  // namespace reckon::fuzz
