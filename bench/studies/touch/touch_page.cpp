// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

#include "reckon/bench/plots/html_page.hpp"
#include "reckon/bench/plots/log_axis.hpp"
#include "reckon/bench/plots/sortable_page.hpp"
#include "reckon/bench/studies/pose/study_text.hpp"
#include "reckon/bench/studies/touch/touch_report.hpp"
#include "reckon/tools/plots/svg_elements.hpp"

namespace reckon::bench {
namespace {

// Of the picture and of the area inside the axes.
constexpr double kWidth = 760, kHeight = 470;
constexpr double kLeft = 84, kRight = 740, kTop = 40, kBottom = 400;
constexpr double kLeastShown = 1e-6;  // [N]: what is below lies on the axis

/// A shape in a square of 12 about the origin and a colour, by the place of the axis in its list.
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
    "<style>.l{stroke:#59636e;stroke-dasharray:5 4}.dot{stroke:#fff;stroke-width:.8}"
    ".dot.d{opacity:.28}@media(prefers-color-scheme:dark){.dot{stroke:#0d1117}}</style>\n";

struct Axes {
  LogAxis time, error;
};

Axes axes_of(std::span<const TouchResult> results) {
  // The lines of 1 ms and of the least force that is felt are always in the picture.
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

/// What a servo step may take, and what is felt.
void append_limits(std::string& out, const Axes& axes) {
  const double limit = axes.time.at(kServoBudget), felt = axes.error.at(kLeastFelt);
  tools::append_svg_line(out, "l", limit, kTop, limit, kBottom);
  tools::append_svg_text(out, limit - 5, kTop + 14, " text-anchor=\"end\"", "1 ms, a servo step");
  tools::append_svg_line(out, "l", kLeft, felt, kRight, felt);
  tools::append_svg_text(out, std::min(limit, kRight) - 12, felt - 5, " text-anchor=\"end\"",
                         "50 mN, the least force that is felt");
}

void append_marks(std::string& out, const TouchResult& result, const Axes& axes) {
  const Mark& mark = mark_of(result.axis);
  for (const TouchRow& row : result.rows) {
    if (!(row.cost.median > 0)) continue;
    out += fmt::format(
        "<path class=\"dot{}\" transform=\"translate({:.1f} {:.1f})\" fill=\"{}\" "
        "d=\"{}\"><title>{}: "
        "{}, {} ns, p99 {} mN{}</title></path>\n",
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

void append_row(std::string& out, const TouchResult& result, const TouchRow& row) {
  out += fmt::format("<tr{}><td class=\"w\">{}</td>", row.beaten ? " class=\"d\"" : "",
                     html_escaped(row.setting));
  for (const double error : {row.error.rms, row.error.p99, row.error.max})
    out += page_cell(error, number_text(1e3 * error));
  out += page_cell(row.error.noticed, fmt::format("{:.1f} %", 100 * row.error.noticed));
  for (const double ns : {row.cost.median, row.cost.low, row.cost.high})
    out += page_cell(ns, ns > 0 ? number_text(ns) : "-");
  out += fmt::format("<td class=\"w\">{}</td></tr>\n",
                     row.beaten ? html_escaped(result.rows[row.beaten->by].setting) : "");
}

void append_result(std::string& out, const TouchResult& result) {
  out += fmt::format(
      "<section id=\"{0}\">\n<h2>{0}: {1}</h2>\n<p>Truth: {2}.</p>\n<p class=\"note\">{3}</p>\n{4}"
      "<div class=\"wide\"><table>\n<thead><tr><th class=\"w\">setting</th><th>RMS "
      "[mN]</th><th>99 % [mN]</th><th>max [mN]</th><th>felt</th><th>ns</th><th>10 "
      "%</th><th>90 %</th><th class=\"w\">dominated by</th></tr></thead>\n<tbody>\n",
      result.axis, html_escaped(result.meaning), html_escaped(result.truth),
      html_escaped(result.remark), touch_svg({&result, 1}));
  for (const TouchRow& row : result.rows) append_row(out, result, row);
  out += "</tbody></table></div>\n</section>\n";
}

}  // namespace

std::string touch_svg(std::span<const TouchResult> results) {
  const Axes axes = axes_of(results);
  std::string inside(kStyle);
  tools::append_svg_text(inside, kLeft, 24, " class=\"t\"",
                         results.size() == 1 ? results.front().meaning
                                             : "What accuracy of a force costs in the servo");
  append_log_grid(inside, {axes.time, "time for one millisecond of touch", time_tick},
                  {axes.error, "error of the force, 99 % below", force_tick});
  append_limits(inside, axes);
  for (const TouchResult& result : results) append_marks(inside, result, axes);
  append_legend(inside, results);
  return tools::svg_picture(inside, kWidth, kHeight);
}

std::string touch_page(const TouchReport& report) {
  std::string out = fmt::format(
      "<p>What a servo step computes, how far the force is "
      "from the truth of each axis, and what it takes.</p>\n<dl>\n<dt>command</dt><dd><code>{}"
      "</code></dd>\n<dt>ns</dt><dd>{}; one millisecond of touch, a servo step at 1 kHz; median of "
      "blocks that took turns</dd>\n<dt>felt</dt><dd>share of the time with an error above 10 % of "
      "the force and 50 mN</dd>\n</dl>\n<p class=\"note\">In full colour: no other setting of the "
      "axis takes no more time and errs no more. Errors below 1 uN lie on the axis.</p>\n{}",
      html_escaped(report.command), html_escaped(report.processor), touch_svg(report.results));
  for (const TouchResult& result : report.results) append_result(out, result);
  out += "<h2>left out</h2>\n<dl>\n";
  for (const LeftOutAxis& axis : left_out_axes())
    out += fmt::format("<dt>{}</dt><dd>{}</dd>\n", html_escaped(axis.name), html_escaped(axis.why));
  return sortable_page("Touch: accuracy against time", "", out + "</dl>\n");
}

}  // namespace reckon::bench
