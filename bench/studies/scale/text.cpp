// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/scale/text.hpp"

#include <fmt/format.h>

#include <cmath>

#include "reckon/bench/studies/pose/study_text.hpp"
#include "reckon/bench/studies/scale/mechanisms.hpp"
#include "reckon/pdu/seconds.hpp"
#include "reckon/tools/terminal/json_text.hpp"
#include "reckon/tools/terminal/text_table.hpp"

namespace reckon::bench {
namespace {

double ratio(double part, double all) { return all > 0 ? part / all : 0; }

double ratio(std::uint64_t part, std::uint64_t all) {
  return ratio(static_cast<double>(part), static_cast<double>(all));
}

/// A sum over all peers as what one has of it in a second.
double each(const ScaleRow& row, double sum) {
  return ratio(sum, row.counts.seconds * static_cast<double>(row.counts.peers));
}
double each(const ScaleRow& row, std::uint64_t sum) { return each(row, static_cast<double>(sum)); }

/// Of the witnesses.
double each_witness(const ScaleRow& row, std::uint64_t sum) {
  return ratio(static_cast<double>(sum),
               row.counts.seconds * static_cast<double>(row.counts.witnesses));
}

double wanted(const ScaleRow& row) {
  return each_witness(row, row.counts.wanted - row.counts.missed - row.counts.lost);
}

constexpr std::array kMeasures{
    ScaleMeasure{"sent_packets_per_s", "SENT/s",
                 [](const ScaleRow& row) { return each(row, row.counts.datagrams); }},
    ScaleMeasure{"sent_bytes_per_s", "SENT B/s",
                 [](const ScaleRow& row) { return each(row, row.counts.octets); }},
    ScaleMeasure{"sent_updates_per_s", "UPDATES/s",
                 [](const ScaleRow& row) { return each(row, row.counts.updates); }},
    ScaleMeasure{"heard_packets_per_s", "HEARD/s",
                 [](const ScaleRow& row) { return each(row, row.counts.heard_datagrams); }},
    ScaleMeasure{"heard_bytes_per_s", "HEARD B/s",
                 [](const ScaleRow& row) { return each(row, row.counts.heard_octets); }},
    ScaleMeasure{"heard_updates_per_s", "HEARD UPD/s",
                 [](const ScaleRow& row) { return each(row, row.counts.heard_updates); }},
    ScaleMeasure{"wanted_updates_per_s", "WANTED/s", wanted},
    ScaleMeasure{"unwanted_updates_per_s", "UNWANTED/s",
                 [](const ScaleRow& row) {
                   const double heard = each(row, row.counts.heard_updates) *
                                        (1 - ratio(row.counts.lost, row.counts.wanted));
                   return std::max(0.0, heard - wanted(row));
                 }},
    ScaleMeasure{"pose_error_p50_m", "POSE p50",
                 [](const ScaleRow& row) { return row.counts.pose.p50; }},
    ScaleMeasure{"pose_error_p99_m", "POSE p99",
                 [](const ScaleRow& row) { return row.counts.pose.p99; }},
    ScaleMeasure{"unseen_share", "UNSEEN",
                 [](const ScaleRow& row) { return ratio(row.counts.unseen, row.counts.looks); }},
    ScaleMeasure{"missed_share", "MISSED",
                 [](const ScaleRow& row) { return ratio(row.counts.missed, row.counts.wanted); }},
    ScaleMeasure{"lost_share", "LOST",
                 [](const ScaleRow& row) {
                   return ratio(row.counts.lost, row.counts.wanted - row.counts.missed);
                 }},
    ScaleMeasure{"joins_per_s", "JOINS/s",
                 [](const ScaleRow& row) { return each(row, row.counts.joins); }},
    ScaleMeasure{"shown_after_p50_s", "SHOWN p50",
                 [](const ScaleRow& row) { return pdu::to_seconds(row.counts.discovery.p50); }},
    ScaleMeasure{"shown_after_p99_s", "SHOWN p99",
                 [](const ScaleRow& row) { return pdu::to_seconds(row.counts.discovery.p99); }},
    ScaleMeasure{"send_cpu_share", "CPU OUT",
                 [](const ScaleRow& row) { return each(row, row.counts.send_cpu); }},
    ScaleMeasure{"interest_cpu_share", "CPU AOI",
                 [](const ScaleRow& row) { return each(row, row.counts.interest_cpu); }},
};

bool is_same_exercise(const ScaleRow& a, const ScaleRow& b) {
  return a.setting.peers == b.setting.peers && a.counts.entities == b.counts.entities;
}

}  // namespace

std::span<const ScaleMeasure> scale_measures() { return kMeasures; }

std::string measure_text(const ScaleMeasure& measure, double value) {
  if (measure.name.ends_with("_m")) return length_text(value);
  if (measure.name.ends_with("_s") && !measure.name.ends_with("_per_s"))
    return value < 1e-3 ? "0 ms" : fmt::format("{} ms", number_text(1e3 * value));
  if (measure.name.ends_with("_share")) return fmt::format("{} %", number_text(100 * value));
  return value >= 1e6 ? fmt::format("{:.3g} M", 1e-6 * value) : number_text(value);
}

std::string scale_text(std::span<const ScaleRow> rows) {
  std::string out;
  while (!rows.empty()) {
    std::size_t count = 1;
    while (count < rows.size() && is_same_exercise(rows.front(), rows[count])) ++count;
    std::vector<tools::TextTable::Column> columns{{"EACH PEER"}};
    for (const ScaleMeasure& measure : kMeasures)
      columns.push_back({std::string(measure.title), tools::TextTable::Align::right});
    tools::TextTable table(columns);
    for (const ScaleRow& row : rows.first(count)) {
      std::vector<std::string> cells{std::string(kMechanisms[row.mechanism].name)};
      for (const ScaleMeasure& measure : kMeasures)
        cells.push_back(measure_text(measure, measure.of(row)));
      table.add(cells);
    }
    const ScaleRow& first = rows.front();
    out += fmt::format(
        "{} with {} over {:g} s\n{}\n", tools::counted(first.counts.peers, "peer"),
        first.counts.entities == 1 ? "1 entity" : fmt::format("{} entities", first.counts.entities),
        first.counts.seconds, table.text());
    rows = rows.subspan(count);
  }
  out +=
      "SENT, HEARD: datagrams with those of control; B with headers of UDP and IPv4. WANTED: "
      "updates "
      "of others' entities\nwithin the radius; UNWANTED: heard beside them. POSE: shown against "
      "true. UNSEEN: of entities within the radius,\nat each tick, not shown; SHOWN: after coming "
      "in. MISSED: wanted, and the group not joined yet. LOST: of what\nwas sent to a joined "
      "group. "
      "CPU: of this machine's core, in the library's code.\n";
  return out;
}

std::string scale_json(std::span<const ScaleRow> rows) {
  std::string out;
  for (const ScaleRow& row : rows) {
    tools::JsonObject object(out);
    object.text("kind", "row")
        .text("mechanism", kMechanisms[row.mechanism].name)
        .value("peers", row.counts.peers)
        .value("entities", row.counts.entities)
        .value("seconds", row.counts.seconds);
    for (const ScaleMeasure& measure : kMeasures) object.value(measure.name, measure.of(row));
    object.value("groups", row.counts.groups).end("\n");
  }
  return out;
}

}  // namespace reckon::bench
