// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The articulated parts of remote entities as shown: turrets, guns, flaps. Beside the state table,
// because few entities have any: only those take a place here.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "reckon/deadreckon/motion/articulation.hpp"
#include "reckon/peer/counters/counters.hpp"
#include "reckon/peer/world/state_table.hpp"

namespace reckon::peer {

/// One number of one part at one instant.
struct ShownPart {
  std::uint32_t part = 0;         ///< class of the part, SISO UID 59, without the metric
  std::uint16_t attached_to = 0;  ///< 0 = the entity itself, else a part
  deadreckon::PartMetric metric = deadreckon::PartMetric::azimuth;
  double value = 0;  ///< unit as the metric says
  double rate = 0;   ///< the unit a second
};

/// The parts of one entity at one instant; good until the next update of RemoteEntities.
class ShownParts {
 public:
  ShownParts() = default;
  /// @param now [s] of the steady clock.
  ShownParts(const deadreckon::PartConvergence& parts, double now) noexcept
      : parts_(&parts), now_(now) {}

  /// At most deadreckon::PartState::kCapacity.
  [[nodiscard]] std::size_t size() const noexcept {
    return parts_ == nullptr ? 0 : parts_->state().parameters().size();
  }
  [[nodiscard]] bool empty() const noexcept { return size() == 0; }
  /// `i` < size(). About 30 ns.
  [[nodiscard]] ShownPart operator[](std::size_t i) const noexcept;

 private:
  const deadreckon::PartConvergence* parts_ = nullptr;
  double now_ = 0;
};

/// A fixed pool of entities that have parts; a row knows its place. One thread; allocates only at
/// construction. An update costs some 80 ns a number, 5 us with 255 hostile records, 2 ns for an
/// entity without.
class RemoteParts {
 public:
  static constexpr std::size_t kEntities = 256;  ///< each about 1,600 octets

  /// @param counters outlives this.
  RemoteParts(const deadreckon::ConvergenceSettings& settings, Counters& counters);

  /// Takes the records of an update that `row` has taken already, at `now`: its instant, time-out
  /// and freeze are the row's. Without a good record the row has no parts any more. Bad records are
  /// left out and counted; where the pool is full the entity goes without parts and is counted.
  /// @param abrupt the entity is shown at once, so its parts are.
  void update(RemoteEntity& row, std::span<const std::byte> records, std::chrono::nanoseconds now,
              bool abrupt) noexcept;
  /// Gives the place of a row back; nothing happens where it has none.
  void release(RemoteEntity& row) noexcept;

  /// What the last update stated of them; null where the row has none.
  [[nodiscard]] const deadreckon::PartState* received(const RemoteEntity& row) const noexcept {
    if (row.parts_place == RemoteEntity::kNoParts) return nullptr;
    return &places_[row.parts_place].state();
  }
  [[nodiscard]] ShownParts shown(const RemoteEntity& row,
                                 std::chrono::nanoseconds now) const noexcept;
  /// Entities that have parts.
  [[nodiscard]] std::size_t in_use() const noexcept { return places_.size() - free_.size(); }

 private:
  deadreckon::PartConvergence* claim(RemoteEntity& row) noexcept;

  deadreckon::ConvergenceSettings settings_;
  std::vector<deadreckon::PartConvergence> places_;
  std::vector<std::uint16_t> free_;

  Counter& refused_;
  Counter& full_;
};

}  // namespace reckon::peer
