// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/verbs/demo_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "reckon/pdu/seconds.hpp"
#include "reckon/tools/exercise/body_report.hpp"
#include "reckon/tools/exercise/hand_report.hpp"
#include "reckon/tools/exercise/run_summary.hpp"
#include "reckon/tools/terminal/report_text.hpp"
#include "reckon/tools/terminal/text_table.hpp"

namespace reckon::tools {
namespace {

using std::chrono::nanoseconds;

std::vector<const peer::Counters*> counters_of(Exercise& exercise) {
  std::vector<const peer::Counters*> counters;
  for (std::size_t i = 0; i < exercise.size(); ++i)
    counters.push_back(&exercise.peer(i).counters());
  return counters;
}

Hands hands_of(const Exercise& exercise) {
  Hands hands;
  for (std::size_t i = 0; i < exercise.size(); ++i) add_hands(exercise.view(i), hands);
  return hands;
}

bool is_any_softened(const Hands& hands) {
  return std::any_of(hands.begin(), hands.end(), [](const peer::HandView* hand) {
    return hand->stiffness.softens_hand() || std::isfinite(hand->stiffness.straight_from());
  });
}

void print_force_error(std::FILE* out, const DemoCost& cost, const Exercise& exercise) {
  if (!(exercise.measurement().touching_hands() > 0)) {
    const bool touched = exercise.measurement().touching_entities() > 0;
    fmt::print(out, "    force             none: no hand touched another{}\n",
               touched ? "; forces of entities are not compared" : "");
  } else if (is_any_softened(hands_of(exercise))) {
    spread_row(out, "force asked", cost.force, 1.0, "N   (between hands, in contact)");
    spread_row(out, "force possible", cost.possible_force, 1.0, "N   (possible for the devices)");
  } else {
    spread_row(out, "force", cost.force, 1.0, "N   (between hands, in contact)");
  }
}

void print_pose_error(std::FILE* out, const DemoCost& cost) {
  if (cost.pose.count > 0) {
    spread_row(out, "pose", cost.pose, 1e3, "mm");
  } else {
    fmt::print(out, "    pose              none: no peer showed an entity of another\n");
  }
}

void print_touching(std::FILE* out, const DemoMeasurement& measured) {
  fmt::print(
      out, "  touching                   each other {:.1f} s, the object {:.1f} s{} (all peers)\n",
      measured.touching_hands(), measured.touching_scene(),
      measured.touching_entities() > 0
          ? fmt::format(", entities {:.1f} s", measured.touching_entities())
          : "");
}

/// Compares the packets sent with peers without dead reckoning.
std::string against_raw(double raw, double now, std::size_t peers) {
  if (peers == 1) return "one peer: no receiver";
  if (!(raw > 0)) return "no hand to stream";
  return fmt::format("raw streaming {:.0f} /s   {:.0f} x fewer", raw, now > 0 ? raw / now : 0.0);
}

}  // namespace

DemoCost cost_of(const Exercise& exercise) {
  DemoCost cost;
  cost.seconds = pdu::to_seconds(exercise.elapsed());
  const nanoseconds seen = exercise.remote_seen();
  cost.remote_seen = seen < nanoseconds(0) ? -1.0 : pdu::to_seconds(seen);
  cost.packets = static_cast<double>(exercise.total("datagrams_out")) / cost.seconds;
  cost.octets = static_cast<double>(exercise.total("octets_out")) / cost.seconds;
  cost.raw_packets = exercise.raw_rate();
  cost.raw_octets = cost.raw_packets * kRawOctets;
  cost.servo = exercise.servo_report();
  cost.pose = exercise.measurement().pose_error();
  cost.force = exercise.measurement().force_error();
  cost.possible_force = exercise.measurement().possible_force_error();
  cost.energy_min = exercise.measurement().energy_min();
  cost.late_cost = exercise.measurement().late_cost();
  return cost;
}

void print_demo_json(std::FILE* out, const DemoCost& cost, Exercise& exercise) {
  const DemoMeasurement& measured = exercise.measurement();
  fmt::print(
      out,
      R"({{"remote_seen_s":{},"packets_per_s":{:.6g},"bytes_per_s":{:.6g},)"
      R"("raw_packets_per_s":{:.6g},"raw_bytes_per_s":{:.6g},"servo_late_us":{},)"
      R"("missed_steps":{},"loops":{},"unmeasured_steps":{},"pose_error_m":{},"force_error_n":{},"force_error_possible_n":{},)"
      R"("energy_min_j":{:.6g},"late_cost_j":{:.6g},"loan_j":{:.6g},)"
      R"("seconds":{:.6g},"hand_contact_s":{:.6g},"scene_contact_s":{:.6g},)"
      R"("entity_contact_s":{:.6g},)"
      R"("peak_force_n":{:.6g},"trips":{},"datagrams_lost":{},"send_checks":{},)"
      R"("updates_out":{},"own_octets":{},"hands":{}{}{}}})"
      "\n",
      cost.remote_seen < 0 ? "null" : fmt::format("{:.6g}", cost.remote_seen), cost.packets,
      cost.octets, cost.raw_packets, cost.raw_octets,
      spread_json(microseconds(cost.servo.lateness)), cost.servo.missed,
      loops_json(cost.servo.loops), exercise.unmeasured_steps(), errors_json(cost.pose),
      errors_json(cost.force), errors_json(cost.possible_force), cost.energy_min, cost.late_cost,
      measured.loan_most(), cost.seconds, measured.touching_hands(), measured.touching_scene(),
      measured.touching_entities(), measured.peak_force(), measured.trips(),
      exercise.total("datagrams_lost"), exercise.total("send_checks"),
      exercise.total("updates_out"), exercise.total("own_octets"), hands_json(hands_of(exercise)),
      bodies_json(exercise.peer(0).bodies()), walls_json(counters_of(exercise)));
}

void print_demo_text(std::FILE* out, const DemoCost& cost, Exercise& exercise) {
  const DemoMeasurement& measured = exercise.measurement();
  fmt::print(out, "What {:.1f} s with {} cost\n", cost.seconds, counted(exercise.size(), "peer"));
  if (exercise.size() == 1) {
    fmt::print(out, "  first remote hand shown    none: one peer\n");
  } else if (cost.remote_seen >= 0) {
    fmt::print(out, "  first remote hand shown    {:.3f} s after start\n", cost.remote_seen);
  } else {
    fmt::print(out, "  first remote hand shown    never, by at least one peer\n");
  }
  const std::size_t peers = exercise.size();
  fmt::print(out, "  packets                    {:.1f} /s   {}\n", cost.packets,
             against_raw(cost.raw_packets, cost.packets, peers));
  fmt::print(out, "  octets                     {:.0f} /s   {}\n", cost.octets,
             against_raw(cost.raw_octets, cost.octets, peers));
  print_touching(out, measured);
  fmt::print(out, "  decisions                  {} taken, {} sent an update\n",
             exercise.total("send_checks"), exercise.total("updates_out"));
  spread_heading(out, "error");
  print_pose_error(out, cost);
  print_force_error(out, cost, exercise);
  if (cost.servo.steps > 0) {
    spread_row(
        out, "servo late", microseconds(cost.servo.lateness), 1.0,
        fmt::format("us  ({} periods missed, {} steps)", cost.servo.missed, cost.servo.steps));
    print_loops(out, cost.servo.loops);
    fmt::print(out, "  servo thread               {}\n", cost.servo.thread);
  }
  if (exercise.unmeasured_steps() > 0)
    fmt::print(
        out,
        "  not measured               {} servo steps: too many peers for this machine in real "
        "time; see --simulated-time\n",
        exercise.unmeasured_steps());
  fmt::print(out,
             "  energy                     never below {:.1e} J at any port or in sum; peak force "
             "{:.2f} N\n",
             cost.energy_min, measured.peak_force());
  if (measured.loan_most() > 0)
    fmt::print(out,
               "                             {:.1f} mJ lent to hands that met inside one another\n",
               1e3 * measured.loan_most());
  print_bodies(out, exercise.peer(0).bodies());
  print_hands(out, hands_of(exercise));
  print_walls(out, counters_of(exercise));
}

}  // namespace reckon::tools
