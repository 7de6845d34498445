// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/metrics/peer_metrics.hpp"

#include <fmt/format.h>

#include <array>
#include <string_view>

#include "reckon/tools/metrics/open_metrics.hpp"

namespace reckon::tools {
namespace {

/// A value from a peer's view.
struct ViewNumber {
  std::string_view name, meaning;
  double (*value)(const peer::PeerView& view);
};
constexpr std::array<ViewNumber, 7> kViewNumbers{{
    {"entities", "remote entities known",
     [](const peer::PeerView& view) { return static_cast<double>(view.entities); }},
    {"owned_entities", "entities of this peer",
     [](const peer::PeerView& view) { return static_cast<double>(view.owned); }},
    {"peers", "other Reckon peers known",
     [](const peer::PeerView& view) { return static_cast<double>(view.peers); }},
    {"groups", "groups of cells that are joined",
     [](const peer::PeerView& view) { return static_cast<double>(view.groups); }},
    {"frozen", "1 while the exercise is frozen",
     [](const peer::PeerView& view) { return view.frozen ? 1.0 : 0.0; }},
    {"cells", "cells of which this peer is a member, in a scene with leaders",
     [](const peer::PeerView& view) { return static_cast<double>(view.leaders.cells); }},
    {"cells_leaderless", "of these, without a known leader",
     [](const peer::PeerView& view) { return static_cast<double>(view.leaders.leaderless); }},
}};

/// A value of a hand.
struct HandNumber {
  std::string_view name, meaning;
  double haptics::ServoSnapshot::*value;
};
constexpr std::array<HandNumber, 7> kHandNumbers{{
    {"port_energy_joules", "energy in the hand's port", &haptics::ServoSnapshot::port_energy},
    {"port_energy_min_joules",
     "lowest energy of the port so far, including its loan and the energy of regions",
     &haptics::ServoSnapshot::port_energy_min},
    {"port_loan_joules", "energy lent to hands that met inside one another",
     &haptics::ServoSnapshot::loan},
    {"port_region_loan_joules", "energy lent to the potentials of regions",
     &haptics::ServoSnapshot::region_loan},
    {"port_oscillation_joules", "energy that oscillations of regions added so far",
     &haptics::ServoSnapshot::oscillation_energy},
    {"port_late_cost_joules", "energy that late steps took from an empty ledger",
     &haptics::ServoSnapshot::late_cost},
    {"hand_softening_ratio", "displayed share of the stiffness of remote bodies",
     &haptics::ServoSnapshot::softening},
}};

void add_hands(OpenMetrics& out, const peer::PeerView& view) {
  for (std::size_t i = 0; i < view.hand_count; ++i) {
    const std::string number = std::to_string(i + 1);
    const haptics::ServoSnapshot& servo = view.hands[i].servo;
    for (const HandNumber& row : kHandNumbers)
      out.gauge(row.name, row.meaning, servo.*row.value, {{"hand", number}});
    out.counter("hand_trips", "times that safety cut the force", servo.trips, {{"hand", number}});
    out.counter("hand_stops", "times that the software stop switched the force off",
                servo.tally.stops, {{"hand", number}});
    out.gauge("hand_stopped", "1 while the software stop holds the force at zero",
              servo.stopped ? 1.0 : 0.0, {{"hand", number}});
  }
}

void add_servo(OpenMetrics& out, const peer::DutyCycle& duty) {
  out.counter("servo_steps", "steps of the servo", duty.steps());
  out.counter("servo_steps_missed", "servo periods without a step", duty.missed());
  out.counter("servo_overruns", "steps that ended more than a period after their due time",
              duty.overruns());
  out.durations("servo_lateness", "delay of the start of servo steps", duty.lateness());
  out.durations("servo_step", "duration of servo steps", duty.step_time());
}

void add_loop(OpenMetrics& out, std::string_view name, const peer::PassTimes& times) {
  out.counter("loop_overruns", "passes longer than a servo period", times.overruns(),
              {{"loop", name}});
  out.durations("loop_pass", "duration of the passes of the loop", times.times(), {{"loop", name}});
}

}  // namespace

std::string peer_metrics(peer::Peer& peer, const peer::PeerThreads& threads,
                         const peer::PeerView& view, double seconds) {
  OpenMetrics out;
  out.gauge("uptime_seconds", "time since the start", seconds);
  out.counters(peer.counters());
  peer.link().statistics().for_each(
      [&](std::string_view name, std::string_view meaning, std::uint64_t value) {
        out.counter(fmt::format("link_{}", name), meaning, value);
      });
  for (const ViewNumber& row : kViewNumbers) out.gauge(row.name, row.meaning, row.value(view));
  out.spread("pose_jump", "meters", "difference of updates from the prediction",
             peer.model().remote().pose_jumps().spread());
  out.spread("force_jump", "newtons", "difference of force models from the prediction",
             peer.model().remote().force_jumps().spread());
  add_loop(out, "read", threads.read_times());
  add_loop(out, "model", threads.model_times());
  add_loop(out, "write", threads.write_times());
  if (threads.servo() == nullptr) return out.end();
  add_servo(out, threads.servo_duty());
  add_hands(out, view);
  return out.end();
}

}  // namespace reckon::tools
