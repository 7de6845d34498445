// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Searches one or two bounding volume trees with the caller's bound.
#pragma once

#include <array>
#include <cstddef>
#include <utility>

#include "reckon/haptics/geometry/bounding_volume_tree.hpp"

namespace reckon::haptics {

/// Stack of a depth-first search, each entry with the lower bound of its subtree.
template <class Entry, std::size_t kMost>
class BoundStack {
 public:
  void push(const Entry& entry, double bound) noexcept {
    entries_[count_] = entry;
    bounds_[count_++] = bound;
  }
  /// Sorts the entries from index `base` on: the least bound is popped first.
  void sort_from(std::size_t base) noexcept {
    for (std::size_t i = base + 1; i < count_; ++i) {
      for (std::size_t j = i; j > base && bounds_[j - 1] < bounds_[j]; --j) {
        std::swap(bounds_[j - 1], bounds_[j]);
        std::swap(entries_[j - 1], entries_[j]);
      }
    }
  }
  /// @return false: empty
  [[nodiscard]] bool pop(Entry& entry, double& bound) noexcept {
    if (count_ == 0) return false;
    entry = entries_[--count_];
    bound = bounds_[count_];
    return true;
  }
  [[nodiscard]] std::size_t size() const noexcept { return count_; }

 private:
  std::array<Entry, kMost> entries_;
  std::array<double, kMost> bounds_{};
  std::size_t count_ = 0;
};

/// Visits runs of items, `visit(first, count)`, whose `bound(box)` is below `limit`, roughly in the
/// order of their bounds; visit may lower the limit. The bound of a box must not exceed the bounds
/// of its content.
void search_tree(const BoundingVolumeTree& tree, const double& limit, auto&& bound,
                 auto&& visit) noexcept {
  using Branch = BoundingVolumeTree::Branch;
  BoundStack<Branch, 3 * BoundingVolumeTree::kMaxDepth + 4> stack;
  Branch branch = tree.root();
  double least = bound(branch.box);
  stack.push(branch, least);
  while (stack.pop(branch, least)) {
    if (!(least < limit)) continue;
    if (branch.count > 0) {
      visit(branch.first, branch.count);
      continue;
    }
    const std::size_t base = stack.size();
    tree.visit_children(branch.first,
                        [&](const Branch& child) { stack.push(child, bound(child.box)); });
    stack.sort_from(base);
  }
}

/// The same for pairs of runs of two trees: bound(box of a, box of b), visit(first, count of a,
/// first, count of b).
void search_trees(const BoundingVolumeTree& a, const BoundingVolumeTree& b, const double& limit,
                  auto&& bound, auto&& visit) noexcept {
  using Branch = BoundingVolumeTree::Branch;
  struct Two {
    Branch a, b;
  };
  BoundStack<Two, 6 * BoundingVolumeTree::kMaxDepth + 4> stack;
  Two two{a.root(), b.root()};
  double least = bound(two.a.box, two.b.box);
  stack.push(two, least);
  while (stack.pop(two, least)) {
    if (!(least < limit)) continue;
    if (two.a.count > 0 && two.b.count > 0) {
      visit(two.a.first, two.a.count, two.b.first, two.b.count);
      continue;
    }
    const std::size_t base = stack.size();
    const bool opens_a =
        two.b.count > 0 ||
        (two.a.count == 0 && two.a.box.sizes().squaredNorm() >= two.b.box.sizes().squaredNorm());
    const auto push = [&](const Branch& one, const Branch& other) {
      stack.push({one, other}, bound(one.box, other.box));
    };
    if (opens_a) {
      a.visit_children(two.a.first, [&](const Branch& child) { push(child, two.b); });
    } else {
      b.visit_children(two.b.first, [&](const Branch& child) { push(two.a, child); });
    }
    stack.sort_from(base);
  }
}

}  // namespace reckon::haptics
