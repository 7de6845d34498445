// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/tune/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>

#include "reckon/bench/plots/log_plot.hpp"
#include "reckon/peer/scene/units.hpp"
#include "reckon/tools/terminal/json_text.hpp"
#include "reckon/tools/terminal/text_end.hpp"
#include "reckon/tools/terminal/text_table.hpp"

namespace reckon::bench {
namespace {

using tools::JsonObject;

constexpr double kDegrees = 180 / std::numbers::pi;
/// A match beyond this threshold [m] says that nothing but heartbeats is left to compare.
constexpr double kWidestMatch = 90;

std::string metres(double value) { return peer::format_quantity(value, "m"); }

// Three digits that count; no exponent where a person reads it.
std::string short_number(double value) {
  if (value == 0) return "0";
  const double size = std::abs(value);
  if (size >= 100) return fmt::format("{:.0f}", value);
  if (size >= 10) return fmt::format("{:.1f}", value);
  if (size >= 1) return fmt::format("{:.2f}", value);
  if (size >= 0.001) return fmt::format("{:.3g}", value);
  return fmt::format("{:.2g}", value);
}

/// A length as a person says it, of three digits.
std::string length_text(double value) {
  if (!(value > 0)) return "0 m";
  const double step = std::pow(10.0, std::floor(std::log10(value)) - 2);
  return metres(std::stod(fmt::format("{:.3g}", std::round(value / step) * step)));
}

/// The unit in which a column of errors reads best.
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
  fmt::format_to(tools::end_of(out),
                 "{}: {}, {} in {} s; of an entity each {} s, moving {} in {} s (medians)\n",
                 report.file.name,
                 summary.entities == 1 ? "1 entity" : fmt::format("{} entities", summary.entities),
                 tools::counted(summary.samples, "sample"), short_number(summary.span),
                 short_number(summary.interval), length_text(summary.step),
                 short_number(std::max(summary.interval, kLeastStepTime)));
  if (!report.file.note.empty()) fmt::format_to(tools::end_of(out), "{}\n", report.file.note);
  const bool often = report.options.heartbeat <= 2 * summary.interval && summary.interval > 0;
  if (often)
    fmt::format_to(tools::end_of(out),
                   "The heartbeat of {} is due at nearly every sample, so that thresholds decide "
                   "little; a longer --heartbeat shows what they would.\n",
                   peer::format_quantity(report.options.heartbeat, "s"));
  out += '\n';
}

std::vector<std::string> cells_of(const TuneRow& row, std::string mark, const LengthUnit& unit,
                                  bool angle) {
  const PoseResult& result = row.result;
  return {std::move(mark),
          std::string(row.model),
          threshold_of(row),
          short_number(row.packets_per_s),
          short_number(row.octets_per_s),
          short_number(unit.scale * result.position.rms),
          short_number(unit.scale * result.position.p99),
          short_number(unit.scale * result.position.max),
          angle ? short_number(result.angle.p99 * kDegrees) : "-"};
}

/// Places of the rows to show: all as they are, or the front from dear to cheap.
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
  constexpr auto kRight = tools::TextTable::Align::right;
  const bool angle = report.options.angle < std::numbers::pi;
  const TuneTable& tuned = report.table;
  const auto [least, most] =
      std::minmax_element(tuned.rows.begin(), tuned.rows.end(),
                          [](const TuneRow& x, const TuneRow& y) { return x.error() < y.error(); });
  const LengthUnit unit = unit_for(std::sqrt(least->error() * most->error()));
  tools::TextTable table({{""},
                          {"MODEL"},
                          {"THRESHOLD", kRight},
                          {"PACKETS/s", kRight},
                          {"OCTETS/s", kRight},
                          {fmt::format("RMS {}", unit.name), kRight},
                          {fmt::format("P99 {}", unit.name), kRight},
                          {fmt::format("MAX {}", unit.name), kRight},
                          {"ANGLE P99 deg", kRight}});
  for (const std::size_t i : shown_rows(report, all)) {
    const TuneRow& row = report.table.rows[i];
    const bool is_knee = report.table.knee == i;
    table.add(cells_of(row, is_knee ? "knee" : row.on_front ? "*" : "", unit, angle));
  }
  table.add(cells_of(report.table.every_sample, "each", unit, angle));
  table.add(cells_of(report.table.common, "DIS", unit, angle));
  out += table.text();
  out +=
      "\n* on the front: no other setting has fewer packets and less p99 error. each: every sample "
      "sent and\nheld. DIS: DRM 4 (rvw) with 1 m. Packets are those of all entities, octets with "
      "UDP and IPv4.\n";
  for (const auto& [twin, model] : report.table.twins)
    fmt::format_to(tools::end_of(out), "{} sends what {} sends.\n", twin, model);
  out += "\n";
}

void append_advice(std::string& out, const TuneReport& report) {
  const TuneTable& table = report.table;
  if (report.advice.row == nullptr) {
    fmt::format_to(tools::end_of(out), "{}\n", report.advice.why);
    return;
  }
  const TuneRow& row = *report.advice.row;
  fmt::format_to(tools::end_of(out), "Take {} with {}, {}: {} packets/s, {} kB/s, p99 error {}.\n",
                 row.model, metres(row.threshold), report.advice.why,
                 short_number(row.packets_per_s), short_number(row.octets_per_s / 1000),
                 length_text(row.error()));
  fmt::format_to(
      tools::end_of(out),
      "Its packets are {} those of sending every sample, and {} those of DRM 4 with 1 m, whose p99 "
      "error is {}.\n",
      against(row, table.every_sample), against(row, table.common),
      length_text(table.common.error()));
  if (!table.matched || table.matched->threshold > kWidestMatch) return;
  fmt::format_to(
      tools::end_of(out),
      "At the p99 error of DRM 4 with 1 m: {} with {} sends {} packets/s, {} of what that sends.\n",
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

/// Of a run in which hands never touched there is none.
std::optional<double> error_of(const ForceRow& row, double error) {
  return row.samples > 0 ? std::optional(error) : std::nullopt;
}

std::string csv_number(const std::optional<double>& value) {
  return value ? fmt::format("{}", *value) : std::string();
}

void append_row_json(std::string& out, const TuneRow& row, std::string_view kind, bool is_knee) {
  const PoseResult& result = row.result;
  JsonObject(out)
      .text("kind", kind)
      .text("model", row.model)
      .number("threshold_m", row.threshold > 0 ? std::optional(row.threshold) : std::nullopt)
      .number("packets_per_s", row.packets_per_s)
      .number("octets_per_s", row.octets_per_s)
      .number("packets_per_entity_s", result.updates_per_second())
      .number("rms_m", result.position.rms)
      .number("p99_m", result.position.p99)
      .number("max_m", result.position.max)
      .number("angle_p99_rad", result.angle.p99)
      .number("velocity_step_p99_mps", result.velocity_step.p99)
      .value("front", row.on_front)
      .value("knee", is_knee)
      .end("\n");
}

std::optional<double> ratio(const TuneRow& row, const TuneRow& other) {
  if (!(other.packets_per_s > 0)) return std::nullopt;
  return row.packets_per_s / other.packets_per_s;
}

void append_row_csv(std::string& out, const TuneRow& row, std::string_view kind, bool is_knee) {
  const PoseResult& result = row.result;
  fmt::format_to(tools::end_of(out), "{},{},{},{},{},{},{},{},{},{},{},{},{}\n", kind, row.model,
                 row.threshold, row.packets_per_s, row.octets_per_s, result.updates_per_second(),
                 result.position.rms, result.position.p99, result.position.max, result.angle.p99,
                 result.velocity_step.p99, row.on_front ? 1 : 0, is_knee ? 1 : 0);
}

template <typename Append>
void for_all_rows(const TuneReport& report, Append&& append) {
  const auto& rows = report.table.rows;
  for (std::size_t i = 0; i < rows.size(); ++i) append(rows[i], "setting", report.table.knee == i);
  append(report.table.every_sample, "every_sample", false);
  append(report.table.common, "drm4_1m", false);
  if (report.table.matched) append(*report.table.matched, "drm4_1m_matched", false);
}

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
  std::string out;
  for_all_rows(report, [&](const TuneRow& row, std::string_view kind, bool is_knee) {
    append_row_json(out, row, kind, is_knee);
  });
  const TuneRow* row = report.advice.row;
  JsonObject object(out);
  object.text("kind", "recommendation")
      .text("file", report.file.name)
      .value("entities", report.summary.entities)
      .value("samples", report.summary.samples)
      .number("span_s", report.summary.span)
      .text("why", report.advice.why)
      .text("note", report.file.note);
  if (row != nullptr)
    object.text("model", row->model)
        .number("threshold_m", row->threshold)
        .number("packets_per_s", row->packets_per_s)
        .number("p99_m", row->error())
        .number("of_every_sample", ratio(*row, report.table.every_sample))
        .number("of_drm4_1m", ratio(*row, report.table.common))
        .text("toml", toml_of(report));
  object.end("\n");
  return out;
}

std::string tune_csv(const TuneReport& report) {
  std::string out =
      "kind,model,threshold_m,packets_per_s,octets_per_s,packets_per_entity_s,rms_m,p99_m,max_m,"
      "angle_p99_rad,velocity_step_p99_mps,front,knee\n";
  for_all_rows(report, [&](const TuneRow& row, std::string_view kind, bool is_knee) {
    append_row_csv(out, row, kind, is_knee);
  });
  return out;
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
  // Beside the curves it would only squeeze them.
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
  constexpr auto kRight = tools::TextTable::Align::right;
  const std::string unit = rows.empty() ? "" : rows.front().unit;
  tools::TextTable table({{"NAME"},
                          {"SETTING"},
                          {"PACKETS/s", kRight},
                          {"OCTETS/s", kRight},
                          {"OF RAW %", kRight},
                          {"RMS " + unit, kRight},
                          {"P99 " + unit, kRight},
                          {"MAX " + unit, kRight},
                          {contact ? "FOR FORCE/s" : "OUTSIDE", kRight}});
  for (const ForceRow& row : rows) {
    const auto error = [&](double value) {
      return row.samples > 0 ? short_number(value) : std::string("-");
    };
    table.add({row.name, row.setting, short_number(row.packets_per_s),
               short_number(row.octets_per_s), short_number(100 * row.share()),
               error(row.error.rms), error(row.error.p99), error(row.error.max),
               contact ? short_number(row.for_force_per_s) : fmt::format("{}", row.outside)});
  }
  std::string out = table.text();
  out += contact
             ? "\nAll packets of both peers, against an Entity State and an Attribute PDU each "
               "millisecond of each.\nError: force between the hands after the gate, against "
               "the owner's own model there. FOR FORCE: updates\nthat the force asked for.\n"
             : "\nOUTSIDE: samples where receivers were off by more than the deadband. Raw: each "
               "sample sent.\n";
  return out;
}

std::string force_json(std::span<const ForceRow> rows) {
  std::string out;
  for (const ForceRow& row : rows) {
    JsonObject(out)
        .text("kind", "force")
        .text("name", row.name)
        .text("setting", row.setting)
        .text("unit", row.unit)
        .number("packets_per_s", row.packets_per_s)
        .number("octets_per_s", row.octets_per_s)
        .number("raw_packets_per_s", row.raw_packets_per_s)
        .number("share", row.share())
        .number("rms", error_of(row, row.error.rms))
        .number("p99", error_of(row, row.error.p99))
        .number("max", error_of(row, row.error.max))
        .number("for_force_per_s", row.for_force_per_s)
        .value("samples", row.samples)
        .value("outside", row.outside)
        .end("\n");
  }
  return out;
}

std::string force_csv(std::span<const ForceRow> rows) {
  std::string out =
      "name,setting,unit,packets_per_s,octets_per_s,raw_packets_per_s,share,rms,p99,max,"
      "for_force_per_s,samples,outside\n";
  for (const ForceRow& row : rows)
    fmt::format_to(tools::end_of(out), "\"{}\",\"{}\",{},{},{},{},{},{},{},{},{},{},{}\n", row.name,
                   row.setting, row.unit, row.packets_per_s, row.octets_per_s,
                   row.raw_packets_per_s, row.share(), csv_number(error_of(row, row.error.rms)),
                   csv_number(error_of(row, row.error.p99)),
                   csv_number(error_of(row, row.error.max)), row.for_force_per_s, row.samples,
                   row.outside);
  return out;
}

}  // namespace reckon::bench
