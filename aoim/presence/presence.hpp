// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Presence of peers. Each peer announces itself on the base group at its start, when it receives a
// newcomer, and every second. After six missed announcements it has timed out. A peer with another
// scene is reported once and not joined. A claim to an ID of another peer is pending until it is
// known whether that peer is alive. Two live peers settle a dispute between themselves.
//
//   ProofJudge, AddressProof,
//   SourcePins                 is the sender the peer that it claims to be?
//   FormerLives                has its epoch ended?
//   Claims, Admission          may it get a row?
//   Liveness                   which peers are silent?
//   OwnIdentity, WitnessCount  which peer holds our ID?
//   AnnouncementPace           when do we announce ourselves?
//   HeardListSender            .. and send the list of received peers?
//   MutualHearing              which peers receive us?
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "reckon/aoim/groups/peer_id.hpp"
#include "reckon/aoim/presence/admission.hpp"
#include "reckon/aoim/presence/announcement_pace.hpp"
#include "reckon/aoim/presence/claims.hpp"
#include "reckon/aoim/presence/former_lives.hpp"
#include "reckon/aoim/presence/heard_list_sender.hpp"
#include "reckon/aoim/presence/life_chain.hpp"
#include "reckon/aoim/presence/liveness.hpp"
#include "reckon/aoim/presence/mutual_hearing.hpp"
#include "reckon/aoim/presence/own_identity.hpp"
#include "reckon/aoim/presence/peer_table.hpp"
#include "reckon/aoim/presence/presence_config.hpp"
#include "reckon/aoim/presence/presence_event.hpp"
#include "reckon/aoim/presence/proof_judge.hpp"
#include "reckon/aoim/presence/source_address.hpp"
#include "reckon/aoim/presence/source_pins.hpp"
#include "reckon/pdu/reckon/peers_heard.hpp"
#include "reckon/pdu/reckon/presence_pdu.hpp"

namespace reckon::aoim {

/// Relation of a sender, identified by its epoch, to this peer.
enum class Standing : std::uint8_t {
  unknown,      ///< no announcement received yet, or it claims an ID of another peer
  own,          ///< ourselves
  member,       ///< same scene, present epoch
  other_scene,  ///< reported and not joined
  former_life,  ///< replaced by a later epoch of that peer, or announced its end
  impostor,     ///< uses the epoch of a peer with another source
};

/// Sums since the start.
struct PresenceCounts {
  std::uint64_t announced = 0, heard = 0, former_life = 0, conflicts = 0;
  std::uint64_t table_full = 0;  ///< announcements of peers without room in the table
  std::uint64_t crowd = 0;       ///< announcements refused because their source had too many peers
  std::uint64_t reserved = 0;    ///< announcements refused because they have the site of the scene
  std::uint64_t impostors = 0;   ///< announcements and lists from another source than their peer's
};

/// The peers table and our own announcements. One thread; allocates nothing after construction.
class Presence {
 public:
  /// `own` is our announcement: wanted simulation address, epoch (random at each start of the
  /// process), start time, scene hash, cells. @throws std::invalid_argument for a heartbeat or
  /// number of misses that is not positive, an epoch of 0, or the site of the scene.
  Presence(const PresenceConfig& config, const pdu::Presence& own);
  Presence(const Presence&) = delete;
  Presence& operator=(const Presence&) = delete;

  /// Starts our announcements; the first is sent in the next step.
  void start(std::chrono::nanoseconds now);
  /// The next step announces our end, and no announcement follows.
  void stop();

  /// Receives an announcement from the base group. Own echoes and other exercises are ignored.
  /// Linear in the number of peers for a newcomer.
  /// @param from source of its datagram
  void receive(const pdu::Presence& heard, std::chrono::nanoseconds now,
               const SourceAddress& from = {});
  /// Receives a Peers Heard list.
  void receive(const pdu::PeersHeard& list, std::chrono::nanoseconds now,
               const SourceAddress& from = {});

  /// Notes a datagram of a member as a sign of life: lost announcements do not matter while its
  /// updates arrive. Unknown epochs are ignored. Check its source with standing() first.
  void note_alive(std::uint32_t epoch, std::chrono::nanoseconds now) noexcept;
  /// Sets our source address, as receivers see it; without it our announcements prove no address.
  /// A change is announced at once and repeated, so that others receive the proof soon.
  void note_own_source(const SourceAddress& source, std::chrono::nanoseconds now) noexcept {
    pace_.note_own_source(source, now);
  }
  /// Notes a datagram with this epoch from another source; see Standing::impostor. If the peer can
  /// prove its address, see SourcePins::note_impostor.
  void note_impostor(std::uint32_t epoch, const SourceAddress& from, std::chrono::nanoseconds now);

  /// One of our hands touches a hand of this peer, which therefore sends all the time: if its
  /// address falls silent, a new one is soon accepted on approval. Unknown epochs are ignored.
  void note_touched(std::uint32_t epoch, std::chrono::nanoseconds now) noexcept;

  /// Finds time-outs, and returns the announcements to send on the base group now (mostly 0 or 1),
  /// valid until the next step. They must be sent unchanged.
  /// @param utc since 1970  @param timestamp DIS timestamp of `utc`
  [[nodiscard]] std::span<const pdu::Presence> step(std::chrono::nanoseconds now,
                                                    std::chrono::nanoseconds utc = {},
                                                    std::uint32_t timestamp = 0);
  /// The list of received peers if it is due; it may be empty. Valid until the next call. Call it
  /// after step(). See HeardListSender.
  /// @param last_sent when our last datagram was sent, with any content
  [[nodiscard]] std::optional<HeardList> take_list(
      std::chrono::nanoseconds now,
      std::chrono::nanoseconds last_sent = std::chrono::nanoseconds::min());

  /// Sets the factor of distances to us, 1 .. 2^15, for the next announcement. It is rounded up to
  /// a sixteenth of an octave.
  void set_stretch(double stretch) noexcept { own_.set_stretch(stretch); }
  /// The factor that the peer with this epoch announces; 1 for an unknown epoch.
  [[nodiscard]] double stretch_of(std::uint32_t epoch) const noexcept {
    return peers_.stretch_of(epoch);
  }

  /// Sends our next announcement at `time` or earlier, if that is long enough after the last one.
  void announce_by(std::chrono::nanoseconds time) noexcept { pace_.announce_by(time); }

  /// Takes the smallest free peer number of the scene. Peers that want one are served in the order
  /// of their IDs. The next announcement contains it.
  void take_scene_peer() noexcept { own_.take_scene_peer(); }

  /// Events since the last call, oldest first; valid until the next call.
  [[nodiscard]] std::span<const PresenceEvent> take_events() { return events_.take(); }

  /// Whether the next step at `now` announces us.
  [[nodiscard]] bool is_due(std::chrono::nanoseconds now) const noexcept {
    return pace_.is_due(now) && !own_.is_yielding();
  }
  /// Our present announcement.
  [[nodiscard]] const pdu::Presence& own() const noexcept { return own_.announced(); }
  [[nodiscard]] PeerId id() const noexcept { return own_.id(); }
  /// True for an own entity. A received datagram with its ID is an echo or shows a disputed ID.
  [[nodiscard]] bool is_own(const pdu::EntityId& entity) const noexcept {
    return entity.simulation() == id();
  }
  /// The other peers, one for each ID.
  [[nodiscard]] std::span<const Peer> peers() const noexcept { return peers_.rows(); }
  /// @param from source of the datagram; nothing: any
  [[nodiscard]] Standing standing(std::uint32_t epoch,
                                  const SourceAddress* from = nullptr) const noexcept;
  /// Epoch of the live member that holds this ID and so owns its entities. Does not include this
  /// peer. Linear in the number of peers.
  [[nodiscard]] std::optional<std::uint32_t> epoch_of(PeerId id) const noexcept {
    return peers_.epoch_of(id);
  }
  /// ID of the live member with this epoch, if any.
  [[nodiscard]] std::optional<PeerId> id_of(std::uint32_t epoch) const noexcept {
    return peers_.id_of(epoch);
  }
  /// Lower bound of the last receive times of all joined peers; may lag by some seconds.
  [[nodiscard]] std::chrono::nanoseconds heard_since() const noexcept {
    return liveness_.heard_since();
  }
  /// Source of the peer with this epoch; port 0 if the source is unknown, nothing for an unknown
  /// epoch.
  [[nodiscard]] std::optional<SourceAddress> source_of(std::uint32_t epoch) const noexcept {
    return peers_.source_of(epoch);
  }
  /// Time from the first to the last datagram of the peer with this epoch; 0 for an unknown epoch.
  [[nodiscard]] std::chrono::nanoseconds heard_for(std::uint32_t epoch) const noexcept {
    return peers_.heard_for(epoch);
  }
  /// Whether we are established: have held our ID long enough to give way to no newcomer.
  [[nodiscard]] bool is_established(std::chrono::nanoseconds now) const noexcept {
    return own_.is_established(now);
  }
  /// Whether all peers that receive us accept our ID: 0.85 s after the start or the last change,
  /// unless there is a dispute that we may lose.
  [[nodiscard]] bool is_settled() const noexcept { return own_.is_settled(); }
  [[nodiscard]] PresenceCounts counts() const noexcept;
  /// Deadline of the next step(); nanoseconds::max() if there is nothing to do.
  [[nodiscard]] std::chrono::nanoseconds next_step() const noexcept;

 private:
  using Nanoseconds = std::chrono::nanoseconds;

  // Arrivals and departures.
  void receive_from_known(std::size_t index, const pdu::Presence& heard, Nanoseconds now,
                          const SourceAddress& from);
  void believe(std::size_t index, const pdu::Presence& heard, Nanoseconds now,
               const SourceAddress& from);
  void rename(std::size_t index, const pdu::Presence& heard, Nanoseconds now,
              const SourceAddress& from);
  void claim(const pdu::Presence& heard, Nanoseconds now, const SourceAddress& from);
  void welcome(const pdu::Presence& heard, Nanoseconds now, const SourceAddress& from);
  void begin_life(std::size_t index, const Claimant& claimant, Nanoseconds now);
  [[nodiscard]] bool takes_back(const pdu::Presence& heard, Nanoseconds now,
                                const SourceAddress& from);
  [[nodiscard]] bool make_room(Nanoseconds now, const SourceAddress& from);
  void append(const Peer& peer);
  void bury(const Peer& peer, Nanoseconds now, bool has_announced_end);
  void remove(std::size_t index, PresenceEventKind why);

  // Time-outs.
  void wake(Nanoseconds now);
  void settle(Nanoseconds now);
  void settle_silence(Nanoseconds now);
  bool settle_claims(Nanoseconds now);  // whether a claimant has become the holder
  bool fill_free_ids(Nanoseconds now);  // whether an ID was assigned

  PresenceConfig config_;
  PeerTable peers_;
  FormerLives former_;
  PresenceEvents events_;
  PresenceCounts counts_;  // without the counts of the parts
  LifeChain chain_;        // our own proofs
  ProofJudge proofs_;      // proofs of others
  Liveness liveness_;
  SourcePins pins_;
  Claims claims_;
  Admission admission_;
  AnnouncementPace pace_;
  OwnIdentity own_;
  MutualHearing hearing_;
  HeardListSender lists_;
  std::vector<pdu::Presence> outgoing_, leaving_;
};

}  // namespace reckon::aoim
