// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Events of presence about other peers and this one, and their queue.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "reckon/aoim/groups/peer_id.hpp"
#include "reckon/aoim/presence/peer_table.hpp"
#include "reckon/aoim/presence/source_address.hpp"
#include "reckon/pdu/reckon/presence_pdu.hpp"

namespace reckon::aoim {

/// What happened to a peer.
enum class PresenceEventKind : std::uint8_t {
  newcomer,          ///< same scene: joined. We introduce our entities
  restarted,         ///< same ID, new epoch: drop the entities of the former one, introduce
  renamed,           ///< it gave up the ID `former`: drop the entities of that ID, introduce
  moved,             ///< its source is `source` now, no longer `other`, and it has proved that
  departed,          ///< announced its end, or lost its ID: drop its entities
  timed_out,         ///< silent for six heartbeats: drop its entities
  scene_mismatch,    ///< another scene or cell grid: reported once per epoch, not joined; drop its
                     ///< entities
  identity_changed,  ///< we lost a dispute: `announced` is ours with the new ID, `former` the old
                     ///< ID
  settled,      ///< we hold our ID, and all receivers accept it: introduce. Not reported beyond the
                ///< area-of-interest manager, see is_settled()
  heard_late,   ///< it receives us, but did not when we introduced our entities: introduce again.
                ///< Not reported beyond the area-of-interest manager
  disputed,     ///< two peers hold one ID and do not settle it: `announced` claims it from the
                ///< source `other`; the holder has `source`, empty for this peer. Once per
                ///< claimant
  impostor,     ///< a datagram with its epoch came from `other`, not from `source`; refused. Once
                ///< per epoch. If it has the site of the scene: `other` announces that; once per
                ///< address
  crowd,        ///< `source` has more peers than one may have: the rest are refused.
                ///< Once per source
  quiet,        ///< not received for 2.5 s
  unheard,      ///< its list shows that it does not receive us
  heard_again,  ///< after quiet or unheard: both receive each other
  slept,        ///< this peer itself was suspended for `slept`
};

struct PresenceEvent {
  PresenceEventKind kind = PresenceEventKind::newcomer;
  pdu::Presence announced;  ///< last of the peer; for slept and settled: our own
  PeerId former;            ///< identity_changed and renamed only
  /// restarted only: the former epoch.
  std::uint32_t former_epoch = 0;
  SourceAddress source{};  ///< source of another peer; see above
  SourceAddress other{};   ///< of disputed, impostor and moved
  std::chrono::nanoseconds slept{0};
  std::chrono::nanoseconds heard_for{0};  ///< from its first to its last datagram

  [[nodiscard]] PeerId peer() const noexcept { return announced.simulation; }

  struct Dropped {
    PeerId name;              ///< of its entities
    std::uint32_t epoch = 0;  ///< that announced them
  };
  /// The peer whose entities are no longer shown after this event, if any.
  [[nodiscard]] std::optional<Dropped> dropped() const noexcept;
};

/// Pending events. One thread; allocates nothing for up to `capacity` events.
class PresenceEvents {
 public:
  explicit PresenceEvents(std::size_t capacity);

  /// Reports an event of this peer, or of a peer without a row.
  /// @return the event, to be completed; valid until the next call
  PresenceEvent& report(PresenceEventKind kind, const pdu::Presence& about);
  /// Reports an event of another peer, with its source and the time since its first datagram.
  PresenceEvent& report(PresenceEventKind kind, const Peer& about);

  /// Events since the last call, oldest first; valid until the next call.
  [[nodiscard]] std::span<const PresenceEvent> take();

 private:
  std::vector<PresenceEvent> pending_, taken_;
};

}  // namespace reckon::aoim
