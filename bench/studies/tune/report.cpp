// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/tune/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>
#include <tuple>
#include <vector>

#include "reckon/bench/plots/log_plot.hpp"
#include "reckon/bench/studies/frame/fields.hpp"
#include "reckon/peer/notation/units.hpp"
#include "reckon/tools/terminal/text_table.hpp"

namespace reckon::bench {
namespace {

constexpr double kDegrees = 180 / std::numbers::pi;
/// A match above this threshold [m] means that only heartbeats are left to compare.
constexpr double kWidestMatch = 90;

std::string metres(double value) { return peer::format_quantity(value, "m"); }

// Three significant digits; no exponent in output for people.
std::string short_number(double value) {
  if (value == 0) return "0";
  const double size = std::abs(value);
  if (size >= 100) return fmt::format("{:.0f}", value);
  if (size >= 10) return fmt::format("{:.1f}", value);
  if (size >= 1) return fmt::format("{:.2f}", value);
  if (size >= 0.001) return fmt::format("{:.3g}", value);
  return fmt::format("{:.2g}", value);
}

/// A length for people, with three significant digits.
std::string length_text(double value) {
  if (!(value > 0)) return "0 m";
  const double step = std::pow(10.0, std::floor(std::log10(value)) - 2);
  return metres(std::stod(fmt::format("{:.3g}", std::round(value / step) * step)));
}

/// The unit in which a column of errors is easiest to read.
struct LengthUnit {
  std::string_view name = "m";
  double scale = 1;
};
LengthUnit unit_for(double error) {
  if (error < 1e-4) return {"um", 1e6};
  if (error < 0.1) return {"mm", 1e3};
  return {};
}

std::string threshold_of(const TuneRow& row) {
  return row.threshold > 0 ? metres(row.threshold) : "-";
}

/// "28.6 %", "3.2 times": the packets of one setting as a share of another's.
std::string against(const TuneRow& row, const TuneRow& other) {
  if (!(other.packets_per_s > 0)) return "-";
  const double ratio = row.packets_per_s / other.packets_per_s;
  return ratio >= 2 ? fmt::format("{:.3g} times", ratio) : fmt::format("{:.1f} %", 100 * ratio);
}

void append_head(std::string& out, const TuneReport& report) {
  const TrackSummary& summary = report.summary;
  out += fmt::format(
      "{}: {}, {} in {} s; of an entity each {} s, moving {} in {} s (medians)\n", report.file.name,
      summary.entities == 1 ? "1 entity" : fmt::format("{} entities", summary.entities),
      tools::counted(summary.samples, "sample"), short_number(summary.span),
      short_number(summary.interval), length_text(summary.step),
      short_number(std::max(summary.interval, kLeastStepTime)));
  if (!report.file.note.empty()) out += fmt::format("{}\n", report.file.note);
  const bool often = report.options.heartbeat <= 2 * summary.interval && summary.interval > 0;
  if (often)
    out += fmt::format(
        "The heartbeat of {} is due at nearly every sample, so thresholds have little effect; "
        "set a longer --heartbeat to see it.\n",
        peer::format_quantity(report.options.heartbeat, "s"));
  out += '\n';
}

/// A setting with its role in the table.
struct MarkedRow {
  TuneRow row;
  std::string_view kind;
  bool is_knee = false;
  std::string mark = {};  ///< printed before its line
};

Fields fields_of(const MarkedRow& of, const LengthUnit& unit, bool angle) {
  const TuneRow& row = of.row;
  const PoseResult& result = row.result;
  const auto threshold = row.threshold > 0 ? std::optional(row.threshold) : std::nullopt;
  Fields fields(of.kind);
  fields.csv("kind", of.kind)
      .value("model", row.model)
      .json("threshold_m", threshold)
      .csv("threshold_m", row.threshold)
      .value("packets_per_s", row.packets_per_s)
      .value("octets_per_s", row.octets_per_s)
      .value("packets_per_entity_s", result.updates_per_second())
      .word("", of.mark)
      .word("MODEL", row.model)
      .cell("THRESHOLD", threshold_of(row))
      .cell("PACKETS/s", short_number(row.packets_per_s))
      .cell("OCTETS/s", short_number(row.octets_per_s));
  for (const auto& [name, title, error] : {std::tuple{"rms_m", "RMS", result.position.rms},
                                           std::tuple{"p99_m", "P99", result.position.p99},
                                           std::tuple{"max_m", "MAX", result.position.max}})
    fields.value(name, error)
        .cell(fmt::format("{} {}", title, unit.name), short_number(unit.scale * error));
  return fields.value("angle_p99_rad", result.angle.p99)
      .value("velocity_step_p99_mps", result.velocity_step.p99)
      .value("front", row.on_front)
      .value("knee", of.is_knee)
      .cell("ANGLE P99 deg", angle ? short_number(result.angle.p99 * kDegrees) : "-");
}

/// Fields for files, which use SI units.
Fields tune_file_fields(const MarkedRow& of) { return fields_of(of, {}, true); }

MarkedRow marked(const TuneReport& report, std::size_t place) {
  const TuneRow& row = report.table.rows[place];
  const bool is_knee = report.table.knee == place;
  return {row, "setting", is_knee, is_knee ? "knee" : row.on_front ? "*" : ""};
}

/// All rows, and the baselines.
std::vector<MarkedRow> file_rows(const TuneReport& report) {
  std::vector<MarkedRow> rows;
  for (std::size_t i = 0; i < report.table.rows.size(); ++i) rows.push_back(marked(report, i));
  rows.push_back({report.table.every_sample, "every_sample"});
  rows.push_back({report.table.common, "drm4_1m"});
  if (report.table.matched) rows.push_back({*report.table.matched, "drm4_1m_matched"});
  return rows;
}

/// Indices of the rows to show: all in their order, or the front from the most to the least
/// packets.
std::vector<std::size_t> shown_rows(const TuneReport& report, bool all) {
  const auto& rows = report.table.rows;
  std::vector<std::size_t> shown;
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (all || rows[i].on_front || &rows[i] == report.advice.row) shown.push_back(i);
  if (!all)
    std::stable_sort(shown.begin(), shown.end(), [&](std::size_t a, std::size_t b) {
      return rows[a].packets_per_s > rows[b].packets_per_s;
    });
  return shown;
}

void append_table(std::string& out, const TuneReport& report, bool all) {
  const bool angle = report.options.angle < std::numbers::pi;
  const TuneTable& tuned = report.table;
  const auto [least, most] =
      std::minmax_element(tuned.rows.begin(), tuned.rows.end(),
                          [](const TuneRow& x, const TuneRow& y) { return x.error() < y.error(); });
  const LengthUnit unit = unit_for(std::sqrt(least->error() * most->error()));
  std::vector<MarkedRow> rows;
  for (const std::size_t i : shown_rows(report, all)) rows.push_back(marked(report, i));
  rows.push_back({tuned.every_sample, {}, false, "each"});
  rows.push_back({tuned.common, {}, false, "DIS"});
  out += table_of(rows, [&](const MarkedRow& of) { return fields_of(of, unit, angle); });
  out +=
      "\n* on the front: no other setting has fewer packets and less p99 error. each: every sample "
      "sent and\nheld. DIS: DRM 4 (rvw) with 1 m. Packets of all entities, octets with UDP and "
      "IPv4.\n";
  for (const auto& [twin, model] : report.table.twins)
    out += fmt::format("{} sends the same as {}.\n", twin, model);
  out += "\n";
}

void append_advice(std::string& out, const TuneReport& report) {
  const TuneTable& table = report.table;
  if (report.advice.row == nullptr) {
    out += fmt::format("{}\n", report.advice.why);
    return;
  }
  const TuneRow& row = *report.advice.row;
  out += fmt::format("Use {} with {}, {}: {} packets/s, {} kB/s, p99 error {}.\n", row.model,
                     metres(row.threshold), report.advice.why, short_number(row.packets_per_s),
                     short_number(row.octets_per_s / 1000), length_text(row.error()));
  out += fmt::format(
      "It sends {} the packets of every sample, and {} the packets of DRM 4 with 1 m, whose p99 "
      "error is {}.\n",
      against(row, table.every_sample), against(row, table.common),
      length_text(table.common.error()));
  if (!table.matched || table.matched->threshold > kWidestMatch) return;
  out += fmt::format(
      "At the p99 error of DRM 4 with 1 m: {} with {} sends {} packets/s, {} of its packets.\n",
      table.matched->model, length_text(table.matched->threshold),
      short_number(table.matched->packets_per_s), against(*table.matched, table.common));
}

std::string toml_of(const TuneReport& report) {
  constexpr double kLongestHeartbeat = 60;  // [s] in a scene file
  const double angle = std::min(report.options.angle, std::numbers::pi);
  return fmt::format(
      "[dead_reckoning]\nalgorithm = \"{}\"\nposition = \"{}\"\nangle = \"{:.6g} deg\"\n"
      "heartbeat = \"{}\"\n",
      report.advice.row->model, metres(report.advice.row->threshold), angle * kDegrees,
      peer::format_quantity(std::min(report.options.heartbeat, kLongestHeartbeat), "s"));
}

std::optional<double> ratio(const TuneRow& row, const TuneRow& other) {
  if (!(other.packets_per_s > 0)) return std::nullopt;
  return row.packets_per_s / other.packets_per_s;
}

Fields force_fields(const ForceRow& row, bool contact, const std::string& unit) {
  const auto known = [&](double error) {
    return row.samples > 0 ? std::optional(error) : std::nullopt;
  };
  Fields fields("force");
  fields.value("name", Value::quoted(row.name))
      .value("setting", Value::quoted(row.setting))
      .value("unit", row.unit)
      .value("packets_per_s", row.packets_per_s)
      .value("octets_per_s", row.octets_per_s)
      .value("raw_packets_per_s", row.raw_packets_per_s)
      .value("share", row.share())
      .word("NAME", row.name)
      .word("SETTING", row.setting)
      .cell("PACKETS/s", short_number(row.packets_per_s))
      .cell("OCTETS/s", short_number(row.octets_per_s))
      .cell("OF RAW %", short_number(100 * row.share()));
  // A run in which the hands never touched has no errors.
  for (const auto& [name, title, error] :
       {std::tuple{"rms", "RMS ", row.error.rms}, std::tuple{"p99", "P99 ", row.error.p99},
        std::tuple{"max", "MAX ", row.error.max}})
    fields.value(name, known(error))
        .cell(title + unit, row.samples > 0 ? short_number(error) : "-");
  return fields.value("for_force_per_s", row.for_force_per_s)
      .value("samples", row.samples)
      .value("outside", row.outside)
      .cell(contact ? "FOR FORCE/s" : "OUTSIDE",
            contact ? short_number(row.for_force_per_s) : fmt::format("{}", row.outside));
}

/// Fields for files, without columns that only contacts have.
Fields force_file_fields(const ForceRow& row) { return force_fields(row, false, row.unit); }

}  // namespace

std::string tune_text(const TuneReport& report, bool all) {
  std::string out;
  append_head(out, report);
  append_table(out, report, all);
  append_advice(out, report);
  if (report.advice.row != nullptr) out += "\n" + toml_of(report);
  return out;
}

std::string tune_json(const TuneReport& report) {
  const TuneRow* row = report.advice.row;
  Fields fields("recommendation");
  fields.json("file", report.file.name)
      .json("entities", report.summary.entities)
      .json("samples", report.summary.samples)
      .json("span_s", report.summary.span)
      .json("why", report.advice.why)
      .json("note", report.file.note);
  if (row != nullptr)
    fields.json("model", row->model)
        .json("threshold_m", row->threshold)
        .json("packets_per_s", row->packets_per_s)
        .json("p99_m", row->error())
        .json("of_every_sample", ratio(*row, report.table.every_sample))
        .json("of_drm4_1m", ratio(*row, report.table.common))
        .json("toml", toml_of(report));
  return json_of(file_rows(report), tune_file_fields) + fields.line();
}

std::string tune_csv(const TuneReport& report) {
  return csv_of(file_rows(report), tune_file_fields);
}

std::string tune_svg(const TuneReport& report) {
  const auto point = [](const TuneRow& row) {
    return LogPoint{row.packets_per_s, row.error(),
                    fmt::format("{} {}: {} packets/s, p99 {}", row.model, threshold_of(row),
                                short_number(row.packets_per_s), length_text(row.error()))};
  };
  LogPlot plot;
  plot.title = report.file.name;
  plot.note = report.advice.row == nullptr
                  ? report.advice.why
                  : fmt::format("Take {} with {}: {}.", report.advice.row->model,
                                metres(report.advice.row->threshold), report.advice.why);
  plot.x = "packets a second, all entities";
  plot.y = "p99 error of position [m]";
  for (const TuneRow& row : report.table.rows) {
    if (plot.curves.empty() || plot.curves.back().name != row.model)
      plot.curves.push_back({std::string(row.model), {}, plot.curves.empty()});
    plot.curves.back().points.push_back(point(row));
  }
  if (report.table.knee)
    plot.marks.push_back({point(report.table.rows[*report.table.knee]),
                          fmt::format("knee: {} {}", report.table.rows[*report.table.knee].model,
                                      threshold_of(report.table.rows[*report.table.knee])),
                          true});
  const bool other =
      report.advice.row != nullptr &&
      (!report.table.knee || report.advice.row != &report.table.rows[*report.table.knee]);
  if (other)
    plot.marks.push_back(
        {point(*report.advice.row),
         fmt::format("asked: {} {}", report.advice.row->model, threshold_of(*report.advice.row)),
         true});
  // Beside the curves it would only compress them.
  const auto near = [&](const TuneRow& row) {
    const TuneRow& common = report.table.common;
    return row.packets_per_s < 2 * common.packets_per_s && row.error() < 2 * common.error() &&
           row.error() > common.error() / 2;
  };
  if (std::any_of(report.table.rows.begin(), report.table.rows.end(), near))
    plot.marks.push_back({point(report.table.common), "DRM 4, 1 m", false});
  for (const auto& [twin, model] : report.table.twins)
    for (LogCurve& curve : plot.curves)
      if (curve.name.substr(0, curve.name.find(',')) == model)
        curve.name += fmt::format(", {}", twin);
  return log_plot_svg(plot);
}

std::string force_text(std::span<const ForceRow> rows, bool contact) {
  const std::string unit = rows.empty() ? "" : rows.front().unit;
  return table_of(rows, [&](const ForceRow& row) { return force_fields(row, contact, unit); }) +
         (contact
              ? "\nAll packets of both peers, against an Entity State and an Attribute PDU each "
                "millisecond of each.\nError: force between the hands after the gate, against the "
                "owner's own model there. FOR FORCE: updates\ndue to the force.\n"
              : "\nOUTSIDE: samples where receivers were off by more than the deadband. Raw: each "
                "sample sent.\n");
}

std::string force_json(std::span<const ForceRow> rows) { return json_of(rows, force_file_fields); }
std::string force_csv(std::span<const ForceRow> rows) { return csv_of(rows, force_file_fields); }

}  // namespace reckon::bench
