// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The layer between a peer and the link. Four duties, and the control traffic they need:
//   1 route      an entity's position -> the group its PDUs go to
//   2 subscribe  my entities' foci -> groups to join and to leave
//   3 filter     an incoming datagram, then each remote entity -> use or drop, with counts
//   4 aggregate  PDUs -> datagrams per group, by size and deadline
// Pure code: no socket, no clock. One thread; after construction and the first seconds it allocates
// nothing.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "reckon/aoim/area_of_interest_config.hpp"
#include "reckon/aoim/bundling/aggregator.hpp"
#include "reckon/aoim/cells/cell_partition.hpp"
#include "reckon/aoim/groups/sequence_tracker.hpp"
#include "reckon/aoim/incoming_datagram.hpp"
#include "reckon/aoim/interest/interest.hpp"
#include "reckon/aoim/interest/receiver_channels.hpp"
#include "reckon/aoim/interest/subscription.hpp"
#include "reckon/aoim/leader/leader_role.hpp"
#include "reckon/aoim/presence/introduction.hpp"
#include "reckon/aoim/presence/introduction_budget.hpp"
#include "reckon/aoim/presence/join_asks.hpp"
#include "reckon/aoim/presence/presence.hpp"
#include "reckon/pdu/reckon/cell_membership.hpp"

namespace reckon::aoim {

/// A beacon of ours, and where what carries it is.
struct PlacedBeacon {
  std::uint32_t tag = 0;  ///< see beacon_tag; not 0
  Position position;      ///< [m], in S
};

/// A beacon that we follow.
struct FollowedBeacon {
  std::uint32_t tag = 0;
  bool found = false;  ///< in the map of groups; else `cell` is where it was last
  CellId cell;         ///< of the tile at the origin: its number is what counts
  GroupIndex group;    ///< in which its cell is spoken in; the base group where it has none
  GroupIndex number;   ///< of its cell in subscription(); 0: we do not listen to it
  std::chrono::nanoseconds until{};  ///< and where it is not found, for how long still
};

/// The AOIM layer of one peer.
class AreaOfInterestManager {
 public:
  /// `own`: who we are (see Presence); cell scheme, cell size and pool are filled in from the
  /// cells.
  /// @throws std::invalid_argument as its parts do, for contact groups where there can be none, and
  /// for more cells than groups.
  AreaOfInterestManager(const AreaOfInterestConfig& config, const pdu::Presence& own);

  /// Begins to announce ourselves at the next step. Call set_foci first, so that the groups are
  /// joined when the others introduce their entities.
  void start(std::chrono::nanoseconds now);
  /// The next step says good-bye.
  void stop();
  /// UTC since 1970 = now + offset; see Aggregator::set_utc_offset.
  void set_utc_offset(std::chrono::nanoseconds offset, bool synchronised) noexcept;

  // 1 route ---------------------------------------------------------------------------------------

  /// Group of what happens at this point [m, S]; where groups are handed out, as of the last step.
  [[nodiscard]] GroupIndex route(const Position& position) const noexcept;

  /// Queues an Entity State, with the records of its force model and energy accounts (may be
  /// empty), for the group of its position. See Aggregator::add.
  AddResult send(const pdu::EntityState& state, const Position& position,
                 std::span<const std::byte> records, const BundleTerms& terms);
  /// The same with the state in a compressed form; see Aggregator::add_compressed.
  AddResult send_compressed(const pdu::EntityId& entity, pdu::CompressedForm form,
                            std::span<const std::byte> state, const Position& position,
                            std::span<const std::byte> records, const BundleTerms& terms);
  /// Queues any other encoded PDU that concerns this point.
  AddResult send(std::span<const std::byte> pdu, const Position& position,
                 const BundleTerms& terms);
  /// Queues records alone.
  AddResult send_records(const pdu::EntityId& entity, const Position& position,
                         std::span<const std::byte> records, const BundleTerms& terms);
  /// Queues an encoded PDU for everyone (base group), e.g. Stop/Freeze.
  AddResult send_to_all(std::span<const std::byte> pdu, const BundleTerms& terms);

  /// Whether what is felt has groups of its own.
  [[nodiscard]] bool has_contact_groups() const noexcept { return contacts_.has_value(); }
  /// The same as send() for the contact group of that position: only who listens there hears it. To
  /// be called where has_contact_groups() alone. Leaders keep nothing of it.
  AddResult send_felt(const pdu::EntityState& state, const Position& position,
                      std::span<const std::byte> records, const BundleTerms& terms);

  /// Rows of the channels that have groups of their own, the nearest being 0; 0 without near
  /// groups. The row behind them is said in the group of the cell.
  [[nodiscard]] std::size_t near_rows() const noexcept { return nears_.size(); }
  /// The same as send() for the group of that position and near row, below near_rows(): who listens
  /// there or in a nearer row hears it.
  AddResult send_near(std::size_t row, const pdu::EntityState& state, const Position& position,
                      std::span<const std::byte> records, const BundleTerms& terms);
  /// The same as send_compressed() for that group.
  AddResult send_near_compressed(std::size_t row, const pdu::EntityId& entity,
                                 pdu::CompressedForm form, std::span<const std::byte> state,
                                 const Position& position, const BundleTerms& terms);
  /// Whether somebody has begun to listen to this near row of the entity's cell who may not know
  /// what was said in it. @param last_told when that was, or something by a row behind it
  [[nodiscard]] bool must_send_near(std::size_t row, const pdu::EntityId& entity,
                                    const Position& position, std::chrono::nanoseconds last_told,
                                    std::chrono::nanoseconds now) const noexcept;
  /// The row whose listeners hear this group: a near row, near_rows() for the group of a cell and
  /// the base group. A contact group's are among those of row 0.
  [[nodiscard]] std::size_t row_of(GroupIndex group) const noexcept;
  [[nodiscard]] bool is_near_group(GroupIndex group) const noexcept;

  /// Beside the peer's own thresholds and heartbeat: must this entity's Entity State be sent now,
  /// because a newcomer does not know it or because it has entered another cell than the group its
  /// last one went to? `last_whole`: when one last left that tells a newcomer everything (far in
  /// the past if never).
  [[nodiscard]] bool must_send(const pdu::EntityId& entity, const Position& position,
                               GroupIndex last_group, std::chrono::nanoseconds last_whole,
                               std::chrono::nanoseconds now) const noexcept;

  /// How many entities this peer owns: the more, the longer answering a newcomer takes, so that no
  /// more than about 15,000 datagrams a second do so. Call it when the number changes.
  void set_owned(std::size_t count) noexcept;
  /// An entity was sent because must_send or must_send_near asked for it, in so many octets. Who
  /// causes more than one introduction of everything in a second waits for the next one.
  void note_introduced(std::size_t octets, std::chrono::nanoseconds now) noexcept;
  /// Where those are who receive what we send; null where it is not thinned out by that.
  [[nodiscard]] ReceiverChannels* receivers() noexcept { return channels_ ? &*channels_ : nullptr; }
  /// How far distances count to a peer: what it announces. 1 where it is not known.
  [[nodiscard]] double stretch_of(std::uint32_t epoch) const noexcept {
    return presence_.stretch_of(epoch);
  }
  /// What we announce of that from now on; see ChannelTable::fit.
  void set_stretch(double stretch) noexcept {
    stretch_ = stretch;
    presence_.set_stretch(stretch);
  }
  /// Where this peer sends from; once that has changed others are to know soon.
  void note_own_source(const SourceAddress& source, std::chrono::nanoseconds now) noexcept {
    presence_.note_own_source(source, now);
  }
  /// False while nobody is new: must_send then is true only for entities in another cell, that is
  /// where route(position) is not the last group.
  [[nodiscard]] bool introduction_pending() const noexcept { return introduction_.is_pending(); }

  // 2 subscribe -----------------------------------------------------------------------------------

  /// Tells what our entities sense now; call it every step or whenever a focus has moved. Join and
  /// leave what the answer lists. The base group is to be joined always.
  SubscriptionChange set_foci(std::span<const Focus> foci, std::chrono::nanoseconds now);

  /// Tells where something of ours can be felt, and from how far away; call it with set_foci. The
  /// answer lists contact groups; it is empty without them. A group is kept until its cell is
  /// beyond twice the reach, and for as long as any other.
  SubscriptionChange set_contact_foci(std::span<const Focus> foci, std::chrono::nanoseconds now);

  /// Tells anew how far our entities sense, for the groups of near rows; call it after set_foci.
  /// Rows are as near as our stretch has them (set_stretch), so that over its budget a peer leaves
  /// the far ones of them. The answer lists near groups; it is empty without them.
  /// @param radius that entities sense [m]: what a focus has beyond that it has for each row
  SubscriptionChange set_near_foci(std::span<const Focus> foci, double radius,
                                   std::chrono::nanoseconds now);

  // 3 filter --------------------------------------------------------------------------------------

  /// Judges a datagram that arrived on `group`, counts losses, and consumes the control PDUs in it
  /// (presence, membership). Never throws; any octets may come. About 50 ns outside the base group.
  /// @param from what it says it comes from
  /// @param came when it arrived, where it has waited since: a map of groups is as old as that
  Incoming receive(GroupIndex group, std::span<const std::byte> datagram,
                   std::chrono::nanoseconds now, const SourceAddress& from = {},
                   std::optional<std::chrono::nanoseconds> came = {});

  /// Judges one remote entity; see Interest::judge. Ask again as its predicted position moves.
  /// Where there are locales, one in a locale that we do not listen to is hidden.
  InterestVerdict judge(const Position& position, double nimbus, std::uint8_t kind,
                        bool shown) noexcept {
    if (is_walled_off(position)) return interest_.judge_hidden();
    return interest_.judge(position, nimbus, kind, shown, is_followed(position, shown));
  }
  /// See Interest::gap; the same holds, and it is 0 in the cell of a beacon that we follow.
  [[nodiscard]] double gap(const Position& position, double nimbus) const noexcept {
    if (is_followed(position, false)) return 0.0;
    const double away = interest_.gap(position, nimbus);
    return away <= 0.0 && is_walled_off(position) ? Interest::kHiddenGap : away;
  }
  /// See Interest::withdrawn; it leaps where a locale or the cell of a beacon is left.
  [[nodiscard]] double withdrawn() const noexcept { return interest_.withdrawn() + leapt_; }
  /// See Interest::spare; 0 in a locale that we do not listen to.
  [[nodiscard]] double spare(const Position& position, double nimbus, std::uint8_t kind) noexcept {
    if (is_walled_off(position)) return 0.0;
    return interest_.spare(position, nimbus, kind, is_followed(position, true));
  }
  /// Beacons that we follow, as of the last set_foci.
  [[nodiscard]] std::span<const FollowedBeacon> followed() const noexcept { return followed_; }
  /// See Interest::take_nearest_outside.
  double take_nearest_outside() noexcept { return interest_.take_nearest_outside(); }
  /// True for an entity of ours: what arrives under its id is an echo or a disputed address.
  [[nodiscard]] bool is_own(const pdu::EntityId& entity) const noexcept {
    return entity.simulation() == presence_.id();
  }

  /// With leaders: the Entity States that leaders have told us of what we came too late for, as far
  /// as their owners are known by now. One that is older than what the owner itself said is to be
  /// dropped.
  [[nodiscard]] std::vector<ToldState> take_told(std::chrono::nanoseconds now);
  /// Whether take_told() has anything to look at.
  [[nodiscard]] bool has_told() const noexcept {
    return leader_ && (leader_->has_told() || !told_.empty());
  }
  /// Our part in leading; null where cells have no leaders.
  [[nodiscard]] const LeaderRole* leader() const noexcept { return leader_ ? &*leader_ : nullptr; }
  /// All beacons of ours and where they are, in the place of those before: who follows one listens
  /// to its cell. Nothing where no groups are handed out. Call it when one has moved; it costs
  /// little where none is in another cell.
  void set_beacons(std::span<const PlacedBeacon> beacons, std::chrono::nanoseconds now);
  /// The cell in which a beacon of ours is, as the map of groups names it; none where it is not.
  [[nodiscard]] std::optional<CellId> carried_in(std::uint32_t tag) const noexcept;

  // 4 aggregate -----------------------------------------------------------------------------------

  /// Emits what is due: announcements, memberships, bundles. `sink` gets (GroupIndex,
  /// std::span<const std::byte>) and must not call the manager.
  void step(std::chrono::nanoseconds now, DatagramSink sink);
  /// Emits everything that waits, e.g. after stop.
  void flush(std::chrono::nanoseconds now, DatagramSink sink);
  /// Hands over what waits, without a word of presence: for who throws it away, being too old.
  void empty(std::chrono::nanoseconds now, DatagramSink sink) { aggregator_.flush_all(now, sink); }
  /// When step has to be called next at the latest; duration max where nothing is pending.
  [[nodiscard]] std::chrono::nanoseconds next_step() const noexcept;

  // Who is here, and what happened ----------------------------------------------------------------

  /// Events since the last call, to be asked for every step; good until the next call. The manager
  /// has drawn its own conclusions (introductions, counts, our new id) already.
  [[nodiscard]] std::span<const PresenceEvent> take_events();

  [[nodiscard]] const Presence& presence() const noexcept { return presence_; }
  [[nodiscard]] const CellPartition& cells() const noexcept { return cells_; }
  /// Of cells: where groups are handed out, each has a number of its own here, else that of its
  /// group.
  [[nodiscard]] const Subscription& subscription() const noexcept { return subscription_; }
  /// Groups that we have joined, the base group not counted.
  [[nodiscard]] std::size_t joined_groups() const noexcept;
  /// Whether we have joined this one; the base group always.
  [[nodiscard]] bool hears(GroupIndex group) const noexcept;
  [[nodiscard]] const Interest& interest() const noexcept { return interest_; }
  [[nodiscard]] const Aggregator& aggregator() const noexcept { return aggregator_; }
  [[nodiscard]] const SequenceTracker& sequences() const noexcept { return sequences_; }
  /// Datagrams by verdict since the start.
  [[nodiscard]] std::uint64_t incoming(IncomingVerdict verdict) const noexcept {
    return incoming_[static_cast<std::size_t>(verdict)];
  }

 private:
  [[nodiscard]] IncomingVerdict judge_datagram(GroupIndex group, const SourceAddress& from,
                                               Incoming& incoming) noexcept;
  [[nodiscard]] bool is_of_exercise(
      GroupIndex group, std::span<const std::byte> datagram,
      const std::optional<pdu::DatagramTrailer>& trailer) const noexcept;
  void consume_control(std::span<const std::byte> datagram, std::chrono::nanoseconds now,
                       const SourceAddress& from);
  void note_membership(const pdu::CellMembership& membership, std::chrono::nanoseconds now,
                       const SourceAddress& from);
  void take_from_leaders(GroupIndex group, std::span<const std::byte> datagram,
                         std::uint32_t sender, const SourceAddress& from,
                         std::chrono::nanoseconds now, std::chrono::nanoseconds came);
  [[nodiscard]] GroupIndex kept_as(GroupIndex group, const pdu::EntityState& state) const;
  void note_state(GroupIndex group, const pdu::EntityState& state,
                  std::span<const std::byte> records, std::chrono::nanoseconds deadline);
  void note_attribute(std::span<const std::byte> octets, std::uint32_t sender);
  void lead(std::chrono::nanoseconds now);
  void ask_owners(CellId cell);
  void ask_near(std::size_t row, CellId cell);
  void introduce_to(GroupIndex group, std::chrono::nanoseconds heard_for,
                    std::chrono::nanoseconds now);
  void introduce_to_waiting(std::chrono::nanoseconds now);
  void announce_membership(pdu::MembershipAction action, std::size_t row,
                           std::vector<std::byte>& cells, std::chrono::nanoseconds now);
  void add_membership(pdu::CellMembership membership, std::chrono::nanoseconds now);
  void ask_about_joins(bool announcing, std::chrono::nanoseconds now);
  void note_near(const pdu::CellMembership& membership, std::chrono::nanoseconds now);
  [[nodiscard]] std::span<const GroupIndex> find_followed(std::chrono::nanoseconds now);
  [[nodiscard]] bool is_followed(const Position& position, bool shown) const noexcept {
    return !followed_.empty() && is_in_followed_cell(position, shown);
  }
  [[nodiscard]] bool is_in_followed_cell(const Position& position, bool shown) const noexcept;
  SubscriptionChange follow_map(const SubscriptionChange& cells, std::chrono::nanoseconds now);
  void read_cells(std::chrono::nanoseconds now);
  /// The pools before the one that a group is of: 0 of cells, then those of near rows, then that of
  /// what is felt.
  [[nodiscard]] std::size_t pools_before(GroupIndex group) const noexcept {
    return group == kBaseGroup ? 0 : (group.value - 1u) / config_.grid.pool;
  }
  [[nodiscard]] GroupIndex in_pool(std::size_t pool, GroupIndex cell) const noexcept {
    return {static_cast<std::uint16_t>(cell.value + pool * config_.grid.pool)};
  }
  [[nodiscard]] bool is_contact_group(GroupIndex group) const noexcept {
    return contacts_ && pools_before(group) == nears_.size() + 1;
  }
  [[nodiscard]] GroupIndex near_group(std::size_t row, GroupIndex cell) const noexcept {
    return in_pool(row + 1, cell);
  }
  [[nodiscard]] GroupIndex contact_group(GroupIndex cell) const noexcept {
    return in_pool(nears_.size() + 1, cell);
  }
  [[nodiscard]] bool is_walled_off(const Position& position) const noexcept {
    return cells_.as<LocaleMap>() != nullptr && is_finite(position) &&
           !subscription_.is_joined(cells_.group(position));
  }
  void leap() noexcept { leapt_ += 2.0 * Interest::kFarthest; }
  [[nodiscard]] bool hands_out() const noexcept { return leader_ && config_.leader.hand_out; }
  void conclude(std::chrono::nanoseconds now);
  void announce(std::chrono::nanoseconds now);
  void announce_peers_heard(std::chrono::nanoseconds now);
  void announce_memberships(std::chrono::nanoseconds now);
  void note_said(std::chrono::nanoseconds now) noexcept;

  AreaOfInterestConfig config_;
  CellPartition cells_;
  Subscription subscription_;
  std::optional<Subscription> contacts_;  ///< to the same cells, for what is felt in them
  std::vector<Subscription> nears_;       ///< the same for each near row of channels
  Interest interest_;
  Aggregator aggregator_;
  Presence presence_;
  Introduction introduction_;
  SequenceTracker sequences_;
  JoinAsks asks_;
  HeardAsks heard_asks_;
  std::optional<LeaderRole> leader_;
  /// A group of the pool that was handed out to a cell of ours.
  struct HandedOut {
    GroupIndex cell;                   ///< its number in subscription_
    std::chrono::nanoseconds until{};  ///< others may speak there
    bool joined = false;
  };
  std::vector<HandedOut> handed_out_;  ///< by group index - 1
  std::vector<bool> unread_;  ///< cells whose leaders are still to be asked, by their number - 1
  std::vector<GroupIndex> join_, leave_;
  std::vector<Focus> near_foci_;
  double stretch_ = 1.0;  ///< ours, see set_stretch()
  double leapt_ = 0.0;    ///< [m], see withdrawn()
  std::vector<FollowedBeacon> followed_;
  std::vector<GroupIndex> besides_;     ///< numbers of their cells
  std::vector<CarriedBeacon> carried_;  ///< of ours
  std::optional<ReceiverChannels> channels_;
  std::vector<Focus> wide_;  ///< foci as far as a nimbus may reach them
  std::vector<std::pair<std::chrono::nanoseconds, ToldState>> told_;  ///< and when
  bool started_ = false;
  std::chrono::nanoseconds begun_{};    ///< when we started
  std::chrono::nanoseconds stepped_{};  ///< the last time, with leaders
  bool leaves_cells_ = false;           ///< with the next step
  bool introduce_ = false;              ///< with our next announcement: somebody is new
  /// What those who came lately cause together, and what those whom we have known for long do.
  struct Introduced {
    IntroductionBudget budget;
    std::vector<GroupIndex> waiting;  ///< none twice
    std::vector<bool> waits;          ///< by group
    std::chrono::nanoseconds until = std::chrono::nanoseconds::min();  ///< the last one goes on
  };
  Introduced strangers_, members_;
  std::size_t owned_ = 0;
  double introduced_octets_ = 208.0;  ///< of one entity, on average
  std::chrono::nanoseconds utc_offset_{};
  bool synchronised_ = false;
  std::uint64_t datagrams_said_ = 0;                                 ///< until the last step
  std::chrono::nanoseconds said_ = std::chrono::nanoseconds::min();  ///< when the last one left
  std::vector<std::byte> peers_heard_;   ///< encoded PeerEpoch of the list that is told now
  std::vector<std::byte> joined_cells_;  ///< encoded CellIndex of joins not told yet
  std::vector<std::vector<std::byte>> joined_near_;  ///< the same of near rows
  std::vector<PresenceEvent> events_, taken_;
  std::array<std::uint64_t, kIncomingVerdicts> incoming_{};
};

}  // namespace reckon::aoim
