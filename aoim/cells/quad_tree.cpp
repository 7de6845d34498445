// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/aoim/cells/quad_tree.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace reckon::aoim {
namespace {

constexpr int kDeepest = 15;  // 4^15 places of the deepest level fit 31 bits

void check(const QuadTreeConfig& config) {
  const auto refuse = [](const std::string& what) { throw std::invalid_argument(what); };
  if (!(config.side > 0.0) || !std::isfinite(config.side) || !is_finite(config.centre)) {
    refuse("a square of " + std::to_string(config.side) +
           " m: side and centre must be finite, the side positive, e.g. 25600");
  }
  if (config.depth > kDeepest) {
    refuse("a depth of " + std::to_string(config.depth) + ": take 0 to 15");
  }
  if (config.pool < 1 || config.pool > kMaximumPool) {
    refuse("a pool of " + std::to_string(config.pool) + " groups: take 1 to 1000");
  }
}

// Columns or rows from the even bits of a place on the Z-order curve.
std::uint32_t even_bits(std::uint32_t place) noexcept {
  std::uint32_t bits = 0;
  for (int i = 0; i < 16; ++i) bits |= ((place >> (2 * i)) & 1u) << i;
  return bits;
}

}  // namespace

QuadTree::QuadTree(const QuadTreeConfig& config) : config_(config) {
  check(config);
  nodes_.push_back({0, GroupIndex{1}});
  leaves_.push_back({0, 0});
}

void QuadTree::quarter(CellId cell) {
  const std::size_t node = node_of(cell);
  const GroupIndex group = nodes_[node].group;
  nodes_[node] = {static_cast<std::uint32_t>(nodes_.size()), {}};
  for (std::int32_t i = 0; i < 4; ++i) {
    const GroupIndex own =
        i == 0 ? group : GroupIndex{static_cast<std::uint16_t>(leaves_.size() + 1)};
    nodes_.push_back({0, own});
    if (i == 0) {
      leaves_[group.value - 1u] = child(cell, i);
    } else {
      leaves_.push_back(child(cell, i));
    }
  }
}

Position QuadTree::centre(CellId cell) const noexcept {
  const auto place = static_cast<std::uint32_t>(cell.q);
  const double size = std::ldexp(config_.side, -cell.r);
  return {config_.centre.x - 0.5 * config_.side + (even_bits(place) + 0.5) * size,
          config_.centre.y - 0.5 * config_.side + (even_bits(place >> 1) + 0.5) * size, 0.0};
}

double QuadTree::distance(CellId cell, const Position& position) const noexcept {
  const double half_square = 0.5 * config_.side, half = std::ldexp(half_square, -cell.r);
  const Position middle = centre(cell);
  const auto inside = [half_square](double value, double about) {
    return std::clamp(value, about - half_square, about + half_square);
  };
  const double x = std::abs(inside(position.x, config_.centre.x) - middle.x);
  const double y = std::abs(inside(position.y, config_.centre.y) - middle.y);
  return std::hypot(std::max(x - half, 0.0), std::max(y - half, 0.0));
}

// East 1, north 2.
std::int32_t QuadTree::quarter_of(CellId cell, const Position& position) const noexcept {
  const Position middle = centre(cell);
  return (position.x >= middle.x ? 1 : 0) + (position.y >= middle.y ? 2 : 0);
}

QuadTree::Place QuadTree::find(const Position& position) const noexcept {
  const Position point = is_finite(position) ? position : config_.centre;
  Place place{0, {0, 0}};
  while (nodes_[place.node].children != 0) {
    const std::int32_t quarter = quarter_of(place.cell, point);
    place = {nodes_[place.node].children + static_cast<std::size_t>(quarter),
             child(place.cell, quarter)};
  }
  return place;
}

CellId QuadTree::cell(const Position& position) const noexcept { return find(position).cell; }

GroupIndex QuadTree::group(const Position& position) const noexcept {
  return nodes_[find(position).node].group;
}

GroupIndex QuadTree::group(CellId cell) const noexcept { return nodes_[node_of(cell)].group; }

// Of a cell that this tree does not have, the leaf that stands for it.
std::size_t QuadTree::node_of(CellId cell) const noexcept {
  const int depth = std::clamp(cell.r, 0, kDeepest);
  std::size_t node = 0;
  for (int level = 1; nodes_[node].children != 0; ++level) {
    const auto quarter =
        level <= depth ? (static_cast<std::uint32_t>(cell.q) >> (2 * (depth - level))) & 3u : 0u;
    node = nodes_[node].children + quarter;
  }
  return node;
}

}  // namespace reckon::aoim
