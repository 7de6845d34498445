// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/studies/accuracy/page.hpp"

#include <fmt/format.h>

#include "reckon/tools/studies/accuracy/scatter.hpp"
#include "reckon/tools/studies/pose/study_text.hpp"
#include "reckon/tools/terminal/text_table.hpp"

namespace reckon::tools {
namespace {

/// Colours that most people tell apart on white and on black; shapes tell them apart too.
constexpr std::string_view kStyle = R"(
:root{color-scheme:light dark;--ink:#1f2328;--soft:#59636e;--line:#d8dee4;--page:#fff;
--band:#f6f8fa;--front:#1f2328}
@media(prefers-color-scheme:dark){:root{--ink:#e6edf3;--soft:#9198a1;--line:#30363d;--page:#0d1117;
--band:#161b22;--front:#e6edf3}}
body{margin:0 auto;padding:1.5rem 1rem 4rem;max-width:76rem;font:15px/1.5 system-ui,sans-serif;
color:var(--ink);background:var(--page)}
h1{font-size:1.6rem;margin:0 0 .5rem}h2{font-size:1.25rem;margin:2.5rem 0 .2rem;
border-top:1px solid var(--line);padding-top:1.5rem}
p{margin:.3rem 0;max-width:60rem}code{font:13px ui-monospace,monospace;overflow-wrap:anywhere}
dl{display:grid;grid-template-columns:max-content 1fr;gap:.15rem 1rem;margin:1rem 0}
dt{color:var(--soft)}dd{margin:0}
nav a{display:inline-block;margin:.2rem .8rem .2rem 0}a{color:inherit}
.note{color:var(--soft)}.defs{position:absolute}
.plot{display:block;width:100%;max-width:60rem;margin:.8rem 0}
.plot text{font:13px system-ui,sans-serif;fill:var(--soft)}
.g{stroke:var(--line);fill:none}.a{stroke:var(--soft);fill:none}
.f{stroke:var(--front);fill:none;stroke-width:1.5;stroke-linejoin:round}
use{stroke:var(--page);stroke-width:.8}.plot .d{opacity:.28}
.legend span{display:inline-block;margin-right:1rem;white-space:nowrap}
.legend svg{vertical-align:-2px}
.m0{fill:#d55e00}.m1{fill:#8c8c8c}.m2{fill:#56b4e9}.m3{fill:#0072b2}.m4{fill:#009e73}
.m5{fill:#7fb800}.m6{fill:#e69f00}.m7{fill:#b8860b}.m8{fill:#cc79a7}.m9{fill:#8a5cd1}
.m10{fill:#17a2a2}
.wide{overflow-x:auto}table{border-collapse:collapse;font-variant-numeric:tabular-nums;
font-size:13px;white-space:nowrap}
th,td{padding:.2rem .6rem;text-align:right;border-bottom:1px solid var(--line)}
th{background:var(--band);font-weight:600}th button{all:unset;cursor:pointer}
th button:focus-visible{outline:2px solid}
th[aria-sort=ascending] button::after{content:" \2191"}
th[aria-sort=descending] button::after{content:" \2193"}
.w{text-align:left}tr.d td{color:var(--soft)}
.few tr.d,.few td:last-child,.few th:last-child{display:none}
.more{font:inherit;margin:.6rem 0;padding:.2rem .7rem;color:inherit;background:var(--band);
border:1px solid var(--line);border-radius:6px;cursor:pointer}
)";

constexpr std::string_view kScript = R"(
for (const section of document.querySelectorAll("section")) {
  const table = section.querySelector("table"), body = table.tBodies[0];
  const beaten = body.querySelectorAll("tr.d").length;
  if (beaten > 0) {
    const more = document.createElement("button");
    more.className = "more";
    const show = few => {
      table.classList.toggle("few", few);
      more.textContent = (few ? "Show" : "Hide") + " the " + beaten + " dominated settings";
    };
    more.onclick = () => show(!table.classList.contains("few"));
    show(true);
    table.parentNode.before(more);
  }
  table.querySelectorAll("th").forEach((head, column) => {
    const button = document.createElement("button");
    button.textContent = head.textContent;
    head.replaceChildren(button);
    button.onclick = () => {
      const up = head.getAttribute("aria-sort") !== "ascending";
      for (const other of table.querySelectorAll("th")) other.removeAttribute("aria-sort");
      head.setAttribute("aria-sort", up ? "ascending" : "descending");
      const value = row => row.cells[column].dataset.v ?? row.cells[column].textContent;
      const order = (a, b) => {
        const x = value(a), y = value(b);
        return isNaN(x) || isNaN(y) ? x.localeCompare(y) : x - y;
      };
      body.append(...[...body.rows].sort((a, b) => up ? order(a, b) : order(b, a)));
    };
  });
}
)";

void append_head(std::string& out) {
  out +=
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">\n"
      "<title>Reckon: poses, accuracy against cost</title>\n";
  out += fmt::format("<style>{}</style>\n</head>\n<body>\n", kStyle);
}

void append_summary(std::string& out, const AccuracyReport& report) {
  out +=
      "<h1>Poses: accuracy against cost</h1>\n"
      "<p>An owner sends the motion of an entity when the prediction that its peers make is off by "
      "more than a threshold; a viewer predicts and smooths. Each setting is a model, a threshold "
      "and a convergence curve.</p>\n<dl>\n";
  const auto row = [&](std::string_view name, const std::string& value) {
    out += fmt::format("<dt>{}</dt><dd>{}</dd>\n", name, value);
  };
  row("command", fmt::format("<code>{}</code>", html_text(report.command)));
  row("conditions", html_text(conditions_text(report.grid)));
  row("octets", "172 an update: Entity State of 144, UDP and IPv4 headers of 28");
  if (!report.processor.empty())
    row("ns", html_text(report.processor) +
                  "; one predicted and converged pose, median of blocks that took turns");
  out +=
      "</dl>\n<p class=\"note\">In full colour: the Pareto front of octets, error (99 % below) and "
      "largest velocity step; no setting is better in one of these without being worse in another. "
      "The line joins the least errors for the octets; marks off the line are on the front for "
      "smaller velocity steps. Pale: dominated, by what the table says. Settings are compared at "
      "three digits. Errors below the axis are drawn on it.</p>\n<nav>";
  for (std::size_t i = 0; i < report.results.size(); ++i)
    out += fmt::format("<a href=\"#r{}\">{}</a>\n", i, html_text(report.results[i].subject));
  if (!report.contacts.empty()) out += "<a href=\"#contacts\">hands in contact</a>\n";
  out += "</nav>\n";
}

/// A cell that is sorted by a value other than its text.
std::string cell(double value, const std::string& text) {
  return fmt::format("<td data-v=\"{:.6g}\">{}</td>", value, text);
}

void append_row(std::string& out, const AccuracyResult& result, const AccuracyRow& row) {
  const PoseResult& r = row.result;
  const auto& curve = deadreckon::kConvergenceCurves[static_cast<std::size_t>(row.curve)];
  out += fmt::format("<tr{}><td class=\"w\">{}</td><td class=\"w\">{}</td>",
                     row.beaten ? " class=\"d\"" : "", row.model.name, curve.name);
  out += cell(row.threshold, length_text(row.threshold));
  out += cell(r.updates_per_second(), number_text(r.updates_per_second()));
  out += cell(row.octets_per_second(), number_text(row.octets_per_second()));
  for (const double error : {r.position.rms, r.position.p99, r.position.max})
    out += cell(error, length_text(error));
  out += cell(r.angle.p99, number_text(degrees(r.angle.p99)));
  out += cell(r.velocity_step.max, number_text(r.velocity_step.max));
  out += cell(row.query_ns, row.query_ns > 0 ? fmt::format("{:.0f}", row.query_ns) : "");
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
    out += fmt::format("<tr><td class=\"w\">{}</td><td class=\"w\">{}</td>", html_text(row.scene),
                       html_text(sending_text(row.sending)));
    const ForceError& error = row.from_shown;
    if (!row.touched()) {
      out += cell(row.packets_per_s, number_text(row.packets_per_s)) +
             cell(row.times_fewer(), number_text(row.times_fewer())) +
             "<td class=\"w\" colspan=\"5\">did not touch</td></tr>\n";
      continue;
    }
    for (const double value : {row.packets_per_s, row.times_fewer(), error.rms, error.p99,
                               error.max, row.linger, row.servo_step_ns})
      out += cell(value, number_text(value));
    out += "</tr>\n";
  }
  out += "</tbody></table></div>\n</section>\n";
}

void append_result(std::string& out, const AccuracyResult& result, std::size_t number) {
  out += fmt::format("<section id=\"r{}\">\n<h2>{}</h2>\n<p>{}</p>\n", number,
                     html_text(result.subject), html_text(result.meaning));
  out += fmt::format(
      "<p class=\"note\">{}, {} samples; the true velocity steps by up to {} m/s from sample to "
      "sample. {} of {} settings are on the front.</p>\n",
      counted(result.entities, "track"), result.samples, number_text(result.own_velocity_step),
      result.on_front(), result.rows.size());
  out += scatter_svg(result) + scatter_legend(result);
  append_table(out, result);
  out += "</section>\n";
}

}  // namespace

std::string accuracy_page(const AccuracyReport& report) {
  std::string out;
  append_head(out);
  out += scatter_marks();
  append_summary(out, report);
  for (std::size_t i = 0; i < report.results.size(); ++i) append_result(out, report.results[i], i);
  append_contacts(out, report);
  out += fmt::format("<script>{}</script>\n</body>\n</html>\n", kScript);
  return out;
}

}  // namespace reckon::tools
