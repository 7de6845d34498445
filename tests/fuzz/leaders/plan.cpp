// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tests/fuzz/leaders/plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "reckon/pdu/seconds.hpp"
#include "reckon/tests/fuzz/search/dice.hpp"

namespace reckon::fuzz::leaders {
namespace {

using std::chrono::hours;
using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr nanoseconds kFaultsBegin = milliseconds(1200), kFaultsEnd = seconds(16);
constexpr std::array<std::string_view, kFaultKinds> kNames = {
    "kill",         "restart",      "good-bye",         "pause",           "split",
    "clock step",   "move",         "leader's restart", "leader's return", "leader's pause",
    "forged claim", "forged leave", "forged map",       "forged states"};

// A position in 2 x 3 cells of 100 m, so that peers share cells.
aoim::Position draw_place(Dice& dice) { return {200.0 * dice.unit(), 300.0 * dice.unit(), 0.0}; }

LossyLine draw_line(Dice& dice) {
  LossyLine line;
  if (dice.chance(0.6)) line.loss = 0.3 * dice.unit() * dice.unit();
  if (dice.chance(0.3)) line.duplicates = 0.1 * dice.unit();
  line.delay = dice.between(nanoseconds(milliseconds(1)) / 10, milliseconds(20));
  if (dice.chance(0.5)) line.jitter = 2.0 * dice.unit();
  return line;
}

Fault draw_fault(Plan& plan, Dice& dice) {
  Fault fault;
  fault.kind = static_cast<FaultKind>(dice.below(kFaultKinds));
  fault.at = dice.between(kFaultsBegin, kFaultsEnd - seconds(2));
  if (is_forgery(fault.kind) && dice.chance(0.5)) fault.at = dice.between(plan.calm, plan.end);
  const double length = dice.unit();
  fault.until =
      std::min<nanoseconds>(fault.at + pdu::from_seconds(0.3 + 12.0 * length * length), kFaultsEnd);
  fault.host = dice.below(plan.hosts.size() - 1);
  fault.side = dice.below(std::size_t{1} << plan.hosts.size());
  fault.step = dice.between(-hours(2), hours(2));
  fault.place = draw_place(dice);
  fault.pool = plan.pool;
  return fault;
}

// Hosts that move from cell to cell, so that groups are given back and requested.
void wander(Plan& plan, std::size_t times, Dice& dice) {
  for (std::size_t i = 0; i < times; ++i) {
    Fault fault = draw_fault(plan, dice);
    fault.kind = FaultKind::move;
    fault.at = dice.between(kFaultsBegin, kFaultsEnd - seconds(2));
    plan.faults.push_back(fault);
  }
}

// A split into two sides until the calm, long enough for each to hand out groups of its own.
void divide(Plan& plan, Dice& dice) {
  Fault fault = draw_fault(plan, dice);
  fault.kind = FaultKind::split;
  fault.at = dice.between(kFaultsBegin, seconds(5));
  fault.until = kFaultsEnd;
  plan.faults.push_back(fault);
  wander(plan, 4 + dice.below(6), dice);
}

}  // namespace

Plan plan_of(std::uint64_t seed) {
  Dice dice(mixed(seed, 77));
  Plan plan;
  plan.seed = seed;
  plan.hosts.resize(4 + dice.below(dice.chance(0.8) ? 5 : kMostHosts - 4));
  plan.pool = dice.chance(0.5) ? 2 + dice.below(5) : 20;
  plan.hand_out = Dice(mixed(seed, 78)).chance(0.5);
  plan.beacons = plan.hand_out && Dice(mixed(seed, 80)).chance(0.5);
  plan.loses_maps = Dice(mixed(seed, 79)).chance(0.5);
  plan.line = draw_line(dice);
  plan.calm = kFaultsEnd;
  plan.kill = plan.calm + seconds(12);
  plan.newcomer = plan.kill + seconds(3);
  plan.end = plan.newcomer + seconds(3);
  const bool together = dice.chance(0.3), one_cell = dice.chance(0.3);
  for (Host& host : plan.hosts) {
    host.start = together ? nanoseconds() : dice.between({}, seconds(3));
    if (dice.chance(0.3)) host.clock = dice.between(-hours(3), hours(3));
    host.place = one_cell ? aoim::Position{50.0, 50.0, 0.0} : draw_place(dice);
    host.entities = 1 + dice.below(dice.chance(0.1) ? 40 : 3);
  }
  plan.hosts.back().start = plan.newcomer;
  const std::size_t faults = dice.below(8);
  for (std::size_t i = 0; i < faults; ++i) plan.faults.push_back(draw_fault(plan, dice));
  plan.loses_parts = dice.chance(0.5);
  if (dice.chance(0.3)) wander(plan, 4 + dice.below(8), dice);
  if (dice.chance(0.15)) divide(plan, dice);
  std::sort(plan.faults.begin(), plan.faults.end(),
            [](const Fault& a, const Fault& b) { return a.at < b.at; });
  return plan;
}

Plan calmed(Plan plan) {
  plan.line = {.delay = plan.line.delay};
  return plan;
}

std::string text_of(const Fault& fault) {
  return fmt::format("{} of host {} at {:.3f} s until {:.3f} s, side {:x}, place {:.0f} {:.0f}",
                     kNames[static_cast<std::size_t>(fault.kind)], fault.host,
                     pdu::to_seconds(fault.at), pdu::to_seconds(fault.until), fault.side,
                     fault.place.x, fault.place.y);
}

std::string text_of(const Plan& plan) {
  return fmt::format(
      "{} hosts, pool {}{}{}, loss {:.3f}, copies {:.3f}, delay {:.4f} s, jitter {:.2f}, {} "
      "faults{}{}",
      plan.hosts.size(), plan.pool, plan.hand_out ? " handed out" : "",
      plan.beacons ? ", beacons" : "", plan.line.loss, plan.line.duplicates,
      pdu::to_seconds(plan.line.delay), plan.line.jitter, plan.faults.size(),
      plan.loses_parts ? ", parts of snapshots lost in the calm" : "",
      plan.loses_maps ? ", last maps lost when it begins" : "");
}

}  // namespace reckon::fuzz::leaders
