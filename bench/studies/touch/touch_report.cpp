// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/touch/touch_report.hpp"

#include <fmt/format.h>

#include <iterator>

#include "reckon/bench/studies/accuracy/text.hpp"
#include "reckon/bench/studies/pose/study_text.hpp"
#include "reckon/tools/terminal/json_text.hpp"
#include "reckon/tools/terminal/text_table.hpp"

namespace reckon::bench {
namespace {

constexpr std::string_view kLegend =
    "Errors in mN against the truth of the axis. FELT: share of the time with an error that a "
    "person may notice, above 10 % of the force and 50 mN; ! above 1 %. NS: one millisecond of "
    "touch, a servo step at 1 kHz; median of blocks that took turns, then 10 and 90 % of them. OF "
    "1 "
    "ms: share of the servo's time. <: another row of the axis takes no more time and errs no "
    "more; "
    "=: the same as another.";

/// Down to 1 uN, below which rows are not told apart.
std::string millinewtons(double newtons) {
  return newtons == 0 ? "0" : newtons < 1e-6 ? "<0.001" : number_text(1e3 * newtons);
}

/// Short also where a block was interrupted.
std::string time_text(double ns) {
  return ns < 9999.5 ? number_text(ns) : fmt::format("{:.0f}us", 1e-3 * ns);
}

std::string mark_of(const TouchRow& row) {
  return !row.beaten ? "" : row.beaten->equal ? "=" : "<";
}

std::string axis_text(const TouchResult& result) {
  constexpr auto kRight = tools::TextTable::Align::right;
  tools::TextTable table({{"SETTING"},
                          {"RMS", kRight},
                          {"P99", kRight},
                          {"MAX", kRight},
                          {"FELT", kRight},
                          {"NS", kRight},
                          {"10 % TO 90 %", kRight},
                          {"OF 1 ms", kRight},
                          {""}});
  for (const TouchRow& row : result.rows) {
    const TouchCost& cost = row.cost;
    const bool timed = cost.median > 0;
    table.add({row.setting, millinewtons(row.error.rms), millinewtons(row.error.p99),
               millinewtons(row.error.max),
               fmt::format("{:.1f} %{}", 100 * row.error.noticed, row.is_felt() ? " !" : ""),
               timed ? time_text(cost.median) : "-",
               cost.low > 0 ? time_text(cost.low) + " to " + time_text(cost.high) : "-",
               timed ? fmt::format("{:.1g} %", 100 * cost.median / kServoBudget) : "-",
               mark_of(row)});
  }
  std::string text = fmt::format("{}: {}\n", result.axis, result.meaning);
  text += wrapped("Truth: " + result.truth + ".", kColumns) + '\n';
  if (result.largest > 0) text += fmt::format("Up to {} N.\n", number_text(result.largest));
  return text + table.text() + wrapped(result.remark, kColumns) + "\n\n";
}

}  // namespace

std::string touch_text(const TouchReport& report) {
  std::string text;
  for (const TouchResult& result : report.results) text += axis_text(result);
  text += wrapped(kLegend, kColumns) + '\n';
  for (const LeftOutAxis& axis : left_out_axes())
    text += wrapped(fmt::format("Left out: {}: {}.", axis.name, axis.why), kColumns) + '\n';
  return text + fmt::format("seed {}; {}\n", report.seed, report.processor);
}

std::string touch_json(const TouchReport& report) {
  std::string text;
  tools::JsonObject(text)
      .text("kind", "touch_study")
      .text("command", report.command)
      .text("processor", report.processor)
      .value("seed", report.seed)
      .value("budget_ns", kServoBudget)
      .value("least_felt_n", kLeastFelt)
      .value("weber", kWeberShare)
      .end("\n");
  for (const TouchResult& result : report.results) {
    tools::JsonObject(text)
        .text("kind", "touch_axis")
        .text("axis", result.axis)
        .text("meaning", result.meaning)
        .text("truth", result.truth)
        .text("remark", result.remark)
        .value("largest_n", result.largest)
        .end("\n");
    for (const TouchRow& row : result.rows) {
      tools::JsonObject object(text);
      object.text("kind", "touch")
          .text("axis", result.axis)
          .text("setting", row.setting)
          .value("error_rms_n", row.error.rms)
          .value("error_p99_n", row.error.p99)
          .value("error_max_n", row.error.max)
          .value("noticed", row.error.noticed)
          .value("felt", row.is_felt())
          .value("step_ns", row.cost.median)
          .value("step_p10_ns", row.cost.low)
          .value("step_p90_ns", row.cost.high)
          .value("front", !row.beaten);
      if (row.beaten) object.text("beaten_by", result.rows[row.beaten->by].setting);
      object.end("\n");
    }
  }
  for (const LeftOutAxis& axis : left_out_axes())
    tools::JsonObject(text)
        .text("kind", "touch_left_out")
        .text("axis", axis.name)
        .text("why", axis.why)
        .end("\n");
  return text;
}

std::string touch_csv(const TouchReport& report) {
  std::string text =
      "axis,setting,error_rms_n,error_p99_n,error_max_n,noticed,felt,step_ns,step_p10_ns,"
      "step_p90_ns,front\n";
  for (const TouchResult& result : report.results) {
    for (const TouchRow& row : result.rows)
      fmt::format_to(std::back_inserter(text), "{},\"{}\",{},{},{},{},{:d},{},{},{},{:d}\n",
                     result.axis, row.setting, row.error.rms, row.error.p99, row.error.max,
                     row.error.noticed, row.is_felt(), row.cost.median, row.cost.low, row.cost.high,
                     !row.beaten);
  }
  return text;
}

}  // namespace reckon::bench
