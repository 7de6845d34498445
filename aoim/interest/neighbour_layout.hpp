// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Entities in the order of the places at which they stood once, with a bit for each pair that may
// be within hearing: what IncrementalInterest compares at each tick.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "reckon/aoim/cells/position.hpp"
#include "reckon/aoim/interest/overlap_kernel.hpp"

namespace reckon::aoim {

/// A pair whose bit has changed: `observer` hears `entity` from now on, or no longer.
struct HearingChange {
  std::uint32_t observer = 0, entity = 0;
  bool heard = false;
};

/// Slots sorted by cell. Cells repeat over the plane as a torus, so memory follows the number of
/// slots. Each slot is compared with those behind it in its row and with those of the rows above,
/// so each pair once; a run of neighbours needs no list, for they lie side by side. One thread.
class NeighbourLayout {
 public:
  /// Plans a layout for `count` entities that hear each other up to `reach` [m], and may have moved
  /// by `drift` [m] in the plane since they were put.
  void plan(std::size_t count, double reach, double drift);

  /// First each entity is announced by where it stands, then put in the same order.
  void announce(const Position& anchor) { ++starts_[cell_of(anchor)]; }
  /// All are announced.
  void sort_cells(std::size_t count);
  void put(std::uint32_t entity, const Position& anchor);

  [[nodiscard]] std::size_t size() const noexcept { return count_; }
  [[nodiscard]] std::uint32_t entity(std::size_t slot) const noexcept { return entity_[slot]; }
  [[nodiscard]] Position position(std::size_t slot) const noexcept {
    return {x_[slot], y_[slot], z_[slot]};
  }
  [[nodiscard]] bool is_empty(std::size_t slot) const noexcept { return squared_[slot] <= kEmpty; }
  [[nodiscard]] double reach() const noexcept { return reach_; }
  [[nodiscard]] double drift() const noexcept { return drift_; }
  /// How far from where it was put a place is, in the plane, squared [m^2].
  [[nodiscard]] double drift_squared(std::size_t slot, const Position& position) const noexcept {
    const double dx = position.x - anchor_x_[slot], dy = position.y - anchor_y_[slot];
    return dx * dx + dy * dy;
  }

  /// Where the entity of a slot is now, and up to where it hears; below 0: nobody.
  void move(std::size_t slot, const Position& position) noexcept {
    x_[slot] = position.x;
    y_[slot] = position.y;
    z_[slot] = position.z;
  }
  void fill(std::size_t slot, const Position& position, double radius) noexcept {
    move(slot, position);
    squared_[slot] = radius >= 0 ? radius * radius : kDeaf;
  }
  /// It hears and is heard by nobody from now on.
  void empty(std::size_t slot) noexcept {
    constexpr double kNowhere = std::numeric_limits<double>::quiet_NaN();
    fill(slot, {kNowhere, kNowhere, kNowhere}, 0.0);
    squared_[slot] = kEmpty;
  }

  /// Brings all bits up to the positions and appends what changed, in no order.
  void compare(SimdLevel level, std::vector<HearingChange>& changes);
  /// All bits to what they are at these positions, or to nobody hearing anybody.
  void set_bits(SimdLevel level);
  void clear_bits();
  /// Appends, for each pair of which one hears the other, that it does no longer.
  void take_back(std::vector<HearingChange>& changes) const;

  /// Calls visit(slot) for all slots that may be within `range` [m] of a position now.
  template <typename Visit>
  void for_each_near(const Position& position, double range, Visit&& visit) const {
    const double wide = range + drift_;
    const Span rows = span_of(position.y, wide, per_y_, rows_);
    const Span columns = span_of(position.x, wide, per_x_, columns_);
    for (std::int64_t row = rows.first; row <= rows.last; ++row) {
      for (std::int64_t column = columns.first; column <= columns.last; ++column) {
        const std::size_t cell = cell_at(row, column);
        for (std::size_t slot = starts_[cell]; slot < starts_[cell + 1]; ++slot) visit(slot);
      }
    }
  }
  [[nodiscard]] std::size_t memory() const noexcept;

 private:
  struct Span {
    std::int64_t first, last;
  };
  struct Run {
    std::size_t first = 0, last = 0;
  };
  static constexpr double kDeaf = -0.5, kEmpty = -1.0;  // no square is below 0
  static constexpr std::int64_t kRowsUp = 2;            // in which neighbours lie
  static constexpr std::int64_t kColumnsOut = 8;
  static constexpr std::size_t kLanes = 8;

  [[nodiscard]] static std::int64_t index(double x, double per_unit) noexcept;
  [[nodiscard]] static Span span_of(double x, double range, double per_unit, std::size_t count);
  [[nodiscard]] std::size_t cell_at(std::int64_t row, std::int64_t column) const noexcept {
    return (static_cast<std::size_t>(row) & (rows_ - 1)) * columns_ +
           (static_cast<std::size_t>(column) & (columns_ - 1));
  }
  [[nodiscard]] std::size_t cell_of(const Position& position) const noexcept {
    return cell_at(index(position.y, per_y_), index(position.x, per_x_));
  }
  // The slots of a cell, and the runs that each of them is compared with behind its own.
  struct Block {
    std::size_t begin = 0, end = 0;
    std::size_t own_end = 0;  // of the run that begins behind each slot
    std::array<Run, 2 * (1 + kRowsUp)> runs{};
    std::size_t count = 0;

    void add(std::size_t first, std::size_t last) noexcept {
      if (first < last) runs[count++] = {first, last};
    }
  };
  void add_row(std::int64_t row, std::int64_t first, std::int64_t last, Block& block) const;
  // In an order that depends on the cells alone.
  template <typename Visit>
  void for_each_block(Visit&& visit) const;
  template <typename Compare>
  static void for_each_run(const Block& block, Compare&& compare);
  void count_bits();
  void note(std::size_t slot, std::size_t first, unsigned before, unsigned now,
            std::vector<HearingChange>& changes) const;

  std::uint16_t* compare_scalar(const Block& block, std::uint16_t* bits,
                                std::vector<HearingChange>* changes) const;
  std::uint16_t* compare_avx512(const Block& block, std::uint16_t* bits,
                                std::vector<HearingChange>* changes) const;
  void compare_all(SimdLevel level, std::vector<HearingChange>* changes);

  double reach_ = 0, drift_ = 0, per_x_ = 1, per_y_ = 1;
  std::size_t rows_ = 1, columns_ = 1, count_ = 0;
  std::vector<std::uint32_t> starts_, next_, entity_;
  std::vector<double> x_, y_, z_, squared_, anchor_x_, anchor_y_;
  // Of each run, for eight slots at once: the low octet says whom the slot hears, the high octet
  // who hears it.
  std::vector<std::uint16_t> bits_;
};

}  // namespace reckon::aoim
