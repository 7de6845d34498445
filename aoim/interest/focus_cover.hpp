// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Few foci for many entities: interest and subscription look at each focus, so an owner of
// thousands tells them balls that hold the balls of all its entities.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "reckon/aoim/interest/subscription.hpp"

namespace reckon::aoim {

/// Entities that share a square of the plane share a focus; where more than kMostFoci squares are
/// occupied, the squares double. What a peer then hears beyond its entities' own balls reaches at
/// most a square's diagonal farther.
///
///   FocusCover cover(manager.cells());
///   manager.listen(kCellTier, cover.cover(foci_of_my_entities), now);
///
/// Where there are locales, those of one locale alone share a focus, which stands where one of them
/// does, so that it reaches no farther than the ways from there; where somebody is in more than
/// kMostFoci locales, each of these has one focus. One thread; allocates nothing after
/// construction.
class FocusCover {
 public:
  static constexpr std::size_t kMostFoci = 64;

  /// @param least_side of the squares [m]: the size of a cell, for smaller ones save no group; > 0.
  explicit FocusCover(double least_side) : FocusCover(least_side, nullptr) {}
  /// For these cells, which are copied where they are locales.
  explicit FocusCover(const CellPartition& cells)
      : FocusCover(cells.finest(), cells.as<LocaleMap>()) {}

  /// At most most(cells) foci; each entity's ball lies in one of theirs, and the focus is as fast
  /// as the fastest in it. An entity that is alone in its square is its own focus, unchanged.
  /// Entities that are not finite or have no radius >= 0 are skipped; a speed that is no number >=
  /// 0 counts as 0 in company. Foci stand in the order of their first entities; good until the next
  /// call. Cost: up to nine passes over the entities, each some ns an entity.
  [[nodiscard]] std::span<const Focus> cover(std::span<const Focus> entities) noexcept;

  /// Foci of these cells: kMostFoci, or as many as there are locales.
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
    double radius = 0.0, speed = 0.0;
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
  std::size_t room_ = kMostFoci;      // foci that this gathering may make
  std::vector<std::uint16_t> slots_;  // 0: free, else 1 + index of a group; at most a quarter full
  std::vector<Group> groups_;
  std::size_t count_ = 0;
  std::vector<Focus> foci_;
};

}  // namespace reckon::aoim
