// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// One subscription region against many contiguous update regions: the inner loop of region
// matching, with the instructions that the processor has.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "reckon/bench/interest/region.hpp"

namespace reckon::bench {

/// Instruction set of the comparison. All levels give the same pairs in the same order.
enum class SimdLevel : std::uint8_t { scalar, avx2, avx512 };

/// The best that this processor has.
[[nodiscard]] SimdLevel best_simd_level() noexcept;

/// Update regions by column, with kOverlapPadding readable values behind the last of each.
template <std::size_t D>
struct RegionColumns {
  std::array<const double*, D> lower{}, upper{};
  const std::uint32_t* place = nullptr;  ///< index in the user's list
};

inline constexpr std::size_t kOverlapPadding = 8;

/// Writes the pairs of `subscription`, named `place`, with the update regions [first, first +
/// count) to `out`, in their order. Returns the number of pairs. `out` has room for count +
/// kOverlapPadding.
template <std::size_t D>
using OverlapKernel = std::size_t (*)(const RegionColumns<D>& updates, std::size_t first,
                                      std::size_t count, const Region<D>& subscription,
                                      std::uint32_t place, RegionPair* out);

/// For D = 1, 2, 3. Uses the best available level if the processor lacks `level`.
template <std::size_t D>
[[nodiscard]] OverlapKernel<D> overlap_kernel(SimdLevel level) noexcept;

}  // namespace reckon::bench
