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
#include "reckon/aoim/presence/source_address.hpp"
#include "reckon/pdu/reckon/peers_heard.hpp"
#include "reckon/pdu/reckon/presence_pdu.hpp"

namespace reckon::aoim {

/// Tunables of the presence protocol; all times > 0.
struct PresenceConfig {
  std::chrono::nanoseconds heartbeat = std::chrono::seconds(1);
  /// Announcements missed in a row after which a peer is lost; default 6. At 20 % loss three in a
  /// row go missing every two minutes, six every four hours.
  int missed = 6;
  /// Least time between two announcements of ours, so that many newcomers cause no storm; default
  /// 100 ms. It is also the slack that the last missed announcement is given.
  std::chrono::nanoseconds minimum_gap = std::chrono::milliseconds(100);
  /// After a start or a newcomer we announce ourselves again after `brisk_gap`, twice that and so
  /// on up to half a heartbeat, until all whom we hear list us, for the time `brisk` at most: at 20
  /// % loss everybody knows everybody within 2 s, and without loss nothing is said twice. In a
  /// dispute, or with a new id of ours, every `brisk_gap` for all of that time.
  std::chrono::nanoseconds brisk_gap = std::chrono::milliseconds(150);
  std::chrono::nanoseconds brisk = std::chrono::milliseconds(1500);
  /// A new epoch under a live id is a restart when the old life says nothing for so long; where the
  /// old life itself has just begun, as in a race for the id, for `race_wait`.
  std::chrono::nanoseconds restart_wait = std::chrono::milliseconds(500);
  std::chrono::nanoseconds race_wait = std::chrono::milliseconds(800);
  /// Who has lost its id listens for so long before it draws another, so as to know which are free.
  std::chrono::nanoseconds listen = std::chrono::milliseconds(100);
  /// Who has held its id for so long gives way to no newcomer.
  std::chrono::nanoseconds established = std::chrono::seconds(2);
  /// Two that are both established, as after a partition, ask their witnesses after so long; after
  /// half of it where all of them have spoken.
  std::chrono::nanoseconds dispute = std::chrono::milliseconds(2500);
  /// A peer that proves itself from another address speaks from there when its old one has said
  /// nothing for so long since; from the one before at once.
  std::chrono::nanoseconds still = std::chrono::milliseconds(200);
  /// A life that has offered no proof and is over may come back from another address after so long.
  std::chrono::nanoseconds pin = std::chrono::seconds(3);
  /// One that proves itself takes its id back from who came meanwhile, if it was silent for no
  /// longer.
  std::chrono::nanoseconds take_back = std::chrono::seconds(30);
  /// How lives prove that they are the same as before; null: they do not, and keep their address.
  OneWay one_way = nullptr;
  ChainLink secret{};  ///< of this life, drawn at random
  /// Silence after which a peer is reported as quiet.
  std::chrono::nanoseconds quiet = std::chrono::milliseconds(2500);
  /// Peers heard within this time are in our list of those whom we hear.
  std::chrono::nanoseconds listed = std::chrono::milliseconds(1750);
  /// Peers remembered; default 1,024. Further ones are counted and not joined, unless one can go
  /// that announced itself once and said nothing since, or never said whom it hears.
  std::size_t capacity = 1024;
  /// Peers believed of one address and port, that is of one process; default 64, what a replayed
  /// exercise may have. Of one address: half of `capacity`.
  std::size_t per_source = 64;
  /// Claims to the id of another that are looked into at a time; default 256. Further claimants are
  /// heard when they announce themselves again.
  std::size_t claims = 256;
  /// Peers that one list tells; default 256. Who hears more tells them in turns of `part`, default
  /// 192, at least 2: the list, an announcement and what else goes with it fit one datagram.
  std::size_t most_listed = 256, part = 192;
};

/// What happened to a peer.
enum class PresenceEventKind : std::uint8_t {
  newcomer,          ///< same scene: joined. We introduce our entities to it now
  restarted,         ///< same id, new epoch: drop what its former life left behind, introduce
  renamed,           ///< it gave up the id `former`: drop the entities of that id, introduce
  moved,             ///< it speaks from `source` now, no more from `other`, and has proved itself
  departed,          ///< said good-bye, or lost its id: drop its entities
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
  unheard,      ///< it says that it does not hear us
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
  [[nodiscard]] std::span<const PresenceEvent> take_events();

  /// Whether the next step at `now` announces us.
  [[nodiscard]] bool is_due(std::chrono::nanoseconds now) const noexcept {
    return running_ && !yield_at_ && now >= next_;
  }
  /// Who we are at present.
  [[nodiscard]] const pdu::Presence& own() const noexcept { return own_; }
  [[nodiscard]] PeerId id() const noexcept { return own_.simulation; }
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
  [[nodiscard]] Nanoseconds patience() const noexcept;
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
  void tell(PresenceEventKind kind, const pdu::Presence& about);
  void tell(PresenceEventKind kind, const Peer& about);

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
  [[nodiscard]] Nanoseconds round() const noexcept;

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
  std::vector<PresenceEvent> events_, taken_;
  PresenceCounts counts_;
};

}  // namespace reckon::aoim
