// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/zwidth/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "reckon/bench/analysis/device_damping.hpp"
#include "reckon/bench/plots/html_page.hpp"
#include "reckon/peer/scene/units.hpp"
#include "reckon/tools/plots/curves.hpp"
#include "reckon/tools/terminal/json_text.hpp"
#include "reckon/tools/terminal/text_end.hpp"
#include "reckon/tools/terminal/text_table.hpp"

namespace reckon::bench {
namespace {

using peer::format_quantity;

constexpr double kStiffWall = 2000;  // [N/m], that a wall should have to feel stiff
/// Borders of stability beyond so many times the passive one are cut in the picture.
constexpr double kShownBeyond = 2.2;

constexpr std::string_view kStyle = "section>svg{display:block;width:100%;max-width:60rem}\n";

std::string device_text(const ZWidthDevice& device) {
  return fmt::format(
      "mass {}, damping {}, {}, {}", format_quantity(device.mass, "kg"),
      format_quantity(device.damping, "N s/m"), format_quantity(1 / device.period, "Hz"),
      device.delay_samples == 0
          ? "no delay"
          : fmt::format(
                "{} late ({})", format_quantity(device.period * device.delay_samples, "s"),
                tools::counted(static_cast<std::uint64_t>(device.delay_samples), "sample")));
}

std::string stiffness_text(double value) {
  return std::isfinite(value) ? fmt::format("{:.4g}", value) : "never";
}

std::string off_text(const ZWidthRow& row) {
  return row.passive > 0 ? fmt::format("{:+.3f} %", 100 * row.off()) : "";
}

double worst_off(const ZWidthReport& report) {
  double worst = 0;
  for (const ZWidthRow& row : report.rows) worst = std::max(worst, std::abs(row.off()));
  return worst;
}

std::vector<std::string> cells_of(const ZWidthRow& row) {
  return {fmt::format("{:.4g}", row.damping),
          stiffness_text(row.undelayed),
          stiffness_text(row.passive),
          stiffness_text(row.energy),
          off_text(row),
          stiffness_text(row.unstable),
          stiffness_text(row.shown)};
}

constexpr std::array<std::string_view, 7> kColumns{
    "DAMPING", "(3.8)", "PASSIVE TO", "ENERGY FROM", "OFF", "SWINGS FROM", "SHOWN TO"};

constexpr std::array<std::array<std::string_view, 2>, 7> kMeanings{{
    {"DAMPING", "of the wall, B [N s/m]; all others [N/m]"},
    {"(3.8)",
     "2 (b - |B|)/T: right without delay ((3.7), from which it is said to follow, lost "
     "its K in print)"},
    {"PASSIVE TO", "(3.5) with the delay, solved for the spring"},
    {"ENERGY FROM", "measured: a stiffer one gives energy to a hand that moves it to and fro"},
    {"OFF", "of what is measured from PASSIVE TO"},
    {"SWINGS FROM", "measured: the handle, held by nobody, swings ever wider"},
    {"SHOWN TO",
     "what the servo lets a wall of a scene have, the rest kept for hands and as margin; dampers "
     "above 3/8 of the device's cost no more of it"},
}};

std::string stiff_wall_text(const ZWidthReport& report) {
  const ZWidthDevice& device = report.device;
  const double needed = spring_damping(kStiffWall, device.period, device.delay_samples);
  return fmt::format(
      "A wall of {} needs a device with more than {:.4g} N s/m; this one has {:.4g}.",
      format_quantity(kStiffWall, "N/m"), needed, device.damping);
}

std::string agreement_text(const ZWidthReport& report) {
  return fmt::format("Theory and measured energy agree within {:.3f} %.", 100 * worst_off(report));
}

std::string title_of(const ZWidthReport& report) {
  return report.subject.empty() ? "Stiffness and damping that a device can show"
                                : "Stiffness and damping that " + report.subject + " can show";
}

/// A curve of one member of the rows, where it is finite.
struct DrawnCurve {
  std::vector<float> at, values;

  DrawnCurve(const ZWidthReport& report, double ZWidthRow::*member) {
    for (const ZWidthRow& row : report.rows) {
      if (!std::isfinite(row.*member)) continue;
      at.push_back(static_cast<float>(row.damping));
      values.push_back(static_cast<float>(row.*member));
    }
  }
};

}  // namespace

std::string zwidth_text(const ZWidthReport& report) {
  std::vector<tools::TextTable::Column> columns;
  for (const std::string_view name : kColumns)
    columns.push_back({std::string(name), tools::TextTable::Align::right});
  tools::TextTable table(columns);
  for (const ZWidthRow& row : report.rows) table.add(cells_of(row));
  std::string out = fmt::format("{}{}{}\n{}\n", report.subject, report.subject.empty() ? "" : ": ",
                                device_text(report.device), table.text());
  for (const auto& [name, meaning] : kMeanings)
    fmt::format_to(tools::end_of(out), "{:<12} {}\n", name, meaning);
  return out + fmt::format("\n{}\n{}\n", agreement_text(report), stiff_wall_text(report));
}

std::string zwidth_csv(const ZWidthReport& report) {
  std::string out = "damping_Ns_m,undelayed_N_m,passive_N_m,energy_N_m,unstable_N_m,shown_N_m\n";
  for (const ZWidthRow& row : report.rows)
    fmt::format_to(tools::end_of(out), "{},{},{},{},{},{}\n", row.damping, row.undelayed,
                   row.passive, row.energy,
                   std::isfinite(row.unstable) ? fmt::format("{}", row.unstable) : "", row.shown);
  return out;
}

std::string zwidth_json(const ZWidthReport& report) {
  std::string out;
  const ZWidthDevice& device = report.device;
  for (const ZWidthRow& row : report.rows) {
    tools::JsonObject(out)
        .value("damping", row.damping)
        .value("undelayed", row.undelayed)
        .value("passive", row.passive)
        .value("energy", row.energy)
        .value("unstable", std::isfinite(row.unstable) ? fmt::format("{}", row.unstable) : "null")
        .value("shown", row.shown)
        .value("device_mass", device.mass)
        .value("device_damping", device.damping)
        .value("device_period", device.period)
        .value("device_delay_samples", device.delay_samples)
        .end("\n");
  }
  return out;
}

std::string zwidth_svg(const ZWidthReport& report) {
  const DrawnCurve undelayed(report, &ZWidthRow::undelayed), passive(report, &ZWidthRow::passive),
      shown(report, &ZWidthRow::shown), energy(report, &ZWidthRow::energy),
      unstable(report, &ZWidthRow::unstable);
  tools::SvgPlot plot;
  plot.title = title_of(report);
  plot.note = device_text(report.device) + ". What lies below (3.5) is passive.";
  plot.value = "stiffness of the wall [N/m]";
  plot.across = "damping of the wall [N s/m]";
  double most = 0;
  for (const ZWidthRow& row : report.rows) {
    plot.end = std::max(plot.end, row.damping);
    most = std::max({most, row.passive, row.energy});
  }
  plot.range = {0, most > 0 ? kShownBeyond * most : 1};
  plot.curves = {{"passive to: thesis (3.5)", passive.values, passive.at},
                 {"energy from (measured)", energy.values, energy.at, true},
                 {"swings from (measured)", unstable.values, unstable.at, true},
                 {"thesis (3.8): no delay", undelayed.values, undelayed.at},
                 {"shown by the servo", shown.values, shown.at}};
  return tools::svg_panels(plot.title, std::array{plot.note}, std::array{[&] {
                             tools::SvgPlot panel = plot;
                             panel.title.clear();
                             return panel;
                           }()});
}

std::string zwidth_page(const ZWidthReport& report) {
  std::string body = fmt::format(
      "<dl><dt>command</dt><dd><code>{}</code></dd><dt>device</dt><dd>{}</dd></dl>\n<p>{} {}</p>\n",
      html_escaped(report.command), html_escaped(device_text(report.device)),
      agreement_text(report), stiff_wall_text(report));
  body +=
      "<section>\n" + zwidth_svg(report) + "</section>\n<section class=\"wide\">\n<table>\n<tr>";
  for (const std::string_view name : kColumns)
    fmt::format_to(tools::end_of(body), "<th>{}</th>", name);
  body += "</tr>\n";
  for (const ZWidthRow& row : report.rows) {
    body += "<tr>";
    for (const std::string& cell : cells_of(row))
      fmt::format_to(tools::end_of(body), "<td>{}</td>", cell);
    body += "</tr>\n";
  }
  body += "</table>\n<dl>\n";
  for (const auto& [name, meaning] : kMeanings)
    fmt::format_to(tools::end_of(body), "<dt>{}</dt><dd>{}</dd>\n", name, html_escaped(meaning));
  return html_page(title_of(report), kStyle, body + "</dl>\n</section>\n");
}

}  // namespace reckon::bench
