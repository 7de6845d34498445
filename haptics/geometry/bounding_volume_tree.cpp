// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/geometry/bounding_volume_tree.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace reckon::haptics {

namespace {

// In tree units (1 = diagonal of all boxes): four times the sum of a query's rounding errors.
constexpr double kRoundingPad = 2e-6;
constexpr int kBins = 16;
// Below this level a split halves the items, so that the depth is bounded for any input.
constexpr int kSurfaceAreaLevels = 20;

double half_area(const Eigen::AlignedBox3d& box) {
  if (box.isEmpty()) return 0.0;
  const Eigen::Vector3d s = box.sizes();
  return s.x() * s.y() + s.y() * s.z() + s.z() * s.x();
}

}  // namespace

/// Builds top-down: each node takes the four ranges that a surface-area heuristic splits off.
struct BoundingVolumeTree::Builder {
  struct Range {
    std::uint32_t begin, end;
    Eigen::AlignedBox3d box;  // tree units
    [[nodiscard]] std::uint32_t count() const { return end - begin; }
  };

  std::vector<Eigen::AlignedBox3d> boxes;  // padded, tree units
  std::vector<std::uint32_t>& order;
  std::vector<Node>& nodes;
  int deepest = 0;

  [[nodiscard]] Range range(std::uint32_t begin, std::uint32_t end) const {
    Range r{begin, end, {}};
    for (std::uint32_t i = begin; i < end; ++i) r.box.extend(boxes[order[i]]);
    return r;
  }

  [[nodiscard]] double centre(std::uint32_t item, int axis) const {
    return 0.5 * (boxes[item].min()[axis] + boxes[item].max()[axis]);
  }

  // Best of 15 planes along the widest axis of the centres, by area x count.
  [[nodiscard]] std::uint32_t area_split(const Range& r) {
    Eigen::AlignedBox3d centres;
    for (std::uint32_t i = r.begin; i < r.end; ++i) centres.extend(boxes[order[i]].center());
    int axis = 0;
    const double width = centres.sizes().maxCoeff(&axis);
    if (!(width > 0.0)) return r.begin;
    const double low = centres.min()[axis];
    const auto bin_of = [&](std::uint32_t item) {
      return std::min(kBins - 1, static_cast<int>((centre(item, axis) - low) / width * kBins));
    };
    std::array<Eigen::AlignedBox3d, kBins> bin_boxes;
    std::array<std::uint32_t, kBins> counts{};
    for (std::uint32_t i = r.begin; i < r.end; ++i) {
      const auto bin = static_cast<std::size_t>(bin_of(order[i]));
      bin_boxes[bin].extend(boxes[order[i]]);
      ++counts[bin];
    }
    std::array<double, kBins> right_cost{};
    Eigen::AlignedBox3d side;
    std::uint32_t items = 0;
    for (std::size_t bin = kBins - 1; bin > 0; --bin) {
      side.extend(bin_boxes[bin]);
      items += counts[bin];
      right_cost[bin] = half_area(side) * items;
    }
    side.setEmpty();
    items = 0;
    double best_cost = std::numeric_limits<double>::infinity();
    int best = 0;
    for (std::size_t bin = 0; bin + 1 < kBins; ++bin) {
      side.extend(bin_boxes[bin]);
      items += counts[bin];
      const double cost = half_area(side) * items + right_cost[bin + 1];
      if (items == 0 || items == r.count() || cost >= best_cost) continue;
      best_cost = cost;
      best = static_cast<int>(bin) + 1;
    }
    const auto first = order.begin() + r.begin;
    const auto middle = std::partition(first, order.begin() + r.end,
                                       [&](std::uint32_t item) { return bin_of(item) < best; });
    return static_cast<std::uint32_t>(middle - order.begin());
  }

  [[nodiscard]] std::uint32_t half_split(const Range& r) {
    int axis = 0;
    r.box.sizes().maxCoeff(&axis);
    const std::uint32_t middle = r.begin + r.count() / 2;
    std::nth_element(order.begin() + r.begin, order.begin() + middle, order.begin() + r.end,
                     [&](std::uint32_t a, std::uint32_t b) {
                       const double ca = centre(a, axis);
                       const double cb = centre(b, axis);
                       return ca != cb ? ca < cb : a < b;
                     });
    return middle;
  }

  [[nodiscard]] std::array<Range, 2> split(const Range& r, int level) {
    std::uint32_t middle = r.begin;
    if (level < kSurfaceAreaLevels) middle = area_split(r);
    if (middle == r.begin || middle == r.end) middle = half_split(r);
    return {range(r.begin, middle), range(middle, r.end)};
  }

  std::uint32_t build(const Range& all, int level) {
    deepest = std::max(deepest, level);
    std::array<Range, kWidth> parts;
    parts[0] = all;
    std::size_t count = 1;
    while (count < kWidth) {
      std::size_t largest = kWidth;
      for (std::size_t i = 0; i < count; ++i) {
        if (parts[i].count() <= kLeafItems) continue;
        if (largest == kWidth || half_area(parts[i].box) > half_area(parts[largest].box))
          largest = i;
      }
      if (largest == kWidth) break;
      const std::array<Range, 2> halves = split(parts[largest], level);
      parts[largest] = halves[0];
      parts[count++] = halves[1];
    }

    const auto index = static_cast<std::uint32_t>(nodes.size());
    nodes.emplace_back();
    for (std::size_t lane = 0; lane < kWidth; ++lane) {
      const bool used = lane < count;
      const bool leaf = used && parts[lane].count() <= kLeafItems;
      const std::uint32_t child =
          !used ? 0 : (leaf ? parts[lane].begin : build(parts[lane], level + 1));
      Node& node = nodes[index];
      node.child[lane] = child;
      node.count[lane] = leaf ? parts[lane].count() : 0;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto i = static_cast<Eigen::Index>(axis);
        // An unused lane is NaN, so that every comparison of a query is false.
        constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
        node.lower[axis][lane] = used ? static_cast<float>(parts[lane].box.min()[i]) : kNone;
        node.upper[axis][lane] = used ? static_cast<float>(parts[lane].box.max()[i]) : kNone;
      }
    }
    return index;
  }
};

BoundingVolumeTree::BoundingVolumeTree(std::span<const Eigen::AlignedBox3d> boxes, double padding) {
  if (boxes.empty()) return;
  for (const Eigen::AlignedBox3d& box : boxes) bounds_.extend(box);
  centre_ = bounds_.center();
  const double diagonal = bounds_.sizes().norm();
  scale_ = diagonal > 0.0 ? 1.0 / diagonal : 1.0;

  order_.resize(boxes.size());
  std::iota(order_.begin(), order_.end(), 0u);
  const Eigen::Vector3d pad = Eigen::Vector3d::Constant(padding * scale_ + kRoundingPad);
  Builder builder{{}, order_, nodes_};
  builder.boxes.reserve(boxes.size());
  for (const Eigen::AlignedBox3d& box : boxes) {
    builder.boxes.emplace_back((box.min() - centre_) * scale_ - pad,
                               (box.max() - centre_) * scale_ + pad);
  }
  builder.build(builder.range(0, static_cast<std::uint32_t>(boxes.size())), 0);
  depth_ = builder.deepest;
  const Eigen::Vector3d grow = pad / scale_;
  bounds_ = Eigen::AlignedBox3d(bounds_.min() - grow, bounds_.max() + grow);
}

bool BoundingVolumeTree::clip(const Eigen::Vector3d& origin, const Eigen::Vector3d& step,
                              double radius, Ray& ray) const noexcept {
  double first = 0.0;
  double last = 1.0;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const double to_lower = bounds_.min()[axis] - radius - origin[axis];
    const double to_upper = bounds_.max()[axis] + radius - origin[axis];
    if (step[axis] == 0.0) {
      if (to_lower > 0.0 || to_upper < 0.0) return false;
      continue;
    }
    const double t0 = to_lower / step[axis];
    const double t1 = to_upper / step[axis];
    first = std::max(first, std::min(t0, t1));
    last = std::min(last, std::max(t0, t1));
  }
  if (first > last) return false;

  ray.first = first;
  ray.length = std::max(last - first, 1e-300);
  const Eigen::Vector3f from = ((origin + first * step - centre_) * scale_).cast<float>();
  const Eigen::Vector3f way = (step * (ray.length * scale_)).cast<float>();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<Eigen::Index>(axis);
    ray.origin[axis] = broadcast(from[i]);
    // Not zero, so no product is NaN; the box's padding covers the difference.
    const float safe = std::abs(way[i]) > 1e-18f ? way[i] : std::copysign(1e-18f, way[i]);
    ray.inverse[axis] = broadcast(1.0f / safe);
  }
  return true;
}

}  // namespace reckon::haptics
