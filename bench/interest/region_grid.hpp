// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Update regions of similar size, sorted by the cell of their lower corner: the regions that a
// subscription region overlaps lie in few runs.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "reckon/bench/interest/overlap_kernel.hpp"
#include "reckon/bench/interest/region.hpp"

namespace reckon::bench {

/// Cell sizes at which few of `places` share a cell, but not below `floor`. Judged by a sample of
/// about 4 sqrt(count) of them, so that crowds count by their place. Infinite and equal bounds are
/// allowed.
template <std::size_t D>
[[nodiscard]] std::array<double, D> cell_sides(std::span<const Region<D>> regions,
                                               std::span<const std::uint32_t> places,
                                               const std::array<double, D>& floor);

/// A grid over update regions. If it would have more than twice as many cells as regions, its cells
/// repeat over space, as a torus. Regions that only share a wrapped cell are then compared in vain,
/// but none is missed. One thread; memory is kept from one build to the next.
template <std::size_t D>
class RegionGrid {
 public:
  /// Takes `regions[place]` for each of `places`; all are valid, and there are fewer than 2^31.
  void build(std::span<const Region<D>> regions, std::span<const std::uint32_t> places);

  /// Calls run(first, count) for runs of columns() that contain all regions that overlap
  /// `subscription`. Runs do not share a region.
  template <typename Run>
  void for_each_run(const Region<D>& subscription, Run&& run) const {
    std::array<Range, 3> ranges{};
    for (std::size_t axis = 0; axis < D; ++axis) {
      ranges[axis] = axes_[axis].range(subscription.lower[axis], subscription.upper[axis]);
    }
    for (std::int64_t layer = ranges[2].first; layer <= ranges[2].last; ++layer) {
      for (std::int64_t row = ranges[1].first; row <= ranges[1].last; ++row) {
        run_of_row(row_start(row, layer), ranges[0], run);
      }
    }
  }

  [[nodiscard]] RegionColumns<D> columns() const noexcept;
  /// The cell of a corner, below cell_count().
  [[nodiscard]] std::size_t cell_of(const std::array<double, D>& corner) const noexcept {
    std::size_t cell = 0;
    for (std::size_t axis = D; axis-- > 0;) {
      cell = cell * axes_[axis].count + axes_[axis].wrapped(axes_[axis].clamped(corner[axis]));
    }
    return cell;
  }
  [[nodiscard]] std::size_t cell_count() const noexcept { return starts_.size() - 1; }
  [[nodiscard]] std::size_t memory() const noexcept;

 private:
  struct Range {
    std::int64_t first = 0, last = 0;
  };

  struct Axis {
    double origin = 0, per_unit = 1;  // cells begin at origin, per_unit of them in a unit
    double reach = 0;                 // size of the longest region
    std::size_t count = 1;            // cells, a power of two if they repeat
    bool repeats = false;

    // Monotonic in x, which is the only condition for exactness.
    [[nodiscard]] std::int64_t index(double x) const noexcept {
      constexpr double kMost = 1LL << 40;
      const double cells = std::clamp((x - origin) * per_unit, -kMost, kMost);
      const auto whole = static_cast<std::int64_t>(cells);
      return whole - (cells < static_cast<double>(whole) ? 1 : 0);
    }
    [[nodiscard]] std::int64_t clamped(double x) const noexcept {
      const std::int64_t cell = index(x);
      if (repeats) return cell;
      return std::clamp<std::int64_t>(cell, 0, static_cast<std::int64_t>(count) - 1);
    }
    [[nodiscard]] std::size_t wrapped(std::int64_t cell) const noexcept {
      return repeats ? static_cast<std::size_t>(cell) & (count - 1)
                     : static_cast<std::size_t>(cell);
    }
    // The cells of the lower corners of all regions that overlap [lower, upper).
    [[nodiscard]] Range range(double lower, double upper) const noexcept {
      // Subtracts more than rounding can take from the difference.
      const double farthest = lower - reach - 1e-15 * (std::abs(lower) + reach);
      if (!repeats) return {clamped(farthest), clamped(upper)};
      const auto most = static_cast<std::int64_t>(count);
      const Range cells{index(farthest), index(upper)};
      if (cells.last - cells.first + 1 >= most) return {0, most - 1};
      return cells;
    }
  };

  void choose_cells(std::span<const Region<D>> regions, std::span<const std::uint32_t> places);
  void limit_cells(std::size_t most);

  [[nodiscard]] std::size_t row_start(std::int64_t row, std::int64_t layer) const noexcept {
    std::size_t start = 0;
    if constexpr (D > 2) start = axes_[2].wrapped(layer);
    if constexpr (D > 1) start = start * axes_[1].count + axes_[1].wrapped(row);
    return start * axes_[0].count;
  }

  template <typename Run>
  void run_of_row(std::size_t start, const Range& range, Run& run) const {
    const std::size_t first = axes_[0].wrapped(range.first), last = axes_[0].wrapped(range.last);
    if (first <= last) return run_of_cells(start + first, start + last, run);
    run_of_cells(start + first, start + axes_[0].count - 1, run);
    run_of_cells(start, start + last, run);
  }
  template <typename Run>
  void run_of_cells(std::size_t first, std::size_t last, Run& run) const {
    const std::uint32_t begin = starts_[first], end = starts_[last + 1];
    if (begin < end) run(std::size_t{begin}, std::size_t{end - begin});
  }

  std::array<Axis, D> axes_{};
  std::vector<std::uint32_t> starts_{0, 0};  // start of each cell in the columns, and the end
  std::array<std::vector<double>, D> lower_, upper_;
  std::vector<std::uint32_t> place_, cell_;
};

}  // namespace reckon::bench
