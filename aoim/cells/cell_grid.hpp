// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Cuts the plane of the scene into cells and gives each cell a multicast group. The map needs no
// directory: a tile of a x b cells, a b <= G, repeats over the plane. Every peer computes the same
// group, and a cell shares its group with none of its neighbours.
#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>

#include "reckon/aoim/cells/position.hpp"
#include "reckon/aoim/groups/group_index.hpp"
#include "reckon/pdu/codec/enumerations.hpp"

namespace reckon::aoim {

/// Scheme of the cells; a CellGrid accepts square and hexagonal.
using CellScheme = pdu::CellScheme;

/// Square: column and row. Hexagonal: axial coordinates (q to the east, r to the north-north-east).
struct CellId {
  std::int32_t q = 0, r = 0;
  auto operator<=>(const CellId&) const = default;
};

/// Settings that all peers of a scene must share if cells are equal.
struct GridConfig {
  CellScheme scheme = CellScheme::hexagonal;
  /// Side of the square, or of the hexagon (= its centre to a corner) [m], > 0; default 125,
  /// hexagons as large as squares of 200 m. A larger side joins fewer groups per peer and delivers
  /// more unwanted traffic: 2 to 3 times the content of R with squares of side R, 3.5 to 5 with 2
  /// R.
  double cell_size = 125.0;
  /// G, groups in the pool: 4 .. 1,000, or 1 for no partition; default 256.
  std::size_t pool = kDefaultPool;
};

/// Neighbours of one cell: 6 hexagons, or 8 squares (edges and corners).
class Neighbours {
 public:
  void push(CellId cell) noexcept { cells_[count_++] = cell; }
  [[nodiscard]] const CellId* begin() const noexcept { return cells_.data(); }
  [[nodiscard]] const CellId* end() const noexcept { return cells_.data() + count_; }
  [[nodiscard]] std::size_t size() const noexcept { return count_; }

 private:
  std::array<CellId, 8> cells_{};
  std::size_t count_ = 0;
};

/// Cells of the plane z = 0; height has no effect. Immutable, hence safe from any thread.
class CellGrid {
 public:
  /// @throws std::invalid_argument with value and remedy, for a cell size that is not finite and
  /// positive, a pool of 0, 2, 3 or above 1,000, or the scheme `none`.
  explicit CellGrid(const GridConfig& config);

  /// The cell of a point. Coordinates are limited to +-2^30 cells; NaN counts as 0. About 10 ns.
  [[nodiscard]] CellId cell(const Position& position) const noexcept;

  /// Centre of a cell [m], z = 0.
  [[nodiscard]] Position centre(CellId cell) const noexcept;

  /// Cells that touch this one.
  [[nodiscard]] Neighbours neighbours(CellId cell) const noexcept;

  /// Horizontal distance from a point to the nearest point of a cell [m]; 0 inside.
  [[nodiscard]] double distance(CellId cell, const Position& position) const noexcept;

  /// Group of a cell, 1 .. G.
  [[nodiscard]] GroupIndex group(CellId cell) const noexcept;

  /// Group of the cell of a point.
  [[nodiscard]] GroupIndex group(const Position& position) const noexcept {
    return group(cell(position));
  }

  /// A cell of this group: the one of the tile at the origin.
  [[nodiscard]] CellId cell_of(GroupIndex group) const noexcept {
    const auto index = static_cast<std::int32_t>(group.value) - 1;
    const auto columns = static_cast<std::int32_t>(columns_);
    return {index % columns, index / columns};
  }

  /// Groups in use: the cells of the tile.
  [[nodiscard]] std::size_t groups() const noexcept { return columns_ * rows_; }
  [[nodiscard]] std::size_t groups_in_use() const noexcept { return groups(); }
  [[nodiscard]] CellScheme scheme() const noexcept { return config_.scheme; }
  /// The size of a cell [m].
  [[nodiscard]] double finest() const noexcept { return config_.cell_size; }

  /// Calls visit(CellId, double distance [m]) for each cell that a disc reaches (distance <=
  /// radius), row by row. The cost grows with the cells in the disc's bounding box.
  void for_each_cell_within(const Position& position, double radius, auto&& visit) const {
    if (!(radius >= 0.0) || !is_finite(position)) return;
    const Rows rows = rows_within(position, radius);
    for (std::int32_t r = rows.first; r <= rows.last; ++r) {
      const Rows columns = columns_within(r, position, radius);
      for (std::int32_t q = columns.first; q <= columns.last; ++q) {
        const double away = distance({q, r}, position);
        if (away <= radius) visit(CellId{q, r}, away);
      }
    }
  }

  /// Upper bound of the cells that a disc of this radius can reach, for reserving memory or
  /// refusing a radius.
  [[nodiscard]] double cells_bound(double radius) const noexcept;

  /// Most groups that a disc of this radius can reach, at any position: at most as many as with a
  /// radius larger by a ninth of a cell, and all of the tile for a large radius. For set-up: up to
  /// 0.1 s.
  [[nodiscard]] std::size_t groups_bound(double radius) const;

  [[nodiscard]] const GridConfig& config() const noexcept { return config_; }
  /// Cells of the repeating tile along q and r; their product is the number of groups in use.
  [[nodiscard]] std::size_t tile_columns() const noexcept { return columns_; }
  [[nodiscard]] std::size_t tile_rows() const noexcept { return rows_; }

 private:
  struct Rows {
    std::int32_t first = 0, last = -1;
  };
  [[nodiscard]] std::size_t groups_within(const Position& position, double radius) const;
  [[nodiscard]] Rows rows_within(const Position& position, double radius) const noexcept;
  [[nodiscard]] Rows columns_within(std::int32_t r, const Position& position,
                                    double radius) const noexcept;

  GridConfig config_;
  double spacing_ = 0.0;  ///< between centres of cells that share an edge [m]
  std::size_t columns_ = 1;
  std::size_t rows_ = 1;
};

}  // namespace reckon::aoim
