// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// CPU time that live peers use on this host beside their loops in simulated time.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "reckon/bench/studies/scale/whole_runs.hpp"

namespace reckon::bench {

/// What live peers used beside their loops, and how often they did what costs.
struct CostSample {
  double wakes = 0, datagrams = 0, ticks = 0;  ///< as in LiveCosts
  double cpu = 0;                              ///< [s]
};
/// The sample of a run of processes. @param loops CPU time of the same run in simulated time [s]
[[nodiscard]] CostSample cost_sample(const WholeRun& run, double loops);

/// The costs that fit the samples best: least squares of relative errors, none below 0. Zero for no
/// samples.
[[nodiscard]] LiveCosts fitted_costs(std::span<const CostSample> samples);

/// "34 us a wake, 1.2 us a datagram, 80 us a tick".
[[nodiscard]] std::string costs_text(const LiveCosts& costs);

/// Runs some peers as processes that do little but wake, receive, or state the motion of their
/// entities, all at once, for some 5 s. @param meeting lo or lan; others are measured on lo
/// @return none if `progress` ended the run  @throws as run_whole_peers() does
[[nodiscard]] std::optional<LiveCosts> measure_live_costs(Meeting meeting,
                                                          const ScaleProgress& progress = {});

}  // namespace reckon::bench
