// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Claims to ids that others hold, or we do: they wait until it is plain whether the holder lives.
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

/// Of two that claim an id anew: a total order that both compute alike and that no restart turns
/// round. Who started first keeps it; of two in the same second, the lower epoch.
[[nodiscard]] bool precedes(const pdu::Presence& one, const pdu::Presence& other) noexcept;
/// Whether it announces that it has held its id for long.
[[nodiscard]] bool announces_established(const pdu::Presence& heard) noexcept;

/// A peer that announces itself under an id that another holds, or we do.
struct Claimant {
  pdu::Presence announced;
  std::chrono::nanoseconds since{}, last_heard{};
  SourceAddress source;
  Hearing hears;
  LifeTip tip;
  bool reported = false;  ///< as disputed

  [[nodiscard]] PeerId id() const noexcept { return announced.simulation; }
  [[nodiscard]] std::uint32_t epoch() const noexcept { return announced.epoch; }
  /// It has announced itself again, maybe under another id.
  void hear(const pdu::Presence& heard, std::chrono::nanoseconds now, const SourceAddress& from);
};

/// All claimants, without an order. One thread; allocates nothing after construction.
class Claims {
 public:
  /// @param config, peers, events outlive this
  Claims(const PresenceConfig& config, const PeerTable& peers, PresenceEvents& events);

  /// Null where this life claims nothing; good until the next call that adds or removes one.
  [[nodiscard]] Claimant* find(std::uint32_t epoch) noexcept;
  [[nodiscard]] const Claimant* find(std::uint32_t epoch) const noexcept;
  /// Whether anybody claims this id.
  [[nodiscard]] bool contains(PeerId id) const noexcept;
  [[nodiscard]] bool is_full() const noexcept { return claimants_.size() == config_.claims; }
  /// One more; not where they are full.
  Claimant& add(const Claimant& claimant);
  void forget(std::uint32_t epoch) noexcept;
  /// This process stood still for `slept`: nobody was silent meanwhile.
  void note_slept(std::chrono::nanoseconds slept, std::chrono::nanoseconds now) noexcept;

  /// Looks at the claimant of this index, which goes where it has been silent for too long. A claim
  /// that lasts is reported.
  /// @return the claimant, removed, where it is the holder's next life
  [[nodiscard]] std::optional<Claimant> settle(std::size_t index, PeerId own,
                                               std::chrono::nanoseconds now);
  /// Removes the best of those that claim an id that nobody holds.
  [[nodiscard]] std::optional<Claimant> take_free(PeerId own, std::chrono::nanoseconds now);
  /// When one is to be looked at; duration max where there is none. @param looked the last time
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
