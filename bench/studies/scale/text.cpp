// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/scale/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

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

/// Converts a sum over all peers to a value per peer and second.
double each(const ScaleRow& row, double sum) {
  return ratio(sum, row.run.counts.seconds * static_cast<double>(row.peers()));
}
double each(const ScaleRow& row, std::uint64_t sum) { return each(row, static_cast<double>(sum)); }

double p50(const peer::Percentiles& time) { return pdu::to_seconds(time.p50); }
double p99(const peer::Percentiles& time) { return pdu::to_seconds(time.p99); }

constexpr std::array kMeasures{
    ScaleMeasure{"sent_packets_per_s", "SENT/s", "SENT/s",
                 [](const ScaleRow& row) { return each(row, row.run.counts.datagrams); }},
    ScaleMeasure{"sent_bytes_per_s", "SENT B/s", "",
                 [](const ScaleRow& row) { return each(row, row.run.counts.octets); }},
    ScaleMeasure{"sent_updates_per_s", "UPDATES/s", "",
                 [](const ScaleRow& row) { return each(row, row.run.counts.updates); }},
    ScaleMeasure{"heard_packets_per_s", "HEARD/s", "HEARD/s",
                 [](const ScaleRow& row) { return each(row, row.run.counts.heard_datagrams); }},
    ScaleMeasure{"heard_bytes_per_s", "HEARD B/s", "HEARD B/s",
                 [](const ScaleRow& row) { return each(row, row.run.counts.heard_octets); }},
    ScaleMeasure{"heard_updates_per_s", "HEARD UPD/s", "",
                 [](const ScaleRow& row) { return each(row, row.run.counts.heard_updates); }},
    ScaleMeasure{"wanted_updates_per_s", "WANTED/s", "",
                 [](const ScaleRow& row) { return each(row, row.run.counts.wanted); }},
    ScaleMeasure{"unwanted_updates_per_s", "UNWANTED/s", "",
                 [](const ScaleRow& row) {
                   return each(row, row.run.counts.heard_updates - row.run.counts.wanted);
                 }},
    ScaleMeasure{"pose_error_p50_m", "POSE p50", "",
                 [](const ScaleRow& row) { return row.run.pose.p50; }},
    ScaleMeasure{"pose_error_p99_m", "POSE p99", "POSE",
                 [](const ScaleRow& row) { return row.run.pose.p99; }},
    ScaleMeasure{
        "unseen_share", "UNSEEN", "",
        [](const ScaleRow& row) { return ratio(row.run.counts.unseen, row.run.counts.looks); }},
    ScaleMeasure{"lost_share", "LOST", "",
                 [](const ScaleRow& row) {
                   const WholeCounts& counts = row.run.counts;
                   return ratio(counts.lost, counts.lost + counts.heard_datagrams);
                 }},
    ScaleMeasure{"joins_per_s", "JOINS/s", "",
                 [](const ScaleRow& row) { return each(row, row.run.counts.joins); }},
    ScaleMeasure{"groups", "GROUPS", "",
                 [](const ScaleRow& row) { return ratio(row.run.counts.groups, row.peers()); }},
    ScaleMeasure{"shown_after_p50_s", "SHOWN p50", "",
                 [](const ScaleRow& row) { return p50(row.run.discovery); }},
    ScaleMeasure{"shown_after_p99_s", "SHOWN p99", "SHOWN",
                 [](const ScaleRow& row) { return p99(row.run.discovery); }},
    ScaleMeasure{"wanted_share", "WANTED", "WANTED",
                 [](const ScaleRow& row) {
                   return ratio(row.run.counts.wanted, row.run.counts.heard_updates);
                 }},
    ScaleMeasure{"loops_cpu_share", "CPU LOOPS", "",
                 [](const ScaleRow& row) { return each(row, row.run.counts.cpu); }},
    ScaleMeasure{"wakes_per_s", "WAKES/s", "",
                 [](const ScaleRow& row) { return each(row, row.run.counts.passes); }},
    ScaleMeasure{"live_cpu_share", "CPU LIVE", "",
                 [](const ScaleRow& row) { return each(row, row.run.live_cpu); }},
    ScaleMeasure{"cpu_share", "CPU", "CPU",
                 [](const ScaleRow& row) { return row.run.cpu_share(); }},
};

bool is_same_exercise(const ScaleRow& a, const ScaleRow& b) {
  return a.peers() == b.peers() && a.entities() == b.entities();
}

/// "64 peers with 6400 entities"
std::string exercise_name(const ScaleRow& row) {
  return fmt::format("{} with {}", tools::counted(row.peers(), "peer"),
                     row.entities() == 1 ? "1 entity" : fmt::format("{} entities", row.entities()));
}

/// "5 s"; if the first row was measured for less, "5 s (every tick: 1 s)".
std::string length_of(std::span<const ScaleRow> rows) {
  const double longest = rows.back().run.counts.seconds, first = rows.front().run.counts.seconds;
  if (first >= longest) return fmt::format("{:g} s", longest);
  return fmt::format("{:g} s ({}: {:g} s)", longest, kMechanisms[rows.front().mechanism].name,
                     first);
}

}  // namespace

std::span<const ScaleMeasure> scale_measures() { return kMeasures; }

const ScaleMeasure& scale_measure(std::string_view name) {
  return *std::ranges::find(kMeasures, name, &ScaleMeasure::name);
}

std::string measure_text(const ScaleMeasure& measure, double value) {
  if (measure.name.ends_with("_m")) return length_text(value);
  if (measure.name.ends_with("_s") && !measure.name.ends_with("_per_s"))
    return value < 1e-3 ? "0 ms" : fmt::format("{} ms", number_text(1e3 * value));
  if (measure.name.ends_with("_share")) return fmt::format("{} %", number_text(100 * value));
  return value >= 1e6 ? fmt::format("{:.3g} M", 1e-6 * value) : number_text(value);
}

namespace {

/// A note on --pool 1; else empty.
std::string one_group_text(std::span<const ScaleRow> rows) {
  const auto one = [](const ScaleRow& row) { return shares_one_group(row.run.setting); };
  if (std::ranges::none_of(rows, one)) return {};
  return "\n--pool 1: all cells share one group, so this is the growth without areas of\ninterest. "
         "Contact and near groups, which need a group of each cell, are off.\n";
}

}  // namespace

std::string scale_text(std::span<const ScaleRow> rows) {
  const std::span<const ScaleRow> all = rows;
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
    out += fmt::format("{} over {}\n{}\n", exercise_name(rows.front()),
                       length_of(rows.first(count)), table.text());
    rows = rows.subspan(count);
  }
  out += one_group_text(all);
  out +=
      "SENT, HEARD: datagrams, with control; B with headers of UDP and IPv4. WANTED: received "
      "updates of remote entities\nthat are used: within the radius, or shown; UNWANTED: the "
      "others. POSE: shown against true. UNSEEN: share of\nentities within the radius, at each "
      "sample, not shown; SHOWN: time until shown. LOST: of the datagrams for\njoined groups. "
      "GROUPS: joined at the end. CPU: of this machine's core; LIVE: of a live peer beside its "
      "loops, "
      "by its wakes, datagrams\nand ticks. WAKES: passes of the model loop.\n";
  return out;
}

namespace {

/// "sent 3.4 x less", "sent 2 x more"; empty for a change within 5 %.
std::string times(double before, double now, std::string_view what) {
  if (!(before > 0) || !(now > 0)) return {};
  const double factor = before / now;
  if (factor > 1.05) return fmt::format("{} {:.2g} x less", what, factor);
  if (factor < 1 / 1.05) return fmt::format("{} {:.2g} x more", what, 1 / factor);
  return {};
}

std::string bought(const ScaleRow& before, const ScaleRow& now) {
  std::string out;
  const auto add = [&](const std::string& words) {
    if (!words.empty()) out += (out.empty() ? "" : ", ") + words;
  };
  const auto compare = [&](std::string_view name, std::string_view what) {
    const ScaleMeasure& measure = scale_measure(name);
    add(times(measure.of(before), measure.of(now), what));
  };
  compare("heard_packets_per_s", "heard");
  compare("sent_packets_per_s", "sent");
  compare("heard_bytes_per_s", "octets heard");
  const ScaleMeasure& pose = scale_measure("pose_error_p99_m");
  if (std::abs(pose.of(now) - pose.of(before)) > 0.05 * pose.of(now))
    add(fmt::format("pose {}", measure_text(pose, pose.of(now))));
  return out.empty() ? "no difference here" : out;
}

std::vector<tools::TextTable::Column> narrow_columns(
    std::vector<tools::TextTable::Column> columns) {
  for (const ScaleMeasure& measure : kMeasures)
    if (!measure.short_title.empty())
      columns.push_back({std::string(measure.short_title), tools::TextTable::Align::right});
  return columns;
}

void add_narrow(tools::TextTable& table, std::vector<std::string> cells, const ScaleRow& row) {
  for (const ScaleMeasure& measure : kMeasures)
    if (!measure.short_title.empty()) cells.push_back(measure_text(measure, measure.of(row)));
  table.add(cells);
}

/// From which size on a peer's received datagrams grow in step with the exercise, and why.
std::string knee_text(std::span<const ScaleRow> rows) {
  constexpr double kInStep = 0.9;
  const ScaleMeasure& heard = scale_measure("heard_packets_per_s");
  const ScaleRow* before = nullptr;
  for (const ScaleRow& row : rows) {
    if (row.mechanism + 1 != kMechanisms.size()) continue;
    const ScaleRow* last = std::exchange(before, &row);
    if (last == nullptr || !(heard.of(*last) > 0)) continue;
    const double growth = ratio(row.entities(), last->entities());
    if (!(growth > 1) || std::log(heard.of(row) / heard.of(*last)) < kInStep * std::log(growth))
      continue;
    return fmt::format("From {} entities on, each peer receives {:.2g} times as much{}.\n",
                       row.entities(), heard.of(row) / heard.of(*last),
                       groups_suffice(row.run.setting)
                           ? ""
                           : ": cells\nshare the groups of the pool; --pool can be up to 1000");
  }
  return {};
}

}  // namespace

std::string scale_summary(std::span<const ScaleRow> rows) {
  if (rows.empty()) return {};
  const ScaleRow& largest = *std::ranges::max_element(
      rows, {}, [](const ScaleRow& row) { return std::pair(row.entities(), row.peers()); });
  tools::TextTable table(narrow_columns({{"EACH PEER"}}));
  std::string changes;
  const ScaleRow* before = nullptr;
  std::vector<ScaleRow> shown;
  for (const ScaleRow& row : rows) {
    if (!is_same_exercise(row, largest)) continue;
    shown.push_back(row);
    const std::string_view name = kMechanisms[row.mechanism].short_name;
    add_narrow(table, {std::string(name)}, row);
    if (before != nullptr) changes += fmt::format("  {}: {}\n", name, bought(*before, row));
    before = &row;
  }
  std::string out = fmt::format("{} over {}\n{}\n{}", exercise_name(largest), length_of(shown),
                                table.text(), changes);
  tools::TextTable sizes(narrow_columns({{"PEERS x ENTITIES"}}));
  std::size_t count = 0;
  for (const ScaleRow& row : rows) {
    if (row.mechanism + 1 != kMechanisms.size()) continue;
    add_narrow(sizes, {fmt::format("{} x {}", row.peers(), row.entities())}, row);
    ++count;
  }
  if (count > 1)
    out += fmt::format("\nAll mechanisms together\n{}{}", sizes.text(), knee_text(rows));
  return out + one_group_text(rows) +
         "\nHEARD: received datagrams, with control; WANTED: of the received updates;\nPOSE: error "
         "p99; SHOWN: time until shown, p99;\nCPU: of a core, including the kernel. --wide has all "
         "columns.\n";
}

std::string scale_json(std::span<const ScaleRow> rows) {
  std::string out;
  for (const ScaleRow& row : rows) {
    tools::JsonObject object(out);
    object.text("kind", "row")
        .text("mechanism", kMechanisms[row.mechanism].name)
        .value("peers", row.peers())
        .value("entities", row.entities())
        .value("seconds", row.run.counts.seconds);
    for (const ScaleMeasure& measure : kMeasures) object.value(measure.name, measure.of(row));
    object.end("\n");
  }
  return out;
}

}  // namespace reckon::bench
