// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/scale/page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <set>
#include <span>
#include <utility>

#include "reckon/bench/plots/html_page.hpp"
#include "reckon/bench/plots/log_plot.hpp"
#include "reckon/bench/studies/scale/mechanisms.hpp"

namespace reckon::bench {
namespace {

constexpr std::string_view kStyle =
    "body{max-width:100rem}pre{overflow-x:auto;font-size:12px}"
    ".plots{display:grid;grid-template-columns:repeat(auto-fill,minmax(min(26rem,100%),1fr));"
    "gap:1rem}"
    ".plots svg{width:100%;height:auto}";

/// A plot of one measure.
struct Picture {
  std::string_view measure, title, axis;
};
constexpr std::array kPictures{
    Picture{"heard_packets_per_s", "Datagrams received by a peer", "datagrams/s"},
    Picture{"heard_bytes_per_s", "Octets received by a peer", "B/s"},
    Picture{"sent_packets_per_s", "Datagrams sent by a peer", "datagrams/s"},
    Picture{"unwanted_updates_per_s", "Unused updates received", "updates/s"},
    Picture{"pose_error_p99_m", "Error of the shown pose, p99", "m"},
    Picture{"cpu_share", "CPU of a peer", "share of a core"},
};

/// The name without its leading "+ ".
std::string short_name(std::size_t mechanism) {
  const std::string_view name = kMechanisms[mechanism].name;
  return std::string(name.substr(name.starts_with("+ ") ? 2 : 0));
}

/// A curve for each mechanism over the entities, with a line for each number of peers. With one
/// number of entities, or if entities grow with peers: over the peers.
std::string picture(const ScaleReport& report, const Picture& drawn) {
  std::set<std::size_t> sizes, peers;
  for (const ScaleRow& row : report.rows) {
    sizes.insert(row.entities());
    peers.insert(row.peers());
  }
  // In the usual sweep both grow together: one line.
  const bool together = std::ranges::all_of(report.rows, [&](const ScaleRow& row) {
    return std::abs(static_cast<double>(row.entities()) *
                        static_cast<double>(report.rows.front().peers()) -
                    static_cast<double>(report.rows.front().entities()) *
                        static_cast<double>(row.peers())) < 0.5;
  });
  const bool over_entities = sizes.size() > 1 && !together;
  LogPlot plot;
  plot.title = drawn.title;
  plot.x = over_entities ? "entities in the world"
           : together    ? "peers, with as many entities each"
                         : "peers";
  plot.y = drawn.axis;
  if (over_entities && peers.size() > 1) {
    for (std::size_t piece = 0; const std::size_t count : peers)
      plot.note += fmt::format("{}{} peers {}", plot.note.empty() ? "" : ", ", count,
                               LogPlot::dash_name(piece++));
  }
  const ScaleMeasure& measure = scale_measure(drawn.measure);
  for (std::size_t mechanism = 0; mechanism < kMechanisms.size(); ++mechanism) {
    LogCurve curve{short_name(mechanism), {}, mechanism + 1 == kMechanisms.size()};
    for (const ScaleRow& row : report.rows) {
      if (row.mechanism != mechanism) continue;
      const auto x = static_cast<double>(over_entities ? row.entities() : row.peers());
      const auto piece = std::distance(peers.begin(), peers.find(row.peers()));
      curve.points.push_back({x, measure.of(row),
                              fmt::format("{} peers, {} entities: {:.4g} {}", row.peers(),
                                          row.entities(), measure.of(row), drawn.axis),
                              over_entities ? static_cast<std::size_t>(piece) : 0});
    }
    std::ranges::sort(curve.points, {},
                      [](const LogPoint& point) { return std::pair(point.piece, point.x); });
    plot.curves.push_back(std::move(curve));
  }
  return log_plot_svg(plot);
}

/// A curve for each scene, a point for each threshold.
std::string hands_picture(std::span<const HandsRow> rows) {
  LogPlot plot;
  plot.title = "Hands in contact: datagrams against force error";
  plot.x = "error of the force while they touch, p99 [N]";
  plot.y = "datagrams/s of a hand, whole run";
  for (const HandsRow& row : rows) {
    if (plot.curves.empty() || plot.curves.back().name != row.scene)
      plot.curves.push_back({std::string(row.scene), {}, false});
    plot.curves.back().points.push_back(
        {row.error.p99, row.packets_per_s,
         fmt::format("{}, sent at {:g} mN: {:.3g} a second, {:.3g} mN", row.scene,
                     1e3 * row.threshold, row.packets_per_s, 1e3 * row.error.p99)});
  }
  return log_plot_svg(plot);
}

std::string table(std::string_view title, const std::string& text) {
  return fmt::format("<h2>{}</h2>\n<pre>{}</pre>\n", html_escaped(title), html_escaped(text));
}

}  // namespace

std::string scale_page(const ScaleReport& report) {
  std::string body = fmt::format("<p><code>{}</code></p>\n<p>{}</p>\n",
                                 html_escaped(report.command), html_escaped(report.circumstances));
  const auto found = capacities(report.rows, report.limits);
  if (!found.empty()) body += table("Capacity", capacity_text(found, report.limits));
  body += table("Mechanism by mechanism", scale_summary(report.rows));
  std::string list;
  for (const Mechanism& mechanism : kMechanisms)
    list += fmt::format("<li><b>{}</b>: {}</li>\n", mechanism.name, mechanism.meaning);
  body += fmt::format("<ul>{}</ul>\n<div class=\"plots\">\n", list);
  for (const Picture& drawn : kPictures) body += picture(report, drawn);
  if (!report.hands.empty()) body += hands_picture(report.hands);
  body += "</div>\n";
  body += table("All columns", scale_text(report.rows));
  const auto growth = growth_rows(report.rows);
  if (!growth.empty()) body += table("Growth", growth_text(growth));
  if (!report.fitted.empty()) body += table("Beyond the runs", fitted_text(report.fitted));
  if (!report.whole.empty()) body += table("As processes", whole_text(report.whole));
  if (!report.hands.empty()) body += table("Hands in contact", hands_text(report.hands));
  if (!report.many_hands.empty())
    body += table("Hands among many", many_hands_text(report.many_hands));
  if (!report.base.empty())
    body += table("Against the base", comparison_text(report.rows, report.base));
  return html_page("reckon bench scale", kStyle, body);
}

}  // namespace reckon::bench
