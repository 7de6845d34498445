// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The shown articulated parts of remote entities: turrets, guns, flaps. They are kept separately
// from the state table, because few entities have parts.
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

/// One parameter of one part at one instant.
struct ShownPart {
  std::uint32_t part = 0;         ///< class of the part, SISO UID 59, without the metric
  std::uint16_t attached_to = 0;  ///< 0 = the entity itself, else a part
  deadreckon::PartMetric metric = deadreckon::PartMetric::azimuth;
  double value = 0;  ///< unit by the metric
  double rate = 0;   ///< the unit a second
};

/// The parts of one entity at one instant; valid until the next update of RemoteEntities.
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

/// A fixed pool for entities with parts; a row has the place of its entry. One thread; allocates
/// only at construction. An update costs some 80 ns a number, 5 us with 255 hostile records, 2 ns
/// for an entity without parts.
class RemoteParts {
 public:
  static constexpr std::size_t kEntities = 256;  ///< each about 1,600 octets

  /// @param counters outlives this.
  RemoteParts(const deadreckon::ConvergenceSettings& settings, Counters& counters);

  /// Takes the parts of an update at `now`. `row` has already taken that update, and its instant,
  /// time-out and freeze apply. Without a valid record the row loses its parts. Invalid records are
  /// ignored and counted. If the pool is full, the entity is shown without parts and counted.
  /// @param abrupt the entity is shown at once, and so are its parts.
  void update(RemoteEntity& row, std::span<const std::byte> records, std::chrono::nanoseconds now,
              bool abrupt) noexcept;
  /// Gives the place of a row back; does nothing if it has none.
  void release(RemoteEntity& row) noexcept;

  /// The parts of the last update; null if the row has none.
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
