// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/tune/options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "reckon/pdu/seconds.hpp"
#include "reckon/peer/scene/nearest_word.hpp"
#include "reckon/peer/scene/units.hpp"
#include "reckon/tools/command_line/size_text.hpp"

namespace reckon::bench {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kLeastThreshold = 1e-6, kMostThreshold = 1e4;  // [m], as in scene files
constexpr double kThreeDegrees = 3 * kPi / 180;
constexpr std::size_t kMostThresholds = 100;

std::vector<PoseModel> models_of(const TuneWords& words) {
  if (words.models.empty()) return default_tune_models();
  std::vector<std::string_view> names;
  for (const PoseModel& model : tune_models()) names.push_back(model.name);
  std::vector<PoseModel> models;
  for (const std::string& word : list_of(words.models)) {
    const auto found = std::find(names.begin(), names.end(), word);
    if (found == names.end()) {
      const std::string_view nearest = peer::nearest_word(word, names);
      throw tools::UsageError(
          fmt::format("--models {}: there is no such model{}; give some of {}", word,
                      nearest.empty() ? "" : fmt::format(", did you mean '{}'", nearest),
                      fmt::join(names, ",")));
    }
    const PoseModel& model = tune_models()[static_cast<std::size_t>(found - names.begin())];
    const auto same = [&](const PoseModel& other) { return other.name == model.name; };
    if (std::none_of(models.begin(), models.end(), same)) models.push_back(model);
  }
  return models;
}

std::vector<double> thresholds_of(const TuneWords& words, const TuneGoal& goal, double step) {
  std::vector<double> thresholds;
  for (const std::string& word : list_of(words.thresholds))
    thresholds.push_back(
        quantity_of("--thresholds", word, "m", kLeastThreshold, kMostThreshold, 0));
  if (thresholds.empty()) {
    thresholds = threshold_ladder(step);
    // What is asked for may lie beside what the data suggest.
    if (goal.error)
      for (const double share : {0.1, 0.2, 0.5, 0.8, 1.0})
        thresholds.push_back(std::clamp(share * *goal.error, kLeastThreshold, kMostThreshold));
  }
  std::sort(thresholds.begin(), thresholds.end());
  const auto same = [](double a, double b) { return b <= a * (1 + 1e-9); };
  thresholds.erase(std::unique(thresholds.begin(), thresholds.end(), same), thresholds.end());
  if (thresholds.size() > kMostThresholds)
    throw tools::UsageError(fmt::format("--thresholds: more than {}; give fewer", kMostThresholds));
  return thresholds;
}

}  // namespace

void TuneWords::declare(tools::CommandLine& line) {
  line.word("FILE", file, false,
            "CSV table of motion or capture; with --force a CSV table of a force, or a scene file "
            "(default: two_hands.toml)");
  line.option("--error", error, "the cheapest setting whose p99 error is within this, as in 0.5m");
  line.option("--budget", budget,
              "the most accurate setting within this: 10kB/s, or packets a second as in 40");
  line.option("--models", models, "which to try, as in auto,rvw; default: all that differ");
  line.option("--thresholds", thresholds,
              "which to try, as in 0.1m,0.5m,1m; default: 1-2-5 from a hundredth to ten times the "
              "median way between samples, or in 0.1s");
  line.option(
      "--angle", angle,
      "threshold of orientation; default 3deg where the file tells orientations, else none");
  line.option("--heartbeat", heartbeat, "an update at least so often, default 5s");
  line.option("--delay", delay,
              "mean delay of the network, default none; with --force and a scene too");
  line.option("--jitter", jitter, "delays differ by up to this share of --delay, as in 40%");
  line.option("--loss", loss, "share of updates that are lost, as in 10%");
  line.option("--seed", seed, "of delay and loss (1; with --force the scene's)");
  line.option("--plot", plot, "write the curve to this SVG file");
  line.flag("--all", all, "every row of the table, model by model, not only the front");
  line.flag("--force", force, "a force: by the deadband without a model, or contacts of a scene");
  line.option("--columns", columns, "with --force: one to three columns, as in fx_N,fy_N");
  line.option("--floor", floor, "with --force: differences below are never sent, default 50mN");
  line.option("--for", span, "with --force and a scene: how long the hands move, default 60s");
  line.flag("--json", json, "one JSON object a line for each setting, then the recommendation");
  line.flag("--csv", csv, "the table as CSV");
}

std::vector<std::string> list_of(std::string_view text) {
  std::vector<std::string> words;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(','), text.size());
    std::string_view word = text.substr(0, end);
    while (word.starts_with(' ')) word.remove_prefix(1);
    while (word.ends_with(' ')) word.remove_suffix(1);
    if (!word.empty()) words.emplace_back(word);
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return words;
}

double quantity_of(std::string_view flag, std::string_view text, std::string_view unit,
                   double least, double most, double fallback) {
  if (text.empty()) return fallback;
  const peer::Quantity quantity = peer::parse_quantity(text, unit);
  if (!quantity.good())
    throw tools::UsageError(fmt::format("{} {}: {}", flag, text, quantity.error));
  if (!(quantity.value >= least && quantity.value <= most))
    throw tools::UsageError(fmt::format("{} {}: out of range; give {} to {}", flag, text,
                                        peer::format_quantity(least, unit),
                                        peer::format_quantity(most, unit)));
  return quantity.value;
}

TuneGoal goal_of(const TuneWords& words) {
  TuneGoal goal;
  if (!words.error.empty() && !words.budget.empty())
    throw tools::UsageError("--error and --budget are two goals; give one of them");
  if (!words.error.empty()) goal.error = quantity_of("--error", words.error, "m", 1e-6, 1e5, 0);
  if (words.budget.empty()) return goal;
  constexpr std::string_view kSecond = "/s";
  std::string_view text = words.budget;
  if (text.ends_with(kSecond)) text.remove_suffix(kSecond.size());
  const peer::Quantity packets = peer::parse_quantity(text, "");
  const bool is_packets = packets.good() && text.find('%') == std::string_view::npos;
  if (is_packets && packets.value > 0) {
    goal.packets_per_s = packets.value;
  } else if (const auto octets = tools::parse_size(text)) {
    goal.packets_per_s = static_cast<double>(*octets) / kUpdateOctets;
  } else {
    throw tools::UsageError(
        fmt::format("--budget {}: no rate; give octets a second as in 10kB/s, or packets as in 40",
                    words.budget));
  }
  return goal;
}

TuneOptions options_of(const TuneWords& words, const TuneGoal& goal, double step,
                       bool has_orientation) {
  TuneOptions options;
  options.models = models_of(words);
  options.drop_twins = words.models.empty();
  options.thresholds = thresholds_of(words, goal, step);
  options.angle = quantity_of("--angle", words.angle, "rad", kPi / 180e3, kPi,
                              has_orientation ? kThreeDegrees : kPi);
  options.heartbeat = pdu::to_seconds(words.heartbeat);
  if (!(options.heartbeat >= 0.1))
    throw tools::UsageError("--heartbeat is too short; give 100ms or more");
  options.network.law = peer::delayed_by(words.delay ? pdu::to_seconds(*words.delay) : 0,
                                         quantity_of("--jitter", words.jitter, "", 0, 1, 0),
                                         quantity_of("--loss", words.loss, "", 0, 0.99, 0));
  options.network.seed = words.seed.value_or(1);
  return options;
}

}  // namespace reckon::bench
