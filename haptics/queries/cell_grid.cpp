// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/queries/cell_grid.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace reckon::haptics {
namespace {

using Eigen::AlignedBox3d;
using Eigen::Vector3d;

// Greatest distance from the origin in cells; cells beyond have no number.
constexpr double kMostCells = 4e18;

std::uint64_t mixed(std::uint64_t x) {
  x ^= x >> 32;
  x *= 0x9E3779B97F4A7C15u;
  return x ^ (x >> 29);
}

bool is_box(const AlignedBox3d& box) { return (box.min().array() <= box.max().array()).all(); }

}  // namespace

CellGrid::CellGrid(std::size_t numbers) {
  grow_to(std::max<std::size_t>(numbers, 1));
  pairs_.reserve(numbers);
}

// Cell of a box's lower corner, at the level whose cells are at least as large as the box.
CellGrid::Cell CellGrid::cell_of(const AlignedBox3d& box) noexcept {
  if (!is_box(box)) return {};
  const Cell everywhere{0, 0, 0, kEverywhere};
  const double edge = box.sizes().maxCoeff();
  int power = kLeastPower;
  if (edge > 0.0 && std::isfinite(edge))
    power = std::max(kLeastPower, static_cast<int>(std::ilogb(edge)) + 1);
  const int level = power - kLeastPower;
  if (!std::isfinite(edge) || level >= kLevels) return everywhere;
  const Vector3d at = (box.min() * std::ldexp(1.0, -power)).array().floor();
  if (!(at.cwiseAbs().maxCoeff() < kMostCells)) return everywhere;
  return {static_cast<std::int64_t>(at.x()), static_cast<std::int64_t>(at.y()),
          static_cast<std::int64_t>(at.z()), level};
}

CellGrid::Spot CellGrid::spot_of(const Cell& cell) const noexcept {
  const auto part = [](std::int64_t x) { return static_cast<std::uint64_t>(x); };
  const std::uint64_t hash =
      mixed(part(cell.x) * 73856093u + part(cell.y) * 19349663u + part(cell.z) * 83492791u +
            static_cast<std::uint64_t>(cell.level) * 2654435761u);
  return {hash & (buckets_.size() - 1), static_cast<std::uint32_t>(hash >> 32)};
}

void CellGrid::grow_to(std::size_t numbers) {
  if (numbers <= entries_.size()) return;
  entries_.resize(std::max(numbers, entries_.size() + entries_.size() / 2));
  links_.resize(entries_.size());
  const std::size_t buckets = std::bit_ceil(2 * entries_.size());
  if (buckets <= buckets_.size()) return;
  buckets_.assign(buckets, kNone);
  for (std::uint32_t i = 0; i < entries_.size(); ++i)
    if (entries_[i].cell.level >= 0) link(i);
}

void CellGrid::link(std::uint32_t number) noexcept {
  const Spot spot = spot_of(entries_[number].cell);
  std::uint32_t& first = buckets_[spot.bucket];
  links_[number] = {spot.tag, kNone, first};
  if (first != kNone) links_[first].before = number;
  first = number;
}

void CellGrid::unlink(std::uint32_t number) noexcept {
  const Link& link = links_[number];
  (link.before == kNone ? buckets_[spot_of(entries_[number].cell).bucket]
                        : links_[link.before].after) = link.after;
  if (link.after != kNone) links_[link.after].before = link.before;
}

void CellGrid::place(std::uint32_t number, const AlignedBox3d& box) {
  grow_to(std::size_t{number} + 1);
  Entry& entry = entries_[number];
  const Cell cell = cell_of(box);
  entry.box = box;
  if (cell == entry.cell) return;
  remove(number);
  if (cell.level < 0) return;
  entry.cell = cell;
  link(number);
  ++size_;
  if (in_level_[static_cast<std::size_t>(cell.level)]++ == 0)
    levels_ |= std::uint64_t{1} << cell.level;
}

void CellGrid::remove(std::uint32_t number) noexcept {
  if (number >= entries_.size() || entries_[number].cell.level < 0) return;
  Cell& cell = entries_[number].cell;
  unlink(number);
  --size_;
  if (--in_level_[static_cast<std::size_t>(cell.level)] == 0)
    levels_ &= ~(std::uint64_t{1} << cell.level);
  cell = {};
}

std::span<const BoxPair> CellGrid::overlaps() {
  pairs_.clear();
  for (std::uint32_t i = 0; i < entries_.size(); ++i)
    if (entries_[i].cell.level >= 0) find_pairs_of(i);
  return pairs_;
}

// Finds pairs of a box with boxes of its own level and larger ones: the smaller box searches.
void CellGrid::find_pairs_of(std::uint32_t number) {
  const int own = entries_[number].cell.level;
  for (std::uint64_t left = levels_ >> own << own; left != 0; left &= left - 1) {
    const int level = std::countr_zero(left);
    if (level == kEverywhere) {
      find_in_cell(number, {0, 0, 0, kEverywhere});
    } else {
      find_in_level(number, level);
    }
  }
}

// A box that overlaps this one has its lower corner at most one cell below, and not above it.
CellGrid::CellRange CellGrid::range_of(const AlignedBox3d& box, int level) noexcept {
  const double scale = std::ldexp(1.0, -(level + kLeastPower));
  return {(box.min() * scale).array().floor() - 1.0, (box.max() * scale).array().floor()};
}

double CellGrid::CellRange::cells() const noexcept {
  if (!(low.cwiseAbs().maxCoeff() < kMostCells) || !(high.cwiseAbs().maxCoeff() < kMostCells))
    return std::numeric_limits<double>::infinity();
  return ((high - low).array() + 1.0).prod();
}

void CellGrid::find_in_level(std::uint32_t number, int level) {
  const Entry& entry = entries_[number];
  const auto [low, high] = range_of(entry.box, level);
  const auto index = [](double x) { return static_cast<std::int64_t>(x); };
  const bool same = level == entry.cell.level;
  Cell cell;
  cell.level = level;
  // Of two boxes of one level, the one in the lower cell searches.
  for (cell.x = same ? entry.cell.x : index(low.x()); cell.x <= index(high.x()); ++cell.x) {
    const bool level_x = same && cell.x == entry.cell.x;
    for (cell.y = level_x ? entry.cell.y : index(low.y()); cell.y <= index(high.y()); ++cell.y) {
      const bool level_y = level_x && cell.y == entry.cell.y;
      for (cell.z = level_y ? entry.cell.z : index(low.z()); cell.z <= index(high.z()); ++cell.z)
        find_in_cell(number, cell);
    }
  }
}

void CellGrid::find_in_cell(std::uint32_t number, const Cell& cell) {
  const Entry& entry = entries_[number];
  const bool own = cell == entry.cell;
  const Spot spot = spot_of(cell);
  for (std::uint32_t i = buckets_[spot.bucket]; i != kNone; i = links_[i].after)
    if (is_in(i, cell, spot) && (!own || i > number) && meet(entry.box, entries_[i].box))
      note(number, i);
}

void CellGrid::note(std::uint32_t one, std::uint32_t other) {
  pairs_.push_back({std::min(one, other), std::max(one, other)});
}

}  // namespace reckon::haptics
