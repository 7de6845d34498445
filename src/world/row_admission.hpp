// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Decides which senders get a row of the state table when room is short, and which row is dropped.
#pragma once

#include <cstddef>
#include <cstdint>

#include "reckon/aoim/presence/source_address.hpp"
#include "reckon/deadreckon/extrapolators/adaptive_order.hpp"
#include "reckon/peer/clocks/sender_clock.hpp"
#include "reckon/peer/world/arrival.hpp"
#include "reckon/peer/world/held_states.hpp"
#include "reckon/peer/world/outside_entities.hpp"
#include "reckon/peer/world/remote_counters.hpp"
#include "reckon/peer/world/remote_settings.hpp"
#include "reckon/peer/world/row_owners.hpp"
#include "reckon/peer/world/state_table.hpp"

namespace reckon::peer {

/// Two bounds: the capacity of the table, and the memory of guests, which are plain DIS programs of
/// unproven identity. One thread; no allocation.
class RowAdmission {
 public:
  /// References outlive this. It uses the settings strangers_memory and all settings that determine
  /// the size of a row.
  RowAdmission(const RemoteSettings& settings, const StateTable& table, RowOwners& owners,
               OutsideEntities& outside, const RemoteCounters& counts)
      : settings_(settings),
        table_(table),
        owners_(owners),
        outside_(outside),
        counts_(counts),
        row_octets_(row_octets(settings)) {}

  /// Makes room for one more row of this sender, which then owns it. Calls drop(place) for each row
  /// that has to be dropped and counts it as evicted. Returns false and makes no row if there is no
  /// room, which is counted.
  [[nodiscard]] bool admit(const Arrival& arrival, auto&& drop) noexcept {
    const bool guest = arrival.epoch == 0;
    if (guest && !make_guest_room(arrival, drop)) {
      counts_.strangers_full.add();
      last_stranger_ = arrival.from;
      return false;
    }
    if (!make_room(arrival, drop) || !owners_.push(arrival.from, guest, arrival.now)) {
      counts_.table_full.add();
      return false;
    }
    return true;
  }
  /// Whether one more entity of a guest may be kept outside.
  [[nodiscard]] bool has_room_outside() const noexcept {
    return guests_octets() + kOutsideOctets <= settings_.strangers_memory;
  }
  /// Upper bound of the memory for guests' entities, shown or not [octets].
  [[nodiscard]] std::size_t guests_octets() const noexcept {
    return owners_.guests() * row_octets_ + outside_.guests() * kOutsideOctets;
  }

  /// Rows dropped to make room for others, and the owner of the last one.
  [[nodiscard]] std::uint64_t evicted() const noexcept { return counts_.evicted.value(); }
  [[nodiscard]] const aoim::SourceAddress& last_evicted() const noexcept { return last_evicted_; }
  /// Entities of guests refused for lack of room, and the sender of the last one.
  [[nodiscard]] std::uint64_t refused() const noexcept { return counts_.strangers_full.value(); }
  [[nodiscard]] const aoim::SourceAddress& last_refused() const noexcept { return last_stranger_; }

 private:
  // Size of one shown entity, in all tables that have a row for it.
  static std::size_t row_octets(const RemoteSettings& settings) {
    constexpr std::size_t kBeside = 320;  // owner, instants, index, near search, list of changes
    std::size_t octets = sizeof(RemoteEntity) + sizeof(SenderClock) + kBeside;
    if (settings.is_adaptive()) octets += sizeof(deadreckon::AdaptiveOrder);
    if (settings.record_changes) octets += sizeof(RemoteCopy);  // of the program
    return octets + settings.near_rows * sizeof(HeldState);
  }

  // Size of one entity outside: its row, instants, owner and place in the index.
  static constexpr std::size_t kOutsideOctets = sizeof(OutsideEntity) + 192;

  // Bounds the memory that guests share. A shown entity replaces outside ones, up to half of the
  // memory; then a row of the host with the most is dropped.
  [[nodiscard]] bool make_guest_room(const Arrival& arrival, auto&& drop) noexcept {
    const std::size_t most = settings_.strangers_memory;
    while (guests_octets() + row_octets_ > most) {
      const bool has_half = (owners_.guests() + 1) * row_octets_ > most / 2;
      if (!has_half && outside_.give_up_guest()) continue;
      const auto place = owners_.guest_to_give_up(arrival.from);
      if (!place) return false;
      evict(*place, drop);
    }
    return true;
  }
  // In a full table, drops a row of a host that has too many.
  [[nodiscard]] bool make_room(const Arrival& arrival, auto&& drop) noexcept {
    if (table_.rows().size() < table_.capacity()) return true;
    const auto place = owners_.row_to_give_up(arrival.from, arrival.epoch == 0);
    if (!place) return false;
    evict(*place, drop);
    return true;
  }
  void evict(std::size_t place, auto&& drop) noexcept {
    last_evicted_ = owners_.owner(place);
    drop(place);
  }

  const RemoteSettings& settings_;
  const StateTable& table_;
  RowOwners& owners_;
  OutsideEntities& outside_;
  const RemoteCounters& counts_;
  std::size_t row_octets_;  // of one shown entity
  aoim::SourceAddress last_evicted_, last_stranger_;
};

}  // namespace reckon::peer
