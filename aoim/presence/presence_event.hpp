// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What presence reports of the others and of ourselves, and the queue in which it waits.
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
  newcomer,          ///< same scene: joined. We introduce our entities to it now
  restarted,         ///< same id, new epoch: drop what its former life left behind, introduce
  renamed,           ///< it gave up the id `former`: drop the entities of that id, introduce
  moved,             ///< it speaks from `source` now, no more from `other`, and has proved itself
  departed,          ///< announced that it leaves, or lost its id: drop its entities
  timed_out,         ///< silent for six heartbeats: drop its entities
  scene_mismatch,    ///< another scene or cell grid: reported once per life, not joined; drop its
                     ///< entities
  identity_changed,  ///< we lost a dispute: `announced` is ours with the new id, `former` the old
                     ///< id
  settled,      ///< we hold our id, and all who hear us believe it now: introduce. Not reported
                ///< beyond the area-of-interest manager, see is_settled()
  heard_late,   ///< it hears us, but did not when we introduced our entities: introduce again.
                ///< Not reported beyond the area-of-interest manager
  disputed,     ///< two hold one id and do not settle it: `announced` is the one that claims it
                ///< from `other`; the holder speaks from `source`, none where that is this
                ///< peer. Once per claimant
  impostor,     ///< something in its name came from `other`, not from `source`; not believed.
                ///< Once per life
  crowd,        ///< `source` speaks for more peers than one may: the rest are not believed.
                ///< Once per source
  quiet,        ///< not heard for 2.5 s
  unheard,      ///< its list reports that it does not hear us
  heard_again,  ///< after quiet or unheard: both hear each other
  slept,        ///< this peer itself stood still for `slept`: nobody else is to blame
};

struct PresenceEvent {
  PresenceEventKind kind = PresenceEventKind::newcomer;
  pdu::Presence announced;  ///< last heard of the peer; of slept and settled: our own
  PeerId former;            ///< identity_changed and renamed only
  /// restarted only: epoch of the life that is over.
  std::uint32_t former_epoch = 0;
  SourceAddress source{};  ///< where the peer speaks from, if it is another's; see above
  SourceAddress other{};   ///< of disputed, impostor and moved
  std::chrono::nanoseconds slept{0};
  std::chrono::nanoseconds heard_for{0};  ///< from its first word to its last one so far

  [[nodiscard]] PeerId peer() const noexcept { return announced.simulation; }

  struct Dropped {
    PeerId name;              ///< of its entities
    std::uint32_t epoch = 0;  ///< of the life that announced them
  };
  /// Whose entities are not to be shown any more after this event; none after most.
  [[nodiscard]] std::optional<Dropped> dropped() const noexcept;
};

/// Events that have not been taken. One thread; allocates nothing while no more than `capacity`
/// wait.
class PresenceEvents {
 public:
  explicit PresenceEvents(std::size_t capacity);

  /// Reports something of ourselves, or of one that has no row.
  /// @return the event, to be completed; good until the next call
  PresenceEvent& report(PresenceEventKind kind, const pdu::Presence& about);
  /// Reports something of another peer, with its source and how long it has been heard.
  PresenceEvent& report(PresenceEventKind kind, const Peer& about);

  /// Events since the last call, oldest first; the span is good until the next call.
  [[nodiscard]] std::span<const PresenceEvent> take();

 private:
  std::vector<PresenceEvent> pending_, taken_;
};

}  // namespace reckon::aoim
