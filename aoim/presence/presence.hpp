// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Who else is here. Each peer announces itself on the base group at once on start, when it hears a
// newcomer, and every second; six missed announcements mean it is gone. Another scene is reported
// once and not joined. Who claims an id that another holds waits until it is plain whether the
// other still lives; two that live settle it between themselves.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "reckon/aoim/groups/peer_id.hpp"
#include "reckon/aoim/presence/former_lives.hpp"
#include "reckon/aoim/presence/life_chain.hpp"
#include "reckon/aoim/presence/peer_table.hpp"
#include "reckon/aoim/presence/presence_config.hpp"
#include "reckon/aoim/presence/presence_event.hpp"
#include "reckon/aoim/presence/source_address.hpp"
#include "reckon/pdu/reckon/peers_heard.hpp"
#include "reckon/pdu/reckon/presence_pdu.hpp"

namespace reckon::aoim {

/// Those whom we hear, or a part of them.
struct HeardList {
  std::span<const std::uint32_t> epochs;  ///< a part is in ascending order
  std::uint16_t continues = 0;            ///< pdu::kPeersHeardBelow, pdu::kPeersHeardAbove
};

/// How the sender of a datagram, named by its epoch, stands with us.
enum class Standing : std::uint8_t {
  unknown,      ///< no announcement heard (yet), or it claims an id that another holds
  own,          ///< ourselves
  member,       ///< same scene, present life
  other_scene,  ///< reported and not joined
  former_life,  ///< a later life of that peer has been heard since, or it said good-bye
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
  /// `own` carries all that we tell: simulation address wanted, epoch (drawn at random at every
  /// start of the process), start time, scene hash, cells. @throws std::invalid_argument for a
  /// heartbeat or number of misses that is not positive, or an epoch of 0.
  Presence(const PresenceConfig& config, const pdu::Presence& own);

  /// From now on we announce ourselves, at once at the next step.
  void start(std::chrono::nanoseconds now);
  /// The next step says good-bye, and nothing follows.
  void stop();

  /// Takes an announcement heard on the base group; our own echoes and those of other exercises are
  /// ignored. Of a newcomer linear in the peers known.
  /// @param from the source of the datagram it was in
  void receive(const pdu::Presence& heard, std::chrono::nanoseconds now,
               const SourceAddress& from = {});
  /// Takes a list of those whom another peer hears.
  void receive(const pdu::PeersHeard& list, std::chrono::nanoseconds now,
               const SourceAddress& from = {});

  /// Any datagram of a member shows that it lives: announcements lost in a row say nothing while
  /// its updates arrive. Unknown epochs are ignored. Ask standing() about its source first.
  void note_alive(std::uint32_t epoch, std::chrono::nanoseconds now) noexcept;
  /// Where we send from. Where that is elsewhere than at the last call we announce ourselves at
  /// once and some times more, so that others take the proof soon.
  void note_own_source(const SourceAddress& source, std::chrono::nanoseconds now) noexcept;
  /// A datagram in the name of this epoch came from elsewhere; see Standing::impostor. Of one that
  /// can prove itself it is reported when it has not done so half a second later.
  void note_impostor(std::uint32_t epoch, const SourceAddress& from, std::chrono::nanoseconds now);

  /// Announcements to send on the base group now (mostly 0 or 1), good until the next step; finds
  /// who has timed out. Send times and timestamps are left to the caller.
  [[nodiscard]] std::span<const pdu::Presence> step(std::chrono::nanoseconds now);
  /// Epochs of the peers whom we hear, where it is time to tell them, maybe none; good until the
  /// next call. After step(). Goes with each announcement that is more than a heartbeat; else once
  /// a heartbeat: when we have been silent for three quarters of it, as a sign of life, or with an
  /// announcement. @param said when our last datagram left, whatever was in it
  [[nodiscard]] std::optional<HeardList> take_list(
      std::chrono::nanoseconds now,
      std::chrono::nanoseconds said = std::chrono::nanoseconds::min());

  /// Says from the next announcement on that distances count so many times as long to us, 1 ..
  /// 2^15; rounded up to a sixteenth of an octave.
  void set_stretch(double stretch) noexcept;
  /// What the peer of this epoch says of that; 1 where it is not known.
  [[nodiscard]] double stretch_of(std::uint32_t epoch) const noexcept;

  /// Our next announcement leaves at `time` at the latest, if that is far enough from the last one.
  void announce_by(std::chrono::nanoseconds time) noexcept;

  /// Takes the smallest number of the scene's peers that no member holds; those that want one are
  /// served in the order of their ids. Announced from the next announcement on.
  void take_scene_peer() noexcept;

  /// Events since the last call, oldest first; the span is good until the next call.
  [[nodiscard]] std::span<const PresenceEvent> take_events() { return events_.take(); }

  /// Whether the next step at `now` announces us.
  [[nodiscard]] bool is_due(std::chrono::nanoseconds now) const noexcept {
    return running_ && !yield_at_ && now >= next_;
  }
  /// Who we are at present.
  [[nodiscard]] const pdu::Presence& own() const noexcept { return own_; }
  [[nodiscard]] PeerId id() const noexcept { return own_.simulation; }
  /// The others, one for each id.
  [[nodiscard]] std::span<const Peer> peers() const noexcept { return peers_.rows(); }
  /// @param from the source of the datagram; nothing: whatever it is
  [[nodiscard]] Standing standing(std::uint32_t epoch,
                                  const SourceAddress* from = nullptr) const noexcept;
  /// Epoch of the living member that holds this id: who may speak for its entities. Ourselves are
  /// no member. Linear in the peers known.
  [[nodiscard]] std::optional<std::uint32_t> epoch_of(PeerId id) const noexcept;
  /// The id that the living member of this epoch holds; nothing where there is none. Linear in the
  /// peers known.
  [[nodiscard]] std::optional<PeerId> id_of(std::uint32_t epoch) const noexcept;
  /// No joined peer was heard last before this: a bound, which may lag behind by some seconds.
  [[nodiscard]] std::chrono::nanoseconds heard_since() const noexcept { return heard_since_; }
  /// Where the peer of this epoch speaks from; port 0 where that is not known, nothing where the
  /// epoch is not known.
  [[nodiscard]] std::optional<SourceAddress> source_of(std::uint32_t epoch) const noexcept;
  /// For how long the peer of this epoch has been heard, from its first word to its last one; 0
  /// where it is not known.
  [[nodiscard]] std::chrono::nanoseconds heard_for(std::uint32_t epoch) const noexcept;
  /// Whether we have held our id for long enough to give way to no newcomer.
  [[nodiscard]] bool is_established(std::chrono::nanoseconds now) const noexcept;
  /// Whether all who hear us believe our id: 0.85 s after the start or the last change, as long as
  /// there is no dispute that we may lose.
  [[nodiscard]] bool is_settled() const noexcept { return settled_told_ && !yield_at_; }
  [[nodiscard]] const PresenceCounts& counts() const noexcept { return counts_; }
  /// When step has to be called next at the latest; duration max where there is nothing to do.
  [[nodiscard]] std::chrono::nanoseconds next_step() const noexcept;

 private:
  using Nanoseconds = std::chrono::nanoseconds;
  static constexpr std::size_t kCrowds = 16;  // sources remembered as reported

  // A peer that announces itself under an id that another holds, or we do.
  struct Claimant {
    pdu::Presence announced;
    Nanoseconds since, last_heard;
    SourceAddress source;
    Hearing hears;
    LifeTip tip;
    bool reported = false;
  };
  // What our next announcement is for.
  enum class Cause : std::uint8_t { heartbeat, repetition, news };
  // How many say that they hear a peer: from how many addresses, and how many at all.
  struct Support {
    std::size_t addresses = 0, peers = 0;
    auto operator<=>(const Support&) const = default;
  };

  // presence.cpp: who comes and goes
  [[nodiscard]] bool shares_scene(const pdu::Presence& heard) const noexcept;
  void wake(Nanoseconds now);
  void append(const Peer& peer);
  void note_heard(Peer& peer, Nanoseconds now) noexcept;
  void watch(const Peer& peer) noexcept;
  [[nodiscard]] Nanoseconds silence_due(const Peer& peer) const noexcept;
  void hear_known(std::size_t index, const pdu::Presence& heard, Nanoseconds now,
                  const SourceAddress& from);
  void believe(std::size_t index, const pdu::Presence& heard, Nanoseconds now,
               const SourceAddress& from);
  void rename(std::size_t index, const pdu::Presence& heard, Nanoseconds now,
              const SourceAddress& from);
  void welcome(const pdu::Presence& heard, Nanoseconds now, const SourceAddress& from);
  void begin_life(std::size_t index, const Claimant& claimant, Nanoseconds now);
  void bury(const Peer& peer, Nanoseconds now, bool said_goodbye);
  void remove(std::size_t index, PresenceEventKind why);
  void watch_silence(Nanoseconds now);
  void settle(Nanoseconds now);

  // presence_proof.cpp: who is the same as before
  [[nodiscard]] Opening judge(const LifeTip& tip, const pdu::Presence& heard, Nanoseconds now,
                              bool at_home) noexcept;
  [[nodiscard]] bool may_move(Peer& peer, const pdu::Presence& heard, Nanoseconds now,
                              const SourceAddress& from);
  void move(Peer& peer, const SourceAddress& to);
  void settle_moves(Nanoseconds now);
  void tell_impostor(Peer& peer, SourceAddress from);
  [[nodiscard]] bool takes_back(const pdu::Presence& heard, Nanoseconds now,
                                const SourceAddress& from);

  // presence_pace.cpp: when we announce ourselves
  void announce_soon(Nanoseconds now) noexcept;
  void insist(Nanoseconds now) noexcept;
  [[nodiscard]] bool is_acquainted() const noexcept;
  void schedule_next(Nanoseconds now) noexcept;

  // presence_lists.cpp: whom we hear, and whom others hear
  void read_list(Hearing& hearing, const pdu::PeersHeard& list, Nanoseconds now) noexcept;
  void note_listing(Peer& peer, Nanoseconds now);
  [[nodiscard]] HeardList next_part();

  // presence_room.cpp: how many are believed of whom
  [[nodiscard]] bool is_crowd(const SourceAddress& from);
  [[nodiscard]] bool make_room(Nanoseconds now, const SourceAddress& from);

  // presence_identity.cpp: who holds which id
  [[nodiscard]] bool is_taken(PeerId id) const noexcept;
  [[nodiscard]] Claimant* find_claimant(std::uint32_t epoch) noexcept;
  void claim(const pdu::Presence& heard, Nanoseconds now, const SourceAddress& from);
  void forget_claimant(std::uint32_t epoch) noexcept;
  void settle_with(const Claimant& rival, Nanoseconds now);
  // Whether a claimant has become the holder.
  bool settle_claims(Nanoseconds now);
  bool fill_free_ids(Nanoseconds now);  // whether it gave one
  void look_at_own_id(Nanoseconds now);
  [[nodiscard]] bool loses_by_witnesses(const Claimant& rival, Nanoseconds now) const noexcept;
  template <typename Names>
  [[nodiscard]] Support support(const Names& names) const noexcept;
  void take_next_id(Nanoseconds now);
  [[nodiscard]] PeerId draw_id() noexcept;
  [[nodiscard]] Nanoseconds restart_at(const Claimant& claimant, const Peer& holder) const noexcept;
  [[nodiscard]] bool is_over(const pdu::Presence& heard, Nanoseconds now,
                             const SourceAddress& from);
  [[nodiscard]] Nanoseconds next_identity_step() const noexcept;

  PresenceConfig config_;
  pdu::Presence own_;
  LifeChain chain_;
  bool running_ = false;
  Nanoseconds next_ = Nanoseconds::max();
  Cause next_cause_ = Cause::news;
  Nanoseconds next_list_ = Nanoseconds::max();
  Nanoseconds brisk_until_ = Nanoseconds::min();
  Nanoseconds insist_until_ = Nanoseconds::min();
  Nanoseconds gap_{0};                   // until we repeat ourselves again
  std::optional<Nanoseconds> last_;      // our last announcement under this id
  std::optional<Nanoseconds> awake_;     // when we were last called
  Nanoseconds claimed_{0};               // since when our id is ours
  int yields_ = 0;                       // ids lost in a row, none held for long
  std::optional<Nanoseconds> yield_at_;  // we have lost it, and draw another then
  bool yields_for_good_ = false;         // .. also if we become established until then
  bool settled_told_ = false;            // of this id
  std::uint32_t draws_ = 0;              // ids drawn so far
  Nanoseconds next_verdict_{0};          // when witnesses are counted again
  Nanoseconds next_eviction_{0};         // when one of a crowd may go again
  PeerTable peers_;
  Nanoseconds silent_at_ = Nanoseconds::max();  // nobody is silent for too long before
  Nanoseconds heard_since_ = Nanoseconds::max();
  Nanoseconds next_move_ = Nanoseconds::max();  // when somebody may have moved
  Nanoseconds wrong_since_ = Nanoseconds::min() / 2;
  std::uint32_t wrong_steps_ = 0;  // of the function for wrong proofs, since then
  SourceAddress own_source_;       // where we send from
  bool look_ = false;              // one that was quiet may have been heard
  std::uint32_t listed_to_ = 0;    // the last one of the last part of our list
  std::vector<Claimant> claimants_;
  FormerLives former_;
  std::vector<SourceAddress> crowds_;  // reported, oldest first
  std::vector<std::uint32_t> list_;
  std::vector<pdu::Presence> outgoing_, farewells_;
  PresenceEvents events_;
  PresenceCounts counts_;
};

}  // namespace reckon::aoim
