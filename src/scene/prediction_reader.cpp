// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <string_view>

#include "reckon/peer/scene/scene_sections.hpp"

namespace reckon::peer {
namespace {

/// A rule and the quantity that it alone looks at belong together.
void check_rule(TomlReader& table, const DeadReckoningConfig& config, std::string_view rule,
                std::string_view key, double value) {
  if (config.rule->name == rule && !(value > 0)) {
    table.problem("rule", fmt::format("rule '{}' needs '{}' above 0", rule, key));
  }
  if (config.rule->name != rule && value > 0) {
    table.problem(key, fmt::format("only the rule '{0}' takes '{1}': write rule = \"{0}\", or take "
                                   "'{1}' out",
                                   rule, key));
  }
}

}  // namespace

void check_dead_reckoning(TomlReader& table, DeadReckoningConfig& config) {
  const deadreckon::Thresholds& thresholds = config.thresholds;
  check_rule(table, config, "velocity_aware", "speed_allowance", thresholds.speed_allowance);
  check_rule(table, config, "seen_from", "viewer_distance", thresholds.viewer_distance);
}

}  // namespace reckon::peer
