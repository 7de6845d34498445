// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Locales, as in Spline: parts of the world with a frame each, for example the rooms of a building.
// A locale has its own group and neighbours. An entity behind a wall is not received,
// however close it is, unless a path of neighbours leads there within the radius.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "reckon/aoim/cells/cell_grid.hpp"

namespace reckon::aoim {

/// One locale: a rectangle about the origin of its frame, of any height or a box.
struct Locale {
  Position origin;   ///< of its frame, in S [m]
  double yaw = 0.0;  ///< from S's x axis to its x axis about the common z axis [rad]
  double half_x = 0.0, half_y = 0.0;           ///< along its own axes [m], > 0
  std::vector<std::uint16_t> neighbours = {};  ///< by their places in the list
  /// Up and down from its origin [m], > 0; infinite: height has no effect.
  double half_z = std::numeric_limits<double>::infinity();
};

/// Immutable, hence safe from any thread. If locales overlap, the first one counts; a point in none
/// belongs to the nearest.
class LocaleMap {
 public:
  /// @throws std::invalid_argument with the locale and the remedy: none or more than 1,000, a size
  /// that is not positive, a neighbour that does not exist or does not list it as a neighbour too.
  explicit LocaleMap(std::vector<Locale> locales);

  /// The locale of a point: q is its place in the list, r is 0. NaN counts as the first one. About
  /// 3 ns a locale.
  [[nodiscard]] CellId cell(const Position& position) const noexcept;
  /// Group of a locale, 1 + its place in the list; for one that is not in it, the first one's.
  [[nodiscard]] GroupIndex group(CellId cell) const noexcept {
    return {static_cast<std::uint16_t>(place(cell) + 1)};
  }
  [[nodiscard]] GroupIndex group(const Position& position) const noexcept {
    return group(cell(position));
  }
  [[nodiscard]] CellId cell_of(GroupIndex group) const noexcept { return {group.value - 1, 0}; }
  [[nodiscard]] Position centre(CellId cell) const noexcept { return locales_[place(cell)].origin; }
  /// Distance from a point of S to a locale [m]; 0 inside. Horizontal if the locale has any height.
  [[nodiscard]] double distance(CellId cell, const Position& position) const noexcept;
  [[nodiscard]] std::span<const Locale> locales() const noexcept { return locales_; }
  [[nodiscard]] std::size_t groups() const noexcept { return locales_.size(); }
  [[nodiscard]] std::size_t groups_in_use() const noexcept { return locales_.size(); }
  [[nodiscard]] CellScheme scheme() const noexcept { return CellScheme::locales; }
  /// The shortest side of a locale [m].
  [[nodiscard]] double finest() const noexcept;
  /// Most groups that a disc of this radius can reach from within a locale, or a few more. For
  /// set-up: up to 0.1 s.
  [[nodiscard]] std::size_t groups_bound(double radius) const;
  [[nodiscard]] double cells_bound(double) const noexcept {
    return static_cast<double>(locales_.size());
  }

  /// A point of S in a locale's frame, and back. Another locale changes the coordinates, not the
  /// point: to_scene(a, to_locale(a, p)) is p for each a.
  [[nodiscard]] Position to_locale(CellId cell, const Position& position) const noexcept;
  [[nodiscard]] Position to_scene(CellId cell, const Position& local) const noexcept;

  /// Calls visit(CellId, double distance [m]) for the locale of the point, and for each locale
  /// within the radius that a path of neighbours within the radius connects with it.
  void for_each_cell_within(const Position& position, double radius, auto&& visit) const {
    if (!(radius >= 0.0) || !is_finite(position)) return;
    for_each_reached(place(cell(position)), position, radius, visit);
  }

 private:
  [[nodiscard]] std::size_t place(CellId cell) const noexcept {
    const auto index = static_cast<std::size_t>(cell.q);
    return cell.q >= 0 && index < locales_.size() ? index : 0;
  }

  // The same from a home locale that need not contain the point.
  void for_each_reached(std::size_t home, const Position& position, double radius,
                        auto&& visit) const {
    std::array<bool, kMaximumPool> seen{};
    std::array<std::uint16_t, kMaximumPool> reached;
    std::size_t count = 0;
    const auto reach = [&](std::uint16_t index) {
      seen[index] = true;
      reached[count++] = index;
    };
    reach(static_cast<std::uint16_t>(home));
    for (std::size_t next = 0; next < count; ++next) {
      const CellId here{reached[next], 0};
      visit(here, next == 0 ? 0.0 : distance(here, position));
      for (const std::uint16_t neighbour : locales_[reached[next]].neighbours) {
        if (seen[neighbour] || distance({neighbour, 0}, position) > radius) continue;
        reach(neighbour);
      }
    }
  }

  struct Turn {
    double cosine, sine;
  };
  std::vector<Locale> locales_;
  std::vector<Turn> turns_;  // rotations of their x axes
};

}  // namespace reckon::aoim
