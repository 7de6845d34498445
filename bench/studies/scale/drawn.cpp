// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/scale/drawn.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "reckon/tools/terminal/json_text.hpp"
#include "reckon/tools/terminal/text_table.hpp"

namespace reckon::bench {
namespace {

constexpr std::array kRates{10.0, 20.0, 30.0};
constexpr std::array<std::size_t, 5> kPools{16, 64, 256, 500, 1000};
constexpr std::array<std::string_view, 4> kMovements{kMixedGait, "walkers", "vehicles", "rest"};

/// "tiers, compressed".
std::string with_text(const ScaleDesign& design) {
  if (design.channels) return design.compression ? "tiers, compressed" : "tiers";
  return design.compression ? "compressed" : "areas alone";
}

ScaleRow whole_row(const WholeRow& row) {
  return {row.run.setting, row.model.mechanism, row.run.as_row()};
}

}  // namespace

ScaleSetting drawn_exercise(std::uint64_t seed, std::size_t number) {
  std::mt19937_64 random(1'000'003 * seed + number);
  // Distributions of the standard library differ from host to host.
  const auto below = [&](std::size_t count) { return static_cast<std::size_t>(random() % count); };
  ScaleSetting setting;
  setting.peers = 8 + below(57);
  setting.crowd.entities = setting.peers * (4 + below(17));
  setting.crowd.movement = kMovements[below(kMovements.size())];
  setting.rate = kRates[below(kRates.size())];
  setting.grid.pool = kPools[below(kPools.size())];
  setting.whole.channels = below(3) > 0;
  setting.whole.compression = below(3) > 0;
  setting.seed = setting.crowd.seed = 1 + below(1'000'000);
  setting.fresh = true;
  // What was said at the start is said again 15 s later: counted of all, whoever came when.
  setting.warm_up = 12;
  if (setting.crowd.movement == "rest") setting.seconds = 30;  // in which little is said
  return setting;
}

WholeRow run_drawn(const ScaleSetting& setting, const ScaleProgress& progress) {
  WholeRow row;
  const auto part = [&](double from, double to) {
    return
        [=, &progress](double share) { return !progress || progress(from + (to - from) * share); };
  };
  constexpr double kModel = 0.1;  // of the time
  row.model = {setting, kMechanisms.size() - 1, run_world(setting, setting.whole, part(0, kModel))};
  row.run = run_whole_peers(setting, Meeting::simulated, part(kModel, 1));
  return row;
}

double difference_of(const WholeRow& row, const DrawnBar& bar) {
  const ScaleMeasure& measure = scale_measure(bar.measure);
  const double model = measure.of(row.model), whole = measure.of(whole_row(row));
  return model > 0 ? whole / model - 1 : 0;
}

bool is_beyond(const WholeRow& row) {
  return std::ranges::any_of(kDrawnBars, [&](const DrawnBar& bar) {
    return !(std::abs(difference_of(row, bar)) <= bar.most);
  });
}

std::string drawn_text(std::span<const WholeRow> rows) {
  constexpr auto kRight = tools::TextTable::Align::right;
  std::vector<tools::TextTable::Column> columns{{"EXERCISE"}};
  for (const DrawnBar& bar : kDrawnBars) columns.push_back({std::string(bar.title), kRight});
  tools::TextTable table(columns);
  for (const WholeRow& row : rows) {
    const ScaleSetting& setting = row.run.setting;
    std::vector<std::string> cells{
        fmt::format("{} x {} {}", setting.peers, setting.crowd.entities, setting.crowd.movement)};
    for (const DrawnBar& bar : kDrawnBars) {
      const double difference = difference_of(row, bar);
      cells.push_back(fmt::format("{:+.0f} %{}", 100 * difference,
                                  std::abs(difference) <= bar.most ? " " : "!"));
    }
    table.add(cells);
    table.add({fmt::format("  {:g}/s, pool {}, {}", setting.rate, setting.grid.pool,
                           with_text(setting.whole))});
  }
  const auto beyond = static_cast<std::size_t>(std::ranges::count_if(rows, is_beyond));
  std::string bars;
  for (const DrawnBar& bar : kDrawnBars)
    bars += fmt::format("{}{} {:g} %", bars.empty() ? "" : ", ", bar.title, 100 * bar.most);
  return fmt::format(
      "What whole simulated peers do over what the model says, drawn by a seed\n{}\n"
      "Bars: {}; !: beyond.\n{}\n",
      table.text(), bars,
      beyond == 0 ? fmt::format("The model holds in all {}.", rows.size())
                  : fmt::format("The model is beyond its bars in {} of {}.", beyond, rows.size()));
}

std::string drawn_json(std::span<const WholeRow> rows) {
  std::string out;
  for (const WholeRow& row : rows) {
    const ScaleSetting& setting = row.run.setting;
    tools::JsonObject object(out);
    object.text("kind", "drawn")
        .value("peers", setting.peers)
        .value("entities", setting.crowd.entities)
        .value("rate_hz", setting.rate)
        .text("movement", setting.crowd.movement)
        .value("pool", setting.grid.pool)
        .value("tiers", setting.whole.channels)
        .value("compression", setting.whole.compression)
        .value("seed", setting.seed);
    for (const DrawnBar& bar : kDrawnBars) {
      const ScaleMeasure& measure = scale_measure(bar.measure);
      object.value("model_" + std::string(bar.measure), measure.of(row.model));
      object.value("whole_" + std::string(bar.measure), measure.of(whole_row(row)));
    }
    object.value("beyond", is_beyond(row)).end("\n");
  }
  return out;
}

}  // namespace reckon::bench
