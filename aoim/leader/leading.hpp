// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The part of a peer in leading cells: the groups that are handed out, and the states that leaders
// keep for newcomers.
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
#include "reckon/aoim/groups/group_index.hpp"
#include "reckon/aoim/interest/subscription.hpp"
#include "reckon/aoim/leader/leader_role.hpp"
#include "reckon/aoim/presence/presence.hpp"

namespace reckon::aoim {

/// A beacon of ours, and where what carries it is.
struct PlacedBeacon {
  std::uint32_t tag = 0;  ///< see beacon_tag; not 0
  Position position;      ///< [m], in S
};

/// Between LeaderRole, which knows cells and lives, and the groups of this peer. One thread;
/// allocates as cells, members and entities are new.
class Leading {
 public:
  using Nanoseconds = std::chrono::nanoseconds;
  using Locate = std::function<Position(const pdu::WorldCoordinates&)>;

  /// @param cells, subscription, presence outlive this  @param pool groups of the scene
  /// @param locate see AreaOfInterestConfig
  /// @throws std::invalid_argument as LeaderRole does
  Leading(const LeaderConfig& config, std::size_t pool, const CellPartition& cells,
          const Subscription& subscription, const Presence& presence, Locate locate);

  void start(Nanoseconds utc, Nanoseconds now);
  /// The next step says good-bye.
  void stop() noexcept { leaves_cells_ = true; }
  /// Elections, maps and snapshots of ours. @param send as LeaderRole::step
  void step(Nanoseconds now, std::uint32_t timestamp, const LeaderRole::Send& send);
  [[nodiscard]] Nanoseconds next_step() const noexcept {
    return leaves_cells_ ? Nanoseconds::min() : role_.next_step();
  }

  [[nodiscard]] const LeaderRole& role() const noexcept { return role_; }
  [[nodiscard]] LeaderRole& role() noexcept { return role_; }
  [[nodiscard]] bool hands_out() const noexcept { return config_.hand_out; }

  // Groups ----------------------------------------------------------------------------------------

  /// The group in which the cell of this group is spoken in, as of the last step.
  [[nodiscard]] GroupIndex speak_group(GroupIndex cell) const noexcept {
    return hands_out() ? role_.speak_group(cells_.cell_of(cell), stepped_) : cell;
  }
  /// Cells that we listen to have changed. @return groups to join and to leave, until the next call
  SubscriptionChange follow(const SubscriptionChange& cells, Nanoseconds utc, Nanoseconds now);

  // States ----------------------------------------------------------------------------------------

  /// A state of ours, which the others receive when its bundle leaves.
  void note_own(GroupIndex cell, const pdu::EntityState& state, std::span<const std::byte> records,
                Nanoseconds deadline);
  /// A datagram of this life, from a peer that is known and at its own address.
  void receive(GroupIndex group, std::span<const std::byte> datagram, std::uint32_t sender,
               Nanoseconds now, Nanoseconds came);
  /// Entity States that leaders have relayed of what we came too late for, as far as their owners
  /// are known by now. One that is older than what the owner itself sent is to be dropped.
  [[nodiscard]] std::vector<RelayedState> take_relayed(Nanoseconds now);
  /// Whether take_relayed() has anything to look at.
  [[nodiscard]] bool has_relayed() const noexcept {
    return role_.has_relayed() || !relayed_.empty();
  }

  // Beacons ---------------------------------------------------------------------------------------

  /// All beacons of ours and where they are, in the place of those before: who follows one listens
  /// to its cell. Nothing where no groups are handed out. Call it when one has moved; it costs
  /// little where none is in another cell.
  void set_beacons(std::span<const PlacedBeacon> beacons, Nanoseconds now);
  /// The cell in which a beacon of ours is, as the map of groups names it; none where it is not.
  [[nodiscard]] std::optional<CellId> carried_in(std::uint32_t tag) const noexcept;

 private:
  void read_cells(Nanoseconds now);
  [[nodiscard]] GroupIndex kept_as(GroupIndex group, const pdu::EntityState& state) const;
  void note_attribute(std::span<const std::byte> octets, std::uint32_t sender);

  LeaderConfig config_;
  const CellPartition& cells_;
  const Subscription& subscription_;
  const Presence& presence_;
  Locate locate_;
  LeaderRole role_;
  /// A group of the pool that was handed out to a cell of ours.
  struct HandedOut {
    GroupIndex cell;                   ///< its number in subscription_
    std::chrono::nanoseconds until{};  ///< others may speak there
    bool joined = false;
  };
  std::vector<HandedOut> handed_out_;  // by group index - 1
  std::vector<bool> unread_;  // cells whose leaders are still to be asked, by their number - 1
  std::vector<GroupIndex> join_, leave_;
  std::vector<CarriedBeacon> carried_;                         // of ours
  std::vector<std::pair<Nanoseconds, RelayedState>> relayed_;  // and when
  bool started_ = false;
  Nanoseconds begun_{};        // when we started
  Nanoseconds stepped_{};      // the last time
  bool leaves_cells_ = false;  // with the next step
};

}  // namespace reckon::aoim
