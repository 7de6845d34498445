// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Checks whether a sender may send in the name of an entity, and records violations.
#pragma once

#include <array>
#include <bit>
#include <chrono>
#include <cstdint>
#include <optional>
#include <span>

#include "reckon/aoim/area_of_interest_manager.hpp"
#include "reckon/peer/counters/counters.hpp"
#include "reckon/peer/world/arrival.hpp"
#include "reckon/peer/world/disputes.hpp"
#include "reckon/peer/world/outside_entities.hpp"
#include "reckon/peer/world/row_owners.hpp"
#include "reckon/peer/world/scene_bodies.hpp"
#include "reckon/peer/world/state_table.hpp"

namespace reckon::peer {

/// Relation of a sender to the entity in whose name it sends, as far as this peer knows.
enum class SenderRight : std::uint8_t {
  owner,    ///< its own: it owns the entity, or its site and application
  unknown,  ///< an entity that no known sender owns
  refused,  ///< another owner's
};

/// Applies the rule of ownership (see RemoteEntities) to rows and owners. It changes neither of
/// them; it keeps only the disputes. One thread; no allocation.
class EntityOwnership {
 public:
  /// References outlive this.  @param refused counts PDUs sent in another owner's name
  EntityOwnership(aoim::AreaOfInterestManager& aoim, const StateTable& table,
                  const RowOwners& owners, const OutsideEntities& outside, SceneBodies& bodies,
                  Counter& refused)
      : aoim_(aoim),
        table_(table),
        owners_(owners),
        outside_(outside),
        bodies_(bodies),
        refused_(refused) {}

  /// Whether this came from the epoch and the sender that made the row. Called for each update.
  [[nodiscard]] bool is_owner(const RemoteEntity& row, const Arrival& arrival) const noexcept {
    return row.epoch == arrival.epoch && is_sender(row, arrival);
  }
  /// Whether this came from the address of the row's owner.
  [[nodiscard]] bool is_sender(const RemoteEntity& row, const Arrival& arrival) const noexcept {
    return same(owners_.owner(table_.place_of(row)), arrival.from);
  }
  /// Whether an update may be taken; else it is counted as a dispute. Bodies of the scene have a
  /// rule of their own, see SceneBodies.
  /// @param row of the entity; null if it has none
  [[nodiscard]] bool may_update(const Inbound& update, const Arrival& arrival,
                                const RemoteEntity* row) noexcept {
    if (bodies_.contains(update.entity)) return bodies_.admits(update, arrival);
    return may_update(update.entity, arrival, row);
  }
  /// The same for an entity outside. A body was checked when it was kept, and its owner may have
  /// left since.
  [[nodiscard]] bool may_enter(const pdu::EntityId& id, const Arrival& arrival) noexcept {
    return bodies_.contains(id) || may_update(id, arrival, nullptr);
  }
  /// See RemoteEntities::sender_right.
  [[nodiscard]] SenderRight sender_right(std::span<const pdu::EntityId> ids,
                                         const Arrival& arrival) noexcept;
  /// Impostors, see Disputes::take_news.
  [[nodiscard]] std::optional<Dispute> take_dispute(std::chrono::nanoseconds now) noexcept {
    return disputes_.take_news(now);
  }

 private:
  [[nodiscard]] bool may_update(const pdu::EntityId& id, const Arrival& arrival,
                                const RemoteEntity* row) noexcept;
  // As ==, inlined.
  [[nodiscard]] static bool same(const aoim::SourceAddress& a,
                                 const aoim::SourceAddress& b) noexcept {
    if ((a.boot | b.boot) != 0) return a.boot == b.boot;
    using Words = std::array<std::uint64_t, 2>;
    static_assert(sizeof a.octets == sizeof(Words));
    const auto left = std::bit_cast<Words>(a.octets), right = std::bit_cast<Words>(b.octets);
    return ((left[0] ^ right[0]) | (left[1] ^ right[1])) == 0 && a.port == b.port;
  }
  [[nodiscard]] SenderRight right_of(const pdu::EntityId& id, const Arrival& arrival,
                                     const RemoteEntity* row,
                                     aoim::SourceAddress& owner) const noexcept;
  void refuse(const pdu::EntityId& id, const Arrival& arrival,
              const aoim::SourceAddress& owner) noexcept;

  aoim::AreaOfInterestManager& aoim_;
  const StateTable& table_;
  const RowOwners& owners_;
  const OutsideEntities& outside_;
  SceneBodies& bodies_;
  Counter& refused_;
  Disputes disputes_;
};

}  // namespace reckon::peer
