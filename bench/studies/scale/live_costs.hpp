// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// CPU time that live peers use on this host beside their loops in simulated time.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "reckon/bench/studies/scale/whole_runs.hpp"

namespace reckon::bench {

/// What live peers used beside their loops, and how often they did what costs.
struct CostSample {
  CostCounts counts{};
  double cpu = 0;  ///< beside the loops [s], > 0
};

/// The costs that fit the samples best: least squares of relative errors, none below 0. Where
/// samples do not tell two costs apart, their usual ratio decides. Zero for no samples.
[[nodiscard]] LiveCosts fitted_costs(std::span<const CostSample> samples);
/// Mean ratio of what the samples used to what the costs predict for them; 1 for no samples.
[[nodiscard]] double level_of(std::span<const CostSample> samples, const LiveCosts& costs);

/// "34 us a wake, 9 us a pass, .."
[[nodiscard]] std::string costs_text(const LiveCosts& costs);

/// One half of the exercises that cost_samples() can run. An exercise is measured between both.
enum class CostHalf : bool { before, after };

/// Runs two or three exercises of processes, one after the other, some 4 s each. They do little but
/// wake, receive, decide what to send, or state the motion of their entities. @param like the
/// exercise to predict: the same peers (16 at most), cells and mechanisms, but other entities and
/// ticks  @param meeting lo or lan; others are measured on lo  @return empty if `progress` ended
/// them  @throws as run_whole_peers() does
[[nodiscard]] std::vector<CostSample> cost_samples(const ScaleSetting& like, Meeting meeting,
                                                   CostHalf half,
                                                   const ScaleProgress& progress = {});

}  // namespace reckon::bench
