// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Broad phase of collision detection, before measure_pair(): finds overlaps of many moving boxes by
// a hierarchical hash grid, one level for each size of boxes.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace reckon::haptics {

/// Two boxes that overlap or touch; first < second.
struct BoxPair {
  std::uint32_t first = 0, second = 0;
  friend bool operator==(const BoxPair&, const BoxPair&) = default;
};

/// Axis-aligned boxes by the caller's numbers; small numbers keep the table small. A box is in one
/// cell, of a level with cells one to two times its size. Moving a box costs 5 ns within its cell,
/// 30 ns to another. All pairs of 10,000 boxes with few overlaps: 1 ms, linear in boxes and pairs;
/// boxes at one position all form pairs.
///
/// Allocates only when the greatest number or the count of pairs reaches a new maximum. The order
/// of the pairs depends only on the calls. One thread.
///
/// Example:
///   CellGrid grid;
///   for (const Body& body : bodies) grid.place(body.number, shape.bounds_at(body.placement));
///   for (const BoxPair& pair : grid.overlaps()) ..
class CellGrid {
 public:
  /// @param numbers reserved from the start
  explicit CellGrid(std::size_t numbers = 0);

  /// Adds, moves or resizes a box. @param box [m], of any size, possibly infinite. A box with NaN,
  /// or a minimum above its maximum, overlaps nothing
  void place(std::uint32_t number, const Eigen::AlignedBox3d& box);
  /// Removes a box, if it is there.
  void remove(std::uint32_t number) noexcept;
  [[nodiscard]] std::size_t size() const noexcept { return size_; }

  /// All pairs of boxes that overlap or touch, each once. Valid until the next call.
  [[nodiscard]] std::span<const BoxPair> overlaps();
  /// Calls visit(number) for each box that overlaps or touches `box` [m], in any order. Searches
  /// the cells around it, or all boxes if there are fewer of them. `visit` must not change the
  /// grid.
  void visit(const Eigen::AlignedBox3d& box, auto&& visit) const {
    for (std::uint64_t left = levels_; left != 0; left &= left - 1)
      visit_level(box, std::countr_zero(left), visit);
  }

 private:
  static constexpr std::uint32_t kNone = 0xFFFFFFFF;
  // Edges of cells are powers of two [m]: 2^-24 (60 nm) to 2^38.
  static constexpr int kLeastPower = -24;
  static constexpr int kLevels = 63;
  static constexpr int kEverywhere = kLevels;  // list of boxes larger than any cell

  struct Cell {
    std::int64_t x = 0, y = 0, z = 0;
    int level = -1;  // -1: no box
    friend bool operator==(const Cell&, const Cell&) = default;
  };
  struct Entry {
    Eigen::AlignedBox3d box;
    Cell cell;
  };
  /// What a search reads of each box of a bucket, most of which are in other cells: the caches hold
  /// these of many more boxes than entries.
  struct Link {
    std::uint32_t tag = 0;                        // of its cell
    std::uint32_t before = kNone, after = kNone;  // neighbours in its bucket
  };
  /// Where a cell's boxes are.
  struct Spot {
    std::size_t bucket;
    std::uint32_t tag;
  };

  /// Cells of a level with possible overlaps.
  struct CellRange {
    Eigen::Vector3d low, high;
    [[nodiscard]] double cells() const noexcept;
  };
  [[nodiscard]] static CellRange range_of(const Eigen::AlignedBox3d& box, int level) noexcept;
  [[nodiscard]] static bool meet(const Eigen::AlignedBox3d& a,
                                 const Eigen::AlignedBox3d& b) noexcept {
    return (a.min().array() <= b.max().array()).all() && (b.min().array() <= a.max().array()).all();
  }
  void visit_level(const Eigen::AlignedBox3d& box, int level, auto&& visit) const {
    const auto visit_cell = [&](const Cell& cell) {
      const Spot spot = spot_of(cell);
      for (std::uint32_t i = buckets_[spot.bucket]; i != kNone; i = links_[i].after)
        if (is_in(i, cell, spot) && meet(box, entries_[i].box)) visit(i);
    };
    if (level == kEverywhere) return visit_cell({0, 0, 0, kEverywhere});
    const CellRange range = range_of(box, level);
    if (!(range.cells() < static_cast<double>(size_))) {
      for (std::uint32_t i = 0; i < entries_.size(); ++i)
        if (entries_[i].cell.level == level && meet(box, entries_[i].box)) visit(i);
      return;
    }
    const auto index = [](double x) { return static_cast<std::int64_t>(x); };
    Cell cell;
    cell.level = level;
    for (cell.x = index(range.low.x()); cell.x <= index(range.high.x()); ++cell.x)
      for (cell.y = index(range.low.y()); cell.y <= index(range.high.y()); ++cell.y)
        for (cell.z = index(range.low.z()); cell.z <= index(range.high.z()); ++cell.z)
          visit_cell(cell);
  }
  [[nodiscard]] Spot spot_of(const Cell& cell) const noexcept;
  [[nodiscard]] bool is_in(std::uint32_t number, const Cell& cell,
                           const Spot& spot) const noexcept {
    return links_[number].tag == spot.tag && entries_[number].cell == cell;
  }
  [[nodiscard]] static Cell cell_of(const Eigen::AlignedBox3d& box) noexcept;
  void grow_to(std::size_t numbers);
  void link(std::uint32_t number) noexcept;
  void unlink(std::uint32_t number) noexcept;
  void find_pairs_of(std::uint32_t number);
  void find_in_level(std::uint32_t number, int level);
  void find_in_cell(std::uint32_t number, const Cell& cell);
  void note(std::uint32_t one, std::uint32_t other);

  std::vector<Entry> entries_;
  std::vector<Link> links_;             // of the entries
  std::vector<std::uint32_t> buckets_;  // heads of the lists; their number is a power of two
  std::vector<BoxPair> pairs_;
  std::array<std::uint32_t, kLevels + 1> in_level_{};
  std::uint64_t levels_ = 0;  // bit i: level i has boxes; the last bit is kEverywhere
  std::size_t size_ = 0;
};

}  // namespace reckon::haptics
