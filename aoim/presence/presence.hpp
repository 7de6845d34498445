// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Who else is here. Each peer announces itself on the base group at once on start, when it hears a
// newcomer, and every second; six missed announcements mean it is gone. Another scene is reported
// once and not joined. Who claims an id that another holds waits until it is plain whether the
// other still lives; two that live settle it between themselves.
//
//   ProofJudge, SourcePins     is it the peer that it claims to be?
//   FormerLives                is its life over?
//   Claims, Admission          may it have a row?
//   Liveness                   who is silent?
//   OwnIdentity, WitnessCount  who holds our id?
//   AnnouncementPace           when do we announce ourselves?
//   HeardListSender            .. and list whom we hear?
//   MutualHearing              who hears us?
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

/// How the sender of a datagram, named by its epoch, stands with us.
enum class Standing : std::uint8_t {
  unknown,      ///< no announcement heard (yet), or it claims an id that another holds
  own,          ///< ourselves
  member,       ///< same scene, present life
  other_scene,  ///< reported and not joined
  former_life,  ///< a later life of that peer has been heard since, or it announced that it leaves
  impostor,     ///< it speaks in the name of a peer that speaks from elsewhere
};

/// Sums since the start.
struct PresenceCounts {
  std::uint64_t announced = 0, heard = 0, former_life = 0, conflicts = 0;
  std::uint64_t table_full = 0;  ///< announcements of peers for whom there was no room
  std::uint64_t crowd = 0;       ///< announcements refused for too many of one source
  std::uint64_t impostors = 0;   ///< announcements and lists from another source than their peer's
};

/// The peers table and our own announcements. One thread; allocates nothing after construction.
class Presence {
 public:
  /// `own` carries all that we announce: simulation address wanted, epoch (drawn at random at every
  /// start of the process), start time, scene hash, cells. @throws std::invalid_argument for a
  /// heartbeat or number of misses that is not positive, or an epoch of 0.
  Presence(const PresenceConfig& config, const pdu::Presence& own);
  Presence(const Presence&) = delete;
  Presence& operator=(const Presence&) = delete;

  /// From now on we announce ourselves, at once at the next step.
  void start(std::chrono::nanoseconds now);
  /// The next step announces that we leave, and nothing follows.
  void stop();

  /// Takes an announcement heard on the base group; our own echoes and those of other exercises are
  /// ignored. Of a newcomer linear in the peers known.
  /// @param from the source of the datagram it was in
  void receive(const pdu::Presence& heard, std::chrono::nanoseconds now,
               const SourceAddress& from = {});
  /// Takes a list of those whom another peer hears.
  void receive(const pdu::PeersHeard& list, std::chrono::nanoseconds now,
               const SourceAddress& from = {});

  /// Any datagram of a member shows that it lives: lost announcements do not count while its
  /// updates arrive. Unknown epochs are ignored. Ask standing() about its source first.
  void note_alive(std::uint32_t epoch, std::chrono::nanoseconds now) noexcept;
  /// Where we send from. Where that is elsewhere than at the last call we announce ourselves at
  /// once and some times more, so that others take the proof soon.
  void note_own_source(const SourceAddress& source, std::chrono::nanoseconds now) noexcept {
    pace_.note_own_source(source, now);
  }
  /// A datagram in the name of this epoch came from elsewhere; see Standing::impostor. Of one that
  /// can prove itself it is reported when it has not done so half a second later.
  void note_impostor(std::uint32_t epoch, const SourceAddress& from, std::chrono::nanoseconds now);

  /// Announcements to send on the base group now (mostly 0 or 1), good until the next step; finds
  /// who has timed out. Send times and timestamps are left to the caller.
  [[nodiscard]] std::span<const pdu::Presence> step(std::chrono::nanoseconds now);
  /// Epochs of the peers whom we hear, where it is time to send them, maybe none; good until the
  /// next call. After step(). See HeardListSender.
  /// @param last_sent when our last datagram left, whatever was in it
  [[nodiscard]] std::optional<HeardList> take_list(
      std::chrono::nanoseconds now,
      std::chrono::nanoseconds last_sent = std::chrono::nanoseconds::min());

  /// Announces from the next time on that distances count so many times as long to us, 1 ..
  /// 2^15; rounded up to a sixteenth of an octave.
  void set_stretch(double stretch) noexcept { own_.set_stretch(stretch); }
  /// What the peer of this epoch announces of that; 1 where it is not known.
  [[nodiscard]] double stretch_of(std::uint32_t epoch) const noexcept {
    return peers_.stretch_of(epoch);
  }

  /// Our next announcement leaves at `time` at the latest, if that is far enough from the last one.
  void announce_by(std::chrono::nanoseconds time) noexcept { pace_.announce_by(time); }

  /// Takes the smallest number of the scene's peers that no member holds; those that want one are
  /// served in the order of their ids. Announced from the next announcement on.
  void take_scene_peer() noexcept { own_.take_scene_peer(); }

  /// Events since the last call, oldest first; the span is good until the next call.
  [[nodiscard]] std::span<const PresenceEvent> take_events() { return events_.take(); }

  /// Whether the next step at `now` announces us.
  [[nodiscard]] bool is_due(std::chrono::nanoseconds now) const noexcept {
    return pace_.is_due(now) && !own_.is_yielding();
  }
  /// Who we are at present.
  [[nodiscard]] const pdu::Presence& own() const noexcept { return own_.announced(); }
  [[nodiscard]] PeerId id() const noexcept { return own_.id(); }
  /// True for an entity of ours: what arrives under its id is an echo or a disputed address.
  [[nodiscard]] bool is_own(const pdu::EntityId& entity) const noexcept {
    return entity.simulation() == id();
  }
  /// The others, one for each id.
  [[nodiscard]] std::span<const Peer> peers() const noexcept { return peers_.rows(); }
  /// @param from the source of the datagram; nothing: whatever it is
  [[nodiscard]] Standing standing(std::uint32_t epoch,
                                  const SourceAddress* from = nullptr) const noexcept;
  /// Epoch of the living member that holds this id: who may speak for its entities. Ourselves are
  /// no member. Linear in the peers known.
  [[nodiscard]] std::optional<std::uint32_t> epoch_of(PeerId id) const noexcept {
    return peers_.epoch_of(id);
  }
  /// The id that the living member of this epoch holds; nothing where there is none.
  [[nodiscard]] std::optional<PeerId> id_of(std::uint32_t epoch) const noexcept {
    return peers_.id_of(epoch);
  }
  /// No joined peer was heard last before this: a bound, which may lag behind by some seconds.
  [[nodiscard]] std::chrono::nanoseconds heard_since() const noexcept {
    return liveness_.heard_since();
  }
  /// Where the peer of this epoch speaks from; port 0 where that is not known, nothing where the
  /// epoch is not known.
  [[nodiscard]] std::optional<SourceAddress> source_of(std::uint32_t epoch) const noexcept {
    return peers_.source_of(epoch);
  }
  /// For how long the peer of this epoch has been heard, from its first word to its last one; 0
  /// where it is not known.
  [[nodiscard]] std::chrono::nanoseconds heard_for(std::uint32_t epoch) const noexcept {
    return peers_.heard_for(epoch);
  }
  /// Whether we have held our id for long enough to give way to no newcomer.
  [[nodiscard]] bool is_established(std::chrono::nanoseconds now) const noexcept {
    return own_.is_established(now);
  }
  /// Whether all who hear us believe our id: 0.85 s after the start or the last change, as long as
  /// there is no dispute that we may lose.
  [[nodiscard]] bool is_settled() const noexcept { return own_.is_settled(); }
  [[nodiscard]] PresenceCounts counts() const noexcept;
  /// When step has to be called next at the latest; duration max where there is nothing to do.
  [[nodiscard]] std::chrono::nanoseconds next_step() const noexcept;

 private:
  using Nanoseconds = std::chrono::nanoseconds;

  // Who comes, and who goes.
  void hear_known(std::size_t index, const pdu::Presence& heard, Nanoseconds now,
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
  void bury(const Peer& peer, Nanoseconds now, bool said_goodbye);
  void remove(std::size_t index, PresenceEventKind why);

  // What time settles.
  void wake(Nanoseconds now);
  void settle(Nanoseconds now);
  void settle_moves(Nanoseconds now);
  void settle_silence(Nanoseconds now);
  bool settle_claims(Nanoseconds now);  // whether a claimant has become the holder
  bool fill_free_ids(Nanoseconds now);  // whether it gave one

  PresenceConfig config_;
  PeerTable peers_;
  FormerLives former_;
  PresenceEvents events_;
  PresenceCounts counts_;  // without those of the parts
  LifeChain chain_;        // our own proofs
  ProofJudge proofs_;      // those of others
  Liveness liveness_;
  SourcePins pins_;
  Claims claims_;
  Admission admission_;
  AnnouncementPace pace_;
  OwnIdentity own_;
  MutualHearing hearing_;
  HeardListSender lists_;
  std::vector<pdu::Presence> outgoing_, farewells_;
};

}  // namespace reckon::aoim
