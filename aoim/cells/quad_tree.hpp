// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Cells of uneven size: a square of the scene, quartered where much traffic has many recipients. A
// cell has its own group, numbered along the Z-order curve. All peers of a scene need the same
// tree. Equal demands or cells give the same tree on every machine, because it uses whole numbers
// and the four operations and square roots of IEEE 754 in one order. Its epoch orders successive
// trees: a tree with a higher epoch replaces the one before.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "reckon/aoim/cells/cell_grid.hpp"

namespace reckon::aoim {

/// The square to divide, and the depth.
struct QuadTreeConfig {
  Position centre;                  ///< of the square [m]; height has no effect
  double side = 25'600.0;           ///< of the square [m], > 0
  std::uint8_t depth = 10;          ///< most quarterings of one place, 0 .. 15
  std::size_t pool = kDefaultPool;  ///< G: most cells, 1 .. 1,000
  std::uint32_t epoch = 0;          ///< the tree with the higher epoch applies
};

/// A past position of a sender and listener.
struct Demand {
  Position position;          ///< [m], in S
  double radius = 0.0;        ///< of interest [m], >= 0
  std::uint32_t instant = 0;  ///< demands of one instant receive each other; any number
};

/// Immutable, hence safe from any thread. A place outside the square belongs to the cell of the
/// nearest place inside.
class QuadTree {
 public:
  /// Undivided: one cell.
  /// @throws std::invalid_argument with value and remedy, for a side, depth or pool out of range.
  explicit QuadTree(const QuadTreeConfig& config);

  /// Repeatedly quarters the cell with the most waste: traffic of its senders to listeners that
  /// need the cell but are farther away than their radius. It ends when the pool is used up or
  /// nothing is wasted. Then it merges four cells into one if a quartering elsewhere saves more
  /// than that costs. For set-up: some ns for each pair of demands of one instant.
  /// @throws std::invalid_argument for the reasons of the constructor.
  static QuadTree divided_by(const QuadTreeConfig& config, std::span<const Demand> demands);

  /// The tree in which each of `cells`, in any order, is a cell; the rest of the square has the
  /// largest possible cells. For set-up.
  /// @throws std::invalid_argument for the reasons of the constructor; for a cell outside the
  /// square, deeper than the depth, or inside another one; for more cells than the pool has groups.
  static QuadTree of_cells(const QuadTreeConfig& config, std::span<const CellId> cells);

  /// The path to a cell: the quarters from the whole square to it, as "132"; see child().
  [[nodiscard]] static std::string path_of(CellId cell);
  /// The cell at the end of a path; nothing if it has another character than 0 to 3 or is longer
  /// than the deepest tree.
  [[nodiscard]] static std::optional<CellId> cell_at(std::string_view path) noexcept;

  /// The cell of a point: q is its place on the Z-order curve of its depth, r its depth. NaN counts
  /// as the centre. About 5 ns a quartering.
  [[nodiscard]] CellId cell(const Position& position) const noexcept;
  /// Group of a cell, 1 .. cells(). For a finer cell that this tree lacks, its ancestor's; for a
  /// divided one, its first descendant's.
  [[nodiscard]] GroupIndex group(CellId cell) const noexcept;
  [[nodiscard]] GroupIndex group(const Position& position) const noexcept;
  [[nodiscard]] Position centre(CellId cell) const noexcept;
  /// Horizontal distance from a point, moved into the square, to a cell [m]; 0 inside.
  [[nodiscard]] double distance(CellId cell, const Position& position) const noexcept;
  /// The cell of this group; the whole square for a group without a cell.
  [[nodiscard]] CellId cell_of(GroupIndex group) const noexcept {
    return group.value <= leaves_.size() ? leaves_[group.value - 1u] : CellId{0, 0};
  }
  [[nodiscard]] std::size_t groups() const noexcept { return config_.pool; }
  [[nodiscard]] std::size_t cells() const noexcept { return leaves_.size(); }
  [[nodiscard]] std::size_t groups_in_use() const noexcept { return leaves_.size(); }
  /// All cells by group, that is along the Z-order curve.
  [[nodiscard]] std::span<const CellId> leaves() const noexcept { return leaves_; }
  [[nodiscard]] CellScheme scheme() const noexcept { return CellScheme::quad_tree; }
  /// Side of the smallest cell [m].
  [[nodiscard]] double finest() const noexcept;
  /// Side of the cells of a depth [m].
  [[nodiscard]] double side(std::int32_t depth) const noexcept;
  /// Most groups that a disc of this radius can reach at any position, or a few more. For set-up:
  /// up to 0.1 s.
  [[nodiscard]] std::size_t groups_bound(double radius) const;
  [[nodiscard]] double cells_bound(double) const noexcept {
    return static_cast<double>(leaves_.size());
  }
  [[nodiscard]] const QuadTreeConfig& config() const noexcept { return config_; }

  /// Calls visit(CellId, double distance [m]) for each cell within the radius. Cost: the nodes that
  /// the disc meets, about 10 ns each.
  void for_each_cell_within(const Position& position, double radius, auto&& visit) const {
    if (!(radius >= 0.0) || !is_finite(position)) return;
    descend(0, {0, 0}, position, radius, visit);
  }

  /// One of a cell's quarters, by its number: east 1, north 2.
  static constexpr CellId child(CellId cell, std::int32_t quarter) noexcept {
    return {4 * cell.q + quarter, cell.r + 1};
  }
  /// The quarter of a cell that contains a point of it.
  [[nodiscard]] std::int32_t quarter_of(CellId cell, const Position& position) const noexcept;

 private:
  struct Node {
    std::uint32_t children = 0;  ///< place of the first of four; 0: a leaf
    GroupIndex group;
  };
  void descend(std::size_t node, CellId cell, const Position& position, double radius,
               auto&& visit) const {
    const double away = distance(cell, position);
    if (away > radius) return;
    if (nodes_[node].children == 0) return visit(cell, away);
    for (std::int32_t quarter = 0; quarter < 4; ++quarter) {
      descend(nodes_[node].children + static_cast<std::size_t>(quarter), child(cell, quarter),
              position, radius, visit);
    }
  }
  struct Place {
    std::size_t node;
    CellId cell;
  };
  [[nodiscard]] Place find(const Position& position) const noexcept;
  [[nodiscard]] std::size_t node_of(CellId cell) const noexcept;
  struct Box {
    Position middle;
    double half;
  };
  void grow(CellId cell, std::span<const CellId> divided);
  void count_near(std::size_t node, CellId cell, const Box& box, double radius,
                  std::size_t& count) const noexcept;

  QuadTreeConfig config_;
  std::vector<Node> nodes_;
  std::vector<CellId> leaves_;  ///< by group - 1
};

}  // namespace reckon::aoim
