// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Who we are: what we announce of ourselves, and the disputes about our id. Who has held an id for
// long gives way to no newcomer; who has lost it draws another.
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

/// Our own announcement and the id in it. One thread; allocates nothing.
class OwnIdentity {
 public:
  /// @param own what we announce at first  @param config, peers, claims, pace, events outlive this
  OwnIdentity(const PresenceConfig& config, const pdu::Presence& own, const PeerTable& peers,
              const Claims& claims, AnnouncementPace& pace, PresenceEvents& events) noexcept;

  [[nodiscard]] const pdu::Presence& announced() const noexcept { return own_; }
  [[nodiscard]] PeerId id() const noexcept { return own_.simulation; }
  [[nodiscard]] std::uint32_t epoch() const noexcept { return own_.epoch; }
  /// The announcement that leaves now.
  [[nodiscard]] const pdu::Presence& announce(std::chrono::nanoseconds now) noexcept;

  /// Whether it has our scene, cells and port.
  [[nodiscard]] bool shares_scene(const pdu::Presence& heard) const noexcept;
  /// Whether a peer of the table holds this id, or we do.
  [[nodiscard]] bool is_taken(PeerId id) const noexcept;

  /// Our id is ours from now on: we start, or have stood still for so long that another may have
  /// it.
  void hold_from(std::chrono::nanoseconds now) noexcept { claimed_ = now; }
  [[nodiscard]] std::chrono::nanoseconds held_since() const noexcept { return claimed_; }
  /// Another has announced itself under our id: we insist, or yield, or leave it to witnesses.
  void settle_with(const Claimant& rival, std::chrono::nanoseconds now) noexcept;
  /// Ends a dispute whose time is over, and reports once that all believe our id. @return whether
  /// we have lost it, and have another
  [[nodiscard]] bool step(std::chrono::nanoseconds now);
  [[nodiscard]] std::chrono::nanoseconds next_step() const noexcept;

  /// Whether we have held our id for long enough to give way to no newcomer.
  [[nodiscard]] bool is_established(std::chrono::nanoseconds now) const noexcept;
  /// Whether we have lost our id and have not drawn another yet: nothing is announced.
  [[nodiscard]] bool is_yielding() const noexcept { return yield_at_.has_value(); }
  /// Whether all who hear us believe our id.
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
  Nanoseconds claimed_{0};               // since when our id is ours
  int yields_ = 0;                       // ids lost in a row, none held for long
  std::optional<Nanoseconds> yield_at_;  // we have lost it, and draw another then
  bool yields_for_good_ = false;         // .. also if we become established until then
  bool settled_ = false;                 // of this id, and reported
  std::uint32_t draws_ = 0;              // ids drawn so far
};

}  // namespace reckon::aoim
