// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The list of parameters that a study of stability can sweep, each with its name in a scene file.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "reckon/bench/baselines/coupling_simulation.hpp"
#include "reckon/bench/studies/sweep/values.hpp"

namespace reckon::bench {

/// One cell before its mode is set: the input of simulate(), and values that become part of it only
/// together with the rest of the cell.
struct StabilitySetting {
  CouplingRun run;
  EnvironmentKind environment = EnvironmentKind::linear;
  double stiffness = 1000;             ///< [N/m]
  std::optional<double> jitter_share;  ///< of the delay; overrides run.network.jitter
  /// A value of OperatorKind; the value after the last one means `recorded`.
  std::size_t operator_number = 0;
  std::optional<OperatorModel> recorded;
};

/// Value of StabilitySetting::operator_number for a recorded hand.
inline constexpr std::size_t kRecordedOperator = 3;

/// A parameter that can be swept. Values of words are indices into `words`.
struct StabilityParameter {
  std::string_view name;  ///< "impairment.delay"; "delay" is enough if no other name ends with it
  std::string_view meaning;
  ValueRule rule;
  std::span<const std::string_view> words;  ///< empty: numbers
  double (*get)(const StabilitySetting&);
  void (*set)(StabilitySetting&, double);
};

[[nodiscard]] std::span<const StabilityParameter> stability_parameters();

/// Finds a parameter by its name or the end of it. @throws UsageError with the nearest name and
/// all known names
[[nodiscard]] const StabilityParameter& stability_parameter(std::string_view name);

/// One axis: a parameter and the values it takes, at least one.
struct StabilityAxis {
  const StabilityParameter* parameter;
  std::vector<double> values;
};

/// Reads "impairment.delay=0..200ms/5" or "environment=linear,moving". @throws UsageError
[[nodiscard]] StabilityAxis read_stability_axis(std::string_view text);

/// For example "50 ms" or "moving".
[[nodiscard]] std::string value_text(const StabilityParameter& parameter, double value);

}  // namespace reckon::bench
