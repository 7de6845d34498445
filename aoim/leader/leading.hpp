// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The leader functions of a peer: the assigned groups, and the states that leaders keep for
// newcomers.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "reckon/aoim/cells/cell_partition.hpp"
#include "reckon/aoim/groups/body_owners.hpp"
#include "reckon/aoim/groups/group_index.hpp"
#include "reckon/aoim/interest/subscription.hpp"
#include "reckon/aoim/leader/leader_role.hpp"
#include "reckon/aoim/presence/presence.hpp"

namespace reckon::aoim {

/// A beacon of ours, and the position of its carrier.
struct PlacedBeacon {
  std::uint32_t tag = 0;  ///< see beacon_tag; not 0
  Position position;      ///< [m], in S
};

/// Connects LeaderRole, which works with cells and epochs, with the groups of this peer. One
/// thread; allocates when cells, members and entities are new.
class Leading {
 public:
  using Nanoseconds = std::chrono::nanoseconds;
  using Locate = std::function<Position(const pdu::WorldCoordinates&)>;

  /// @param cells, subscription, presence, owners outlive this  @param pool groups of the scene
  /// @param owners see AreaOfInterestConfig
  /// @param locate see AreaOfInterestConfig
  /// @throws std::invalid_argument as LeaderRole does
  Leading(const LeaderConfig& config, std::size_t pool, const CellPartition& cells,
          const Subscription& subscription, const Presence& presence, const BodyOwners* owners,
          Locate locate);

  void start(Nanoseconds utc, Nanoseconds now);
  /// Makes the next step leave all cells.
  void stop() noexcept { leaves_cells_ = true; }
  /// Advances our elections, maps and snapshots.  @param send as for LeaderRole::step
  void step(Nanoseconds now, std::uint32_t timestamp, const LeaderRole::Send& send);
  [[nodiscard]] Nanoseconds next_step() const noexcept {
    return leaves_cells_ ? Nanoseconds::min() : role_.next_step();
  }

  [[nodiscard]] const LeaderRole& role() const noexcept { return role_; }
  [[nodiscard]] LeaderRole& role() noexcept { return role_; }
  [[nodiscard]] bool hands_out() const noexcept { return config_.hand_out; }

  // Groups ----------------------------------------------------------------------------------------

  /// The group used for the traffic of this cell, as of the last step.
  [[nodiscard]] GroupIndex speak_group(GroupIndex cell) const noexcept {
    return hands_out() ? role_.speak_group(cells_.cell_of(cell), stepped_) : cell;
  }
  /// Takes a change of the subscribed cells.
  /// @return groups to join and to leave, valid until the next call
  SubscriptionChange follow(const SubscriptionChange& cells, Nanoseconds utc, Nanoseconds now);

  // States ----------------------------------------------------------------------------------------

  /// Records a state of ours, which the others receive when its bundle is sent.
  void note_own(GroupIndex cell, const pdu::EntityState& state, std::span<const std::byte> records,
                Nanoseconds deadline);
  /// Takes a datagram of this epoch, from a known peer at its own address.
  void receive(GroupIndex group, std::span<const std::byte> datagram, std::uint32_t sender,
               Nanoseconds now, Nanoseconds came);
  /// Takes the Entity States that leaders relayed to us as a newcomer, except states of owners that
  /// are not known yet. The caller drops a state that is older than one from the owner itself.
  [[nodiscard]] std::vector<RelayedState> take_relayed(Nanoseconds now);
  /// Whether take_relayed() has anything to examine.
  [[nodiscard]] bool has_relayed() const noexcept {
    return role_.has_relayed() || !relayed_.empty();
  }

  // Beacons ---------------------------------------------------------------------------------------

  /// Replaces all beacons of ours and their positions. A follower of a beacon listens to its cell.
  /// Does nothing if no groups are assigned. Call it when a beacon has moved; it is cheap while
  /// none changes its cell.
  void set_beacons(std::span<const PlacedBeacon> beacons, Nanoseconds now);
  /// The cell of a beacon of ours in the map of groups; none if the map lacks it.
  [[nodiscard]] std::optional<CellId> carried_in(std::uint32_t tag) const noexcept;

 private:
  void read_cells(Nanoseconds now);
  [[nodiscard]] bool owns(std::uint32_t sender, const pdu::EntityId& entity) const noexcept;
  [[nodiscard]] GroupIndex kept_as(const pdu::EntityState& state) const;
  void note_attribute(std::span<const std::byte> octets, std::uint32_t sender);

  LeaderConfig config_;
  const CellPartition& cells_;
  const Subscription& subscription_;
  const Presence& presence_;
  const BodyOwners* owners_;
  Locate locate_;
  LeaderRole role_;
  /// A group of the pool that is assigned to a cell of ours.
  struct HandedOut {
    GroupIndex cell;                   ///< its number in subscription_
    std::chrono::nanoseconds until{};  ///< others may send there until then
    bool joined = false;
  };
  std::vector<HandedOut> handed_out_;  // by group index - 1
  std::vector<bool>
      unread_;  // whether the request to a cell's leader is still to be sent, by cell number - 1
  std::vector<GroupIndex> join_, leave_;
  std::vector<CarriedBeacon> carried_;                         // of ours
  std::vector<std::pair<Nanoseconds, RelayedState>> relayed_;  // with the time of arrival
  bool started_ = false;
  Nanoseconds begun_{};        // time of our start
  Nanoseconds stepped_{};      // time of the last step
  bool leaves_cells_ = false;  // with the next step
};

}  // namespace reckon::aoim
