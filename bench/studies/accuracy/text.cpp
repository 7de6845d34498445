// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/accuracy/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <tuple>
#include <utility>

#include "reckon/bench/studies/contact/contact_report.hpp"
#include "reckon/bench/studies/frame/fields.hpp"
#include "reckon/bench/studies/frame/text_lines.hpp"
#include "reckon/bench/studies/pose/study_text.hpp"
#include "reckon/pdu/seconds.hpp"
#include "reckon/tools/terminal/text_table.hpp"

namespace reckon::bench {
namespace {

std::string_view curve_name(deadreckon::ConvergenceCurve curve) {
  return deadreckon::kConvergenceCurves[static_cast<std::size_t>(curve)].name;
}

/// At most three characters, also on a slow machine.
std::string nanoseconds_text(double ns) {
  if (!(ns > 0)) return "-";
  return ns < 999.5 ? fmt::format("{:.0f}", ns) : fmt::format("{:.0f}us", ns / 1000);
}

/// The line above a table: the subject and the settings.
std::string heading_of(const AccuracyResult& result) {
  const std::string colon = result.meaning.empty() ? "" : ": ";
  return wrapped(result.subject + colon + result.meaning, kTextColumns) +
         fmt::format(
             "\n{}, {} samples; the true velocity steps by up to {} m/s from sample to sample\n"
             "front: {} of {}; {} dominated\n",
             tools::counted(result.entities, "track"), result.samples,
             number_text(result.own_velocity_step), result.on_front(),
             tools::counted(result.rows.size(), "setting"), result.rows.size() - result.on_front());
}

void add_size(Fields& fields, std::string_view what, std::string_view unit, const ErrorSize& size) {
  Fields sizes;
  for (const auto& [name, value] :
       {std::pair{"rms", size.rms}, std::pair{"p99", size.p99}, std::pair{"max", size.max}}) {
    sizes.json(name, value);
    fields.csv(fmt::format("{}_{}_{}", what, name, unit), value);
  }
  fields.json(fmt::format("{}_{}", what, unit), sizes);
}

void add_result(Fields& fields, const PoseResult& result) {
  fields.value("updates", result.updates)
      .value("updates_per_s", result.updates_per_second())
      .value("octets_per_s", kUpdateOctets * result.updates_per_second());
  add_size(fields, "position", "m", result.position);
  add_size(fields, "angle", "rad", result.angle);
  add_size(fields, "velocity_step", "mps", result.velocity_step);
}

/// A setting with the names that its row refers to.
struct NamedRow {
  std::string_view subject;
  AccuracyRow row;
  std::string beaten_by;
};

std::vector<NamedRow> named_rows(const AccuracyResult& result, bool front_only) {
  std::vector<NamedRow> rows;
  for (const std::size_t i : rows_in_order(result, front_only)) {
    const AccuracyRow& row = result.rows[i];
    rows.push_back(
        {result.subject, row, row.beaten ? setting_text(result.rows[row.beaten->by]) : ""});
  }
  return rows;
}

void add_cells(Fields& fields, const NamedRow& of) {
  const AccuracyRow& row = of.row;
  const PoseResult& r = row.result;
  const auto shown = [&](std::string title, std::string_view page_title, double value,
                         std::string (*text)(double)) {
    fields.shown(std::move(title), page_title, value, text(value));
  };
  fields.shown_word("MODEL", "model", std::string(row.model.name))
      .shown_word("CURVE", "curve", std::string(curve_name(row.curve)));
  shown("SEND AT", "threshold", row.threshold, length_text);
  shown("UPD/S", "updates/s", r.updates_per_second(), number_text);
  shown("OCT/S", "octets/s", row.octets_per_second(), number_text);
  shown("RMS", "RMS", r.position.rms, length_text);
  shown("P99", "99 %", r.position.p99, length_text);
  shown("MAX", "max", r.position.max, length_text);
  fields.shown("ANGLE", "angle 99 % [deg]", r.angle.p99, number_text(degrees(r.angle.p99)));
  shown("STEP", "velocity step [m/s]", r.velocity_step.max, number_text);
  fields.cell("NS", nanoseconds_text(row.query_ns))
      .page("ns", row.query_ns, row.query_ns > 0 ? fmt::format("{:.0f}", row.query_ns) : "")
      .word("", beaten_mark(row.beaten))
      .page_word("dominated by",
                 (row.beaten && row.beaten->equal ? "same as " : "") + of.beaten_by);
}

Fields setting_fields(const NamedRow& of) {
  const AccuracyRow& row = of.row;
  Fields fields("setting");
  fields.value("subject", Value::quoted(of.subject))
      .value("model", row.model.name)
      .value("curve", curve_name(row.curve))
      .value("threshold_m", row.threshold);
  add_result(fields, row.result);
  const auto query = row.query_ns > 0 ? std::optional(row.query_ns) : std::nullopt;
  fields.value("query_ns", Value::decimals(query, 1))
      .value("front", !row.beaten)
      .csv("beaten_by", Value::quoted(of.beaten_by));
  if (row.beaten) fields.json("beaten_by", of.beaten_by).json("equal", row.beaten->equal);
  add_cells(fields, of);
  return fields;
}

/// No value if `value` is `none` or above.
std::optional<double> below(double value, double none) {
  return value < none ? std::optional(value) : std::nullopt;
}

Fields study_fields(const AccuracyReport& report) {
  const AccuracyGrid& grid = report.grid;
  const peer::ImpairmentLaw& law = grid.network.law;
  return Fields("study")
      .json("command", report.command)
      .json("processor", report.processor)
      .json("angle_rad", below(grid.angle, kAnyAngle))
      .json("heartbeat_s", below(grid.heartbeat, kNoHeartbeat))
      .json("first_heartbeat_s",
            grid.first_heartbeat > 0 ? std::optional(grid.first_heartbeat) : std::nullopt)
      .json("converge_s", grid.convergence.duration)
      .json("converge_longest_s", grid.convergence.longest)
      .json("delay_s", pdu::to_seconds(law.delay))
      .json("jitter", peer::jitter_share(law))
      .json("loss", law.loss)
      .json("seed", grid.network.seed)
      .json("seeds", grid.seeds)
      .json("update_octets", kUpdateOctets);
}

Fields subject_fields(const AccuracyResult& result) {
  return Fields("subject")
      .json("subject", result.subject)
      .json("meaning", result.meaning)
      .json("tracks", result.entities)
      .json("samples", result.samples)
      .json("seconds", result.seconds)
      .json("angle_rad", below(result.angle, kAnyAngle))
      .json("own_velocity_step_mps", result.own_velocity_step)
      .json("settings", result.rows.size())
      .json("on_front", result.on_front());
}

Fields circle_fields(const CircleRow& row) {
  const PoseResult& r = row.result;
  Fields fields("circle");
  fields.json("model", row.model.name).json("curve", curve_name(row.curve));
  add_result(fields, r);
  fields.json("clears", row.clears())
      .word("MODEL", row.model.name)
      .word("CURVE", curve_name(row.curve))
      .cell("RMS", length_text(r.position.rms))
      .cell("P99", length_text(r.position.p99))
      .cell("MAX", length_text(r.position.max))
      .cell("ANGLE RMS", fmt::format("{} deg", number_text(degrees(r.angle.rms))))
      .cell("LARGEST STEP", fmt::format("{} m/s", number_text(r.velocity_step.max)))
      .word("BAR", row.clears() ? "cleared" : "missed");
  return fields;
}

Fields side_fields(const PoseModel& model, double threshold, const PoseResult& result) {
  Fields fields;
  fields.json("model", model.name).json("threshold_m", threshold);
  add_result(fields, result);
  return fields;
}

Fields equal_error_fields(const NamedEqualError& row) {
  const auto& [subject, found] = row;
  const bool is_found = found.threshold > 0;
  const std::optional<double> none;
  return Fields("equal_error")
      .json("subject", subject)
      .json("baseline",
            side_fields(found.baseline, found.baseline_threshold, found.baseline_result))
      .json("rival",
            is_found ? Value(side_fields(found.rival, found.threshold, found.result)) : Value(none))
      .json("saving", is_found ? Value(found.saving()) : Value(none));
}

}  // namespace

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
  std::string text = grid.angle < kAnyAngle ? fmt::format("also sent when off by {} degrees",
                                                          number_text(degrees(grid.angle)))
                                            : "orientation causes no updates";
  text += grid.heartbeat < kNoHeartbeat
              ? fmt::format(", and every {} s", number_text(grid.heartbeat))
              : ", no heartbeat";
  if (grid.first_heartbeat > 0)
    text += fmt::format("; repeated after {} ms, then after twice the time",
                        number_text(grid.first_heartbeat * 1e3));
  const auto is_curve = [](auto curve) { return curve != deadreckon::ConvergenceCurve::snap; };
  if (std::any_of(grid.curves.begin(), grid.curves.end(), is_curve))
    text += fmt::format(
        "; converges in {} ms, at most {} ms", number_text(grid.convergence.duration * 1e3),
        number_text(std::max(grid.convergence.duration, grid.convergence.longest) * 1e3));
  const std::uint64_t seed = grid.network.seed;
  text += fmt::format("; {}", network_text(grid.network.law));
  text += grid.seeds > 1 ? fmt::format("; medians of {} seeds from {}", grid.seeds, seed)
                         : fmt::format("; seed {}", seed);
  return text;
}

std::string accuracy_text(const AccuracyReport& report, bool front_only) {
  std::string text;
  if (!report.contacts.empty()) text = contact_text(report.contacts, report.grid.network);
  if (report.results.empty()) return text;
  if (!report.contacts.empty()) text += '\n';
  for (const AccuracyResult& result : report.results)
    text += heading_of(result) + table_of(named_rows(result, front_only), setting_fields) + '\n';
  return text + wrapped(conditions_text(report.grid), kTextColumns) +
         "\nOCT/S: 172 octets an update (Entity State, UDP, IPv4), one entity. ANGLE: p99 [deg]. "
         "STEP:\nlargest change of the drawn velocity between samples [m/s]. NS: one shown pose, "
         "measured.\n" +
         (front_only ? "Front: no setting is better in OCT/S, P99 and STEP together; --all shows "
                       "the rest.\n"
                     : "<: dominated in OCT/S, P99 and STEP; =: equal to another.\n");
}

std::string accuracy_csv(const AccuracyReport& report, bool front_only) {
  std::vector<NamedRow> all;
  for (const AccuracyResult& result : report.results)
    std::ranges::move(named_rows(result, front_only), std::back_inserter(all));
  return csv_of(all, setting_fields);
}

std::string accuracy_page_table(const AccuracyResult& result) {
  return page_table_of(named_rows(result, false), setting_fields,
                       [](const NamedRow& of) { return of.row.beaten.has_value(); });
}

std::string accuracy_json(const AccuracyReport& report, bool front_only) {
  std::string text = study_fields(report).line();
  for (const AccuracyResult& result : report.results)
    text += subject_fields(result).line() + json_of(named_rows(result, front_only), setting_fields);
  return text + contact_json(report.contacts, report.grid.network);
}

std::string circle_lines(std::span<const CircleRow> rows, bool json) {
  return lines_of(json, rows, circle_fields);
}

std::string equal_error_json(std::span<const NamedEqualError> rows) {
  return json_of(rows, equal_error_fields);
}

std::string equal_error_table(std::span<const NamedEqualError> rows) {
  struct Side {
    std::string_view of;
    PoseModel model;
    double threshold = 0;
    PoseResult result;
    std::string saving;
  };
  std::vector<Side> sides;
  std::string_view last;
  for (const auto& [subject, found] : rows) {
    if (subject != last)
      sides.push_back(
          {subject, found.baseline, found.baseline_threshold, found.baseline_result, ""});
    last = subject;
    sides.push_back({"", found.rival, found.threshold, found.result,
                     fmt::format("{:.1f} %", 100 * found.saving())});
  }
  return table_of(sides, [](const Side& side) {
    Fields fields;
    fields.word("OF", side.of)
        .word("MODEL", side.model.name)
        .cell("SEND AT", length_text(side.threshold))
        .cell("UPDATES", fmt::format("{}", side.result.updates))
        .cell("P99", length_text(side.result.position.p99))
        .cell("RMS", length_text(side.result.position.rms))
        .cell("MAX", length_text(side.result.position.max))
        .cell("SAVING", side.saving);
    if (!(side.threshold > 0)) fields.instead(2, "none");
    return fields;
  });
}

}  // namespace reckon::bench
