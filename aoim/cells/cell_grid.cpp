// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/aoim/cells/cell_grid.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

namespace reckon::aoim {
namespace {

constexpr double kRow = 0.86602540378443864676;  // sqrt(3)/2: rows of hexagons per cell size
constexpr double kInverseRoot3 = 0.57735026918962576451;  // edge of a hexagon per cell size
constexpr double kFarthestCell = 1073741824.0;            // 2^30: sums of two still fit 32 bits

std::int32_t to_index(double value) noexcept {
  if (std::isnan(value)) return 0;
  return static_cast<std::int32_t>(std::clamp(value, -kFarthestCell, kFarthestCell));
}

std::size_t modulo(std::int32_t value, std::size_t size) noexcept {
  const auto n = static_cast<std::int64_t>(size);
  const std::int64_t rest = value % n;
  return static_cast<std::size_t>(rest < 0 ? rest + n : rest);
}

// Nearest centre in axial coordinates: rounds all three cube coordinates and corrects the one with
// the largest error.
CellId round_axial(double q, double r) noexcept {
  const double s = -q - r;
  double round_q = std::round(q), round_r = std::round(r);
  const double round_s = std::round(s);
  const double error_q = std::abs(round_q - q), error_r = std::abs(round_r - r);
  const double error_s = std::abs(round_s - s);
  if (error_q > error_r && error_q > error_s) {
    round_q = -round_r - round_s;
  } else if (error_r > error_s) {
    round_r = -round_q - round_s;
  }
  return {to_index(round_q), to_index(round_r)};
}

// Distance to a hexagon with vertical edges at +-1/2 and corners at (0, +-1/sqrt(3)), size 1.
double hexagon_distance(double x, double y) noexcept {
  x = std::abs(x);
  y = std::abs(y);

  // A point above the corner line belongs to the slanted edge: reflect it onto the upright one.
  const double across = kRow * y - 0.5 * x;  // > 0: above the corner line at 30 degrees
  if (across > 0.0) {
    const double along_x = 0.5 * x + kRow * y, along_y = kRow * x - 0.5 * y;
    x = along_x;
    y = std::abs(along_y);
  }
  const double out = x - 0.5;
  const double past = y - 0.5 * kInverseRoot3;
  if (out <= 0.0) return 0.0;
  return past <= 0.0 ? out : std::hypot(out, past);
}

double square_distance(double x, double y) noexcept {
  return std::hypot(std::max(std::abs(x) - 0.5, 0.0), std::max(std::abs(y) - 0.5, 0.0));
}

// The tile with most cells and both sides >= 2; among equal ones, the one nearest to a square.
void choose_tile(std::size_t pool, std::size_t& columns, std::size_t& rows) noexcept {
  columns = rows = 1;
  for (std::size_t a = 2; a * a <= pool; ++a) {
    const std::size_t b = pool / a;
    if (a * b < columns * rows) continue;
    columns = b;
    rows = a;
  }
}

}  // namespace

CellGrid::CellGrid(const GridConfig& config)
    : config_(config),
      spacing_(config.scheme == CellScheme::square ? config.cell_size
                                                   : 2.0 * kRow * config.cell_size) {
  if (config.scheme != CellScheme::square && config.scheme != CellScheme::hexagonal) {
    throw std::invalid_argument("cell scheme none: take square or hexagonal");
  }
  if (!(config.cell_size > 0.0) || !std::isfinite(config.cell_size)) {
    throw std::invalid_argument("cell size " + std::to_string(config.cell_size) +
                                " m: must be positive, e.g. the radius of interest");
  }
  if (!is_pool(config.pool)) {
    throw std::invalid_argument("a pool of " + std::to_string(config.pool) +
                                " groups: " + std::string(kPoolRemedy));
  }
  choose_tile(config.pool, columns_, rows_);
}

CellId CellGrid::cell(const Position& position) const noexcept {
  const double x = position.x / spacing_, y = position.y / spacing_;
  if (config_.scheme == CellScheme::square)
    return {to_index(std::floor(x)), to_index(std::floor(y))};
  const double r = y / kRow;
  return round_axial(x - 0.5 * r, r);
}

Position CellGrid::centre(CellId cell) const noexcept {
  const double q = cell.q, r = cell.r;
  if (config_.scheme == CellScheme::square) {
    return {(q + 0.5) * spacing_, (r + 0.5) * spacing_, 0.0};
  }
  return {(q + 0.5 * r) * spacing_, r * kRow * spacing_, 0.0};
}

Neighbours CellGrid::neighbours(CellId cell) const noexcept {
  Neighbours result;
  for (std::int32_t dr = -1; dr <= 1; ++dr) {
    for (std::int32_t dq = -1; dq <= 1; ++dq) {
      // A hexagon has only six of the eight neighbours: the ones off the diagonal dq = dr.
      const bool corner = config_.scheme == CellScheme::hexagonal && dq == dr;
      if ((dq == 0 && dr == 0) || corner) continue;
      result.push({cell.q + dq, cell.r + dr});
    }
  }
  return result;
}

double CellGrid::distance(CellId cell, const Position& position) const noexcept {
  const Position middle = centre(cell);
  const double x = (position.x - middle.x) / spacing_;
  const double y = (position.y - middle.y) / spacing_;
  const double unit =
      config_.scheme == CellScheme::square ? square_distance(x, y) : hexagon_distance(x, y);
  return unit * spacing_;
}

GroupIndex CellGrid::group(CellId cell) const noexcept {
  const std::size_t index = modulo(cell.r, rows_) * columns_ + modulo(cell.q, columns_);
  return {static_cast<std::uint16_t>(index + 1)};
}

CellGrid::Rows CellGrid::rows_within(const Position& position, double radius) const noexcept {
  const double size = spacing_;
  if (config_.scheme == CellScheme::square) {
    return {to_index(std::floor((position.y - radius) / size)),
            to_index(std::floor((position.y + radius) / size))};
  }
  // A hexagon's corners are 1/sqrt(3) above and below its centre.
  const double reach = radius + kInverseRoot3 * size;
  return {to_index(std::ceil((position.y - reach) / (kRow * size))),
          to_index(std::floor((position.y + reach) / (kRow * size)))};
}

CellGrid::Rows CellGrid::columns_within(std::int32_t r, const Position& position,
                                        double radius) const noexcept {
  const double size = spacing_;
  if (config_.scheme == CellScheme::square) {
    return {to_index(std::floor((position.x - radius) / size)),
            to_index(std::floor((position.x + radius) / size))};
  }
  const double shift = 0.5 * r * size, reach = radius + 0.5 * size;
  return {to_index(std::ceil((position.x - reach - shift) / size)),
          to_index(std::floor((position.x + reach - shift) / size))};
}

std::size_t CellGrid::groups_within(const Position& position, double radius) const {
  std::vector<bool> reached(columns_ * rows_);
  for_each_cell_within(position, radius,
                       [&](CellId cell, double) { reached[group(cell).value - 1u] = true; });
  return static_cast<std::size_t>(std::count(reached.begin(), reached.end(), true));
}

// Tests discs all over one cell, each enlarged to contain the discs of the centres around it.
std::size_t CellGrid::groups_bound(double radius) const {
  constexpr int kSteps = 16;
  const std::size_t all = columns_ * rows_;
  const bool vast = !(cells_bound(radius) < 64.0 * static_cast<double>(all) + 1024.0);
  if (vast) return all;
  const bool square = config_.scheme == CellScheme::square;
  const double slant = square ? 0.0 : 0.5, height = square ? 1.0 : kRow;
  const double reach = radius + 0.5 / kSteps * spacing_ * std::hypot(1.0 + slant, height);
  std::size_t most = 0;
  for (int i = 0; i < kSteps * kSteps && most < all; ++i) {
    const double u = (i % kSteps + 0.5) / kSteps, v = (i / kSteps + 0.5) / kSteps;
    const Position middle{(u + slant * v) * spacing_, height * v * spacing_, 0.0};
    most = std::max(most, groups_within(middle, reach));
  }
  return most;
}

double CellGrid::cells_bound(double radius) const noexcept {
  const double side = 2.0 * radius / spacing_ + 3.0;
  return side * side / kRow;
}

}  // namespace reckon::aoim
