// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A subscription or update region of the High Level Architecture: a box in 1 to 3 dimensions.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace reckon::bench {

/// Half-open on every axis: lower <= x < upper. A bound may be infinite: infinite bounds leave a
/// dimension unrestricted. A closed interval, such as a point, uses std::nextafter(upper, infinity)
/// as its upper bound. Units are the user's, separately for each axis.
template <std::size_t D>
struct Region {
  std::array<double, D> lower{}, upper{};

  /// Whether they have a point in common; false if either is empty.
  [[nodiscard]] friend bool overlap(const Region& a, const Region& b) noexcept {
    for (std::size_t axis = 0; axis < D; ++axis) {
      if (!(a.lower[axis] < b.upper[axis] && b.lower[axis] < a.upper[axis])) return false;
    }
    return true;
  }
};

/// A subscription region and an update region that overlap, by their indices in the lists that were
/// passed.
struct RegionPair {
  std::uint32_t subscription = 0, update = 0;

  friend auto operator<=>(const RegionPair&, const RegionPair&) = default;
};

}  // namespace reckon::bench
