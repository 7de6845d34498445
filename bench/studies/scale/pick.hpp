// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The cheapest policy of an exercise within an error: chosen by prediction, checked by processes.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "reckon/bench/studies/scale/prediction.hpp"

namespace reckon::bench {

/// The policies that are tried: all combinations of a position of each list.
inline constexpr std::array kPickThresholds{0.06, 0.12, 0.25, 0.5, 1.0};  ///< of the error
inline constexpr std::array kPickCells{0.3, 0.6, 1.2};                    ///< of the radius
inline constexpr std::array<std::size_t, 3> kPickPools{1, 64, 256};
/// A policy: positions in the three lists.
using PolicyPlace = std::array<std::size_t, 3>;

[[nodiscard]] ScaleSetting with_policy(const ScaleSetting& exercise, double error,
                                       const PolicyPlace& place);
/// The policies one step away, along one list each.
[[nodiscard]] std::vector<PolicyPlace> neighbours_of(const PolicyPlace& place);

/// A policy with its prediction.
struct Policy {
  PolicyPlace place;
  WholeRun predicted;
};
/// The one with the least CPU among those with a p99 pose error of at most `error` [m]; null if
/// there is none.
[[nodiscard]] const Policy* cheapest_policy(std::span<const Policy> policies, double error);

/// The pick, then its neighbours.
struct PolicyPick {
  double error = 0;            ///< p99 pose error that is allowed [m]
  std::size_t tried = 0;       ///< policies that were predicted
  std::vector<WholeRow> rows;  ///< the pick first; empty if no policy reaches the error
};
/// @param costs for the predictions  @return none if `progress` ended it
[[nodiscard]] std::optional<PolicyPick> pick_policy(const ScaleSetting& exercise, double error,
                                                    const LiveCosts& costs, Meeting meeting,
                                                    const ScaleProgress& progress);
/// The policy in words, and whether a neighbour within the error was cheaper.
[[nodiscard]] std::string pick_text(const PolicyPick& pick);

}  // namespace reckon::bench
