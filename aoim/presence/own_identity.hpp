// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Our identity: our announcement, and disputes about our ID. An established peer, which has held
// its ID for long, gives way to no newcomer. A peer that loses its ID draws another.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

#include "reckon/aoim/groups/peer_id.hpp"
#include "reckon/aoim/presence/announcement_pace.hpp"
#include "reckon/aoim/presence/claims.hpp"
#include "reckon/aoim/presence/peer_table.hpp"
#include "reckon/aoim/presence/presence_config.hpp"
#include "reckon/aoim/presence/presence_event.hpp"
#include "reckon/aoim/presence/witness_count.hpp"

namespace reckon::aoim {

/// Our announcement and its ID. One thread; allocates nothing.
class OwnIdentity {
 public:
  /// @param own the first announcement  @param config, peers, claims, pace, events outlive this
  OwnIdentity(const PresenceConfig& config, const pdu::Presence& own, const PeerTable& peers,
              const Claims& claims, AnnouncementPace& pace, PresenceEvents& events) noexcept;

  [[nodiscard]] const pdu::Presence& announced() const noexcept { return own_; }
  [[nodiscard]] PeerId id() const noexcept { return own_.simulation; }
  [[nodiscard]] std::uint32_t epoch() const noexcept { return own_.epoch; }
  /// The announcement to send now.
  [[nodiscard]] const pdu::Presence& announce(std::chrono::nanoseconds now) noexcept;

  /// Whether an announcement has our scene, cells and port.
  [[nodiscard]] bool shares_scene(const pdu::Presence& heard) const noexcept;
  /// Whether a peer of the table or this peer holds the ID.
  [[nodiscard]] bool is_taken(PeerId id) const noexcept;

  /// We hold our ID from now on: at the start, or after a suspend in which another may have taken
  /// it.
  void hold_from(std::chrono::nanoseconds now) noexcept { claimed_ = now; }
  [[nodiscard]] std::chrono::nanoseconds held_since() const noexcept { return claimed_; }
  /// Another peer has announced itself with our ID: we insist, yield, or let witnesses decide.
  void resolve_conflict_with(const Claimant& rival, std::chrono::nanoseconds now) noexcept;
  /// Ends a dispute when its time is over, and reports once that all accept our ID. @return whether
  /// we lost it and have another
  [[nodiscard]] bool step(std::chrono::nanoseconds now);
  [[nodiscard]] std::chrono::nanoseconds next_step() const noexcept;

  /// Whether we are established: have held our ID long enough to give way to no newcomer.
  [[nodiscard]] bool is_established(std::chrono::nanoseconds now) const noexcept;
  /// Whether we have lost our ID and not drawn another yet. Meanwhile nothing is announced.
  [[nodiscard]] bool is_yielding() const noexcept { return yield_at_.has_value(); }
  /// Whether all peers that receive us accept our ID.
  [[nodiscard]] bool is_settled() const noexcept { return settled_ && !yield_at_; }

  /// See Presence.
  void set_stretch(double stretch) noexcept;
  void take_scene_peer() noexcept;

 private:
  using Nanoseconds = std::chrono::nanoseconds;
  void take_next_id(Nanoseconds now);
  [[nodiscard]] PeerId draw_id() noexcept;

  const PresenceConfig& config_;
  const PeerTable& peers_;
  const Claims& claims_;
  AnnouncementPace& pace_;
  PresenceEvents& events_;
  pdu::Presence own_;
  WitnessCount witnesses_;
  Nanoseconds claimed_{0};               // since when we hold our ID
  int yields_ = 0;                       // IDs lost in a row, none held for long
  std::optional<Nanoseconds> yield_at_;  // time to draw another ID after a loss
  bool yields_for_good_ = false;         // .. even if we become established before
  bool settled_ = false;                 // this ID is accepted, and that is reported
  std::uint32_t draws_ = 0;              // IDs drawn so far
};

}  // namespace reckon::aoim
