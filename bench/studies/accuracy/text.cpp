// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/accuracy/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <tuple>

#include "reckon/bench/studies/pose/study_text.hpp"
#include "reckon/tools/terminal/json_text.hpp"
#include "reckon/tools/terminal/text_table.hpp"

namespace reckon::bench {
namespace {

using Align = tools::TextTable::Align;

std::string_view curve_name(deadreckon::ConvergenceCurve curve) {
  return deadreckon::kConvergenceCurves[static_cast<std::size_t>(curve)].name;
}

/// Three columns, also on a machine that is slow.
std::string nanoseconds_text(double ns) {
  if (!(ns > 0)) return "-";
  return ns < 999.5 ? fmt::format("{:.0f}", ns) : fmt::format("{:.0f}us", ns / 1000);
}

/// What ran, above a table.
std::string heading_of(const AccuracyResult& result) {
  const std::string colon = result.meaning.empty() ? "" : ": ";
  return wrapped(result.subject + colon + result.meaning, kColumns) +
         fmt::format(
             "\n{}, {} samples; the true velocity steps by up to {} m/s from sample to sample\n"
             "front: {} of {}; {} dominated\n",
             tools::counted(result.entities, "track"), result.samples,
             number_text(result.own_velocity_step), result.on_front(),
             tools::counted(result.rows.size(), "setting"), result.rows.size() - result.on_front());
}

std::string size_json(const ErrorSize& size) {
  return fmt::format(R"({{"rms":{},"p99":{},"max":{}}})", size.rms, size.p99, size.max);
}

std::string result_json(const PoseResult& result) {
  return fmt::format(R"("updates":{},"updates_per_s":{},"octets_per_s":{},"position_m":{},)"
                     R"("angle_rad":{},"velocity_step_mps":{})",
                     result.updates, result.updates_per_second(),
                     kUpdateOctets * result.updates_per_second(), size_json(result.position),
                     size_json(result.angle), size_json(result.velocity_step));
}

std::string json_quoted(std::string_view text) {
  std::string out;
  tools::append_json_string(out, text);
  return out;
}

/// Within quotes, quotes doubled (RFC 4180).
std::string csv_quoted(std::string_view text) {
  std::string out = "\"";
  for (const char letter : text) out += letter == '"' ? "\"\"" : std::string(1, letter);
  return out + '"';
}

/// Nothing where no angle is too large.
std::string angle_json(double angle) {
  return angle < kAnyAngle ? fmt::format("{}", angle) : "null";
}

std::string study_json(const AccuracyReport& report) {
  const AccuracyGrid& grid = report.grid;
  const bool beats = grid.heartbeat < kNoHeartbeat;
  return fmt::format(
      R"({{"kind":"study","command":{},"processor":{},"angle_rad":{},"heartbeat_s":{},)"
      R"("first_heartbeat_s":{},"converge_s":{},"converge_longest_s":{},)"
      R"("delay_s":{},"jitter":{},"loss":{},"seed":{},"seeds":{},)"
      R"("update_octets":{}}})"
      "\n",
      json_quoted(report.command),
      report.processor.empty() ? "null" : json_quoted(report.processor), angle_json(grid.angle),
      beats ? fmt::format("{}", grid.heartbeat) : "null",
      grid.first_heartbeat > 0 ? fmt::format("{}", grid.first_heartbeat) : "null",
      grid.convergence.duration, grid.convergence.longest, grid.network.delay, grid.network.jitter,
      grid.network.loss, grid.network.seed, grid.seeds, kUpdateOctets);
}

std::string subject_json(const AccuracyResult& result) {
  return fmt::format(
      R"({{"kind":"subject","subject":{},"meaning":{},"tracks":{},"samples":{},"seconds":{},)"
      R"("angle_rad":{},"own_velocity_step_mps":{},"settings":{},"on_front":{}}})"
      "\n",
      json_quoted(result.subject), json_quoted(result.meaning), result.entities, result.samples,
      result.seconds, angle_json(result.angle), result.own_velocity_step, result.rows.size(),
      result.on_front());
}

std::string setting_json(const AccuracyResult& result, const AccuracyRow& row) {
  std::string line = fmt::format(
      R"({{"kind":"setting","subject":{},"model":{},"curve":{},"threshold_m":{},{},"query_ns":{},)",
      json_quoted(result.subject), json_quoted(row.model.name), json_quoted(curve_name(row.curve)),
      row.threshold, result_json(row.result),
      row.query_ns > 0 ? fmt::format("{:.1f}", row.query_ns) : "null");
  line += fmt::format(R"("front":{})", !row.beaten);
  if (row.beaten)
    line += fmt::format(R"(,"beaten_by":{},"equal":{})",
                        json_quoted(setting_text(result.rows[row.beaten->by])), row.beaten->equal);
  return line + "}\n";
}

}  // namespace

std::string wrapped(std::string_view text, std::size_t columns) {
  std::string out;
  std::size_t column = 0;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(' '), text.size());
    const std::string_view word = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    if (column > 0 && column + 1 + tools::text_width(word) > columns) {
      out += '\n';
      column = 0;
    }
    if (column > 0) out += ' ';
    out += word;
    column += tools::text_width(word) + (column > 0 ? 1 : 0);
  }
  return out;
}

std::vector<std::size_t> rows_in_order(const AccuracyResult& result, bool front_only) {
  std::vector<std::size_t> order(result.rows.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  if (front_only) std::erase_if(order, [&](std::size_t i) { return bool(result.rows[i].beaten); });
  const auto key = [&](std::size_t i) {
    const PoseResult& row = result.rows[i].result;
    return std::tuple(row.updates_per_second(), row.position.p99, row.velocity_step.max);
  };
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return key(a) < key(b); });
  return order;
}

std::string conditions_text(const AccuracyGrid& grid) {
  std::string text = grid.angle < kAnyAngle ? fmt::format("sent too when off by {} degrees",
                                                          number_text(degrees(grid.angle)))
                                            : "orientation sends nothing";
  text += grid.heartbeat < kNoHeartbeat
              ? fmt::format(", and every {} s", number_text(grid.heartbeat))
              : ", no heartbeat";
  if (grid.first_heartbeat > 0)
    text += fmt::format("; said again after {} ms, then twice as long",
                        number_text(grid.first_heartbeat * 1e3));
  const auto is_curve = [](auto curve) { return curve != deadreckon::ConvergenceCurve::snap; };
  if (std::any_of(grid.curves.begin(), grid.curves.end(), is_curve))
    text += fmt::format(
        "; converges in {} ms, at most {} ms", number_text(grid.convergence.duration * 1e3),
        number_text(std::max(grid.convergence.duration, grid.convergence.longest) * 1e3));
  const PoseNetwork& network = grid.network;
  text += fmt::format("; delay {} ms", number_text(network.delay * 1e3));
  if (network.delay > 0 && network.jitter > 0)
    text += fmt::format(" +-{} %", number_text(network.jitter * 100));
  if (network.loss > 0) text += fmt::format(", {} % lost", number_text(network.loss * 100));
  text += grid.seeds > 1 ? fmt::format("; medians of {} seeds from {}", grid.seeds, network.seed)
                         : fmt::format("; seed {}", network.seed);
  return text;
}

std::string accuracy_table(const AccuracyResult& result, bool front_only) {
  tools::TextTable table({{"MODEL"},
                          {"CURVE"},
                          {"SEND AT", Align::right},
                          {"UPD/S", Align::right},
                          {"OCT/S", Align::right},
                          {"RMS", Align::right},
                          {"P99", Align::right},
                          {"MAX", Align::right},
                          {"ANGLE", Align::right},
                          {"STEP", Align::right},
                          {"NS", Align::right},
                          {""}});
  for (const std::size_t i : rows_in_order(result, front_only)) {
    const AccuracyRow& row = result.rows[i];
    const PoseResult& r = row.result;
    const std::string mark = !row.beaten ? "" : row.beaten->equal ? "=" : "<";
    table.add({std::string(row.model.name), std::string(curve_name(row.curve)),
               length_text(row.threshold), number_text(r.updates_per_second()),
               number_text(row.octets_per_second()), length_text(r.position.rms),
               length_text(r.position.p99), length_text(r.position.max),
               number_text(degrees(r.angle.p99)), number_text(r.velocity_step.max),
               nanoseconds_text(row.query_ns), front_only ? "" : mark});
  }
  return heading_of(result) + table.text();
}

std::string accuracy_csv(const AccuracyReport& report, bool front_only) {
  std::string text =
      "subject,model,curve,threshold_m,updates,updates_per_s,octets_per_s,position_rms_m,"
      "position_p99_m,position_max_m,angle_rms_rad,angle_p99_rad,angle_max_rad,"
      "velocity_step_rms_mps,velocity_step_p99_mps,velocity_step_max_mps,query_ns,front,beaten_"
      "by\n";
  for (const AccuracyResult& result : report.results) {
    for (const std::size_t i : rows_in_order(result, front_only)) {
      const AccuracyRow& row = result.rows[i];
      const PoseResult& r = row.result;
      text += fmt::format("{},{},{},{},{},{},{}", csv_quoted(result.subject), row.model.name,
                          curve_name(row.curve), row.threshold, r.updates, r.updates_per_second(),
                          row.octets_per_second());
      for (const ErrorSize& size : {r.position, r.angle, r.velocity_step})
        text += fmt::format(",{},{},{}", size.rms, size.p99, size.max);
      text += fmt::format(
          ",{},{},\"{}\"\n", row.query_ns > 0 ? fmt::format("{:.1f}", row.query_ns) : "",
          row.beaten ? 0 : 1, row.beaten ? setting_text(result.rows[row.beaten->by]) : "");
    }
  }
  return text;
}

std::string accuracy_json(const AccuracyReport& report, bool front_only) {
  std::string text = study_json(report);
  for (const AccuracyResult& result : report.results) {
    text += subject_json(result);
    for (const std::size_t i : rows_in_order(result, front_only))
      text += setting_json(result, result.rows[i]);
  }
  return text;
}

std::string circle_table(std::span<const CircleRow> rows) {
  tools::TextTable table({{"MODEL"},
                          {"CURVE"},
                          {"RMS", Align::right},
                          {"P99", Align::right},
                          {"MAX", Align::right},
                          {"ANGLE RMS", Align::right},
                          {"LARGEST STEP", Align::right},
                          {"BAR"}});
  for (const CircleRow& row : rows) {
    table.add({std::string(row.model.name), std::string(curve_name(row.curve)),
               length_text(row.result.position.rms), length_text(row.result.position.p99),
               length_text(row.result.position.max),
               fmt::format("{} deg", number_text(degrees(row.result.angle.rms))),
               fmt::format("{} m/s", number_text(row.result.velocity_step.max)),
               row.clears() ? "cleared" : "missed"});
  }
  return table.text();
}

std::string circle_json(std::span<const CircleRow> rows) {
  std::string text;
  for (const CircleRow& row : rows)
    text += fmt::format(R"({{"kind":"circle","model":{},"curve":{},{},"clears":{}}})"
                        "\n",
                        json_quoted(row.model.name), json_quoted(curve_name(row.curve)),
                        result_json(row.result), row.clears());
  return text;
}

std::string equal_error_table(std::span<const NamedEqualError> rows) {
  tools::TextTable table({{"OF"},
                          {"MODEL"},
                          {"SEND AT", Align::right},
                          {"UPDATES", Align::right},
                          {"P99", Align::right},
                          {"RMS", Align::right},
                          {"MAX", Align::right},
                          {"SAVING", Align::right}});
  const auto add = [&](std::string_view file, const PoseModel& model, double threshold,
                       const PoseResult& result, const std::string& saving) {
    table.add({std::string(file), std::string(model.name), length_text(threshold),
               fmt::format("{}", result.updates), length_text(result.position.p99),
               length_text(result.position.rms), length_text(result.position.max), saving});
  };
  std::string_view last;
  for (const auto& [subject, found] : rows) {
    if (subject != last)
      add(subject, found.baseline, found.baseline_threshold, found.baseline_result, "");
    last = subject;
    if (found.threshold > 0)
      add("", found.rival, found.threshold, found.result,
          fmt::format("{:.1f} %", 100 * found.saving()));
    else
      table.add({"", std::string(found.rival.name), "none"});
  }
  return table.text();
}

std::string equal_error_json(std::span<const NamedEqualError> rows) {
  std::string text;
  for (const auto& [subject, found] : rows) {
    text += fmt::format(
        R"({{"kind":"equal_error","subject":{},"baseline":{{"model":{},"threshold_m":{},{}}},)",
        json_quoted(subject), json_quoted(found.baseline.name), found.baseline_threshold,
        result_json(found.baseline_result));
    text += found.threshold > 0
                ? fmt::format(R"("rival":{{"model":{},"threshold_m":{},{}}},"saving":{}}})",
                              json_quoted(found.rival.name), found.threshold,
                              result_json(found.result), found.saving())
                : std::string(R"("rival":null,"saving":null})");
    text += '\n';
  }
  return text;
}

}  // namespace reckon::bench
