// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <optional>

#include "reckon/bench/plots/html_page.hpp"
#include "reckon/bench/studies/pose/study_text.hpp"
#include "reckon/bench/studies/stability/text.hpp"
#include "reckon/tools/terminal/text_end.hpp"
#include "reckon/tools/terminal/text_table.hpp"

namespace reckon::bench {
namespace {

// Size of a map [px].
constexpr int kCellWide = 44, kCellTall = 26, kLeft = 84, kTop = 8, kBelow = 40;

/// In steps of lightness, so that they are distinguishable without colours; letters do the same.
constexpr std::string_view kStyle = R"(
body{max-width:84rem}
.maps{display:flex;flex-wrap:wrap;gap:.6rem 1.2rem;align-items:flex-end}
figure{margin:.6rem 0}figcaption{font-size:13px;margin-bottom:.2rem}
.map text{font:11px system-ui,sans-serif;fill:var(--soft)}
.map rect{stroke:#fff;stroke-width:1}
.map text.c{font-size:12px;fill:#000;text-anchor:middle;pointer-events:none}
.v0{fill:#e9eef5}.v1{fill:#f0e442}.v2{fill:#e69f00}.v3{fill:#d55e00}.v4{fill:#000}
.map text.c.v4{fill:#fff}.map text.c.n4,.map text.c.n5{fill:#fff}
.n0{fill:#ffffd9}.n1{fill:#c7e9b4}.n2{fill:#7fcdbb}.n3{fill:#41b6c4}.n4{fill:#225ea8}.n5{fill:#081d58}
.legend{margin:.6rem 0}.legend span{display:inline-block;margin-right:1.2rem;white-space:nowrap}
.legend svg{vertical-align:-5px;margin-right:.3rem}
.legend .c{fill:#000;font:12px system-ui,sans-serif;text-anchor:middle}.legend .c.v4{fill:#fff}
.show{position:sticky;top:0;background:var(--page);padding:.5rem 0;z-index:1}
.show label{margin-right:1rem;white-space:nowrap}
@media print{.show{position:static}.show label{display:none}*{print-color-adjust:exact;-webkit-print-color-adjust:exact}}
)";

/// The numbers that the maps can show, by their index in data-v, and the limits between six
/// classes.
constexpr std::string_view kScript = R"(
const kinds = [
  ["verdict", [], ""],
  ["energy made [J]", [1e-9, 1e-4, 1e-3, 1e-2, 1e-1], "J"],
  ["peak force [N]", [2, 5, 10, 20, 50], "N"],
  ["speed of the last third [m/s]", [0.002, 0.02, 0.05, 0.1, 0.5], "m/s"],
  ["force off [%]", [1, 5, 10, 30, 100], "%"],
  ["stiffness kept [%]", [10, 30, 60, 90, 99], "%"],
];
const cells = [...document.querySelectorAll(".map rect")].map(rect => {
  const text = rect.nextElementSibling;
  return {rect, text, kind: rect.getAttribute("class"), letter: text.textContent,
          values: rect.dataset.v.split(" ").map(v => v === "-" ? NaN : Number(v))};
});
const short = v => !isFinite(v) ? "-" : v === 0 ? "0" : Math.abs(v) >= 1e4 || Math.abs(v) < 1e-2
  ? v.toExponential(0).replace("e+", "e") : Number(v.toPrecision(2)).toString();
const legend = document.querySelector(".legend"), verdicts = legend.innerHTML;
const show = number => {
  const [, limits, unit] = kinds[number];
  for (const cell of cells) {
    let kind = cell.kind, words = cell.letter;
    if (number > 0) {
      const value = cell.values[number - 1];
      words = cell.kind === "v4" ? "X" : short(value);
      kind = cell.kind === "v4" ? "v4" : isNaN(value) ? "v0"
        : "n" + limits.filter(limit => value > limit).length;
    }
    cell.rect.setAttribute("class", kind);
    cell.text.setAttribute("class", "c " + kind);
    cell.text.textContent = words;
  }
  legend.innerHTML = number === 0 ? verdicts : limits.concat([null]).map((limit, i) =>
    `<span><svg width="20" height="20"><rect width="20" height="20" class="n${i}"/></svg>` +
    (limit === null ? `above ${limits[i - 1]}` : `up to ${limit}`) + ` ${unit}</span>`).join("") +
    '<span><svg width="20" height="20"><rect width="20" height="20" class="v4"/></svg>runs away</span>';
};
const bar = document.createElement("div");
bar.className = "show";
kinds.forEach(([name], number) => {
  const label = document.createElement("label"), input = document.createElement("input");
  input.type = "radio";
  input.name = "kind";
  input.checked = number === 0;
  input.onchange = () => show(number);
  label.append(input, " " + name);
  bar.append(label);
});
legend.before(bar);
bar.append(legend);
)";

constexpr std::array<std::string_view, kVerdicts> kLetters{"", "~", "o", "E", "X"};

std::optional<std::size_t> axis_named(const StabilityPlan& plan, std::string_view name) {
  for (std::size_t i = 0; i < plan.axes.size(); ++i)
    if (plan.axes[i].parameter->name == name) return i;
  return std::nullopt;
}

/// The numeric axis with the most values, other than `but`; an axis of words if there is no other.
std::optional<std::size_t> longest_axis(const StabilityPlan& plan, std::optional<std::size_t> but) {
  std::optional<std::size_t> best;
  const auto length = [&](std::size_t i) {
    const StabilityAxis& axis = plan.axes[i];
    return axis.values.size() + (axis.parameter->words.empty() ? kMostValues : 0);
  };
  for (std::size_t i = 0; i < plan.axes.size(); ++i)
    if (i != but && (!best || length(i) > length(*best))) best = i;
  return best;
}

/// The axes along a map; for each value of the other axes there is a map.
struct Layout {
  std::optional<std::size_t> across, up;

  explicit Layout(const StabilityPlan& plan) {
    across = axis_named(plan, "impairment.delay");
    up = axis_named(plan, "hand.k1");
    if (!across) across = longest_axis(plan, up);
    if (!up) up = longest_axis(plan, across);
  }
};

std::size_t count_of(const StabilityPlan& plan, std::optional<std::size_t> axis) {
  return axis ? plan.axes[*axis].values.size() : 1;
}

/// For example "delay" for "impairment.delay".
std::string_view short_name(const StabilityParameter& parameter) {
  return parameter.name.substr(parameter.name.rfind('.') + 1);
}

std::string text_at(const StabilityPlan& plan, std::size_t axis, std::size_t cell) {
  const StabilityAxis& row = plan.axes[axis];
  return value_text(*row.parameter, row.values[plan.place(cell, axis)]);
}

std::string setting_text(const StabilityPlan& plan, std::size_t cell) {
  std::string out;
  for (std::size_t axis = 0; axis < plan.axes.size(); ++axis)
    fmt::format_to(tools::end_of(out), "{}{} {}", out.empty() ? "" : ", ",
                   plan.axes[axis].parameter->name, text_at(plan, axis, cell));
  return out;
}

std::string percent(const std::optional<double>& share) {
  return share ? fmt::format("{} %", number_text(100 * *share)) : "-";
}

/// All numbers of a cell, shown under the pointer.
std::string tooltip(const StabilityPlan& plan, std::size_t cell, const StabilityResult& r) {
  const StabilitySetting setting = plan.setting(cell);
  return fmt::format(
      "{}\n{}\nleast energy {:.3g} J\npeak force {} N\nlast third: speed {} m/s, amplitude {}\n"
      "force error rms {} N, p95 {} N\nright force rms {} N, p95 {} N\nforce off {}\n"
      "stiffness kept {}",
      setting_text(plan, cell), name_of(verdict_of(setting, r)), r.least_energy,
      number_text(r.peak_force), number_text(r.rms_speed), length_text(r.amplitude),
      number_text(r.error_rms), number_text(r.error_p95), number_text(r.truth_rms),
      number_text(r.truth_p95), percent(force_off(r)), percent(r.kept));
}

/// Values for the script: see `kinds` there.
std::string shown_values(const StabilityResult& r) {
  const auto plain = [](double value) {
    return std::isfinite(value) ? fmt::format("{:.3g}", value) : std::string("-");
  };
  const auto off = force_off(r);
  return fmt::format("{} {} {} {} {}", plain(std::max(0.0, -r.least_energy)), plain(r.peak_force),
                     plain(r.rms_speed), off ? plain(100 * *off) : "-",
                     r.diverged ? "-" : plain(100 * r.kept));
}

void append_cell(std::string& out, const StabilityReport& report, std::size_t run, int x, int y) {
  const std::size_t cell = report.plan.cell_of(run);
  const StabilityResult& result = report.results[run];
  const auto verdict = static_cast<std::size_t>(verdict_of(report.plan.setting(cell), result));
  fmt::format_to(tools::end_of(out),
                 "<rect class=\"v{0}\" x=\"{1}\" y=\"{2}\" width=\"{3}\" height=\"{4}\" "
                 "data-v=\"{5}\"><title>{6}</title></rect><text class=\"c v{0}\" x=\"{7}\" "
                 "y=\"{8}\">{9}</text>\n",
                 verdict, x, y, kCellWide, kCellTall, shown_values(result),
                 html_escaped(tooltip(report.plan, cell, result)), x + kCellWide / 2,
                 y + kCellTall / 2 + 4, kLetters[verdict]);
}

/// The map of one mode at fixed values of the other axes. `cells` holds its cells row by row, from
/// the lowest value of the upright axis.
void append_map(std::string& out, const StabilityReport& report, const Layout& layout,
                std::size_t mode, const std::vector<std::size_t>& cells) {
  const StabilityPlan& plan = report.plan;
  const std::size_t wide = count_of(plan, layout.across), tall = count_of(plan, layout.up);
  const int width = kLeft + static_cast<int>(wide) * kCellWide + 8;
  const int bottom = kTop + static_cast<int>(tall) * kCellTall;
  std::string caption;
  for (std::size_t axis = 0; axis < plan.axes.size(); ++axis)
    if (axis != layout.across && axis != layout.up)
      fmt::format_to(tools::end_of(caption), "{}{} {}", caption.empty() ? "" : ", ",
                     short_name(*plan.axes[axis].parameter), text_at(plan, axis, cells.front()));
  fmt::format_to(
      tools::end_of(out),
      "<figure style=\"width:{1}px\"><figcaption>{0}</figcaption>\n<svg class=\"map\" "
      "width=\"{1}\" height=\"{2}\" viewBox=\"0 0 {1} {2}\" role=\"img\" aria-label=\"{0}\">\n",
      html_escaped(caption), width, bottom + kBelow);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const auto column = static_cast<int>(i % wide), row = static_cast<int>(i / wide);
    append_cell(out, report, mode * plan.cells() + cells[i], kLeft + column * kCellWide,
                bottom - (row + 1) * kCellTall);
  }
  const auto label = [&](int x, int y, std::string_view anchor, const std::string& text) {
    fmt::format_to(tools::end_of(out), "<text x=\"{}\" y=\"{}\" text-anchor=\"{}\">{}</text>\n", x,
                   y, anchor, html_escaped(text));
  };
  for (std::size_t i = 0; layout.across && i < wide; ++i)
    label(kLeft + static_cast<int>(i) * kCellWide + kCellWide / 2, bottom + 15, "middle",
          text_at(plan, *layout.across, cells[i]));
  for (std::size_t i = 0; layout.up && i < tall; ++i)
    label(kLeft - 6, bottom - static_cast<int>(i) * kCellTall - kCellTall / 2 + 4, "end",
          text_at(plan, *layout.up, cells[i * wide]));
  if (layout.across)
    label(kLeft + static_cast<int>(wide) * kCellWide / 2, bottom + 33, "middle",
          std::string(plan.axes[*layout.across].parameter->name));
  if (layout.up)
    fmt::format_to(
        tools::end_of(out),
        "<text transform=\"translate(11 {}) rotate(-90)\" text-anchor=\"middle\">{}</text>\n",
        (kTop + bottom) / 2, plan.axes[*layout.up].parameter->name);
  out += "</svg></figure>\n";
}

/// The cells of each map: cells with equal values on all other axes.
std::vector<std::vector<std::size_t>> maps_of(const StabilityPlan& plan, const Layout& layout) {
  const std::size_t wide = count_of(plan, layout.across);
  const std::size_t size = wide * count_of(plan, layout.up);
  std::vector<std::vector<std::size_t>> maps(plan.cells() / size, std::vector<std::size_t>(size));
  for (std::size_t cell = 0; cell < plan.cells(); ++cell) {
    std::size_t map = 0;
    for (std::size_t axis = 0; axis < plan.axes.size(); ++axis)
      if (axis != layout.across && axis != layout.up)
        map = map * plan.axes[axis].values.size() + plan.place(cell, axis);
    const std::size_t column = layout.across ? plan.place(cell, *layout.across) : 0;
    const std::size_t row = layout.up ? plan.place(cell, *layout.up) : 0;
    maps[map][row * wide + column] = cell;
  }
  return maps;
}

void append_summary(std::string& out, const StabilityReport& report) {
  fmt::format_to(
      tools::end_of(out),
      "<section>\n{2}<p class=\"note\">right: no energy generated, at rest when expected, force "
      "error at most {0:g} % (rms, of the correct force). makes energy: more than 1 nJ generated. "
      "runs away: beyond 10 m or 1 MN. no rest: moves at more than {1:g} m/s under a constant push "
      "against a fixed environment. force off: by more than {0:g} %, of runs that did not run "
      "away. stiffness kept: median.</p>\n</section>\n",
      100 * kWrong, kRest, stability_page_table(report));
}

void append_legend(std::string& out) {
  out += "<div class=\"legend\">";
  for (std::size_t i = 0; i < kVerdicts; ++i)
    fmt::format_to(
        tools::end_of(out),
        "<span><svg width=\"20\" height=\"20\"><rect class=\"v{0}\" width=\"20\" "
        "height=\"20\"/><text class=\"c v{0}\" x=\"10\" y=\"14\">{1}</text></svg>{2}</span>",
        i, kLetters[i], name_of(static_cast<StabilityVerdict>(i)));
  out += "</div>\n";
}

}  // namespace

std::string stability_page(const StabilityReport& report) {
  const StabilityPlan& plan = report.plan;
  std::string body = fmt::format(
      "<p>A hand touches through each coupling in turn; in each cell, the network treats the "
      "samples equally. Point at a cell to see all of its "
      "numbers.</p>\n<dl><dt>command</dt><dd><code>{}</code></dd><dt>options</dt><dd>{}</dd></"
      "dl>\n",
      html_escaped(report.command), html_escaped(plan.text()));
  if (!plan.gate)
    fmt::format_to(tools::end_of(body), "<p class=\"loud\">{}</p>\n", gate_warning(plan));
  for (const std::string& note : report.notes)
    fmt::format_to(tools::end_of(body), "<p class=\"note\">{}</p>\n", html_escaped(note));
  append_summary(body, report);
  append_legend(body);
  const Layout layout(plan);
  const auto maps = maps_of(plan, layout);
  for (std::size_t mode = 0; mode < plan.modes.size(); ++mode) {
    fmt::format_to(tools::end_of(body),
                   "<section id=\"{0}\">\n<h2>{0}</h2>\n<div class=\"maps\">\n",
                   plan.mode_name(plan.modes[mode]));
    for (const auto& cells : maps) append_map(body, report, layout, mode, cells);
    body += "</div>\n</section>\n";
  }
  fmt::format_to(tools::end_of(body), "<script>{}</script>\n", kScript);
  return html_page("Couplings over a network: stability and force", kStyle, body);
}

}  // namespace reckon::bench
