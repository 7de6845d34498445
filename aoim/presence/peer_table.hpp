// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The peers that live, as presence knows them: one row for each id. Who may have a row is decided
// by Presence; here they are found by id and by life.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "reckon/aoim/groups/epoch_index.hpp"
#include "reckon/aoim/groups/peer_id.hpp"
#include "reckon/aoim/presence/life_chain.hpp"
#include "reckon/aoim/presence/source_address.hpp"
#include "reckon/pdu/reckon/presence_pdu.hpp"

namespace reckon::aoim {

/// What the last lists of a peer say.
struct Hearing {
  std::chrono::nanoseconds came{std::chrono::nanoseconds::min()};  ///< when the last one came
  /// When one came that would list us, or the rival, if it heard us.
  std::chrono::nanoseconds us_at = came, rival_at = came;
  /// The same of one that does list us.
  std::chrono::nanoseconds us_listed = came;
  bool us = false;
  bool missed_us = false;   ///< it had to hear us and did not, and has not listed us since
  bool strangers = false;   ///< it hears lives that we do not know
  std::uint32_t rival = 0;  ///< epoch of one that claims our id and is heard as its holder; 0: none
};

/// A peer has proved itself from another address.
struct Move {
  pdu::Presence announced;
  SourceAddress to;
  std::chrono::nanoseconds since{};
};

/// One other peer: the living holder of its id.
struct Peer {
  pdu::Presence announced;
  std::chrono::nanoseconds first_heard{}, last_heard{};
  /// Its first word, also where it was taken for over meanwhile.
  std::chrono::nanoseconds known_since{};
  /// When it was heard again after it had been quiet, or taken for over.
  std::chrono::nanoseconds back_since = std::chrono::nanoseconds::min() / 2;
  bool joined = false;                   ///< same scene and grid
  SourceAddress source;                  ///< the only one from which it is believed; port 0: any
  SourceAddress former_source;           ///< before it moved
  std::optional<Move> move;              ///< it may have moved
  SourceAddress suspect;                 ///< port 0: nobody; spoke in its name from elsewhere ..
  std::chrono::nanoseconds suspected{};  ///< .. since
  LifeTip tip;
  bool confirmed = false;          ///< heard more than once
  bool impostor_reported = false;  ///< of this life
  bool quiet = false;              ///< reported as such
  bool unheard = false;            ///< reported as such
  Hearing hears;

  [[nodiscard]] PeerId id() const noexcept { return announced.simulation; }
};

/// Rows without an order. One thread; allocates nothing while it holds no more than it was made
/// for. Indices are good until the next row goes.
class PeerTable {
 public:
  /// @param capacity peers that it holds without allocating.
  explicit PeerTable(std::size_t capacity);

  /// Index of who holds this id; size() where nobody does. Linear.
  [[nodiscard]] std::size_t find(PeerId id) const noexcept;
  /// Whether anybody holds this id. Linear.
  [[nodiscard]] bool contains(PeerId id) const noexcept { return find(id) < size(); }
  /// Index of this life; size() where it has no row.
  [[nodiscard]] std::size_t find_epoch(std::uint32_t epoch) const noexcept {
    const std::uint32_t place = places_.find(epoch);
    return place == EpochIndex::kNone ? peers_.size() : place;
  }

  /// Epoch of the joined peer that holds this id; nothing where there is none. Linear.
  [[nodiscard]] std::optional<std::uint32_t> epoch_of(PeerId id) const noexcept;
  /// The id that the joined peer of this epoch holds; nothing where there is none.
  [[nodiscard]] std::optional<PeerId> id_of(std::uint32_t epoch) const noexcept;
  /// Where the peer of this epoch speaks from; port 0 where that is not known, nothing where the
  /// epoch is not known.
  [[nodiscard]] std::optional<SourceAddress> source_of(std::uint32_t epoch) const noexcept;
  /// For how long the peer of this epoch has been heard, from its first word to its last one; 0
  /// where it is not known.
  [[nodiscard]] std::chrono::nanoseconds heard_for(std::uint32_t epoch) const noexcept;
  /// How many times as long distances count to the peer of this epoch; 1 where it is not known.
  [[nodiscard]] double stretch_of(std::uint32_t epoch) const noexcept;

  /// One more row, at the end; neither its id nor its life has one.
  void append(const Peer& peer);
  /// Another life takes over the row.
  void replace(std::size_t index, const Peer& peer);
  /// The row goes, and the last one takes its place.
  void erase(std::size_t index) noexcept;

  [[nodiscard]] std::size_t size() const noexcept { return peers_.size(); }
  /// What it says of itself may change, but for its id and epoch.
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
  std::vector<PeerId> ids_;            // of peers_, in the same order
  std::vector<std::uint32_t> epochs_;  // likewise
  EpochIndex places_;                  // in peers_
};

}  // namespace reckon::aoim
