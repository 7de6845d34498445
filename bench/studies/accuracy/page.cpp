// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/accuracy/page.hpp"

#include <fmt/format.h>

#include "reckon/bench/plots/html_page.hpp"
#include "reckon/bench/plots/sortable_page.hpp"
#include "reckon/bench/studies/accuracy/scatter.hpp"
#include "reckon/bench/studies/pose/study_text.hpp"
#include "reckon/tools/terminal/text_table.hpp"

namespace reckon::bench {
namespace {

/// Colours that most people tell apart on white and on black; shapes tell them apart too.
constexpr std::string_view kPoseStyle = R"(
:root{--front:#1f2328}@media(prefers-color-scheme:dark){:root{--front:#e6edf3}}
.defs{position:absolute;width:0;height:0}.plot text{font:13px system-ui,sans-serif;fill:var(--soft)}
.g{stroke:var(--line);fill:none}.a{stroke:var(--soft);fill:none}
.f{stroke:var(--front);fill:none;stroke-width:1.5;stroke-linejoin:round}
use{stroke:var(--page);stroke-width:.8}.plot .d{opacity:.28}
.legend span{display:inline-block;margin-right:1rem;white-space:nowrap}
.legend svg{vertical-align:-2px}
.m0{fill:#d55e00}.m1{fill:#8c8c8c}.m2{fill:#56b4e9}.m3{fill:#0072b2}.m4{fill:#009e73}
.m5{fill:#7fb800}.m6{fill:#e69f00}.m7{fill:#b8860b}.m8{fill:#cc79a7}.m9{fill:#8a5cd1}
.m10{fill:#17a2a2}
)";

void append_summary(std::string& out, const AccuracyReport& report) {
  out +=
      "<p>An owner sends the motion of an entity when the prediction that its peers make is off by "
      "more than a threshold; a viewer predicts and smooths. Each setting is a model, a threshold "
      "and a convergence curve.</p>\n<dl>\n";
  const auto row = [&](std::string_view name, const std::string& value) {
    out += fmt::format("<dt>{}</dt><dd>{}</dd>\n", name, value);
  };
  row("command", fmt::format("<code>{}</code>", html_escaped(report.command)));
  row("conditions", html_escaped(conditions_text(report.grid)));
  row("octets", "172 an update: Entity State of 144, UDP and IPv4 headers of 28");
  if (!report.processor.empty())
    row("ns", html_escaped(report.processor) +
                  "; one predicted and converged pose, median of blocks that took turns");
  out +=
      "</dl>\n<p class=\"note\">In full colour: the Pareto front of octets, error (99 % below) and "
      "largest velocity step; no setting is better in one of these without being worse in another. "
      "The line joins the least errors for the octets; marks off the line are on the front for "
      "smaller velocity steps. Pale: dominated, by what the table says. Settings are compared at "
      "three digits. Errors below the axis are drawn on it.</p>\n<nav>";
  for (std::size_t i = 0; i < report.results.size(); ++i)
    out += fmt::format("<a href=\"#r{}\">{}</a>\n", i, html_escaped(report.results[i].subject));
  if (!report.contacts.empty()) out += "<a href=\"#contacts\">hands in contact</a>\n";
  out += "</nav>\n";
}

void append_row(std::string& out, const AccuracyResult& result, const AccuracyRow& row) {
  const PoseResult& r = row.result;
  const auto& curve = deadreckon::kConvergenceCurves[static_cast<std::size_t>(row.curve)];
  out += fmt::format("<tr{}><td class=\"w\">{}</td><td class=\"w\">{}</td>",
                     row.beaten ? " class=\"d\"" : "", row.model.name, curve.name);
  out += page_cell(row.threshold, length_text(row.threshold));
  out += page_cell(r.updates_per_second(), number_text(r.updates_per_second()));
  out += page_cell(row.octets_per_second(), number_text(row.octets_per_second()));
  for (const double error : {r.position.rms, r.position.p99, r.position.max})
    out += page_cell(error, length_text(error));
  out += page_cell(r.angle.p99, number_text(degrees(r.angle.p99)));
  out += page_cell(r.velocity_step.max, number_text(r.velocity_step.max));
  out += page_cell(row.query_ns, row.query_ns > 0 ? fmt::format("{:.0f}", row.query_ns) : "");
  out += "<td class=\"w\">";
  if (row.beaten)
    out += fmt::format("{}{}", row.beaten->equal ? "same as " : "",
                       setting_text(result.rows[row.beaten->by]));
  out += "</td></tr>\n";
}

void append_table(std::string& out, const AccuracyResult& result) {
  out +=
      "<div class=\"wide\"><table>\n<thead><tr><th class=\"w\">model</th><th class=\"w\">curve</th>"
      "<th>threshold</th><th>updates/s</th><th>octets/s</th><th>RMS</th><th>99 %</th><th>max</th>"
      "<th>angle 99 % [deg]</th><th>velocity step [m/s]</th><th>ns</th>"
      "<th class=\"w\">dominated by</th></tr></thead>\n<tbody>\n";
  for (const std::size_t i : rows_in_order(result, false)) append_row(out, result, result.rows[i]);
  out += "</tbody></table></div>\n";
}

void append_contacts(std::string& out, const AccuracyReport& report) {
  if (report.contacts.empty()) return;
  out +=
      "<section id=\"contacts\">\n<h2>hands in contact</h2>\n<p>Whole peers in simulated time; all "
      "packets, and how many times fewer they are than an Entity State and an Attribute PDU each "
      "millisecond of each hand. Errors: felt against the spring that the devices can show x the "
      "true overlap at that instant.</p>\n"
      "<div class=\"wide\"><table>\n<thead><tr><th class=\"w\">scene</th><th "
      "class=\"w\">send at</th><th>packets/s</th><th>fewer</th><th>RMS [N]</th>"
      "<th>99 % [N]</th><th>max [N]</th><th>linger [s]</th><th>servo step [ns]</th></tr></thead>\n"
      "<tbody>\n";
  for (const ContactRow& row : report.contacts) {
    out += fmt::format("<tr><td class=\"w\">{}</td><td class=\"w\">{}</td>",
                       html_escaped(row.scene), html_escaped(sending_text(row.sending)));
    const ForceError& error = row.from_shown;
    if (!row.touched()) {
      out += page_cell(row.packets_per_s, number_text(row.packets_per_s)) +
             page_cell(row.times_fewer(), number_text(row.times_fewer())) +
             "<td class=\"w\" colspan=\"5\">did not touch</td></tr>\n";
      continue;
    }
    for (const double value : {row.packets_per_s, row.times_fewer(), error.rms, error.p99,
                               error.max, row.linger, row.servo_step_ns})
      out += page_cell(value, number_text(value));
    out += "</tr>\n";
  }
  out += "</tbody></table></div>\n</section>\n";
}

void append_result(std::string& out, const AccuracyResult& result, std::size_t number) {
  out += fmt::format("<section id=\"r{}\">\n<h2>{}</h2>\n<p>{}</p>\n", number,
                     html_escaped(result.subject), html_escaped(result.meaning));
  out += fmt::format(
      "<p class=\"note\">{}, {} samples; the true velocity steps by up to {} m/s from sample to "
      "sample. {} of {} settings are on the front.</p>\n",
      tools::counted(result.entities, "track"), result.samples,
      number_text(result.own_velocity_step), result.on_front(), result.rows.size());
  out += scatter_svg(result) + scatter_legend(result);
  append_table(out, result);
  out += "</section>\n";
}

}  // namespace

std::string accuracy_page(const AccuracyReport& report) {
  std::string out = scatter_marks();
  append_summary(out, report);
  for (std::size_t i = 0; i < report.results.size(); ++i) append_result(out, report.results[i], i);
  append_contacts(out, report);
  return sortable_page("Poses: accuracy against cost", kPoseStyle, out);
}

}  // namespace reckon::bench
