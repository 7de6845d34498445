// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/scale/fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reckon/aoim/presence/presence_config.hpp"
#include "reckon/bench/studies/pose/study_text.hpp"
#include "reckon/bench/studies/scale/mechanisms.hpp"
#include "reckon/peer/network/link.hpp"
#include "reckon/tools/terminal/json_text.hpp"
#include "reckon/tools/terminal/text_table.hpp"

namespace reckon::bench {
namespace {

// Octets of an announcement: Presence, Time Exchange and PeersHeard without lists, and the trailer.
constexpr double kFixedOctets = 160 + 24 + 24 + 24;
constexpr double kTimedOctets = 12, kMostTimed = 8;  // a peer in a Time Exchange
constexpr double kListedOctets = 4;                  // a peer in PeersHeard

double basis(Growth growth, double peers) {
  return growth == Growth::edge ? 1 / std::sqrt(peers) : peers;
}

/// With areas of interest, only announcements grow with the number of peers. The CPU time to
/// receive them grows too.
Growth growth_of(std::string_view measure, const ScaleDesign& design) {
  const bool is_of_all = measure.starts_with("heard_") && !design.areas;
  return is_of_all || measure == "cpu_share" ? Growth::peers : Growth::edge;
}

/// The part of announcements in a quantity, per peer and second.
double announced(std::string_view measure, double peers) {
  if (measure == "sent_packets_per_s") return 1;
  if (measure == "sent_bytes_per_s") return announcement_octets(peers);
  if (measure == "heard_packets_per_s") return peers - 1;
  if (measure == "heard_bytes_per_s") return (peers - 1) * announcement_octets(peers);
  return 0;
}

}  // namespace

std::vector<const ScaleRow*> ladder_of(std::span<const ScaleRow> rows, std::size_t mechanism,
                                       const ScaleSetting& setting) {
  std::vector<const ScaleRow*> ladder;
  for (const ScaleRow& row : rows)
    if (row.mechanism == mechanism && are_alike(row.run.setting, setting)) ladder.push_back(&row);
  const auto size = [](const ScaleRow* row) { return row->peers(); };
  std::ranges::stable_sort(ladder, {}, size);
  const auto [first, end] = std::ranges::unique(ladder, {}, size);
  ladder.erase(first, end);
  return ladder;
}

std::vector<const ScaleRow*> ladder_of(std::span<const ScaleRow> rows, std::size_t mechanism) {
  const auto largest = std::ranges::max_element(rows, {}, &ScaleRow::peers);
  if (largest == rows.end()) return {};
  return ladder_of(rows, mechanism, largest->run.setting);
}

double fitted(std::span<const SizedValue> points, Growth growth, double peers) {
  double x = 0, y = 0, xx = 0, xy = 0;
  const auto count = static_cast<double>(points.size());
  for (const SizedValue& point : points) {
    const double at = basis(growth, point.peers);
    x += at / count;
    y += point.value / count;
    xx += at * at / count;
    xy += at * point.value / count;
  }
  return y + (xy - x * y) / (xx - x * x) * (basis(growth, peers) - x);
}

double fit_error(std::span<const SizedValue> points, Growth growth, double known) {
  const SizedValue& last = points.back();
  const double off = fitted(points.first(points.size() - 1), growth, last.peers) - last.value;
  return off == 0 ? 0 : off / (last.value + known);
}

double announcement_octets(double peers) {
  const aoim::PresenceConfig config;
  double listed = peers - 1;
  if (listed > static_cast<double>(config.most_listed)) {
    // Each part begins with the last entry of the previous part.
    const double parts = std::ceil((listed - 1) / static_cast<double>(config.part - 1));
    listed = (listed + parts - 1) / parts;
  }
  const double timed = std::min(kMostTimed, peers - 1);
  return kFixedOctets + kTimedOctets * timed + kListedOctets * listed +
         static_cast<double>(peer::kUdpIpv4Headers);
}

std::optional<FittedRow> fitted_row(std::span<const ScaleRow> rows, std::size_t mechanism,
                                    const ScaleSetting& setting, bool is_divided) {
  const auto ladder = ladder_of(rows, mechanism, setting);
  if (ladder.size() < kFewestSizes) return std::nullopt;
  const ScaleDesign design = design_of(mechanism);
  const auto peers = static_cast<double>(setting.peers);
  const auto largest = static_cast<double>(ladder.back()->peers());
  const bool is_claimed = peers <= kFarthest * largest && (is_divided || !design.areas);
  FittedRow out{mechanism, setting.peers, setting.crowd.entities, {}, {}};
  for (const std::string_view name : kFitted) {
    const Growth growth = growth_of(name, design);
    std::vector<SizedValue> points;
    for (const ScaleRow* run : ladder) {
      const auto size = static_cast<double>(run->peers());
      points.push_back({size, scale_measure(name).of(*run) - announced(name, size)});
    }
    out.errors.push_back(fit_error(points, growth, announced(name, largest)));
    const bool is_known = is_claimed && std::abs(out.errors.back()) <= kMostFitError;
    const double value = fitted(points, growth, peers) + announced(name, peers);
    out.values.push_back(is_known ? std::optional(value) : std::nullopt);
  }
  return out;
}

std::vector<FittedRow> fitted_rows(std::span<const ScaleRow> rows, const ScaleSetting& setting) {
  std::vector<FittedRow> out;
  const bool is_divided = groups_suffice(setting);
  for (std::size_t mechanism = 0; mechanism < kMechanisms.size(); ++mechanism)
    if (auto row = fitted_row(rows, mechanism, setting, is_divided)) out.push_back(std::move(*row));
  return out;
}

double log_slope(std::span<const double> x, std::span<const double> y) {
  if (x.size() < 2) return 0;
  const auto n = static_cast<double>(x.size());
  double sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double u = std::log(x[i]), v = std::log(y[i]);
    sx += u;
    sy += v;
    sxx += u * u;
    sxy += u * v;
  }
  const double spread = n * sxx - sx * sx;
  return spread > 1e-12 * n * sxx ? (n * sxy - sx * sy) / spread : 0;
}

double power_of(std::span<const ScaleRow* const> ladder, std::string_view measure) {
  std::vector<double> x, y;
  for (const ScaleRow* row : ladder) {
    x.push_back(static_cast<double>(row->peers()));
    y.push_back(std::max(scale_measure(measure).of(*row), 1e-12));
  }
  return log_slope(x, y);
}

std::vector<GrowthRow> growth_rows(std::span<const ScaleRow> rows) {
  std::vector<GrowthRow> out;
  for (std::size_t mechanism = 0; mechanism < kMechanisms.size(); ++mechanism) {
    const auto ladder = ladder_of(rows, mechanism);
    if (ladder.size() < 2) return {};
    out.push_back({mechanism, power_of(ladder, "heard_packets_per_s"),
                   power_of(ladder, "heard_updates_per_s"), power_of(ladder, "cpu_share")});
  }
  return out;
}

std::string growth_text(std::span<const GrowthRow> rows) {
  if (rows.empty()) return {};
  constexpr auto kRight = tools::TextTable::Align::right;
  tools::TextTable table(
      {{"EACH PEER"}, {"HEARD", kRight}, {"HEARD UPDATES", kRight}, {"CPU", kRight}});
  for (const GrowthRow& row : rows)
    table.add({std::string(kMechanisms[row.mechanism].short_name),
               fmt::format("{:.2f}", row.packets), fmt::format("{:.2f}", row.updates),
               fmt::format("{:.2f}", row.cpu)});
  return "Growth with the number of peers, as a power of it\n" + table.text();
}

std::string growth_json(std::span<const GrowthRow> rows) {
  std::string out;
  for (const GrowthRow& row : rows)
    tools::JsonObject(out)
        .text("kind", "growth")
        .text("mechanism", kMechanisms[row.mechanism].name)
        .value("heard_packets_power", row.packets)
        .value("heard_updates_power", row.updates)
        .value("cpu_power", row.cpu)
        .end("\n");
  return out;
}

std::string fitted_text(std::span<const FittedRow> rows) {
  std::string out;
  while (!rows.empty()) {
    const FittedRow& first = rows.front();
    std::vector<tools::TextTable::Column> columns{{"EACH PEER"}};
    for (const std::string_view name : kFitted)
      columns.push_back({std::string(scale_measure(name).title), tools::TextTable::Align::right});
    tools::TextTable table(columns);
    std::size_t count = 0;
    for (; count < rows.size() && rows[count].peers == first.peers &&
           rows[count].entities == first.entities;
         ++count) {
      const FittedRow& row = rows[count];
      std::vector<std::string> cells{std::string(kMechanisms[row.mechanism].short_name)};
      for (std::size_t i = 0; i < std::size(kFitted); ++i)
        cells.push_back(row.values[i] ? measure_text(scale_measure(kFitted[i]), *row.values[i])
                                      : "?");
      table.add(cells);
    }
    out += fmt::format("{}{} peers with {} entities, fitted to the runs\n{}",
                       out.empty() ? "" : "\n", first.peers, first.entities, table.text());
    rows = rows.subspan(count);
  }
  if (out.empty()) return out;
  return out + fmt::format(
                   "?: the largest run is more than {:g} % off what the others predict, or cells "
                   "share groups.\n",
                   100 * kMostFitError);
}

std::string fitted_json(std::span<const FittedRow> rows) {
  std::string out;
  for (const FittedRow& row : rows) {
    tools::JsonObject object(out);
    object.text("kind", "fitted")
        .text("mechanism", kMechanisms[row.mechanism].name)
        .value("peers", row.peers)
        .value("entities", row.entities);
    for (std::size_t i = 0; i < std::size(kFitted); ++i)
      object.number(kFitted[i], row.values[i])
          .number(std::string(kFitted[i]) + "_error", row.errors[i]);
    object.end("\n");
  }
  return out;
}

}  // namespace reckon::bench
