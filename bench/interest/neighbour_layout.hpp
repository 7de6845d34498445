// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Entities in the order of the cells they stand in, at one tick: who may hear whom lies in few runs
// side by side. IncrementalInterest makes one each tick.
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

/// Pairs of slots that are not compared yet.
struct PairColumns {
  std::vector<std::uint32_t> own, other;
};

/// Where most of the entities are [m].
struct Surroundings {
  aoim::Position middle, least, most;
};

/// Slots sorted by cell. Cells cover the surroundings, where memory that follows the number of
/// slots allows it, else a part of them, and repeat over the plane as a torus: who is elsewhere but
/// in the same cell is compared in vain. Each slot is compared with those behind it in its row and
/// with those of the rows above, so each pair once. One thread; memory, 53 octets a slot and 4 a
/// cell, is kept from one tick to the next.
class NeighbourLayout {
 public:
  NeighbourLayout() { plan(0, 0.0, 0.0, {}); }

  /// Begins a layout of up to `count` entities, of which those that hear up to `reach` [m] are
  /// compared, up to `slack` [m] beyond it.
  void plan(std::size_t count, double reach, double slack, const Surroundings& around);
  /// The cell of a position, to be given to count() and then to put(), in the same order.
  [[nodiscard]] std::uint32_t cell_of(const aoim::Position& position) const noexcept {
    return static_cast<std::uint32_t>(cell_at(index(position.y, per_y_) - corner_row_,
                                              index(position.x, per_x_) - corner_column_));
  }
  void count(std::uint32_t cell) noexcept { ++starts_[cell + 2]; }
  /// All are counted.
  void sort_cells();
  /// Whether it hears no farther than `reach` and is near enough to the origin to be compared in
  /// single precision; who does not fit is put `apart`.
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
  /// All are put. Compared are pairs whose distance is up to `inside` [m] below or up to `outside`
  /// above the radius of either; infinite `inside`: all that are within it.
  void set_border(double inside, double outside);

  /// Slots; the one behind the last is nowhere and hears nobody.
  [[nodiscard]] std::uint32_t size() const noexcept { return starts_.back(); }
  [[nodiscard]] std::uint32_t entity(std::size_t slot) const noexcept { return entity_[slot]; }
  [[nodiscard]] const Hearer& hearer(std::size_t slot) const noexcept { return hearers_[slot]; }
  [[nodiscard]] Apart apart(std::size_t slot) const noexcept { return apart_[slot]; }
  [[nodiscard]] bool is_apart(std::size_t slot) const noexcept { return apart_[slot] != Apart::no; }
  void set_apart(std::size_t slot, Apart apart) noexcept { apart_[slot] = apart; }
  void clear_apart() { std::fill(apart_.begin(), apart_.end(), Apart::no); }
  [[nodiscard]] double reach() const noexcept { return reach_; }

  /// With a layout of another tick, and the slots in it of those here.
  [[nodiscard]] ChangeColumns beside(const NeighbourLayout& there,
                                     const std::uint32_t* link) const noexcept {
    return {hearers_.data(), there.hearers_.data(), link, entity_.data(), apart_.data()};
  }
  /// Calls compare(own, other, count) with columns of pairs of slots: all that are within the
  /// border, each once, and some that are hardly beyond. `pairs` is for them.
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
  static constexpr std::int64_t kRowsUp = 2;  // in which neighbours lie
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
  // Once around: by the mask where there are fewer cells than surroundings, else by a division that
  // few need.
  [[nodiscard]] static std::int64_t around(std::int64_t at, std::int64_t count,
                                           std::int64_t mask) noexcept {
    at &= mask;
    if (at >= 0 && at < count) return at;
    const std::int64_t rest = at % count;
    return rest < 0 ? rest + count : rest;
  }
  // Rows and columns from the corner on.
  [[nodiscard]] std::size_t cell_at(std::int64_t row, std::int64_t column) const noexcept {
    return static_cast<std::size_t>(around(row, rows_, row_mask_) * columns_ +
                                    around(column, columns_, column_mask_));
  }
  void add_row(std::int64_t row, std::int64_t first, std::int64_t last, Runs& runs) const noexcept;
  // Whom the last slot of a cell is compared with; the others of it besides with those behind.
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
  // Of those that are not far: from the origin in single precision, and up to where they hear.
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
  // The rest of the cell is one run with what follows it, or a run of its own.
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
  constexpr std::size_t kBatch = 1024;  // pairs: many enough for a loop, few enough for the cache
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
