// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/stability/study.hpp"

#include <algorithm>
#include <array>
#include <mutex>

#include "reckon/bench/studies/sweep/all_cores.hpp"

namespace reckon::bench {
namespace {

StabilityResult result_of(const CouplingOutcome& outcome) {
  return {outcome.least_energy,   outcome.peak_force, outcome.rms_speed, outcome.amplitude,
          outcome.error_rms,      outcome.error_p95,  outcome.truth_rms, outcome.truth_p95,
          outcome.stiffness_kept, outcome.diverged};
}

}  // namespace

std::string_view name_of(StabilityVerdict verdict) {
  constexpr std::array<std::string_view, kVerdicts> kNames{
      "right", "wrong force", "does not settle", "makes energy", "runs away"};
  return kNames[static_cast<std::size_t>(verdict)];
}

std::optional<double> force_off(const StabilityResult& result) {
  if (result.diverged || !(result.truth_rms > 0)) return std::nullopt;
  return result.error_rms / result.truth_rms;
}

bool comes_to_rest(const StabilitySetting& setting) {
  return setting.operator_number == static_cast<std::size_t>(OperatorKind::push) &&
         (setting.environment == EnvironmentKind::linear ||
          setting.environment == EnvironmentKind::hardening);
}

StabilityVerdict verdict_of(const StabilitySetting& setting, const StabilityResult& result) {
  // NaN counts as energy made.
  if (result.diverged) return StabilityVerdict::diverged;
  if (!(result.least_energy >= kMadeEnergy)) return StabilityVerdict::made_energy;
  if (comes_to_rest(setting) && !(result.rms_speed <= kRest)) return StabilityVerdict::cycles;
  if (const auto off = force_off(result); off && !(*off <= kWrong))
    return StabilityVerdict::wrong_force;
  return StabilityVerdict::right;
}

bool run_stability(const StabilityPlan& plan, StabilityResults& results,
                   const std::function<void(std::size_t)>& done,
                   const std::function<bool(std::size_t, std::size_t)>& progress) {
  std::vector<std::size_t> missing;
  for (std::size_t run = 0; run < results.size(); ++run)
    if (!results[run]) missing.push_back(run);
  std::mutex mutex;
  return run_on_all_cores(
      missing.size(),
      [&](std::size_t i, const std::atomic<bool>&) {
        const std::size_t run = missing[i];
        const StabilityResult result = result_of(simulate(plan.run(run)));
        const std::lock_guard lock(mutex);
        results[run] = result;
        done(run);
      },
      [&](std::size_t count) { return progress(count, missing.size()); });
}

}  // namespace reckon::bench
