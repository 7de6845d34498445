// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/scene/prediction_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <type_traits>

namespace reckon::peer {
namespace {

/// The row of a list whose name the key has; nothing where the key is absent or bad.
template <typename List>
auto row_of(TomlReader& table, std::string_view key, const List& list) -> decltype(&list.front()) {
  const auto word = table.choice(key);
  if (!word) return nullptr;
  return &*std::ranges::find_if(list, [&](const auto& row) { return row.name == *word; });
}

void read_algorithm(TomlReader& table, DeadReckoningConfig& out) {
  const auto word = table.choice("algorithm");
  if (!word) return;
  out.algorithm.reset();
  for (int number = 1; number <= 9; ++number) {
    const auto algorithm = static_cast<pdu::DeadReckoningAlgorithm>(number);
    if (word_of(algorithm) == *word) out.algorithm = algorithm;
  }
}

/// A rule and the quantities that it alone looks at belong together.
template <class Rule>
void check_rule(TomlReader& table, const DeadReckoningConfig& config) {
  const auto& values = config.thresholds.of<Rule>();
  for (const auto& row : Rule::kParameters) {
    const double value = values.*row.field;
    if (config.rule->name == Rule::kName && value == 0 && row.default_value == 0) {
      table.problem("rule", fmt::format("rule '{}' needs '{}' above 0", Rule::kName, row.key));
    }
    if (config.rule->name != Rule::kName && value != row.default_value) {
      table.problem(row.key,
                    fmt::format("only the rule '{0}' takes '{1}': write rule = \"{0}\", or "
                                "take '{1}' out",
                                Rule::kName, row.key));
    }
  }
}

/// The quantities of all rules, and whether they are those of the rule that is named.
void read_rule_parameters(TomlReader& table, DeadReckoningConfig& out) {
  deadreckon::for_each_send_rule([&]<class Rule>(std::type_identity<Rule>) {
    for (const auto& row : Rule::kParameters) {
      table.number(row.key, out.thresholds.of<Rule>().*row.field);
    }
  });
  deadreckon::for_each_send_rule(
      [&]<class Rule>(std::type_identity<Rule>) { check_rule<Rule>(table, out); });
}

}  // namespace

void read_dead_reckoning(TomlReader& table, DeadReckoningConfig& out) {
  read_algorithm(table, out);
  table.number("position", out.thresholds.position);
  table.number("angle", out.thresholds.angle);
  table.number("force", out.thresholds.force);
  table.number("force_share", out.thresholds.weber);
  if (const auto* rule = row_of(table, "rule", deadreckon::kSendRules)) out.rule = rule;
  read_rule_parameters(table, out);
  if (const auto word = table.choice("acceleration")) {
    out.acceleration = *word == "inertial" ? deadreckon::AccelerationReading::inertial
                                           : deadreckon::AccelerationReading::component_rate;
  }
  table.duration("heartbeat", out.heartbeat);
}

void read_convergence(TomlReader& table, ConvergenceConfig& out) {
  if (const auto* row = row_of(table, "curve", deadreckon::kConvergenceCurves)) {
    out.settings.curve = row->curve;
  }
  table.number("duration", out.settings.duration);
  table.number("longest", out.settings.longest);
  table.number("teleport_distance", out.settings.teleport_distance);
  table.number("teleport_angle", out.settings.teleport_angle);
  if (const auto word = table.choice("prediction")) {
    out.prediction = *word == "adaptive" ? Prediction::adaptive : Prediction::as_sent;
  }
}

}  // namespace reckon::peer
