// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Divides a quad-tree so that little unwanted traffic is received.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "reckon/aoim/cells/quad_tree.hpp"

namespace reckon::aoim {
namespace {

double apart(const Demand& one, const Demand& other) noexcept {
  const double x = one.position.x - other.position.x, y = one.position.y - other.position.y;
  return std::sqrt(x * x + y * y);  // see QuadTree::distance
}

// Senders and listeners of a cell.
struct Part {
  std::vector<std::uint32_t> senders, listeners;  // demands, in the order of their instants
  double wasted = 0.0;               // traffic to listeners from senders beyond their radius
  std::optional<double> saved = {};  // by quartering it, once computed
};

class Division {
 public:
  Division(const QuadTreeConfig& config, std::span<const Demand> demands)
      : whole_(config), demands_(demands) {
    Part root;
    for (std::uint32_t i = 0; i < demands.size(); ++i) {
      if (is_finite(demands[i].position)) root.senders.push_back(i);
    }
    std::stable_sort(
        root.senders.begin(), root.senders.end(),
        [&](std::uint32_t a, std::uint32_t b) { return demands[a].instant < demands[b].instant; });
    root.listeners = root.senders;
    root.wasted = wasted_in(root);
    leaves_.emplace(CellId{0, 0}, std::move(root));
  }

  void fill() {
    while (leaves_.size() + 3 <= whole_.config().pool) {
      const auto most =
          std::max_element(leaves_.begin(), leaves_.end(),
                           [&](const auto& a, const auto& b) { return waste_of(a) < waste_of(b); });
      if (waste_of(*most) <= 0.0) return;
      quarter(most->first);
    }
  }

  // Each turn wastes less than the one before, so this ends; the bound limits the time.
  void refine() {
    for (std::size_t turn = 0; turn < whole_.config().pool; ++turn) {
      std::pair<double, CellId> best{0.0, {}}, least{std::numeric_limits<double>::infinity(), {}};
      for (auto& [cell, part] : leaves_)
        best = std::max(best, std::pair(saved_by(cell, part), cell));
      const CellId kept{best.second.q >> 2, best.second.r - 1};  // its quarters are not merged
      for (const auto& [cell, part] : divided_) {
        if (cell == kept || !has_whole_quarters(cell)) continue;
        double lost = part.wasted;
        for (std::int32_t i = 0; i < 4; ++i) lost -= leaves_.at(QuadTree::child(cell, i)).wasted;
        least = std::min(least, std::pair(lost, cell));
      }
      if (best.first <= least.first) return;
      unite(least.second);
      quarter(best.second);
    }
  }

  [[nodiscard]] std::vector<CellId> cells() const {
    std::vector<CellId> cells;
    for (const auto& [cell, part] : leaves_) cells.push_back(cell);
    return cells;
  }

 private:
  using Parts = std::map<CellId, Part>;

  [[nodiscard]] double waste_of(const Parts::value_type& leaf) const noexcept {
    return leaf.first.r < whole_.config().depth ? leaf.second.wasted : 0.0;
  }

  [[nodiscard]] double wasted_in(const Part& part) const {
    double wasted = 0.0;
    std::size_t first = 0;
    for (const std::uint32_t sender : part.senders) {
      const std::uint32_t instant = demands_[sender].instant;
      const auto at = [&](std::size_t i) { return demands_[part.listeners[i]].instant; };
      while (first < part.listeners.size() && at(first) < instant) ++first;
      for (std::size_t i = first; i < part.listeners.size() && at(i) == instant; ++i) {
        const Demand& listener = demands_[part.listeners[i]];
        wasted += apart(demands_[sender], listener) > listener.radius ? 1.0 : 0.0;
      }
    }
    return wasted;
  }

  [[nodiscard]] std::array<Part, 4> quarters_of(CellId cell, const Part& part) const {
    std::array<Part, 4> quarters;
    for (const std::uint32_t i : part.senders) {
      const std::int32_t which = whole_.quarter_of(cell, demands_[i].position);
      quarters[static_cast<std::size_t>(which)].senders.push_back(i);
    }
    for (std::int32_t which = 0; which < 4; ++which) {
      Part& quarter = quarters[static_cast<std::size_t>(which)];
      const CellId own = QuadTree::child(cell, which);
      for (const std::uint32_t i : part.listeners) {
        const bool hears = whole_.distance(own, demands_[i].position) <= demands_[i].radius;
        if (hears) quarter.listeners.push_back(i);
      }
      quarter.wasted = wasted_in(quarter);
    }
    return quarters;
  }

  void quarter(CellId cell) {
    auto node = leaves_.extract(cell);
    std::array<Part, 4> quarters = quarters_of(cell, node.mapped());
    for (std::int32_t i = 0; i < 4; ++i) {
      leaves_.emplace(QuadTree::child(cell, i), std::move(quarters[static_cast<std::size_t>(i)]));
    }
    divided_.insert(std::move(node));
  }

  void unite(CellId cell) {
    for (std::int32_t i = 0; i < 4; ++i) leaves_.erase(QuadTree::child(cell, i));
    leaves_.insert(divided_.extract(cell));
  }

  [[nodiscard]] bool has_whole_quarters(CellId cell) const {
    for (std::int32_t i = 0; i < 4; ++i) {
      if (leaves_.count(QuadTree::child(cell, i)) == 0) return false;
    }
    return true;
  }

  double saved_by(CellId cell, Part& part) const {
    if (cell.r >= whole_.config().depth || part.wasted <= 0.0) return 0.0;
    if (part.saved) return *part.saved;
    double saved = part.wasted;
    for (const Part& quarter : quarters_of(cell, part)) saved -= quarter.wasted;
    part.saved = saved;
    return saved;
  }

  QuadTree whole_;  // undivided: for the places of cells
  std::span<const Demand> demands_;
  Parts leaves_, divided_;
};

}  // namespace

QuadTree QuadTree::divided_by(const QuadTreeConfig& config, std::span<const Demand> demands) {
  Division division(config, demands);
  division.fill();
  division.refine();
  return of_cells(config, division.cells());
}

}  // namespace reckon::aoim
