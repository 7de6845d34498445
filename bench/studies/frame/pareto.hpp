// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Which of many settings nothing beats: the Pareto front.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace reckon::bench {

/// What a setting costs, each by itself: less is better. Not a number counts as infinite.
using Costs = std::array<double, 3>;

/// What a setting is beaten by: another that costs no more in anything, and less in something or,
/// where all are equal, stands before it.
struct Beaten {
  std::size_t by = 0;
  bool equal = false;  ///< the costs of both are the same
};

/// In a table: "<", "=" for the same as another, nothing on the front.
[[nodiscard]] constexpr std::string_view beaten_mark(const std::optional<Beaten>& by) {
  return !by ? "" : by->equal ? "=" : "<";
}

/// For each setting the one that beats it, itself on the front; nothing for one on the front. Of
/// several that beat it: the cheapest by the first cost, then by the second. Cost: n times the
/// length of the front.
[[nodiscard]] std::vector<std::optional<Beaten>> mark_front(std::span<const Costs> settings);

}  // namespace reckon::bench
