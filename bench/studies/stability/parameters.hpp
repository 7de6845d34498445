// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// THE list of what a study of stability can sweep, each by the name that a scene file has for it.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "reckon/bench/baselines/coupling_simulation.hpp"
#include "reckon/bench/studies/sweep/values.hpp"

namespace reckon::bench {

/// One cell before its mode: what simulate() takes, and what only together with the rest of the
/// cell makes a part of it.
struct StabilitySetting {
  CouplingRun run;
  EnvironmentKind environment = EnvironmentKind::linear;
  double stiffness = 1000;             ///< [N/m]
  std::optional<double> jitter_share;  ///< of the delay; goes before run.network.jitter
  /// Of OperatorKind; the one beyond them: `recorded`.
  std::size_t operator_number = 0;
  std::optional<OperatorModel> recorded;
};

/// Of StabilitySetting::operator_number.
inline constexpr std::size_t kRecordedOperator = 3;

/// What can be swept. Values of words are their places in `words`.
struct StabilityParameter {
  std::string_view name;  ///< "impairment.delay"; "delay" will do where no other ends so
  std::string_view meaning;
  ValueRule rule;
  std::span<const std::string_view> words;  ///< empty: numbers
  double (*get)(const StabilitySetting&);
  void (*set)(StabilitySetting&, double);
};

[[nodiscard]] std::span<const StabilityParameter> stability_parameters();

/// By its name or the end of it. @throws UsageError with the nearest, or those that it may mean
[[nodiscard]] const StabilityParameter& stability_parameter(std::string_view name);

/// One axis: a parameter and the values it takes, at least one.
struct StabilityAxis {
  const StabilityParameter* parameter;
  std::vector<double> values;
};

/// "impairment.delay=0..200ms/5", "environment=linear,moving". @throws UsageError
[[nodiscard]] StabilityAxis read_stability_axis(std::string_view text);

/// "50 ms", "moving".
[[nodiscard]] std::string value_text(const StabilityParameter& parameter, double value);

}  // namespace reckon::bench
