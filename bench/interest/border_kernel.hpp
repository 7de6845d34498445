// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// One slot of a NeighbourLayout against runs of others, in single precision: whom may it have begun
// or ceased to hear, or be heard by? The inner loop of incremental interest. What it names is
// compared exactly afterwards.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "reckon/bench/interest/overlap_kernel.hpp"

namespace reckon::bench {

/// Slots by column, with kBorderPadding readable values behind the last.
struct BorderColumns {
  const float *x = nullptr, *y = nullptr, *z = nullptr;  ///< from an origin near all of them [m]
  /// Squared distances [m^2] between which hearing may have changed, of each slot; where all have
  /// the same, null, and the two below count.
  const float *least = nullptr, *most = nullptr;
  float least_of_all = 0, most_of_all = 0;
};

inline constexpr std::size_t kBorderPadding = 32;

/// Slots that lie side by side: first .. last - 1.
struct SlotRun {
  std::uint32_t first = 0, last = 0;
};

/// Pairs of slots, in two columns with room for kBorderPadding more.
struct SlotPairs {
  std::uint32_t *own = nullptr, *other = nullptr;
};

/// Writes a pair of `slot` and each slot of `runs` that is at a squared distance from it between
/// the least and the most of either, in their order; returns how many. A distance that is NaN
/// counts as between. There is room for all slots of the runs.
using BorderKernel = std::size_t (*)(const BorderColumns& columns, std::uint32_t slot,
                                     const SlotRun* runs, std::size_t run_count, SlotPairs out);

/// Where the processor lacks `level`, the best that it has. All give the same slots.
[[nodiscard]] BorderKernel border_kernel(SimdLevel level, bool same_for_all) noexcept;

}  // namespace reckon::bench
