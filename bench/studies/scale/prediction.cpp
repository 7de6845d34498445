// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/scale/prediction.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <random>
#include <utility>

#include "reckon/bench/studies/pose/study_text.hpp"
#include "reckon/bench/studies/scale/live_costs.hpp"
#include "reckon/bench/studies/scale/mechanisms.hpp"
#include "reckon/tools/terminal/json_text.hpp"
#include "reckon/tools/terminal/text_table.hpp"

namespace reckon::bench {
namespace {

/// A measure of scale_measures() that is predicted.
struct Predicted {
  std::string_view name, title;
  bool is_judged;
};
// THE list.
constexpr std::array kPredicted{Predicted{"sent_packets_per_s", "SENT/s", true},
                                Predicted{"heard_packets_per_s", "HEARD/s", true},
                                Predicted{"heard_bytes_per_s", "B/s", true},
                                Predicted{"wakes_per_s", "WAKES/s", false},
                                Predicted{"cpu_share", "CPU", true},
                                Predicted{"pose_error_p99_m", "POSE", false}};

double value_of(std::string_view name, const WholeRun& run) {
  return scale_measure(name).of({kMechanisms.size() - 1, run});
}
double ratio_of(std::string_view name, const WholeRow& row) {
  return value_of(name, row.simulated) / value_of(name, row.run);
}

double present_load() {
  double load = 0;
  return getloadavg(&load, 1) == 1 ? load : 0;
}

}  // namespace

std::vector<ScaleSetting> drawn_settings(const ScaleSetting& base, std::size_t count,
                                         std::uint64_t seed) {
  std::mt19937_64 random(seed);
  // Even over the logarithm.
  const auto between = [&](double least, double most) {
    return least * std::pow(most / least, std::uniform_real_distribution<double>()(random));
  };
  const auto one_of = [&](const auto& list) {
    return list[std::uniform_int_distribution<std::size_t>(0, std::size(list) - 1)(random)];
  };
  constexpr std::array<std::string_view, 5> kMovements{"rest", "walkers", "vehicles", "flyers",
                                                       kMixedGait};
  std::vector<ScaleSetting> settings;
  while (settings.size() < count) {
    ScaleSetting setting = base;
    setting.peers = static_cast<std::size_t>(std::lround(between(2, 16)));
    setting.crowd.entities = setting.peers * static_cast<std::size_t>(std::lround(between(5, 80)));
    setting.crowd.movement = one_of(kMovements);
    setting.crowd.density = between(100, 1600);
    setting.crowd.seed = setting.seed = random();
    setting.radius = between(50, 400);
    setting.rate = one_of(std::array{10.0, 20.0, 30.0, 60.0});
    setting.thresholds.position = between(0.25, 4);
    setting.grid.cell_size = setting.radius * between(0.4, 1.5);
    setting.grid.pool = one_of(std::array<std::size_t, 3>{1, 64, 256});
    settings.push_back(setting);
  }
  return settings;
}

std::optional<WholeRow> predicted_and_measured(const WholeRun& simulated, Meeting meeting,
                                               const HostsPlan& hosts,
                                               const ScaleProgress& progress) {
  const ScaleSetting& setting = simulated.setting;
  std::vector<CostSample> samples;
  const auto measure = [&](CostHalf half) {
    const auto more = cost_samples(setting, meeting, half, progress);
    samples.insert(samples.end(), more.begin(), more.end());
    return !more.empty();
  };
  // Other hosts say at once what they lack.
  const bool is_first = meeting == Meeting::hosts;
  if (!is_first && !measure(CostHalf::before)) return std::nullopt;
  WholeRow row{{}, simulated, present_load()};
  row.run = meeting == Meeting::hosts ? run_on_hosts(setting, hosts, progress)
                                      : run_whole_peers(setting, meeting, progress);
  row.load = (row.load + present_load()) / 2;
  if (is_first && !measure(CostHalf::before)) return std::nullopt;
  if (!measure(CostHalf::after)) return std::nullopt;
  row.samples = std::move(samples);
  return row;
}

void predict(std::span<WholeRow> rows) {
  std::vector<CostSample> samples;
  for (const WholeRow& row : rows)
    samples.insert(samples.end(), row.samples.begin(), row.samples.end());
  const LiveCosts costs = fitted_costs(samples);
  for (WholeRow& row : rows) {
    row.simulated.costs = costs;
    const double level = level_of(row.samples, costs);
    for (double& cost : row.simulated.costs) cost *= level;
    row.simulated.live_cpu = live_cpu(cost_counts(row.simulated), row.simulated.costs);
  }
}

std::string prediction_text(std::span<const WholeRow> rows) {
  constexpr auto kRight = tools::TextTable::Align::right;
  std::vector<tools::TextTable::Column> columns{
      {"PEERS x ENTITIES"}, {"MOVEMENT"}, {"TICKS/s", kRight}};
  for (const Predicted& one : kPredicted)
    for (const std::string_view part : {"", "IS", "RATIO"})
      columns.push_back({std::string(part.empty() ? one.title : part), kRight});
  columns.insert(columns.end(), {{"WAKE", kRight}, {"LOAD", kRight}});
  tools::TextTable table(columns);
  std::size_t good = 0;
  for (const WholeRow& row : rows) {
    const ScaleSetting& setting = row.run.setting;
    std::vector<std::string> cells{fmt::format("{} x {}", setting.peers, setting.crowd.entities),
                                   std::string(setting.crowd.movement),
                                   fmt::format("{:g}", setting.rate)};
    bool is_good = true;
    for (const Predicted& one : kPredicted) {
      const ScaleMeasure& measure = scale_measure(one.name);
      const double ratio = ratio_of(one.name, row);
      cells.push_back(measure_text(measure, value_of(one.name, row.simulated)));
      cells.push_back(measure_text(measure, value_of(one.name, row.run)));
      cells.push_back(fmt::format("{:.2f}", ratio));
      is_good = is_good && !(one.is_judged && std::abs(ratio - 1) > kGoodPrediction);
    }
    good += is_good;
    cells.push_back(fmt::format("{:.0f} us", 1e6 * row.simulated.costs.front()));
    cells.push_back(fmt::format("{:.1f}", row.load));
    table.add(cells);
  }
  if (rows.empty()) return {};
  return fmt::format(
      "Predicted, and measured of processes (IS); each peer\n{}{} of {} rows are within {:g} % in "
      "datagrams, octets and CPU; {}\n",
      table.text(), good, rows.size(), 100 * kGoodPrediction,
      costs_text(rows.back().simulated.costs));
}

std::string prediction_json(std::span<const WholeRow> rows) {
  std::string out;
  for (const WholeRow& row : rows) {
    const ScaleSetting& setting = row.run.setting;
    const LiveCosts& costs = row.simulated.costs;
    tools::JsonObject object(out);
    object.text("kind", "prediction")
        .value("peers", setting.peers)
        .value("entities", setting.crowd.entities)
        .text("movement", setting.crowd.movement)
        .value("ticks_per_s", setting.rate);
    for (const Predicted& one : kPredicted)
      object.value(one.name, value_of(one.name, row.run))
          .value(fmt::format("predicted_{}", one.name), value_of(one.name, row.simulated));
    for (std::size_t i = 0; i < costs.size(); ++i)
      object.value(fmt::format("{}_cost_s", kCostNames[i]), costs[i]);
    object.value("load", row.load).end("\n");
  }
  return out;
}

}  // namespace reckon::bench
