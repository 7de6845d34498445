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
#include "reckon/aoim/interest/receiver_channels.hpp"
#include "reckon/aoim/interest/sight.hpp"
#include "reckon/aoim/interest/subscription.hpp"
#include "reckon/aoim/leader/leading.hpp"
#include "reckon/aoim/presence/introductions.hpp"
#include "reckon/aoim/presence/join_asks.hpp"
#include "reckon/aoim/presence/peers_heard_encoder.hpp"
#include "reckon/aoim/presence/presence.hpp"
#include "reckon/aoim/tiers/join_announcer.hpp"
#include "reckon/aoim/tiers/tier_subscriptions.hpp"
#include "reckon/aoim/tiers/tier_table.hpp"
#include "reckon/aoim/tiers/update_payload.hpp"
#include "reckon/pdu/reckon/cell_membership.hpp"

namespace reckon::aoim {

/// The AOIM layer of one peer.
class AreaOfInterestManager {
 public:
  /// `own`: who we are (see Presence); cell scheme, cell size and pool are filled in from the
  /// cells.
  /// @throws std::invalid_argument as its parts do, for contact groups where there can be none, and
  /// for more cells than groups.
  AreaOfInterestManager(const AreaOfInterestConfig& config, const pdu::Presence& own);
  AreaOfInterestManager(const AreaOfInterestManager&) = delete;
  AreaOfInterestManager& operator=(const AreaOfInterestManager&) = delete;

  /// Begins to announce ourselves at the next step. Call listen first, so that the groups are
  /// joined when the others introduce their entities.
  void start(std::chrono::nanoseconds now);
  /// The next step says good-bye.
  void stop();
  /// UTC since 1970 = now + offset; see Aggregator::set_utc_offset.
  void set_utc_offset(std::chrono::nanoseconds offset, bool synchronised) noexcept;

  // 1 route ---------------------------------------------------------------------------------------

  /// Group of what happens at this point [m, S]; where groups are handed out, as of the last step.
  [[nodiscard]] GroupIndex route(const Position& position) const noexcept;

  /// Who receives what: the tiers of the scene.
  [[nodiscard]] const TierTable& tiers() const noexcept { return tiers_; }

  /// Queues an update for the group of this tier at that position [m, S]; for kEverybody, e.g.
  /// Stop/Freeze, the position does not count. Refused for a tier that the scene has not, in which
  /// nobody listens either. A compressed form has to be decoded by who listens
  /// to the tier. See Aggregator::add. Leaders keep plain states of the cell's tier alone.
  AddResult send(std::size_t tier, const UpdatePayload& update, const Position& position,
                 const BundleTerms& terms);

  /// What a tier received last of an entity.
  struct LastSent {
    std::chrono::nanoseconds at{};  ///< far in the past if never
    GroupIndex group;               ///< of the tier; that of the cell alone counts
  };
  /// Beside the peer's own thresholds and heartbeat: must this entity's Entity State be sent to the
  /// tier now, because somebody who has begun to listen to it may not know it, or because it has
  /// entered another cell than the group its last one went to? Of the cell's tier, `last` is that
  /// of an update that tells a newcomer everything.
  [[nodiscard]] bool must_send(std::size_t tier, const pdu::EntityId& entity,
                               const Position& position, const LastSent& last,
                               std::chrono::nanoseconds now) const noexcept;

  /// When our entities are introduced to newcomers.
  [[nodiscard]] Introductions& introductions() noexcept { return introductions_; }
  [[nodiscard]] const Introductions& introductions() const noexcept { return introductions_; }
  /// Where those are who receive what we send; null where it is not thinned out by that.
  [[nodiscard]] ReceiverChannels* receivers() noexcept { return channels_ ? &*channels_ : nullptr; }
  /// How far distances count to us: what we announce from now on; see ChannelTable::fit.
  void set_stretch(double stretch) noexcept {
    subscriptions_.set_stretch(stretch);
    presence_.set_stretch(stretch);
  }
  /// Where this peer sends from; once that has changed others are to know soon.
  void note_own_source(const SourceAddress& source, std::chrono::nanoseconds now) noexcept {
    presence_.note_own_source(source, now);
  }

  // 2 subscribe -----------------------------------------------------------------------------------

  /// Tells where this peer listens to a tier now; call it for each tier, the cell's first, every
  /// step or whenever a focus has moved. Join and leave what the answer lists; it lives until the
  /// next call. The base group is to be joined always.
  ///   cell        foci of what our entities sense
  ///   near row    the same foci: the row ends as our stretch has it (set_stretch), so that over
  ///               its budget a peer leaves the far ones
  ///   what is felt  where something of ours can be felt, and from how far away; a group is kept
  ///               until its cell is beyond twice the reach, and for as long as any other
  SubscriptionChange listen(std::size_t tier, std::span<const Focus> foci,
                            std::chrono::nanoseconds now);

  // 3 filter --------------------------------------------------------------------------------------

  /// Judges a datagram that arrived on `group`, counts losses, and consumes the control PDUs in it
  /// (presence, membership). Never throws; any octets may come. About 50 ns outside the base group.
  /// @param from what it says it comes from
  /// @param came when it arrived, where it has waited since: a map of groups is as old as that
  Incoming receive(GroupIndex group, std::span<const std::byte> datagram,
                   std::chrono::nanoseconds now, const SourceAddress& from = {},
                   std::optional<std::chrono::nanoseconds> came = {});

  /// Which remote entities are of interest, and what was judged.
  [[nodiscard]] Sight& sight() noexcept { return sight_; }
  [[nodiscard]] const Sight& sight() const noexcept { return sight_; }
  /// Our part in leading; null where cells have no leaders.
  [[nodiscard]] Leading* leading() noexcept { return leading_ ? &*leading_ : nullptr; }
  [[nodiscard]] const Leading* leading() const noexcept { return leading_ ? &*leading_ : nullptr; }

  // 4 aggregate -----------------------------------------------------------------------------------

  /// Emits what is due: announcements, memberships, bundles. `sink` gets (GroupIndex,
  /// std::span<const std::byte>) and must not call the manager.
  void step(std::chrono::nanoseconds now, DatagramSink sink);
  /// Emits what is queued and not yet due, too: after the step that follows stop, or to throw it
  /// away.
  void flush(std::chrono::nanoseconds now, DatagramSink sink) { aggregator_.flush_all(now, sink); }
  /// When step has to be called next at the latest; duration max where nothing is pending.
  [[nodiscard]] std::chrono::nanoseconds next_step() const noexcept;

  // Who is here, and what happened ----------------------------------------------------------------

  /// Events since the last call, to be asked for every step; good until the next call. The manager
  /// has drawn its own conclusions (introductions, counts, our new id) already.
  [[nodiscard]] std::span<const PresenceEvent> take_events();

  [[nodiscard]] const Presence& presence() const noexcept { return presence_; }
  [[nodiscard]] const CellPartition& cells() const noexcept { return cells_; }
  /// Which cells and groups we listen to. Of cells: where groups are handed out, each has a number
  /// of its own here, else that of its group.
  [[nodiscard]] const TierSubscriptions& subscriptions() const noexcept { return subscriptions_; }
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
  void lead(std::chrono::nanoseconds now);
  SubscriptionChange listen_to_cells(std::span<const Focus> foci, std::chrono::nanoseconds now);
  SubscriptionChange listen_beside_cells(std::size_t tier, std::span<const Focus> foci,
                                         std::chrono::nanoseconds now);
  [[nodiscard]] bool hands_out() const noexcept { return leading_ && leading_->hands_out(); }
  void conclude(std::chrono::nanoseconds now);
  void announce(std::chrono::nanoseconds now);
  [[nodiscard]] ControlStamp stamp(std::chrono::nanoseconds now) const noexcept;
  [[nodiscard]] JoinAnnouncer::Send to_everybody(std::chrono::nanoseconds now);
  void note_said(std::chrono::nanoseconds now) noexcept;

  AreaOfInterestConfig config_;
  CellPartition cells_;
  TierTable tiers_;
  TierSubscriptions subscriptions_;
  Sight sight_;
  Aggregator aggregator_;
  Presence presence_;
  Introductions introductions_;
  SequenceTracker sequences_;
  JoinAnnouncer joins_;
  HeardAsks heard_asks_;
  std::optional<Leading> leading_;
  std::optional<ReceiverChannels> channels_;
  bool started_ = false;
  bool introduce_ = false;  ///< with our next announcement: somebody is new
  std::chrono::nanoseconds utc_offset_{};
  bool synchronised_ = false;
  std::uint64_t datagrams_said_ = 0;                                 ///< until the last step
  std::chrono::nanoseconds said_ = std::chrono::nanoseconds::min();  ///< when the last one left
  PeersHeardEncoder peers_heard_;
  std::vector<PresenceEvent> events_, taken_;
  std::array<std::uint64_t, kIncomingVerdicts> incoming_{};
};

}  // namespace reckon::aoim
