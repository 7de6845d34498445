// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Claims to IDs that other peers or we hold. They are pending until it is known whether the holder
// is alive.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "reckon/aoim/groups/peer_id.hpp"
#include "reckon/aoim/presence/life_chain.hpp"
#include "reckon/aoim/presence/peer_table.hpp"
#include "reckon/aoim/presence/presence_config.hpp"
#include "reckon/aoim/presence/presence_event.hpp"
#include "reckon/aoim/presence/source_address.hpp"

namespace reckon::aoim {

/// Which of two new claimants keeps an ID. Both compute the same total order, and a restart does
/// not reverse it. The peer that started first keeps the ID; in the same second, the lower epoch.
[[nodiscard]] bool precedes(const pdu::Presence& one, const pdu::Presence& other) noexcept;
/// Whether it announces that it is established, that is, has held its ID for long.
[[nodiscard]] bool announces_established(const pdu::Presence& heard) noexcept;

/// A peer that announces itself with an ID of another peer or of ours.
struct Claimant {
  pdu::Presence announced;
  std::chrono::nanoseconds since{}, last_heard{};
  SourceAddress source;
  Hearing hears;
  LifeTip tip;
  bool reported = false;  ///< as disputed

  [[nodiscard]] PeerId id() const noexcept { return announced.simulation; }
  [[nodiscard]] std::uint32_t epoch() const noexcept { return announced.epoch; }
  /// It has announced itself again, perhaps with another ID.
  void receive(const pdu::Presence& heard, std::chrono::nanoseconds now, const SourceAddress& from);
};

/// All claimants, unordered. One thread; allocates nothing after construction.
class Claims {
 public:
  /// @param config, peers, events outlive this
  Claims(const PresenceConfig& config, const PeerTable& peers, PresenceEvents& events);

  /// Null if this epoch claims no ID; valid until the next call that adds or removes one.
  [[nodiscard]] Claimant* find(std::uint32_t epoch) noexcept;
  [[nodiscard]] const Claimant* find(std::uint32_t epoch) const noexcept;
  /// Whether anybody claims this id.
  [[nodiscard]] bool contains(PeerId id) const noexcept;
  /// Whether announcements of this claimant are accepted from this source. An announcement from the
  /// host of the ID's holder, as after a restart, replaces the source of one that was replayed from
  /// elsewhere.
  [[nodiscard]] bool may_speak_for(const Claimant& claimant,
                                   const SourceAddress& from) const noexcept;
  [[nodiscard]] bool is_full() const noexcept { return claimants_.size() == config_.claims; }
  /// Adds a claimant unless the table is full.
  Claimant& add(const Claimant& claimant);
  void forget(std::uint32_t epoch) noexcept;
  /// This process was suspended for `slept`, which does not count as silence of others.
  void note_slept(std::chrono::nanoseconds slept, std::chrono::nanoseconds now) noexcept;

  /// Checks the claimant with this index. Removes it after long silence, and reports a claim that
  /// lasts.
  /// @return the removed claimant, if it is a restart of the holder
  [[nodiscard]] std::optional<Claimant> settle(std::size_t index, PeerId own,
                                               std::chrono::nanoseconds now);
  /// Removes and returns the best claimant of an ID without a holder.
  [[nodiscard]] std::optional<Claimant> take_free(PeerId own, std::chrono::nanoseconds now);
  /// When a claimant must be checked; nanoseconds::max() if there is none. @param looked the last
  /// check
  [[nodiscard]] std::chrono::nanoseconds next_step(PeerId own,
                                                   std::chrono::nanoseconds looked) const noexcept;

  [[nodiscard]] std::size_t size() const noexcept { return claimants_.size(); }
  [[nodiscard]] const Claimant& operator[](std::size_t index) const noexcept {
    return claimants_[index];
  }
  [[nodiscard]] auto begin() const noexcept { return claimants_.begin(); }
  [[nodiscard]] auto end() const noexcept { return claimants_.end(); }

 private:
  [[nodiscard]] std::chrono::nanoseconds restart_at(const Claimant& claimant,
                                                    const Peer& holder) const noexcept;
  void erase(std::size_t index) noexcept;

  const PresenceConfig& config_;
  const PeerTable& peers_;
  PresenceEvents& events_;
  std::vector<Claimant> claimants_;
};

}  // namespace reckon::aoim
