// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Few foci for many entities. Interest and subscription visit each focus, so an owner of thousands
// gives them balls that contain the balls of all its entities.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "reckon/aoim/interest/subscription.hpp"

namespace reckon::aoim {

/// Entities in the same square of the plane share a focus; if more than kMostFoci squares are
/// occupied, the squares double. The unwanted traffic comes from at most a square's diagonal beyond
/// the entities' own balls.
///
///   FocusCover cover(manager.cells());
///   manager.listen(kCellTier, cover.cover(foci_of_my_entities), now);
///
/// With locales, only entities of one locale share a focus. It is at one of them, so it reaches no
/// farther than the paths from there. If entities are in more than kMostFoci locales, each of these
/// has one focus. One thread; allocates nothing after construction.
class FocusCover {
 public:
  static constexpr std::size_t kMostFoci = 64;

  /// @param least_side of the squares [m], > 0: the size of a cell, because smaller ones save no
  /// group.
  explicit FocusCover(double least_side) : FocusCover(least_side, nullptr) {}
  /// For these cells, which are copied if they are locales.
  explicit FocusCover(const CellPartition& cells)
      : FocusCover(cells.finest(), cells.as<LocaleMap>()) {}

  /// At most most(cells) foci. Each entity's ball is within one of theirs, cut or whole, and a
  /// focus is as fast as its fastest entity. An entity that is alone in its square is its own
  /// focus, unchanged. Entities that are not finite or have no radius >= 0 are skipped; an invalid
  /// speed counts as 0 in a shared focus. Foci are in the order of their first entities; valid
  /// until the next call. Cost: up to nine passes over the entities, each some ns an entity.
  [[nodiscard]] std::span<const Focus> cover(std::span<const Focus> entities) noexcept;

  /// Most foci of these cells: kMostFoci, or the number of locales if that is larger.
  [[nodiscard]] static std::size_t most(const LocaleMap* locales) noexcept {
    return std::max(kMostFoci, locales != nullptr ? locales->groups() : 0);
  }

 private:
  FocusCover(double least_side, const LocaleMap* locales);

  struct Square {
    std::int64_t column = 0, row = 0;
    bool operator==(const Square&) const = default;
  };
  struct Group {
    Square square;
    Focus only;  ///< its first entity
    Position least, most, centre;
    double radius = 0.0, speed = 0.0, cut = 0.0;
    std::size_t count = 0;
  };
  [[nodiscard]] Square square_of(const Position& position, int level) const noexcept;
  [[nodiscard]] std::size_t find_or_open(const Square& square) noexcept;
  bool gather(std::span<const Focus> entities, int level) noexcept;
  int settle(std::span<const Focus> entities) noexcept;
  void enlarge(std::span<const Focus> entities, int level) noexcept;

  double least_side_;
  std::optional<LocaleMap> locales_;
  double side_ = 1.0;                 // of the squares of level 0 [m], for these entities
  std::size_t room_ = kMostFoci;      // most foci of this gathering
  std::vector<std::uint16_t> slots_;  // 0: free, else 1 + index of a group; at most a quarter full
  std::vector<Group> groups_;
  std::size_t count_ = 0;
  std::vector<Focus> foci_;
};

}  // namespace reckon::aoim
