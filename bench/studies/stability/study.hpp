// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The sweep of a plan: every run's outcome, and what it is worth.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "reckon/bench/studies/stability/plan.hpp"

namespace reckon::bench {

/// What is left of a run, in SI.
struct StabilityResult {
  double least_energy = 0;  ///< [J]; below -1e-9 the coupling made energy
  double peak_force = 0;    ///< [N]
  double rms_speed = 0;     ///< [m/s], of the last third
  double amplitude = 0;     ///< [m], of the last third
  double error_rms = 0;     ///< [N], against what is right
  double error_p95 = 0;
  double truth_rms = 0;  ///< [N], what is right
  double truth_p95 = 0;
  double kept = 0;  ///< share of the stiffness
  bool diverged = false;

  bool operator==(const StabilityResult&) const = default;
};

/// The one word on a run: the first of these that holds, from the end.
enum class StabilityVerdict : std::uint8_t {
  right,        ///< no energy made, force within a tenth
  wrong_force,  ///< passive, and off by more
  cycles,       ///< passive, and does not come to rest under a constant push
  made_energy,  ///< and yet did not run away
  diverged,
};
inline constexpr std::size_t kVerdicts = 5;
[[nodiscard]] std::string_view name_of(StabilityVerdict verdict);

inline constexpr double kMadeEnergy = -1e-9;  ///< [J]
inline constexpr double kWrong = 0.1;         ///< of the right force's rms
inline constexpr double kRest = 0.02;         ///< [m/s], slower is at rest

/// error_rms over truth_rms; nothing where nothing was to be felt.
[[nodiscard]] std::optional<double> force_off(const StabilityResult& result);
/// Whether a run of this setting should come to rest: a constant push against what keeps still.
[[nodiscard]] bool comes_to_rest(const StabilitySetting& setting);
[[nodiscard]] StabilityVerdict verdict_of(const StabilitySetting& setting,
                                          const StabilityResult& result);

/// Results by run; nothing where none is there yet.
using StabilityResults = std::vector<std::optional<StabilityResult>>;

/// Runs those that are missing, on all cores. @param done called for each, one at a time, with its
/// number  @param progress as run_on_all_cores; called at least once where something is to do
/// @return whether all are there
bool run_stability(const StabilityPlan& plan, StabilityResults& results,
                   const std::function<void(std::size_t run)>& done,
                   const std::function<bool(std::size_t done, std::size_t missing)>& progress);

}  // namespace reckon::bench
