// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The layer between a peer and the link. Four duties, and the control traffic they need:
//   1 route an entity's position -> the group of its PDUs
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
#include <vector>

#include "reckon/aoim/area_of_interest_config.hpp"
#include "reckon/aoim/bundling/aggregator.hpp"
#include "reckon/aoim/cells/cell_partition.hpp"
#include "reckon/aoim/cells/routed_position.hpp"
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
  /// `own`: our identity (see Presence); cell scheme, cell size and pool are filled in from the
  /// cells.
  /// @throws std::invalid_argument as its parts do, for tiers that the settings exclude, and for
  /// more cells than groups.
  AreaOfInterestManager(const AreaOfInterestConfig& config, const pdu::Presence& own);
  AreaOfInterestManager(const AreaOfInterestManager&) = delete;
  AreaOfInterestManager& operator=(const AreaOfInterestManager&) = delete;

  /// Announces this peer from the next step on. Call listen() first, so that the groups are joined
  /// when other peers introduce their entities.
  void start(std::chrono::nanoseconds now);
  /// The next step announces the end of this peer.
  void stop();
  /// UTC since 1970 = now + offset; see Aggregator::set_utc_offset.
  void set_utc_offset(std::chrono::nanoseconds offset, bool synchronised) noexcept;

  // 1 route ---------------------------------------------------------------------------------------

  /// Group for this position [m, S]. If leaders hand out groups, as of the last step.
  [[nodiscard]] GroupIndex route(const RoutedPosition& position) const noexcept;

  /// The recipient tiers of the scene.
  [[nodiscard]] const TierTable& tiers() const noexcept { return tiers_; }

  /// Queues an update for the group of this tier at that position [m, S]. For kEverybody, for
  /// example Stop/Freeze, the position is ignored. Refused for a tier that the scene does not have.
  /// The receivers of the tier must be able to decode a compressed form. Leaders keep only plain
  /// states of the cell's tier. See Aggregator::add.
  AddResult send(std::size_t tier, const UpdatePayload& update, const RoutedPosition& position,
                 const BundleTerms& terms);

  /// The last update of an entity to a tier.
  struct LastSent {
    std::chrono::nanoseconds at{};  ///< far in the past if never
    GroupIndex group;               ///< of the tier; used only for the cell's tier
  };
  /// Whether this entity's Entity State must be sent to the tier now, besides thresholds and
  /// heartbeat. True if a newcomer of the tier may lack it, or if the entity has entered a cell
  /// with another group since its last update. For the cell's tier, `last` is the last complete
  /// update.
  [[nodiscard]] bool must_send(std::size_t tier, const pdu::EntityId& entity,
                               const RoutedPosition& position, const LastSent& last,
                               std::chrono::nanoseconds now) const noexcept;

  /// Introductions of our entities to newcomers.
  [[nodiscard]] Introductions& introductions() noexcept { return introductions_; }
  [[nodiscard]] const Introductions& introductions() const noexcept { return introductions_; }
  /// Positions of the receivers; null if tiers do not depend on distance.
  [[nodiscard]] ReceiverChannels* receivers() noexcept { return channels_ ? &*channels_ : nullptr; }
  /// Factor of distances to this peer, which it announces from now on; see ChannelTable::fit.
  void set_stretch(double stretch) noexcept {
    subscriptions_.set_stretch(stretch);
    presence_.set_stretch(stretch);
  }
  /// One of our hands touches a hand of the peer with this epoch.
  void note_touched(std::uint32_t epoch, std::chrono::nanoseconds now) noexcept {
    presence_.note_touched(epoch, now);
  }
  /// The address from which this peer sends. A change is announced soon.
  void note_own_source(const SourceAddress& source, std::chrono::nanoseconds now) noexcept {
    presence_.note_own_source(source, now);
  }

  // 2 subscribe -----------------------------------------------------------------------------------

  /// Sets the foci of this peer for a tier. Call it for each tier, the cell's first, every step or
  /// whenever a focus has moved. Returns the groups to join and to leave, valid until the next
  /// call. The base group must always be joined.
  /// Which foci a tier has depends on its kind, see tier_kind.hpp. set_stretch() shortens the rows
  /// of channels, so that a peer over its budget leaves the distant cells.
  SubscriptionChange listen(std::size_t tier, std::span<const Focus> foci,
                            std::chrono::nanoseconds now);

  // 3 filter --------------------------------------------------------------------------------------

  /// Judges a datagram that arrived on `group`, counts losses, and consumes its control PDUs
  /// (presence, membership). Never throws, for any octets. About 50 ns outside the base group.
  /// @param from its source address
  /// @param came its arrival time, which may be earlier than now; a group map has this age
  Incoming receive(GroupIndex group, std::span<const std::byte> datagram,
                   std::chrono::nanoseconds now, const SourceAddress& from = {},
                   std::optional<std::chrono::nanoseconds> came = {});

  /// Decides which remote entities are of interest, and counts the decisions.
  [[nodiscard]] Sight& sight() noexcept { return sight_; }
  [[nodiscard]] const Sight& sight() const noexcept { return sight_; }
  /// This peer's part in leading cells; null if cells have no leaders.
  [[nodiscard]] Leading* leading() noexcept { return leading_ ? &*leading_ : nullptr; }
  [[nodiscard]] const Leading* leading() const noexcept { return leading_ ? &*leading_ : nullptr; }

  // 4 aggregate -----------------------------------------------------------------------------------

  /// Emits due announcements, memberships and bundles. `sink` gets (GroupIndex,
  /// std::span<const std::byte>) and must not call the manager.
  void step(std::chrono::nanoseconds now, DatagramSink sink);
  /// Also emits queued PDUs that are not due. Call it after the last step, or to clear the queue.
  void flush(std::chrono::nanoseconds now, DatagramSink sink) { aggregator_.flush_all(now, sink); }
  /// Deadline of the next step(); nanoseconds::max() if nothing is pending.
  [[nodiscard]] std::chrono::nanoseconds next_step() const noexcept;

  // Presence and events ---------------------------------------------------------------------------

  /// Events since the last call; call it every step. Valid until the next call. The manager has
  /// already applied them to itself (introductions, counts, our new ID).
  [[nodiscard]] std::span<const PresenceEvent> take_events();

  [[nodiscard]] const Presence& presence() const noexcept { return presence_; }
  [[nodiscard]] const CellPartition& cells() const noexcept { return cells_; }
  /// The joined cells and groups. A cell has the number of its group. If leaders hand out groups,
  /// each cell has its own number.
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
  void note_last_sent(std::chrono::nanoseconds now) noexcept;

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
  ReceivedAsks heard_asks_;
  std::optional<Leading> leading_;
  std::optional<ReceiverChannels> channels_;
  bool started_ = false;
  bool introduce_ = false;  ///< at our next announcement, for a newcomer
  std::chrono::nanoseconds utc_offset_{};
  bool synchronised_ = false;
  std::uint64_t datagrams_said_ = 0;                                 ///< until the last step
  std::chrono::nanoseconds said_ = std::chrono::nanoseconds::min();  ///< time of the last one
  PeersHeardEncoder peers_heard_;
  std::vector<PresenceEvent> events_, taken_;
  std::array<std::uint64_t, kIncomingVerdicts> incoming_{};
};

}  // namespace reckon::aoim
