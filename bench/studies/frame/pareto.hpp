// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The Pareto front of many settings: those that no other dominates.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace reckon::bench {

/// Costs of a setting: less is better for each. NaN counts as infinite.
using Costs = std::array<double, 3>;

/// The setting that dominates another: none of its costs is greater, and one is less or, if all are
/// equal, it has a lower index.
struct Beaten {
  std::size_t by = 0;
  bool equal = false;  ///< the costs of both are the same
};

/// Mark in a table: "<", "=" for equal costs, empty on the front.
[[nodiscard]] constexpr std::string_view beaten_mark(const std::optional<Beaten>& by) {
  return !by ? "" : by->equal ? "=" : "<";
}

/// For each setting the one on the front that dominates it; no value for a setting on the front. If
/// several dominate it: the one with the least first cost, then the least second cost. Complexity:
/// n times the length of the front.
[[nodiscard]] std::vector<std::optional<Beaten>> mark_front(std::span<const Costs> settings);

}  // namespace reckon::bench
