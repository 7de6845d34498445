// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The live peers, one row for each ID. Presence decides which peers get a row. This table finds
// them by ID and by epoch.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "reckon/aoim/groups/epoch_index.hpp"
#include "reckon/aoim/groups/peer_id.hpp"
#include "reckon/aoim/presence/address_proof.hpp"
#include "reckon/aoim/presence/life_chain.hpp"
#include "reckon/aoim/presence/source_address.hpp"
#include "reckon/pdu/reckon/presence_pdu.hpp"

namespace reckon::aoim {

/// Summary of the last lists of a peer.
struct Hearing {
  std::chrono::nanoseconds came{std::chrono::nanoseconds::min()};  ///< arrival of the last list
  /// Arrival of the last list whose part covers our epoch or the rival's.
  std::chrono::nanoseconds us_at = came, rival_at = came;
  /// Arrival of the last list that contains us.
  std::chrono::nanoseconds us_listed = came;
  bool us = false;
  bool missed_us = false;   ///< it missed our announcements and has not listed us since
  bool strangers = false;   ///< it receives epochs that we do not know
  std::uint32_t rival = 0;  ///< epoch that claims our ID and that it accepts as the holder; 0: none
};

/// A peer has opened its last commitment from another address.
struct Move {
  SourceAddress to;
  std::chrono::nanoseconds since{};
};

/// Another peer: the live holder of its ID.
struct Peer {
  pdu::Presence announced;
  std::chrono::nanoseconds first_heard{}, last_heard{};
  /// Its first datagram, also if its epoch was taken for ended in between.
  std::chrono::nanoseconds known_since{};
  /// When it was received again after it had been quiet or taken for ended.
  std::chrono::nanoseconds back_since = std::chrono::nanoseconds::min() / 2;
  bool joined = false;                    ///< same scene and grid
  SourceAddress source;                   ///< the only accepted source; port 0: any
  SourceAddress held;                     ///< source to return to, after a move on approval ..
  std::chrono::nanoseconds held_since{};  ///< .. since; port 0: none
  std::optional<Move> move;               ///< possible move on approval
  bool may_hurry = false;                 ///< .. which is possible once for each proof
  bool doubtful = false;                  ///< its source was refuted and nothing proved since
  std::chrono::nanoseconds opened{};      ///< last link that opened a commitment, from anywhere
  AddressProof proof;
  SourceAddress refuted;  ///< last address that was no proof, port 0: none
  /// Mean interval of its datagrams; bursts of less than 5 ms count as one.
  std::chrono::nanoseconds interval = std::chrono::seconds(1);
  /// When a hand of its was touched last.
  std::chrono::nanoseconds touched = std::chrono::nanoseconds::min() / 2;
  SourceAddress suspect;                 ///< source of an impostor, port 0: none ..
  std::chrono::nanoseconds suspected{};  ///< .. since
  LifeTip tip;
  bool confirmed = false;          ///< received more than once
  bool impostor_reported = false;  ///< in this epoch
  bool quiet = false;              ///< reported as such
  bool unheard = false;            ///< reported as such
  Hearing hears;

  [[nodiscard]] PeerId id() const noexcept { return announced.simulation; }
};

/// Unordered rows. One thread; allocates nothing up to its capacity. Indices are valid until the
/// next row is removed.
class PeerTable {
 public:
  /// @param capacity peers that it holds without allocating.
  explicit PeerTable(std::size_t capacity);

  /// Index of the holder of this ID, or size(). Linear.
  [[nodiscard]] std::size_t find(PeerId id) const noexcept;
  /// Whether a peer holds this ID. Linear.
  [[nodiscard]] bool contains(PeerId id) const noexcept { return find(id) < size(); }
  /// Index of this epoch, or size().
  [[nodiscard]] std::size_t find_epoch(std::uint32_t epoch) const noexcept {
    const std::uint32_t place = places_.find(epoch);
    return place == EpochIndex::kNone ? peers_.size() : place;
  }

  /// Epoch of the joined peer that holds this ID, if any. Linear.
  [[nodiscard]] std::optional<std::uint32_t> epoch_of(PeerId id) const noexcept;
  /// ID of the joined peer with this epoch, if any.
  [[nodiscard]] std::optional<PeerId> id_of(std::uint32_t epoch) const noexcept;
  /// Source of the peer with this epoch; port 0 if the source is unknown, nothing for an unknown
  /// epoch.
  [[nodiscard]] std::optional<SourceAddress> source_of(std::uint32_t epoch) const noexcept;
  /// Time from the first to the last datagram of the peer with this epoch; 0 for an unknown epoch.
  [[nodiscard]] std::chrono::nanoseconds heard_for(std::uint32_t epoch) const noexcept;
  /// Factor of distances to the peer with this epoch; 1 for an unknown epoch.
  [[nodiscard]] double stretch_of(std::uint32_t epoch) const noexcept;

  /// Appends a row; its ID and epoch must not have one.
  void append(const Peer& peer);
  /// Replaces the epoch of a row.
  void replace(std::size_t index, const Peer& peer);
  /// Removes a row; the last row takes its place.
  void erase(std::size_t index) noexcept;

  [[nodiscard]] std::size_t size() const noexcept { return peers_.size(); }
  /// A row to modify; its ID and epoch must not change.
  [[nodiscard]] Peer& operator[](std::size_t index) noexcept { return peers_[index]; }
  [[nodiscard]] const Peer& operator[](std::size_t index) const noexcept { return peers_[index]; }
  [[nodiscard]] std::uint32_t epoch(std::size_t index) const noexcept { return epochs_[index]; }
  [[nodiscard]] std::span<const Peer> rows() const noexcept { return peers_; }
  [[nodiscard]] auto begin() noexcept { return peers_.begin(); }
  [[nodiscard]] auto end() noexcept { return peers_.end(); }
  [[nodiscard]] auto begin() const noexcept { return peers_.begin(); }
  [[nodiscard]] auto end() const noexcept { return peers_.end(); }

 private:
  std::vector<Peer> peers_;
  std::vector<PeerId> ids_;            // IDs of peers_, in the same order
  std::vector<std::uint32_t> epochs_;  // epochs of peers_, in the same order
  EpochIndex places_;                  // in peers_
};

}  // namespace reckon::aoim
