// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// One slot of a NeighbourLayout against runs of others, in single precision: finds the pairs that
// may have begun or ceased to receive each other. It is the inner loop of incremental interest. The
// pairs found are compared exactly afterwards.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "reckon/bench/interest/overlap_kernel.hpp"

namespace reckon::bench {

/// Slots by column, with kBorderPadding readable values behind the last.
struct BorderColumns {
  const float *x = nullptr, *y = nullptr, *z = nullptr;  ///< from an origin near all of them [m]
  /// Squared distances [m^2] between which reception may have changed, for each slot. Null if they
  /// are equal for all slots; then the two values below apply.
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

/// Writes a pair of `slot` and each slot of `runs` at a squared distance between the `least` and
/// `most` of either slot, in the order of the runs. Returns the number of pairs. A distance that is
/// NaN counts as between. The output has room for all slots of the runs.
using BorderKernel = std::size_t (*)(const BorderColumns& columns, std::uint32_t slot,
                                     const SlotRun* runs, std::size_t run_count, SlotPairs out);

/// Uses the best available level if the processor lacks `level`. All levels give the same slots.
[[nodiscard]] BorderKernel border_kernel(SimdLevel level, bool same_for_all) noexcept;

}  // namespace reckon::bench
