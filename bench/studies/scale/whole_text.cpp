// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/scale/whole_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "reckon/aoim/presence/presence.hpp"
#include "reckon/bench/studies/pose/study_text.hpp"
#include "reckon/bench/studies/scale/mechanisms.hpp"
#include "reckon/tools/terminal/json_text.hpp"
#include "reckon/tools/terminal/text_table.hpp"

namespace reckon::bench {
namespace {

/// The measures of scale_measures() that are compared.
constexpr std::array<std::string_view, 13> kCompared{
    "sent_packets_per_s", "sent_bytes_per_s",    "sent_updates_per_s",   "heard_packets_per_s",
    "heard_bytes_per_s",  "heard_updates_per_s", "wanted_updates_per_s", "pose_error_p50_m",
    "pose_error_p99_m",   "unseen_share",        "shown_after_p50_s",    "shown_after_p99_s",
    "cpu_share"};

std::string_view name_of(Meeting meeting) {
  switch (meeting) {
    case Meeting::simulated:
      return "simulated";
    case Meeting::lo:
      return "processes on lo";
    case Meeting::lan:
      return "processes on a LAN of namespaces";
    case Meeting::hosts:
      return "processes on several hosts";
  }
  return "";
}

double value_of(const ScaleMeasure& measure, const WholeRun& run) {
  return measure.of({kMechanisms.size() - 1, run});
}

std::string difference(double found, double simulated) {
  return simulated != 0 ? fmt::format("{:+.1f} %", 100 * (found / simulated - 1)) : "-";
}

double update_cpu(const WholeRun& run) {
  return run.counts.heard_updates > 0
             ? run.counts.cpu / static_cast<double>(run.counts.heard_updates)
             : 0;
}
double octets_each(const WholeRun& run) {
  return run.resident / static_cast<double>(run.setting.peers);
}

/// A warning about late processes: their results depend on the busy machine.
std::string lateness_of(const WholeRun& run) {
  constexpr double kLate = 0.2;  // [s]
  if (run.latest < kLate) return "";
  return fmt::format(
      "a step was {:.1f} s late: this machine was too busy, which may be the cause of overdue or "
      "lost updates\n",
      run.latest);
}

/// A note if one peer cannot store so many others.
std::string limit_of(const WholeRun& run) {
  const std::size_t capacity = aoim::PresenceConfig().capacity;
  const bool has_one_address = run.meeting == Meeting::lo;  // of one address it stores half as many
  const std::size_t remembered = has_one_address ? capacity / 2 : capacity;
  if (run.setting.peers <= remembered + 1) return "";
  return fmt::format("a peer has room for {} others{}: entities of further peers are not shown\n",
                     remembered, has_one_address ? " of one address" : "");
}

}  // namespace

std::string whole_text(std::span<const WholeRow> rows) {
  constexpr auto kRight = tools::TextTable::Align::right;
  std::string out;
  for (const WholeRow& row : rows) {
    const WholeRun& run = row.run;
    tools::TextTable table(
        {{"EACH PEER"}, {"SIMULATED", kRight}, {"PROCESSES", kRight}, {"DIFFERENCE", kRight}});
    for (const std::string_view name : kCompared) {
      const ScaleMeasure& measure = scale_measure(name);
      const double simulated = value_of(measure, row.simulated), found = value_of(measure, run);
      table.add({std::string(measure.title), measure_text(measure, simulated),
                 measure_text(measure, found), difference(found, simulated)});
    }
    const WholeCounts& counts = run.counts;
    out += fmt::format(
        "{} peers with {} entities, {}, {:g} s\n{}of {} samples of entities within the radius, {} "
        "found one overdue (not shown after {:g} s)\nlost {} datagrams, {} because a buffer was "
        "full; {} arrived from groups that were not joined\neach {:.3f} % of a core ({} us for "
        "each update heard), {} KiB of memory, {:.0f} entities in its table, {:.1f} groups; the "
        "run took {:.1f} s\n{}\n",
        run.setting.peers, run.setting.crowd.entities, name_of(run.meeting), counts.seconds,
        table.text(), counts.looks, counts.overdue, kShownWithin, counts.lost, counts.dropped,
        counts.foreign, 100 * run.cpu_share(), number_text(1e6 * update_cpu(run)),
        number_text(octets_each(run) / 1024),
        static_cast<double>(counts.known) / static_cast<double>(run.setting.peers),
        static_cast<double>(counts.groups) / static_cast<double>(run.setting.peers), run.wall,
        limit_of(run) + lateness_of(run));
  }
  return out;
}

std::string whole_json(std::span<const WholeRow> rows) {
  std::string out;
  for (const WholeRow& row : rows) {
    const WholeCounts& counts = row.run.counts;
    tools::JsonObject object(out);
    object.text("kind", "whole")
        .text("meeting", name_of(row.run.meeting))
        .value("peers", row.run.setting.peers)
        .value("entities", row.run.setting.crowd.entities)
        .value("seconds", counts.seconds);
    for (const std::string_view name : kCompared)
      object.value(name, value_of(scale_measure(name), row.run));
    object.value("looks", counts.looks)
        .value("overdue", counts.overdue)
        .value("lost", counts.lost)
        .value("dropped", counts.dropped)
        .value("foreign", counts.foreign)
        .value("update_cpu_s", update_cpu(row.run))
        .value("memory_octets", octets_each(row.run))
        .value("wall_s", row.run.wall)
        .value("latest_s", row.run.latest)
        .end("\n");
  }
  return out;
}

}  // namespace reckon::bench
