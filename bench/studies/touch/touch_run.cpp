// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Output of the study of touch: tables, JSON Lines, CSV, a picture and a page.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

#include "reckon/bench/plots/html_page.hpp"
#include "reckon/bench/plots/log_axis.hpp"
#include "reckon/bench/plots/log_plot.hpp"
#include "reckon/bench/plots/sortable_page.hpp"
#include "reckon/bench/studies/frame/fields.hpp"
#include "reckon/bench/studies/frame/study_watch.hpp"
#include "reckon/bench/studies/frame/text_lines.hpp"
#include "reckon/bench/studies/pose/study_text.hpp"
#include "reckon/bench/studies/sweep/values.hpp"
#include "reckon/bench/studies/touch/touch_study.hpp"
#include "reckon/tools/plots/svg_elements.hpp"

namespace reckon::bench {
namespace {

constexpr std::string_view kLegend =
    "Errors in mN against the truth of the axis. FELT: share of the time with an error that a "
    "person may notice, above 10 % of the force and 50 mN; ! above 1 %. NS: one millisecond of "
    "touch, a servo step at 1 kHz; median of interleaved blocks, then their 10 and 90 % quantiles. "
    "OF 1 ms: share of the servo's time. OF FORCE: RMS of the error over RMS of the true force, "
    "median of the seeds; WORST: greatest of the seeds. <: another row of the axis is no slower "
    "and no less accurate; =: equal to another.";

// Sizes of the picture and of the area inside the axes.
constexpr double kWidth = 760, kHeight = 470;
constexpr double kLeft = 84, kRight = 740, kTop = 40, kBottom = 400;
constexpr double kLeastShown = 1e-6;  // [N]: smaller values are drawn on the axis
constexpr double kLeastShare = 1e-4;  // of the force: smaller errors are drawn here

/// A shape in a square of 12 around the origin and a colour, by the index of the axis in its list.
struct Mark {
  std::string_view shape, colour;
};
constexpr std::array kMarks{
    Mark{"M-5 0A5 5 0 1 0 5 0A5 5 0 1 0-5 0Z", "#d55e00"},
    Mark{"M-4.5-4.5H4.5V4.5H-4.5Z", "#0072b2"},
    Mark{"M0-6L5.5 4.5H-5.5Z", "#009e73"},
    Mark{"M0 6L5.5-4.5H-5.5Z", "#cc79a7"},
    Mark{"M0-6.5L6 0L0 6.5L-6 0Z", "#8c8c8c"},
    Mark{"M-2-6H2V-2H6V2H2V6H-2V2H-6V-2H-2Z", "#b8860b"},
};

const Mark& mark_of(std::string_view axis) {
  const auto axes = touch_axes();
  const auto place = std::ranges::find(axes, axis, &TouchAxis::name) - axes.begin();
  return kMarks[static_cast<std::size_t>(place) % kMarks.size()];
}

constexpr std::string_view kStyle =
    "<style>.l{stroke:#59636e;stroke-dasharray:5 "
    "4}.dot{stroke:#fff;stroke-width:.8}.dot.d{opacity:.28}@media(prefers-color-scheme:dark){.dot{"
    "stroke:#0d1117}}</style>\n";

/// All inputs and results.
struct TouchReport {
  std::string command;    ///< as typed
  std::string processor;  ///< that the times were measured on
  TouchConditions conditions;
  std::vector<TouchResult> results;
};

/// [mN]; rows with errors of less than 1 uN have the same text.
std::string millinewtons(double newtons) {
  return newtons == 0 ? "0" : newtons < 1e-6 ? "<0.001" : number_text(1e3 * newtons);
}

/// Short also if a block was interrupted.
std::string time_text(double ns) {
  return ns < 9999.5 ? number_text(ns) : fmt::format("{:.0f}us", 1e-3 * ns);
}

std::string percent(double share) {
  if (share > 0 && share < kLeastShare) return fmt::format("<{:g} %", 100 * kLeastShare);
  return fmt::format("{:.2g} %", 100 * share);
}

bool is_delayed(const TouchResult& result) {
  return !result.rows.empty() && result.rows.front().delayed;
}

/// All rows of all axes, each with its axis.
struct AxisRow {
  const TouchResult* axis = nullptr;
  TouchRow row;
};
std::vector<AxisRow> rows_of(std::span<const TouchResult> results) {
  std::vector<AxisRow> rows;
  for (const TouchResult& result : results)
    for (const TouchRow& row : result.rows) rows.push_back({&result, row});
  return rows;
}

/// @param over_network the table has the error as a share of the force; else details of the time
Fields row_fields(const AxisRow& of, bool over_network) {
  const auto& [axis, row] = of;
  const TouchCost& cost = row.cost;
  const bool timed = cost.median > 0;
  const std::string noticed = fmt::format("{:.1f} %", 100 * row.error.noticed);
  Fields fields("touch");
  fields.value("axis", axis == nullptr ? "" : axis->axis)
      .value("setting", Value::quoted(row.setting))
      .value("delay_s", row.delayed ? std::optional(row.delayed->delay) : std::nullopt)
      .word("SETTING", row.setting)
      .page_word("setting", html_escaped(row.setting));
  const auto error = [&](std::string_view name, std::string title, std::string_view page_title,
                         double value) {
    fields.value(name, value).cell(std::move(title), millinewtons(value));
    fields.page(page_title, value, number_text(1e3 * value));
  };
  error("error_rms_n", "RMS", "RMS [mN]", row.error.rms);
  error("error_p99_n", "P99", "99 % [mN]", row.error.p99);
  error("error_max_n", "MAX", "max [mN]", row.error.max);
  const auto share = [&](std::string_view name, std::string title, std::string_view page_title,
                         double value) {
    fields.value(name, value).page(page_title, value, html_escaped(percent(value)));
    if (over_network) fields.cell(std::move(title), percent(value));
  };
  share("error_share", "OF FORCE", "of force", row.error.share);
  share("error_share_worst", "WORST", "worst", row.worst);
  fields.value("noticed", row.error.noticed)
      .value("felt", row.is_felt())
      .cell("FELT", noticed + (row.is_felt() ? " !" : ""))
      .page("felt", row.error.noticed, noticed)
      .cell("NS", timed ? time_text(cost.median) : "-");
  if (!over_network)
    fields
        .cell("10 % TO 90 %",
              cost.low > 0 ? time_text(cost.low) + " to " + time_text(cost.high) : "-")
        .cell("OF 1 ms", timed ? fmt::format("{:.1g} %", 100 * cost.median / kServoBudget) : "-");
  const auto time = [&](std::string_view name, std::string_view page_title, double ns) {
    fields.value(name, ns).page(page_title, ns, ns > 0 ? number_text(ns) : "-");
  };
  time("step_ns", "ns", cost.median);
  time("step_p10_ns", "10 %", cost.low);
  time("step_p90_ns", "90 %", cost.high);
  fields.value("front", !row.beaten);
  const std::string by = row.beaten ? axis->rows[row.beaten->by].setting : "";
  if (row.beaten) fields.json("beaten_by", by);
  return fields.word("", beaten_mark(row.beaten)).page_word("dominated by", html_escaped(by));
}

Fields axis_row_fields(const AxisRow& of) { return row_fields(of, false); }

std::string axis_text(const TouchResult& result) {
  std::string text = fmt::format("{}: {}\n", result.axis, result.meaning);
  text += wrapped("Truth: " + result.truth + ".", kTextColumns) + '\n';
  if (result.largest > 0) text += fmt::format("Up to {} N.\n", number_text(result.largest));
  const bool over_network = is_delayed(result);
  const auto fields_of = [&](const AxisRow& row) { return row_fields(row, over_network); };
  return text + table_of(rows_of({&result, 1}), fields_of) + wrapped(result.remark, kTextColumns) +
         "\n\n";
}

std::string touch_text(const TouchReport& report) {
  std::string text;
  for (const TouchResult& result : report.results) text += axis_text(result);
  text += wrapped(kLegend, kTextColumns) + '\n';
  for (const LeftOutAxis& axis : left_out_axes())
    text += wrapped(fmt::format("Left out: {}: {}.", axis.name, axis.why), kTextColumns) + '\n';
  return text + fmt::format("seed {}, {} seed{}, loss {}; {}\n", report.conditions.seed,
                            report.conditions.seeds, report.conditions.seeds == 1 ? "" : "s",
                            percent(report.conditions.loss), report.processor);
}

std::string touch_json(const TouchReport& report) {
  std::string text = Fields("touch_study")
                         .json("command", report.command)
                         .json("processor", report.processor)
                         .json("seed", report.conditions.seed)
                         .json("seeds", report.conditions.seeds)
                         .json("loss", report.conditions.loss)
                         .json("budget_ns", kServoBudget)
                         .json("least_felt_n", kLeastFelt)
                         .json("weber", kWeberShare)
                         .line();
  for (const TouchResult& result : report.results)
    text += Fields("touch_axis")
                .json("axis", result.axis)
                .json("meaning", result.meaning)
                .json("truth", result.truth)
                .json("remark", result.remark)
                .json("largest_n", result.largest)
                .line() +
            json_of(rows_of({&result, 1}), axis_row_fields);
  return text + json_of(left_out_axes(), [](const LeftOutAxis& axis) {
           return Fields("touch_left_out").json("axis", axis.name).json("why", axis.why);
         });
}

struct Axes {
  LogAxis time, error;
};

Axes axes_of(std::span<const TouchResult> results) {
  // The lines of 1 ms and of the least force that people feel are always in the picture.
  std::vector<double> times{kServoBudget}, errors{kLeastFelt};
  for (const TouchResult& result : results) {
    for (const TouchRow& row : result.rows) {
      if (!(row.cost.median > 0)) continue;
      times.push_back(row.cost.median);
      errors.push_back(row.error.p99);
    }
  }
  return {log_axis_over(times, 0.1, kLeft, kRight, 1),
          log_axis_over(errors, kLeastShown, kBottom, kTop, 1)};
}

std::string time_tick(double ns) {
  if (ns < 1e3) return number_text(ns) + " ns";
  return ns < 1e6 ? number_text(1e-3 * ns) + " us" : number_text(1e-6 * ns) + " ms";
}

std::string force_tick(double newtons) {
  if (newtons < 1e-3) return number_text(1e6 * newtons) + " uN";
  return newtons < 1 ? number_text(1e3 * newtons) + " mN" : number_text(newtons) + " N";
}

/// Lines for the time budget of a servo step and for the least force that people feel.
void append_limits(std::string& out, const Axes& axes) {
  const double limit = axes.time.at(kServoBudget), felt = axes.error.at(kLeastFelt);
  tools::append_svg_line(out, "l", limit, kTop, limit, kBottom);
  tools::append_svg_text(out, limit - 5, kTop + 14, " text-anchor=\"end\"", "1 ms, a servo step");
  tools::append_svg_line(out, "l", kLeft, felt, kRight, felt);
  tools::append_svg_text(out, std::min(limit, kRight) - 12, felt - 5, " text-anchor=\"end\"",
                         "50 mN, the least noticeable force");
}

void append_marks(std::string& out, const TouchResult& result, const Axes& axes) {
  const Mark& mark = mark_of(result.axis);
  for (const TouchRow& row : result.rows) {
    if (!(row.cost.median > 0)) continue;
    out += fmt::format(
        "<path class=\"dot{}\" transform=\"translate({:.1f} {:.1f})\" fill=\"{}\" "
        "d=\"{}\"><title>{}: {}, {} ns, p99 {} mN{}</title></path>\n",
        row.beaten ? " d" : "", axes.time.at(row.cost.median), axes.error.at(row.error.p99),
        mark.colour, mark.shape, result.axis, html_escaped(row.setting),
        number_text(row.cost.median), number_text(1e3 * row.error.p99),
        row.beaten ? ", dominated" : "");
  }
}

void append_legend(std::string& out, std::span<const TouchResult> results) {
  double x = kLeft;
  for (const TouchResult& result : results) {
    const Mark& mark = mark_of(result.axis);
    out += fmt::format(
        "<path transform=\"translate({:g} {:g})\" fill=\"{}\" d=\"{}\"/><text x=\"{:g}\" "
        "y=\"{:g}\">{}</text>\n",
        x + 6, kHeight - 12, mark.colour, mark.shape, x + 17, kHeight - 8, result.axis);
    x += 30 + 8.0 * static_cast<double>(result.axis.size());
  }
}

/// Index of a word in a list of distinct words; appends a new one.
std::size_t index_in(std::vector<std::string_view>& words, std::string_view word) {
  const auto found = std::ranges::find(words, word);
  if (found == words.end()) words.push_back(word);
  return static_cast<std::size_t>(std::ranges::find(words, word) - words.begin());
}

/// The error against the delay: a colour for each rule, a line style for each touch.
std::string delay_svg(const TouchResult& result) {
  LogPlot plot{"Force error: " + result.meaning,
               "",
               "delay of the network, one way [ms]",
               "error of the forces [% of the true force]",
               {},
               {}};
  std::vector<std::string_view> rules, touches;
  for (const TouchRow& row : result.rows) {
    const std::size_t rule = index_in(rules, row.delayed->rule);
    const std::size_t touch = index_in(touches, row.delayed->touch);
    if (rule == plot.curves.size()) plot.curves.push_back({std::string(row.delayed->rule), {}});
    plot.curves[rule].points.push_back(
        {1e3 * row.delayed->delay, 100 * std::max(row.error.share, kLeastShare),
         fmt::format("{}: {}, worst {}", row.setting, percent(row.error.share), percent(row.worst)),
         touch});
  }
  for (std::size_t i = 0; i < touches.size(); ++i)
    plot.note += fmt::format("{}: {}; ", touches[i], LogPlot::dash_name(i));
  plot.note +=
      fmt::format("below {}: on the line of {}", percent(kLeastShare), percent(kLeastShare));
  return log_plot_svg(plot);
}

/// An axis over a network is drawn only if it is the only one.
std::string touch_svg(std::span<const TouchResult> all) {
  if (all.size() == 1 && is_delayed(all.front())) return delay_svg(all.front());
  std::vector<TouchResult> results(all.begin(), all.end());
  std::erase_if(results, is_delayed);
  const Axes axes = axes_of(results);
  std::string inside(kStyle);
  tools::append_svg_text(
      inside, kLeft, 24, " class=\"t\"",
      results.size() == 1 ? results.front().meaning : "Cost of force accuracy in the servo");
  append_log_grid(inside, {axes.time, "time for one millisecond of touch", time_tick},
                  {axes.error, "error of the force, 99 % below", force_tick});
  append_limits(inside, axes);
  for (const TouchResult& result : results) append_marks(inside, result, axes);
  append_legend(inside, results);
  return tools::svg_picture(inside, kWidth, kHeight);
}

/// Names the axis that touch_svg() leaves out; else empty.
std::string plot_note(std::span<const TouchResult> results) {
  const auto axis = std::ranges::find_if(results, is_delayed);
  if (results.size() == 1 || axis == results.end()) return {};
  return fmt::format("--plot leaves out the axis {0}: plot it alone, with --axis {0}\n",
                     axis->axis);
}

void append_result(std::string& out, const TouchResult& result) {
  out += fmt::format(
      "<section id=\"{0}\">\n<h2>{0}: {1}</h2>\n<p>Truth: {2}.</p>\n<p "
      "class=\"note\">{3}</p>\n{4}{5}</section>\n",
      result.axis, html_escaped(result.meaning), html_escaped(result.truth),
      html_escaped(result.remark), touch_svg({&result, 1}),
      page_table_of(rows_of({&result, 1}), axis_row_fields,
                    [](const AxisRow& of) { return of.row.beaten.has_value(); }));
}

std::string touch_page(const TouchReport& report) {
  std::string out = fmt::format(
      "<p>Servo step, error of its force against the truth of each axis, and its "
      "duration.</p>\n<dl>\n<dt>command</dt><dd><code>{}</code></dd>\n<dt>ns</dt><dd>{}; one "
      "millisecond of touch, a servo step at 1 kHz; median of interleaved "
      "blocks</dd>\n<dt>felt</dt><dd>share of the time with an error above 10 % of the force and "
      "50 mN</dd>\n</dl>\n<p class=\"note\">In full colour: no other setting of the axis is as "
      "fast and as accurate. Errors below 1 uN lie on the axis.</p>\n{}",
      html_escaped(report.command), html_escaped(report.processor), touch_svg(report.results));
  for (const TouchResult& result : report.results) append_result(out, result);
  out += "<h2>left out</h2>\n<dl>\n";
  for (const LeftOutAxis& axis : left_out_axes())
    out += fmt::format("<dt>{}</dt><dd>{}</dd>\n", html_escaped(axis.name), html_escaped(axis.why));
  return sortable_page("Touch: accuracy against time", "", out + "</dl>\n");
}

const TouchAxis& axis_named(std::string_view name) {
  for (const LeftOutAxis& axis : left_out_axes())
    if (axis.name == name)
      throw tools::UsageError(fmt::format("--axis: {} is left out: {}", axis.name, axis.why));
  return row_named(name, touch_axes(), "--axis");
}

/// Each once, in the order of the list.
std::vector<const TouchAxis*> axes_asked(const std::vector<std::string>& words) {
  std::vector<const TouchAxis*> asked, axes;
  for (const std::string& word : words)
    for (const std::string_view name : parts_between_commas(word))
      if (!name.empty()) asked.push_back(&axis_named(name));
  for (const TouchAxis& axis : touch_axes())
    if (asked.empty() || std::ranges::count(asked, &axis) > 0) axes.push_back(&axis);
  return axes;
}

}  // namespace

StudyOutput run_touch_study(const std::vector<std::string>& words, TouchConditions conditions,
                            bool json, const StudyCall& call) {
  const tools::Console& console = call.console;
  const auto axes = axes_asked(words);
  if ((conditions.delay || conditions.loss > 0) &&
      std::ranges::none_of(axes, [](const TouchAxis* axis) { return axis->has_network; }))
    throw tools::UsageError("--delay, --loss: no axis of this run uses them; add --axis owner");
  conditions.go_on = [&] { return !console.stopped(); };
  TouchReport report{call.command, processor_name(), conditions, {}};
  StudyWatch watch(console);
  for (const TouchAxis* axis : axes) {
    if (!watch.of("axes", axis->name)(report.results.size(), axes.size())) break;
    report.results.push_back(run_touch_axis(*axis, conditions, true));
  }
  if (console.stopped())
    fmt::print(console.err, "stopped after {} of {} axes; the last one may lack settings\n",
               report.results.size(), axes.size());
  return {json ? touch_json(report) : touch_text(report),
          csv_of(rows_of(report.results), axis_row_fields), touch_svg(report.results),
          touch_page(report),
          std::ranges::count(call.given, "--plot") > 0 ? plot_note(report.results) : ""};
}

}  // namespace reckon::bench
