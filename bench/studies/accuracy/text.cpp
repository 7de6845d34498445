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
#include "reckon/pdu/seconds.hpp"
#include "reckon/tools/terminal/json_text.hpp"
#include "reckon/tools/terminal/text_table.hpp"

namespace reckon::bench {
namespace {

using tools::JsonObject;

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
  std::string out;
  JsonObject(out).value("rms", size.rms).value("p99", size.p99).value("max", size.max).end();
  return out;
}

JsonObject& add_result(JsonObject& object, const PoseResult& result) {
  return object.value("updates", result.updates)
      .value("updates_per_s", result.updates_per_second())
      .value("octets_per_s", kUpdateOctets * result.updates_per_second())
      .value("position_m", size_json(result.position))
      .value("angle_rad", size_json(result.angle))
      .value("velocity_step_mps", size_json(result.velocity_step));
}

/// Within quotes, quotes doubled (RFC 4180).
std::string csv_quoted(std::string_view text) {
  std::string out = "\"";
  for (const char letter : text) out += letter == '"' ? "\"\"" : std::string(1, letter);
  return out + '"';
}

/// Nothing where the value is that of no limit.
std::optional<double> below(double value, double none) {
  return value < none ? std::optional(value) : std::nullopt;
}

void append_study(std::string& out, const AccuracyReport& report) {
  const AccuracyGrid& grid = report.grid;
  const peer::ImpairmentLaw& law = grid.network.law;
  JsonObject object(out);
  object.text("kind", "study").text("command", report.command);
  if (report.processor.empty())
    object.value("processor", "null");
  else
    object.text("processor", report.processor);
  object.number("angle_rad", below(grid.angle, kAnyAngle))
      .number("heartbeat_s", below(grid.heartbeat, kNoHeartbeat))
      .number("first_heartbeat_s",
              grid.first_heartbeat > 0 ? std::optional(grid.first_heartbeat) : std::nullopt)
      .value("converge_s", grid.convergence.duration)
      .value("converge_longest_s", grid.convergence.longest)
      .value("delay_s", pdu::to_seconds(law.delay))
      .value("jitter", peer::jitter_share(law))
      .value("loss", law.loss)
      .value("seed", grid.network.seed)
      .value("seeds", grid.seeds)
      .value("update_octets", kUpdateOctets)
      .end("\n");
}

void append_subject(std::string& out, const AccuracyResult& result) {
  JsonObject(out)
      .text("kind", "subject")
      .text("subject", result.subject)
      .text("meaning", result.meaning)
      .value("tracks", result.entities)
      .value("samples", result.samples)
      .value("seconds", result.seconds)
      .number("angle_rad", below(result.angle, kAnyAngle))
      .value("own_velocity_step_mps", result.own_velocity_step)
      .value("settings", result.rows.size())
      .value("on_front", result.on_front())
      .end("\n");
}

void append_setting(std::string& out, const AccuracyResult& result, const AccuracyRow& row) {
  JsonObject object(out);
  object.text("kind", "setting")
      .text("subject", result.subject)
      .text("model", row.model.name)
      .text("curve", curve_name(row.curve))
      .value("threshold_m", row.threshold);
  add_result(object, row.result);
  if (row.query_ns > 0)
    object.decimals("query_ns", row.query_ns, 1);
  else
    object.value("query_ns", "null");
  object.value("front", !row.beaten);
  if (row.beaten)
    object.text("beaten_by", setting_text(result.rows[row.beaten->by]))
        .value("equal", row.beaten->equal);
  object.end("\n");
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
  const std::uint64_t seed = grid.network.seed;
  text += fmt::format("; {}", network_text(grid.network.law));
  text += grid.seeds > 1 ? fmt::format("; medians of {} seeds from {}", grid.seeds, seed)
                         : fmt::format("; seed {}", seed);
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
  std::string text;
  append_study(text, report);
  for (const AccuracyResult& result : report.results) {
    append_subject(text, result);
    for (const std::size_t i : rows_in_order(result, front_only))
      append_setting(text, result, result.rows[i]);
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
  std::string out;
  for (const CircleRow& row : rows) {
    JsonObject object(out);
    object.text("kind", "circle")
        .text("model", row.model.name)
        .text("curve", curve_name(row.curve));
    add_result(object, row.result).value("clears", row.clears()).end("\n");
  }
  return out;
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
  std::string out;
  const auto add = [](JsonObject& object, std::string_view key, const PoseModel& model,
                      double threshold, const PoseResult& result) {
    JsonObject inner(object.member(key));
    inner.text("model", model.name).value("threshold_m", threshold);
    add_result(inner, result).end();
  };
  for (const auto& [subject, found] : rows) {
    JsonObject object(out);
    object.text("kind", "equal_error").text("subject", subject);
    add(object, "baseline", found.baseline, found.baseline_threshold, found.baseline_result);
    if (found.threshold > 0) {
      add(object, "rival", found.rival, found.threshold, found.result);
      object.value("saving", found.saving());
    } else {
      object.value("rival", "null").value("saving", "null");
    }
    object.end("\n");
  }
  return out;
}

}  // namespace reckon::bench
