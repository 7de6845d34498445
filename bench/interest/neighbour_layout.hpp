// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Entities in the order of their cells, at one tick: the candidates of each entity lie in few
// contiguous runs. IncrementalInterest builds one layout each tick.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "reckon/aoim/cells/position.hpp"
#include "reckon/bench/interest/border_kernel.hpp"
#include "reckon/bench/interest/change_kernel.hpp"
#include "reckon/bench/interest/hearer.hpp"

namespace reckon::bench {

/// Pairs of slots that are not yet compared.
struct PairColumns {
  std::vector<std::uint32_t> own, other;
};

/// The region with most of the entities [m].
struct Surroundings {
  aoim::Position middle, least, most;
};

/// Slots sorted by cell. The cells cover the surroundings if memory proportional to the number of
/// slots allows it, else a part of them, and repeat over the plane as a torus. Entities elsewhere
/// that fall into the same cell are compared in vain. Each slot is compared with the later slots of
/// its row and with the slots of the rows above, so that each pair is compared once. One thread.
/// Memory is 53 octets a slot and 4 a cell, and is kept from one tick to the next.
class NeighbourLayout {
 public:
  NeighbourLayout() { plan(0, 0.0, 0.0, {}); }

  /// Begins a layout of up to `count` entities. Entities with a radius of up to `reach` [m] are
  /// compared, up to `slack` [m] beyond it.
  void plan(std::size_t count, double reach, double slack, const Surroundings& around);
  /// The cell of a position, to be passed to count() and then to put(), in the same order.
  [[nodiscard]] std::uint32_t cell_of(const aoim::Position& position) const noexcept {
    return static_cast<std::uint32_t>(cell_at(index(position.y, per_y_) - corner_row_,
                                              index(position.x, per_x_) - corner_column_));
  }
  void count(std::uint32_t cell) noexcept { ++starts_[cell + 2]; }
  /// Called after all entities are counted.
  void sort_cells();
  /// Whether its radius is at most `reach` and it is near enough to the origin to be compared in
  /// single precision. An entity that does not fit is added as `apart`.
  [[nodiscard]] bool fits(const Hearer& hearer) const noexcept {
    const aoim::Position& at = hearer.position;
    return hearer.squared_radius <= reach_ * reach_ && std::abs(at.x - origin_.x) < extent_ &&
           std::abs(at.y - origin_.y) < extent_ && std::abs(at.z - origin_.z) < extent_;
  }
  /// Returns the slot.
  std::uint32_t put(std::uint32_t cell, std::uint32_t entity, const Hearer& hearer,
                    Apart apart) noexcept {
    const std::uint32_t slot = starts_[cell + 1]++;
    hearers_[slot] = hearer;
    entity_[slot] = entity;
    apart_[slot] = apart;
    x_[slot] = static_cast<float>(hearer.position.x - origin_.x);
    y_[slot] = static_cast<float>(hearer.position.y - origin_.y);
    z_[slot] = static_cast<float>(hearer.position.z - origin_.z);
    if (apart != Apart::far) {
      farthest_ = std::max({farthest_, std::abs(x_[slot]), std::abs(y_[slot]), std::abs(z_[slot])});
      least_squared_ = std::min(least_squared_, hearer.squared_radius);
      most_squared_ = std::max(most_squared_, hearer.squared_radius);
    }
    return slot;
  }
  /// Called after all entities are added. Pairs are compared if their distance is up to `inside`
  /// [m] below or up to `outside` above the radius of either; if `inside` is infinite, all pairs
  /// within the radius are.
  void set_border(double inside, double outside);

  /// Number of slots. The slot behind the last has no position and receives nobody.
  [[nodiscard]] std::uint32_t size() const noexcept { return starts_.back(); }
  [[nodiscard]] std::uint32_t entity(std::size_t slot) const noexcept { return entity_[slot]; }
  [[nodiscard]] const Hearer& hearer(std::size_t slot) const noexcept { return hearers_[slot]; }
  [[nodiscard]] Apart apart(std::size_t slot) const noexcept { return apart_[slot]; }
  [[nodiscard]] bool is_apart(std::size_t slot) const noexcept { return apart_[slot] != Apart::no; }
  void set_apart(std::size_t slot, Apart apart) noexcept { apart_[slot] = apart; }
  void clear_apart() { std::fill(apart_.begin(), apart_.end(), Apart::no); }
  [[nodiscard]] double reach() const noexcept { return reach_; }

  /// Columns for a comparison with a layout of another tick. @param link for each slot here, the
  /// slot in `there`
  [[nodiscard]] ChangeColumns beside(const NeighbourLayout& there,
                                     const std::uint32_t* link) const noexcept {
    return {hearers_.data(), there.hearers_.data(), link, entity_.data(), apart_.data()};
  }
  /// Calls compare(own, other, count) with columns of pairs of slots: all pairs within the border,
  /// each once, and some pairs just beyond it. `pairs` is the buffer for them.
  template <typename Compare>
  void for_each_border(SimdLevel level, PairColumns& pairs, Compare&& compare) const;
  /// Calls visit(slot) for all slots that may be within `range` [m] of a position.
  template <typename Visit>
  void for_each_near(const aoim::Position& position, double range, Visit&& visit) const {
    const Span rows = span_of(position.y, range, per_y_, rows_);
    const Span columns = span_of(position.x, range, per_x_, columns_);
    for (std::int64_t row = rows.first; row <= rows.last; ++row) {
      for (std::int64_t column = columns.first; column <= columns.last; ++column) {
        const std::size_t cell = cell_at(row - corner_row_, column - corner_column_);
        for (std::uint32_t slot = starts_[cell]; slot < starts_[cell + 1]; ++slot) visit(slot);
      }
    }
  }
  [[nodiscard]] std::size_t memory() const noexcept;

 private:
  struct Span {
    std::int64_t first, last;
  };
  static constexpr std::int64_t kRowsUp = 2;  // rows above in which neighbours lie
  static constexpr std::int64_t kColumnsOut = 8;
  static constexpr std::int64_t kLeastRows = 8, kLeastColumns = 32;
  static constexpr std::size_t kMostRuns = 1 + 2 * (1 + kRowsUp);
  struct Runs {
    std::array<SlotRun, kMostRuns> runs{};
    std::size_t count = 0;
    std::size_t slots = 0;

    void add(std::uint32_t first, std::uint32_t last) noexcept {
      if (first >= last) return;
      runs[count++] = {first, last};
      slots += last - first;
    }
  };

  [[nodiscard]] static std::int64_t index(double x, double per_unit) noexcept {
    constexpr double kMost = 1LL << 40;
    const double cells = std::clamp(x * per_unit, -kMost, kMost);
    const auto whole = static_cast<std::int64_t>(cells);
    return whole - (cells < static_cast<double>(whole) ? 1 : 0);
  }
  [[nodiscard]] static Span span_of(double x, double range, double per_unit, std::int64_t count);
  void choose_cells(std::size_t count, const Surroundings& around);
  // Wraps an index around the torus: by the mask if there are fewer cells than the surroundings
  // need, else by a division, which is rarely reached.
  [[nodiscard]] static std::int64_t around(std::int64_t at, std::int64_t count,
                                           std::int64_t mask) noexcept {
    at &= mask;
    if (at >= 0 && at < count) return at;
    const std::int64_t rest = at % count;
    return rest < 0 ? rest + count : rest;
  }
  // Rows and columns are counted from the corner.
  [[nodiscard]] std::size_t cell_at(std::int64_t row, std::int64_t column) const noexcept {
    return static_cast<std::size_t>(around(row, rows_, row_mask_) * columns_ +
                                    around(column, columns_, column_mask_));
  }
  void add_row(std::int64_t row, std::int64_t first, std::int64_t last, Runs& runs) const noexcept;
  // Runs with which the last slot of a cell is compared; its other slots are also compared with the
  // later ones of the cell.
  [[nodiscard]] Runs runs_of(std::int64_t row, std::int64_t column) const noexcept;
  [[nodiscard]] BorderColumns columns() const noexcept;

  double reach_ = 0, extent_ = 0, per_x_ = 1, per_y_ = 1;
  aoim::Position origin_;
  std::int64_t rows_ = 1, columns_ = 1, corner_row_ = 0, corner_column_ = 0;
  std::int64_t row_mask_ = -1, column_mask_ = -1;  ///< -1: none
  std::vector<std::uint32_t> starts_, entity_;
  std::vector<Hearer> hearers_;
  std::vector<float> x_, y_, z_, least_, most_;
  std::vector<Apart> apart_;
  // Over the slots that are not far: greatest distance from the origin, for single precision, and
  // the range of squared radii.
  float farthest_ = 0;
  double least_squared_ = 0, most_squared_ = 0;
  bool same_for_all_ = true;
  float least_of_all_ = 0, most_of_all_ = 0;
};

inline void NeighbourLayout::add_row(std::int64_t row, std::int64_t first, std::int64_t last,
                                     Runs& runs) const noexcept {
  const std::size_t from = cell_at(row, first), to = cell_at(row, last);
  if (from <= to) return runs.add(starts_[from], starts_[to + 1]);
  runs.add(starts_[from], starts_[cell_at(row, columns_ - 1) + 1]);
  runs.add(starts_[cell_at(row, 0)], starts_[to + 1]);
}

inline NeighbourLayout::Runs NeighbourLayout::runs_of(std::int64_t row,
                                                      std::int64_t column) const noexcept {
  const std::size_t cell = cell_at(row, column);
  Runs runs;
  // The rest of the cell forms one run with the next cells, or a run by itself.
  runs.runs[0] = {starts_[cell + 1], starts_[cell + 1]};
  runs.count = 1;
  add_row(row, column + 1, column + kColumnsOut, runs);
  if (runs.count > 1 && runs.runs[1].first == runs.runs[0].last) {
    runs.runs[0].last = runs.runs[1].last;
    runs.runs[1] = runs.runs[--runs.count];
  }
  for (std::int64_t up = 1; up <= kRowsUp; ++up) {
    add_row(row + up, column - kColumnsOut, column + kColumnsOut, runs);
  }
  return runs;
}

template <typename Compare>
void NeighbourLayout::for_each_border(SimdLevel level, PairColumns& pairs,
                                      Compare&& compare) const {
  constexpr std::size_t kBatch = 1024;  // pairs: enough for a loop, few enough for the cache
  const BorderKernel kernel = border_kernel(level, same_for_all_);
  const BorderColumns with = columns();
  std::size_t count = 0;
  const auto compare_cell = [&](std::int64_t row, std::int64_t column) {
    const std::size_t cell = cell_at(row, column);
    const std::uint32_t begin = starts_[cell], end = starts_[cell + 1];
    if (begin == end) return;
    Runs runs = runs_of(row, column);
    const std::size_t most = kBatch + runs.slots + (end - begin) + kBorderPadding;
    if (pairs.own.size() < most) {
      pairs.own.resize(2 * most);
      pairs.other.resize(2 * most);
    }
    for (std::uint32_t slot = begin; slot < end; ++slot) {
      runs.runs[0].first = slot + 1;
      count += kernel(with, slot, runs.runs.data(), runs.count,
                      {pairs.own.data() + count, pairs.other.data() + count});
      if (count < kBatch) continue;
      compare(pairs.own.data(), pairs.other.data(), count);
      count = 0;
    }
  };
  for (std::int64_t row = 0; row < rows_; ++row) {
    for (std::int64_t column = 0; column < columns_; ++column) compare_cell(row, column);
  }
  if (count > 0) compare(pairs.own.data(), pairs.other.data(), count);
}

}  // namespace reckon::bench
