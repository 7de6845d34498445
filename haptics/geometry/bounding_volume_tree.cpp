// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/geometry/bounding_volume_tree.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace reckon::haptics {

namespace {

// In tree units (1 = diagonal of all boxes): four times the sum of a query's rounding errors.
constexpr double kRoundingPad = 2e-6;
constexpr int kBins = 16;
// Below this level a split halves the items, so that the depth is bounded for any input.
constexpr int kSurfaceAreaLevels = 20;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

using Eigen::Vector3d;
using Double2 = double __attribute__((vector_size(16)));

Double2 greater(Double2 a, Double2 b) { return a > b ? a : b; }

/// A box in tree units, as its greatest extents along -x, -y; -z, z; x, y: a union takes three
/// instructions.
struct Extents {
  std::array<Double2, 3> far{Double2{-kInfinity, -kInfinity}, Double2{-kInfinity, -kInfinity},
                             Double2{-kInfinity, -kInfinity}};

  void extend(const Extents& other) {
    for (std::size_t i = 0; i < far.size(); ++i) far[i] = greater(far[i], other.far[i]);
  }
  [[nodiscard]] Vector3d low() const { return {-far[0][0], -far[0][1], -far[1][0]}; }
  [[nodiscard]] Vector3d high() const { return {far[2][0], far[2][1], far[1][1]}; }
  [[nodiscard]] Vector3d sizes() const { return high() - low(); }
  [[nodiscard]] double half_area() const {
    const Vector3d s = sizes();
    return s.x() * s.y() + s.y() * s.z() + s.z() * s.x();
  }
};

/// A box and where its item is.
struct Item {
  std::array<double, 6> far;  // as Extents, padded
  std::uint32_t number;
  std::uint32_t bin;  // of the split in progress

  Item(const Vector3d& low, const Vector3d& high, std::uint32_t item)
      : far{-low.x(), -low.y(), -low.z(), high.z(), high.x(), high.y()}, number(item), bin(0) {}
  [[nodiscard]] Extents box() const { return std::bit_cast<Extents>(far); }
  [[nodiscard]] double centre(int axis) const {
    constexpr std::array<std::size_t, 3> kLow{0, 1, 2}, kHigh{4, 5, 3};
    const auto i = static_cast<std::size_t>(axis);
    return 0.5 * (far[kHigh[i]] - far[kLow[i]]);
  }
};

/// Bounds of items and of their centres.
struct Bounds {
  Extents box, centres;
  void add(const Item& item) {
    const Extents extents = item.box();
    const Double2 half{0.5, 0.5};
    const Double2 across = half * (extents.far[2] - extents.far[0]);
    const double up = 0.5 * (extents.far[1][1] - extents.far[1][0]);
    box.extend(extents);
    centres.extend({-across, Double2{-up, up}, across});
  }
  void add(const Bounds& other) {
    box.extend(other.box);
    centres.extend(other.centres);
  }
};

struct Bin {
  Bounds bounds;
  std::uint32_t count = 0;
};
using Bins = std::array<Bin, kBins>;

/// The numbers of the bins that have items, ascending.
struct UsedBins {
  std::array<std::uint8_t, kBins> numbers;
  std::size_t count = 0;

  explicit UsedBins(const Bins& bins) {
    for (std::uint8_t bin = 0; bin < kBins; ++bin) {
      if (bins[bin].count > 0) numbers[count++] = bin;
    }
  }
};

/// The last bin of the lower side, by the least sum of area x count of both sides. Two bins or
/// more are used.
std::size_t best_split(const Bins& bins, const UsedBins& used) {
  std::array<double, kBins> upper_cost;
  Extents upper, lower;
  std::uint32_t items = 0;
  for (std::size_t i = used.count - 1; i > 0; --i) {
    const Bin& bin = bins[used.numbers[i]];
    upper.extend(bin.bounds.box);
    items += bin.count;
    upper_cost[i] = upper.half_area() * items;
  }
  items = 0;
  double best_cost = kInfinity;
  std::size_t best = 0;
  for (std::size_t i = 0; i + 1 < used.count; ++i) {
    const Bin& bin = bins[used.numbers[i]];
    lower.extend(bin.bounds.box);
    items += bin.count;
    const double cost = lower.half_area() * items + upper_cost[i + 1];
    if (cost >= best_cost) continue;
    best_cost = cost;
    best = used.numbers[i];
  }
  return best;
}

}  // namespace

/// Builds top-down: each node takes the four ranges that a surface-area heuristic splits off. The
/// items of a range are next to each other, so that each split reads memory in order.
struct BoundingVolumeTree::Builder {
  struct Range {
    std::uint32_t begin, end;
    Bounds bounds;
    [[nodiscard]] std::uint32_t count() const { return end - begin; }
  };

  std::vector<Item>& items;
  std::vector<Node>& nodes;
  Bins bins{};  // of the split in progress, empty between splits
  int deepest = 0;

  [[nodiscard]] Range range(std::uint32_t begin, std::uint32_t end) const {
    Range r{begin, end, {}};
    for (std::uint32_t i = begin; i < end; ++i) r.bounds.add(items[i]);
    return r;
  }

  // Best of 15 planes along the widest axis of the centres, by area x count. False if all centres
  // are in one bin.
  [[nodiscard]] bool area_split(const Range& r, std::array<Range, 2>& halves) {
    int axis = 0;
    const double width = r.bounds.centres.sizes().maxCoeff(&axis);
    if (!(width > 0.0)) return false;
    const double low = r.bounds.centres.low()[axis];
    for (std::uint32_t i = r.begin; i < r.end; ++i) {
      Item& item = items[i];
      const auto place = static_cast<int>((item.centre(axis) - low) / width * kBins);
      item.bin = static_cast<std::uint32_t>(std::min(kBins - 1, place));
      bins[item.bin].bounds.add(item);
      ++bins[item.bin].count;
    }
    const UsedBins used(bins);
    const std::size_t last = used.count > 1 ? best_split(bins, used) : kBins;
    const auto first = items.begin();
    const auto middle = std::partition(first + r.begin, first + r.end,
                                       [&](const Item& item) { return item.bin <= last; });
    const auto split = static_cast<std::uint32_t>(middle - first);
    halves = {Range{r.begin, split, {}}, Range{split, r.end, {}}};
    for (std::size_t i = 0; i < used.count; ++i) {
      Bin& bin = bins[used.numbers[i]];
      halves[used.numbers[i] <= last ? 0 : 1].bounds.add(bin.bounds);
      bin = {};
    }
    return used.count > 1;
  }

  [[nodiscard]] std::array<Range, 2> half_split(const Range& r) {
    int axis = 0;
    r.bounds.box.sizes().maxCoeff(&axis);
    const std::uint32_t middle = r.begin + r.count() / 2;
    const auto first = items.begin();
    std::nth_element(first + r.begin, first + middle, first + r.end,
                     [&](const Item& a, const Item& b) {
                       const double ca = a.centre(axis), cb = b.centre(axis);
                       return ca != cb ? ca < cb : a.number < b.number;
                     });
    return {range(r.begin, middle), range(middle, r.end)};
  }

  [[nodiscard]] std::array<Range, 2> split(const Range& r, int level) {
    std::array<Range, 2> halves;
    if (level < kSurfaceAreaLevels && area_split(r, halves)) return halves;
    return half_split(r);
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
        if (largest == kWidth ||
            parts[i].bounds.box.half_area() > parts[largest].bounds.box.half_area())
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
      const Vector3d low = parts[lane].bounds.box.low(), high = parts[lane].bounds.box.high();
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto i = static_cast<Eigen::Index>(axis);
        // An unused lane is NaN, so that every comparison of a query is false.
        constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
        node.lower[axis][lane] = used ? static_cast<float>(low[i]) : kNone;
        node.upper[axis][lane] = used ? static_cast<float>(high[i]) : kNone;
      }
    }
    return index;
  }
};

BoundingVolumeTree::BoundingVolumeTree(std::span<const Eigen::AlignedBox3d> boxes, double padding)
    : BoundingVolumeTree(
          boxes.size(), [&](std::size_t item) { return boxes[item]; }, padding) {}

BoundingVolumeTree::BoundingVolumeTree(std::size_t count, const BoxOf& box_of, double padding) {
  if (count == 0) return;
  std::vector<Item> items;
  items.reserve(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    const Eigen::AlignedBox3d box = box_of(i);
    bounds_.extend(box);
    items.emplace_back(box.min(), box.max(), i);
  }
  centre_ = bounds_.center();
  const double diagonal = bounds_.sizes().norm();
  scale_ = diagonal > 0.0 ? 1.0 / diagonal : 1.0;
  const Vector3d pad = Vector3d::Constant(padding * scale_ + kRoundingPad);
  for (Item& item : items) {
    const Extents box = item.box();
    item = Item((box.low() - centre_) * scale_ - pad, (box.high() - centre_) * scale_ + pad,
                item.number);
  }
  nodes_.reserve(count / 5 + 1);
  Builder builder{items, nodes_};
  builder.build(builder.range(0, static_cast<std::uint32_t>(count)), 0);
  depth_ = builder.deepest;
  order_.reserve(count);
  for (const Item& item : items) order_.push_back(item.number);
  const Vector3d grow = pad / scale_;
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
