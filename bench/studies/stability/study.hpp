// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The sweep of a plan: the outcome of every run, and its verdict.
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

/// Stored result of a run, in SI units.
struct StabilityResult {
  double least_energy = 0;  ///< [J]; below -1e-9 the coupling made energy
  double peak_force = 0;    ///< [N]
  double rms_speed = 0;     ///< [m/s], over the last third
  double amplitude = 0;     ///< [m], over the last third
  double error_rms = 0;     ///< [N], against the true force
  double error_p95 = 0;
  double truth_rms = 0;  ///< [N], of the true force
  double truth_p95 = 0;
  double kept = 0;  ///< share of the stiffness that is kept
  bool diverged = false;

  bool operator==(const StabilityResult&) const = default;
};

/// Verdict of a run: the last of these that applies.
enum class StabilityVerdict : std::uint8_t {
  right,        ///< no energy made, force within a tenth
  wrong_force,  ///< passive, but the force is off by more
  cycles,       ///< passive, but does not come to rest under a constant push
  made_energy,  ///< but the motion stayed bounded
  diverged,
};
inline constexpr std::size_t kVerdicts = 5;
[[nodiscard]] std::string_view name_of(StabilityVerdict verdict);

inline constexpr double kMadeEnergy = -1e-9;  ///< [J]
inline constexpr double kWrong = 0.1;         ///< share of the true force's rms
inline constexpr double kRest = 0.02;         ///< [m/s], a slower hand is at rest

/// error_rms over truth_rms; no value if there was no true force.
[[nodiscard]] std::optional<double> force_off(const StabilityResult& result);
/// Whether a run of this setting should come to rest: a constant push against an environment that
/// does not move.
[[nodiscard]] bool comes_to_rest(const StabilitySetting& setting);
[[nodiscard]] StabilityVerdict verdict_of(const StabilitySetting& setting,
                                          const StabilityResult& result);

/// Results by run; no value if a run is missing.
using StabilityResults = std::vector<std::optional<StabilityResult>>;

/// Runs the missing ones, on all cores. @param done called for each run, one at a time, with its
/// number @param progress as run_on_all_cores; called at least once if any run is missing
/// @return whether all results are there
bool run_stability(const StabilityPlan& plan, StabilityResults& results,
                   const std::function<void(std::size_t run)>& done,
                   const std::function<bool(std::size_t done, std::size_t missing)>& progress);

}  // namespace reckon::bench
