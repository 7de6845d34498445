// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/aoim/cells/quad_tree.hpp"

#include <algorithm>
#include <cmath>
#include <queue>
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
    refuse("a pool of " + std::to_string(config.pool) + " groups: use 1 to 1000");
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

// Appends the node of a cell and all its descendants; `divided`: ascending, the whole square first.
void QuadTree::grow(CellId cell, std::span<const CellId> divided) {
  const std::size_t node = node_of(cell);
  if (!std::binary_search(divided.begin(), divided.end(), cell)) {
    leaves_.push_back(cell);
    nodes_[node].group = {static_cast<std::uint16_t>(leaves_.size())};
    return;
  }
  nodes_[node] = {static_cast<std::uint32_t>(nodes_.size()), {}};
  nodes_.resize(nodes_.size() + 4);
  for (std::int32_t i = 0; i < 4; ++i) grow(child(cell, i), divided);
}

QuadTree QuadTree::of_cells(const QuadTreeConfig& config, std::span<const CellId> cells) {
  QuadTree tree(config);
  std::vector<CellId> divided;
  for (const CellId cell : cells) {
    const bool exists = cell.r >= 0 && cell.r <= config.depth && cell.q >= 0 &&
                        cell.q < std::int64_t{1} << (2 * cell.r);
    if (!exists) throw std::invalid_argument("there is no cell \"" + path_of(cell) + "\"");
    for (CellId above = cell; above.r > 0;) {
      above = {above.q >> 2, above.r - 1};
      divided.push_back(above);
    }
  }
  std::sort(divided.begin(), divided.end());
  divided.erase(std::unique(divided.begin(), divided.end()), divided.end());
  for (const CellId cell : cells) {
    if (std::binary_search(divided.begin(), divided.end(), cell))
      throw std::invalid_argument("the cell \"" + path_of(cell) +
                                  "\" contains others of the list: remove it");
  }
  if (1 + 3 * divided.size() > config.pool) {
    throw std::invalid_argument(std::to_string(1 + 3 * divided.size()) + " cells and " +
                                std::to_string(config.pool) +
                                " groups: each cell needs its own group");
  }
  tree.leaves_.clear();
  tree.grow({0, 0}, divided);
  return tree;
}

std::string QuadTree::path_of(CellId cell) {
  std::string path;
  for (int level = std::clamp(cell.r, 0, kDeepest); level > 0; --level)
    path += static_cast<char>('0' + ((static_cast<std::uint32_t>(cell.q) >> (2 * level - 2)) & 3u));
  return path;
}

std::optional<CellId> QuadTree::cell_at(std::string_view path) noexcept {
  if (path.size() > kDeepest) return {};
  CellId cell{0, 0};
  for (const char quarter : path) {
    if (quarter < '0' || quarter > '3') return {};
    cell = child(cell, quarter - '0');
  }
  return cell;
}

double QuadTree::side(std::int32_t depth) const noexcept {
  return std::ldexp(config_.side, -depth);
}

double QuadTree::finest() const noexcept {
  std::int32_t deepest = 0;
  for (const CellId leaf : leaves_) deepest = std::max(deepest, leaf.r);
  return side(deepest);
}

// Cells with a point within the radius of some point of the box.
void QuadTree::count_near(std::size_t node, CellId cell, const Box& box, double radius,
                          std::size_t& count) const noexcept {
  const Position middle = centre(cell);
  const double reach = 0.5 * side(cell.r) + box.half;
  const double x = std::max(std::abs(middle.x - box.middle.x) - reach, 0.0);
  const double y = std::max(std::abs(middle.y - box.middle.y) - reach, 0.0);
  if (std::sqrt(x * x + y * y) > radius) return;
  if (nodes_[node].children == 0) {
    ++count;
    return;
  }
  for (std::int32_t i = 0; i < 4; ++i)
    count_near(nodes_[node].children + static_cast<std::size_t>(i), child(cell, i), box, radius,
               count);
}

// Refines where most cells may be reached.
std::size_t QuadTree::groups_bound(double radius) const {
  constexpr int kLooks = 2000;
  struct Part {
    std::size_t most;
    Box box;
    bool operator<(const Part& other) const { return most < other.most; }
  };
  const auto part = [&](const Box& box) {
    Part made{0, box};
    count_near(0, {0, 0}, box, radius, made.most);
    return made;
  };
  std::priority_queue<Part> open;
  open.push(part({config_.centre, 0.5 * config_.side}));
  std::size_t found = 0;
  for (int looks = 0; looks < kLooks && open.top().most > found; ++looks) {
    const Box box = open.top().box;
    open.pop();
    found = std::max(found, part({box.middle, 0.0}).most);
    const double half = 0.5 * box.half;
    for (const double x : {-half, half})
      for (const double y : {-half, half})
        open.push(part({{box.middle.x + x, box.middle.y + y, 0.0}, half}));
  }
  return std::max(found, open.top().most);
}

Position QuadTree::centre(CellId cell) const noexcept {
  const auto place = static_cast<std::uint32_t>(cell.q);
  const double size = side(cell.r);
  return {config_.centre.x - 0.5 * config_.side + (even_bits(place) + 0.5) * size,
          config_.centre.y - 0.5 * config_.side + (even_bits(place >> 1) + 0.5) * size, 0.0};
}

double QuadTree::distance(CellId cell, const Position& position) const noexcept {
  const double half_square = 0.5 * config_.side, half = 0.5 * side(cell.r);
  const Position middle = centre(cell);
  const auto inside = [half_square](double value, double about) {
    return std::clamp(value, about - half_square, about + half_square);
  };
  const double x = std::max(std::abs(inside(position.x, config_.centre.x) - middle.x) - half, 0.0);
  const double y = std::max(std::abs(inside(position.y, config_.centre.y) - middle.y) - half, 0.0);
  return std::sqrt(x * x + y * y);  // not hypot, which differs between libraries
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

// For a cell that this tree lacks, the leaf that represents it.
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
