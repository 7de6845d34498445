// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Search of many boxes: along a short path, near a point or in a box. A tree of four-wide
// axis-aligned boxes in single precision. The padding of the boxes exceeds the rounding of all
// numbers in a query, so that a result may have too many boxes but never too few.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <utility>
#include <vector>

namespace reckon::haptics {

/// Built once. Queries do not allocate, accept any finite input and may run on many threads.
class BoundingVolumeTree {
 public:
  BoundingVolumeTree() = default;

  /// For a search without prefetch: it ignores the runs to be visited later.
  struct NoNews {
    void operator()(std::uint32_t /*first*/, std::uint32_t /*count*/) const noexcept {}
  };

  /// @param boxes   one per item [m], at most 2^31
  /// @param padding [m] added on all sides, on top of the padding for rounding
  BoundingVolumeTree(std::span<const Eigen::AlignedBox3d> boxes, double padding);

  /// The same for boxes that are made when needed: twice each. 0.2 us an item; 56 octets each until
  /// it is built.
  using BoxOf = std::function<Eigen::AlignedBox3d(std::size_t item)>;
  BoundingVolumeTree(std::size_t count, const BoxOf& box_of, double padding);

  /// Items in the order of the leaves. Queries return places in this list.
  [[nodiscard]] const std::vector<std::uint32_t>& order() const noexcept { return order_; }

  /// Moves that list out of the tree, for an owner who stores the items in this order.
  [[nodiscard]] std::vector<std::uint32_t> take_order() noexcept { return std::move(order_); }

  // The searches below call `soon(first, count)` for a run as it is found, before it is visited or
  // dropped: a time to prefetch the data of a visit from the cache's next level.

  /// Visits runs of items whose boxes, grown by `radius` [m], lie along origin + t step, t in
  /// [0, limit], roughly nearest first. `visit(first, count)` gets places in order() and may lower
  /// `limit` for the rest of the search.
  template <class Visit, class Soon = NoNews>
  void along_segment(const Eigen::Vector3d& origin, const Eigen::Vector3d& step, double radius,
                     const double& limit, Visit&& visit, Soon&& soon = {}) const;

  /// Visits runs of items that a ball of `radius` [m] about origin + t step may meet, t in [0,
  /// limit], roughly in the order of contact; `visit` as above. For a ball larger than its step.
  template <class Visit, class Soon = NoNews>
  void along_ball(const Eigen::Vector3d& origin, const Eigen::Vector3d& step, double radius,
                  const double& limit, Visit&& visit, Soon&& soon = {}) const;

  /// Visits runs of items whose boxes are nearer to p than `limit` [m], nearest boxes first;
  /// `visit` as above.
  template <class Visit, class Soon = NoNews>
  void near_point(const Eigen::Vector3d& p, const double& limit, Visit&& visit,
                  Soon&& soon = {}) const;

  /// Visits runs of items, `visit(first, count)` with places in order(). They contain every item
  /// whose box meets or touches `box` [m], and a few more.
  void overlapping(const Eigen::AlignedBox3d& box, auto&& visit) const;

  /// A box of the tree, for custom searches, such as of two trees at once.
  struct Branch {
    Eigen::AlignedBox3d box;  ///< [m], bounds of its content
    std::uint32_t first = 0;  ///< index in order(); without items the number of a node
    std::uint32_t count = 0;  ///< items; 0: visit_children(first, ..)
  };

  /// The branch of all items. The tree must not be empty.
  [[nodiscard]] Branch root() const noexcept { return {bounds_, 0, 0}; }

  /// Calls visit(const Branch&) for each of the one to four branches of a node.
  void visit_children(std::uint32_t node, auto&& visit) const;

  /// Levels below the root.
  [[nodiscard]] int depth() const noexcept { return depth_; }
  /// Greatest depth of any tree.
  static constexpr int kMaxDepth = 60;

 private:
  using Float4 = float __attribute__((vector_size(16)));
  static constexpr std::size_t kWidth = 4;
  static constexpr std::uint32_t kLeafItems = 4;
  static constexpr std::size_t kStack = (kWidth - 1) * kMaxDepth + kWidth;

  /// Four children. With count 0 the child is a node, else a leaf of count items from place child
  /// on.
  struct alignas(64) Node {
    std::array<Float4, 3> lower;
    std::array<Float4, 3> upper;
    std::array<std::uint32_t, kWidth> child{};
    std::array<std::uint32_t, kWidth> count{};
  };
  struct Entry {
    std::uint32_t child;
    std::uint32_t count;
    float key;  // time or distance of the child's box
  };
  /// A segment clipped to the root box, in tree units.
  struct Ray {
    std::array<Float4, 3> origin;
    std::array<Float4, 3> inverse;
    double first = 0.0;   // t at the start of the clipped segment
    double length = 1.0;  // its share of t
  };
  struct Builder;

  static Float4 broadcast(float x) noexcept { return Float4{x, x, x, x}; }
  // Both return b if either is NaN.
  static Float4 lesser(Float4 a, Float4 b) noexcept { return a < b ? a : b; }
  static Float4 greater(Float4 a, Float4 b) noexcept { return a > b ? a : b; }
  static Float4 root(Float4 a) noexcept {
    return Float4{std::sqrt(a[0]), std::sqrt(a[1]), std::sqrt(a[2]), std::sqrt(a[3])};
  }

  [[nodiscard]] bool clip(const Eigen::Vector3d& origin, const Eigen::Vector3d& step, double radius,
                          Ray& ray) const noexcept;
  template <class Soon>
  void push_sorted(const Node& node, Float4 key, Float4 bound, std::array<Entry, kStack>& stack,
                   std::size_t& top, Soon&& soon) const noexcept;

  std::vector<Node> nodes_;
  std::vector<std::uint32_t> order_;
  Eigen::AlignedBox3d bounds_;                        // padded
  Eigen::Vector3d centre_ = Eigen::Vector3d::Zero();  // tree units: (p - centre) * scale
  double scale_ = 1.0;
  int depth_ = 0;
};

template <class Soon>
inline void BoundingVolumeTree::push_sorted(const Node& node, Float4 key, Float4 bound,
                                            std::array<Entry, kStack>& stack, std::size_t& top,
                                            Soon&& soon) const noexcept {
  const std::size_t base = top;
  for (std::size_t lane = 0; lane < kWidth; ++lane) {
    if (!(key[lane] <= bound[lane])) continue;
    if (node.count[lane] > 0) {
      soon(node.child[lane], node.count[lane]);
    } else {
      const Node* const child = &nodes_[node.child[lane]];
      __builtin_prefetch(child);
      __builtin_prefetch(reinterpret_cast<const char*>(child) + 64);
    }
    std::size_t place = top++;
    while (place > base && stack[place - 1].key < key[lane]) {
      stack[place] = stack[place - 1];
      --place;
    }
    stack[place] = {node.child[lane], node.count[lane], key[lane]};
  }
}

template <class Visit, class Soon>
void BoundingVolumeTree::along_segment(const Eigen::Vector3d& origin, const Eigen::Vector3d& step,
                                       double radius, const double& limit, Visit&& visit,
                                       Soon&& soon) const {
  Ray ray;
  if (nodes_.empty() || !clip(origin, step, radius, ray)) return;
  // The margin exceeds the rounding of an origin at this distance.
  const Float4 grow = broadcast(static_cast<float>(radius * scale_) * 1.00001f);

  // Slightly late, so that rounding of the time never drops the box of a nearer hit.
  const auto last = [&] {
    return static_cast<float>((limit - ray.first) / ray.length) * 1.00001f + 1e-5f;
  };
  std::array<Entry, kStack> stack;
  std::size_t top = 0;
  stack[top++] = {0, 0, 0.0f};
  while (top > 0) {
    const Entry entry = stack[--top];
    const float end = last();
    if (entry.key > end) continue;
    if (entry.count > 0) {
      visit(entry.child, entry.count);
      continue;
    }
    const Node& node = nodes_[entry.child];
    Float4 enter = broadcast(0.0f);
    Float4 leave = broadcast(end);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Float4 t0 = (node.lower[axis] - grow - ray.origin[axis]) * ray.inverse[axis];
      const Float4 t1 = (node.upper[axis] + grow - ray.origin[axis]) * ray.inverse[axis];
      enter = greater(enter, lesser(t0, t1));
      leave = lesser(leave, greater(t0, t1));
    }
    push_sorted(node, enter, leave, stack, top, soon);
  }
}

// The distance of a box from a moving point is a convex function of time, and so stays above its
// tangent at the start. The key is the time at which the tangent falls to the radius.
template <class Visit, class Soon>
void BoundingVolumeTree::along_ball(const Eigen::Vector3d& origin, const Eigen::Vector3d& step,
                                    double radius, const double& limit, Visit&& visit,
                                    Soon&& soon) const {
  if (nodes_.empty()) return;
  const Eigen::Vector3f q = ((origin - centre_) * scale_).cast<float>();
  const Eigen::Vector3f way = (step * scale_).cast<float>();
  // Rounding of the box distance, of the radius and of the tangent.
  const float slack = 8e-7f * (1.0f + q.cwiseAbs().maxCoeff() + way.cwiseAbs().maxCoeff());
  const Float4 reach = broadcast(static_cast<float>(radius * scale_) * 1.000001f + slack);
  const Float4 rate_error = broadcast(slack * way.norm());
  std::array<Entry, kStack> stack;
  std::size_t top = 0;
  stack[top++] = {0, 0, 0.0f};
  while (top > 0) {
    const Entry entry = stack[--top];
    const float end = static_cast<float>(limit) * 1.00001f + 1e-5f;
    if (entry.key > end) continue;
    if (entry.count > 0) {
      visit(entry.child, entry.count);
      continue;
    }
    const Node& node = nodes_[entry.child];
    Float4 squared = broadcast(0.0f);
    Float4 rate = broadcast(0.0f);  // derivative of half the squared distance
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto i = static_cast<Eigen::Index>(axis);
      const Float4 low = broadcast(q[i]) - node.lower[axis];
      const Float4 high = broadcast(q[i]) - node.upper[axis];
      const Float4 gap = high > broadcast(0.0f) ? high : (low >= broadcast(0.0f) ? low - low : low);
      squared += gap * gap;
      rate += gap * broadcast(way[i]);
    }
    const Float4 distance = root(squared);
    const Float4 left = distance * (distance - reach);
    const Float4 fall = greater(rate_error - rate, broadcast(1e-30f));
    // An unused lane stays NaN.
    push_sorted(node, left <= broadcast(0.0f) ? broadcast(0.0f) : left / fall, broadcast(end),
                stack, top, soon);
  }
}

template <class Visit, class Soon>
void BoundingVolumeTree::near_point(const Eigen::Vector3d& p, const double& limit, Visit&& visit,
                                    Soon&& soon) const {
  if (nodes_.empty()) return;
  const Eigen::Vector3f q = ((p - centre_) * scale_).cast<float>();
  const float slack = 4e-7f * (1.0f + q.cwiseAbs().maxCoeff());  // rounding of the box distance
  std::array<Entry, kStack> stack;
  std::size_t top = 0;
  stack[top++] = {0, 0, 0.0f};
  while (top > 0) {
    const Entry entry = stack[--top];
    const float reach = static_cast<float>(limit * scale_) * 1.000001f + slack;
    if (entry.key > reach * reach) continue;
    if (entry.count > 0) {
      visit(entry.child, entry.count);
      continue;
    }
    const Node& node = nodes_[entry.child];
    Float4 squared = broadcast(0.0f);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Float4 x = broadcast(q[static_cast<Eigen::Index>(axis)]);
      const Float4 outside =
          greater(broadcast(0.0f), greater(node.lower[axis] - x, x - node.upper[axis]));
      squared += outside * outside;
    }
    push_sorted(node, squared, broadcast(reach * reach), stack, top, soon);
  }
}

// Every number is rounded like the boxes, which cannot turn "not above" into "above".
void BoundingVolumeTree::overlapping(const Eigen::AlignedBox3d& box, auto&& visit) const {
  if (nodes_.empty()) return;
  const Eigen::Vector3f low = ((box.min() - centre_) * scale_).cast<float>();
  const Eigen::Vector3f high = ((box.max() - centre_) * scale_).cast<float>();
  std::array<std::uint32_t, kStack> stack;
  std::size_t top = 0;
  stack[top++] = 0;
  while (top > 0) {
    const Node& node = nodes_[stack[--top]];
    auto meets = (node.lower[0] <= broadcast(high[0])) & (node.upper[0] >= broadcast(low[0]));
    meets &= (node.lower[1] <= broadcast(high[1])) & (node.upper[1] >= broadcast(low[1]));
    meets &= (node.lower[2] <= broadcast(high[2])) & (node.upper[2] >= broadcast(low[2]));
    for (std::size_t lane = 0; lane < kWidth; ++lane) {
      if (meets[lane] == 0) continue;
      if (node.count[lane] > 0) {
        visit(node.child[lane], node.count[lane]);
      } else {
        stack[top++] = node.child[lane];
      }
    }
  }
}

void BoundingVolumeTree::visit_children(std::uint32_t node, auto&& visit) const {
  const Node& parent = nodes_[node];
  for (std::size_t lane = 0; lane < kWidth; ++lane) {
    if (!(parent.lower[0][lane] <= parent.upper[0][lane])) continue;  // unused
    Branch branch;
    for (Eigen::Index i = 0; i < 3; ++i) {
      const auto axis = static_cast<std::size_t>(i);
      branch.box.min()[i] = static_cast<double>(parent.lower[axis][lane]) / scale_ + centre_[i];
      branch.box.max()[i] = static_cast<double>(parent.upper[axis][lane]) / scale_ + centre_[i];
    }
    branch.first = parent.child[lane];
    branch.count = parent.count[lane];
    visit(branch);
  }
}

}  // namespace reckon::haptics
