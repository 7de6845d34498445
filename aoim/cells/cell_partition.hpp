// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// All schemes of cutting the plane into cells behind one interface: equal squares and hexagons, a
// quad-tree, locales. A new scheme is a class with the members called here and an entry in the list
// of alternatives. The choice is made once a call, so loops over cells run in the scheme itself.
#pragma once

#include <cstddef>
#include <utility>
#include <variant>

#include "reckon/aoim/cells/cell_grid.hpp"
#include "reckon/aoim/cells/locale_map.hpp"
#include "reckon/aoim/cells/quad_tree.hpp"

namespace reckon::aoim {

/// Immutable except by assignment. Cost: the scheme's, plus a branch.
class CellPartition {
 public:
  CellPartition(CellGrid grid) : scheme_(std::move(grid)) {}         // NOLINT: meant to convert
  CellPartition(QuadTree tree) : scheme_(std::move(tree)) {}         // NOLINT: meant to convert
  CellPartition(LocaleMap locales) : scheme_(std::move(locales)) {}  // NOLINT: meant to convert

  /// Calls use(scheme) with the scheme itself, for loops.
  template <typename Use>
  decltype(auto) visit(Use&& use) const {
    // The most common scheme first, for the branch predictor.
    if (const CellGrid* grid = as<CellGrid>()) return use(*grid);
    return std::visit(std::forward<Use>(use), scheme_);
  }
  /// The scheme if it is a Scheme, else null.
  template <typename Scheme>
  [[nodiscard]] const Scheme* as() const noexcept {
    return std::get_if<Scheme>(&scheme_);
  }
  [[nodiscard]] CellScheme scheme() const noexcept {
    return visit([](const auto& scheme) { return scheme.scheme(); });
  }

  /// The cell of a point.
  [[nodiscard]] CellId cell(const Position& position) const noexcept {
    return visit([&](const auto& scheme) { return scheme.cell(position); });
  }
  /// Its group, 1 .. groups().
  [[nodiscard]] GroupIndex group(CellId cell) const noexcept {
    return visit([&](const auto& scheme) { return scheme.group(cell); });
  }
  [[nodiscard]] GroupIndex group(const Position& position) const noexcept {
    return visit([&](const auto& scheme) { return scheme.group(position); });
  }
  /// Groups that may be in use: 1 .. groups().
  [[nodiscard]] std::size_t groups() const noexcept {
    return visit([](const auto& scheme) { return scheme.groups(); });
  }
  /// Number of groups that cells have now.
  [[nodiscard]] std::size_t groups_in_use() const noexcept {
    return visit([](const auto& scheme) { return scheme.groups_in_use(); });
  }
  /// Most groups that a disc of this radius can reach, or a few more. For set-up: up to 0.1 s.
  [[nodiscard]] std::size_t groups_bound(double radius) const {
    return visit([&](const auto& scheme) { return scheme.groups_bound(radius); });
  }
  /// Size of the smallest cell [m].
  [[nodiscard]] double finest() const noexcept {
    return visit([](const auto& scheme) { return scheme.finest(); });
  }
  /// Any cell of this group.
  [[nodiscard]] CellId cell_of(GroupIndex group) const noexcept {
    return visit([&](const auto& scheme) { return scheme.cell_of(group); });
  }

 private:
  std::variant<CellGrid, QuadTree, LocaleMap> scheme_;
};

}  // namespace reckon::aoim
