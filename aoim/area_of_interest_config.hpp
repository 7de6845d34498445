// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What of the AOIM layer can be set, and what a peer announces of it.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "reckon/aoim/bundling/aggregator.hpp"
#include "reckon/aoim/cells/cell_partition.hpp"
#include "reckon/aoim/groups/sequence_tracker.hpp"
#include "reckon/aoim/interest/channel_table.hpp"
#include "reckon/aoim/interest/interest.hpp"
#include "reckon/aoim/interest/subscription.hpp"
#include "reckon/aoim/leader/leader_config.hpp"
#include "reckon/aoim/presence/introduction.hpp"
#include "reckon/aoim/presence/presence.hpp"
#include "reckon/aoim/tiers/tier_table.hpp"

namespace reckon::aoim {

/// Everything that can be set. The aggregator's sender, epoch, pool and exercise are taken from the
/// announcement and the grid.
struct AreaOfInterestConfig {
  /// Equal cells; of other cells, its pool alone counts.
  GridConfig grid;
  /// Other cells than equal ones, of at most as many groups as the pool has, or kMaximumPool where
  /// groups are handed out. All peers of a scene must have the same.
  std::optional<CellPartition> cells;
  SubscriptionConfig subscription;
  InterestConfig interest;
  AggregatorConfig aggregator;
  PresenceConfig presence;
  IntroductionConfig introduction;
  /// Leaders of cells, off by default. All peers of a scene must have the same.
  LeaderConfig leader;
  /// Tags of beacons whose cells we listen to, wherever they are; see beacon_tag. Where groups are
  /// handed out alone.
  std::vector<std::uint32_t> follow;
  /// Where the location of an Entity State lies in S [m], for leaders that hand out groups; none:
  /// it is in S.
  std::function<Position(const pdu::WorldCoordinates&)> locate;
  /// What is sent by distance to those who receive it; empty: everything to all. See
  /// ReceiverChannels.
  std::vector<Channel> channels;
  /// How far entities sense [m], >= 0: what a focus has beyond it, it has for each near row.
  double radius = 0.0;
  /// The largest nimbus of any entity [m], >= 0: cells are joined so much farther.
  double farthest_nimbus = 0.0;
  /// Each cell has a second group, for what is felt in it: the pool's numbers again, behind all
  /// others. Off by default; all peers of a scene must have the same. Not with `interop`, groups
  /// handed out, a pool of 1, or more than kMaximumPool groups in all.
  bool contact_groups = false;
  /// Each cell has a group for each near row of `channels`, too: the pool's numbers again, behind
  /// it. Off by default; all peers of a scene must have the same, with the same rows. As
  /// contact_groups, and not without a near row, with leaders, or where the nearest row has other
  /// thresholds than the scene.
  bool near_groups = false;
  /// (sender, group) pairs whose loss is counted; see SequenceTracker.
  std::size_t tracked = SequenceTracker::kCapacity;
  /// Plain DIS: everything goes to the base group, without presence and trailers.
  bool interop = false;
  /// An entity in another cell than its last Entity State was sent to is sent again after this at
  /// the earliest, so that one that trembles on a border does not flood; default 100 ms.
  std::chrono::nanoseconds crossing_gap = std::chrono::milliseconds(100);
};

/// The cells. Where groups are handed out, they have as many numbers as there can be.
/// @throws std::invalid_argument for cells that the pool or plain DIS cannot have
[[nodiscard]] CellPartition cells_of(const AreaOfInterestConfig& config);

/// Who receives what. @throws std::invalid_argument as ChannelTable does
[[nodiscard]] TierTable tiers_of(const AreaOfInterestConfig& config);

/// Groups behind the base group with these settings: those of the cells, of near rows, of what is
/// felt.
[[nodiscard]] std::size_t all_groups(const AreaOfInterestConfig& config);

/// What a peer announces of itself, with the cells and groups that `config` says.
[[nodiscard]] pdu::Presence announcement(pdu::Presence own, const AreaOfInterestConfig& config);

// The configurations of the manager's parts, completed
// ---------------------------------------------

/// @throws std::invalid_argument where contact or near groups are asked for that cannot be
[[nodiscard]] AggregatorConfig aggregator_of(const AreaOfInterestConfig& config,
                                             const pdu::Presence& own);
[[nodiscard]] InterestConfig interest_of(const AreaOfInterestConfig& config,
                                         const CellPartition& cells);
[[nodiscard]] IntroductionConfig introduction_of(const AreaOfInterestConfig& config,
                                                 const CellPartition& cells);

}  // namespace reckon::aoim
