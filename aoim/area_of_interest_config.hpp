// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Settings of the AOIM layer, and the part of them that a peer announces.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "reckon/aoim/bundling/aggregator.hpp"
#include "reckon/aoim/cells/cell_partition.hpp"
#include "reckon/aoim/groups/body_owners.hpp"
#include "reckon/aoim/groups/sequence_tracker.hpp"
#include "reckon/aoim/interest/channel_table.hpp"
#include "reckon/aoim/interest/interest.hpp"
#include "reckon/aoim/interest/subscription.hpp"
#include "reckon/aoim/leader/leader_config.hpp"
#include "reckon/aoim/presence/introduction.hpp"
#include "reckon/aoim/presence/presence.hpp"
#include "reckon/aoim/tiers/tier_table.hpp"

namespace reckon::aoim {

/// Settings of the AOIM layer. The aggregator gets sender, epoch, pool and exercise from the
/// announcement and the grid.
struct AreaOfInterestConfig {
  /// Equal cells. With other cells only its pool is used.
  GridConfig grid;
  /// Cells of other kinds, with at most as many groups as the pool, or kMaximumPool if leaders hand
  /// out groups. Equal for all peers of a scene.
  std::optional<CellPartition> cells;
  SubscriptionConfig subscription;
  InterestConfig interest;
  AggregatorConfig aggregator;
  PresenceConfig presence;
  IntroductionConfig introduction;
  /// Leaders of cells, off by default. Equal for all peers of a scene.
  LeaderConfig leader;
  /// Tags of the beacons that this peer follows: it joins their cells, wherever they are. See
  /// beacon_tag. Only if leaders hand out groups.
  std::vector<std::uint32_t> follow;
  /// Converts the location of an Entity State to S [m], for leaders that hand out groups. Empty:
  /// the location is already in S.
  std::function<Position(const pdu::WorldCoordinates&)> locate;
  /// Owners of the scene's bodies, for leaders; they outlive the manager. Null: bodies are entities
  /// like others.
  const BodyOwners* body_owners = nullptr;
  /// Recipient tiers by distance; empty: all receivers get everything. See ReceiverChannels.
  std::vector<Channel> channels;
  /// Sensing radius of entities [m], >= 0. The part of a focus radius beyond it is added to the end
  /// of each row of channels.
  double radius = 0.0;
  /// Largest nimbus of any entity [m], >= 0. Cells are joined this much farther away.
  double farthest_nimbus = 0.0;
  /// Kinds of all recipient tiers except the cell's, see TierTable. Each cell has a group for each
  /// of them, and the pool's numbers are repeated for each. Equal for all peers of a scene, with
  /// equal channels. One tier that runs ahead for each inner row of `channels`, or none; the
  /// nearest of these rows has the thresholds of the scene. Excludes `interop`, groups that leaders
  /// hand out, a pool of 1, and more than kMaximumPool groups in all; a tier that runs ahead
  /// excludes leaders.
  std::vector<const TierKind*> tiers;
  /// Most (sender, group) pairs whose loss is counted; see SequenceTracker.
  std::size_t tracked = SequenceTracker::kCapacity;
  /// Plain DIS: all PDUs go to the base group, without presence and trailers.
  bool interop = false;
  /// Shortest time before an entity that has entered another cell is sent there. It keeps an entity
  /// on a border between cells from flooding. Default 100 ms.
  std::chrono::nanoseconds crossing_gap = std::chrono::milliseconds(100);
};

/// The cells. If leaders hand out groups, the cells have kMaximumPool numbers.
/// @throws std::invalid_argument for cells that do not fit the pool or plain DIS
[[nodiscard]] CellPartition cells_of(const AreaOfInterestConfig& config);

[[nodiscard]] TierTable tiers_of(const AreaOfInterestConfig& config);

/// Number of groups after the base group, of all tiers.
[[nodiscard]] std::size_t all_groups(const AreaOfInterestConfig& config);

/// The announcement of a peer, with the cells and groups of `config`.
[[nodiscard]] pdu::Presence announcement(pdu::Presence own, const AreaOfInterestConfig& config);

// Complete configurations of the manager's parts -------------------------------------------------

/// @throws std::invalid_argument as ChannelTable does
[[nodiscard]] TierReach tier_reach_of(const AreaOfInterestConfig& config);
/// @throws std::invalid_argument for tiers that the other settings exclude
[[nodiscard]] AggregatorConfig aggregator_of(const AreaOfInterestConfig& config,
                                             const pdu::Presence& own);
[[nodiscard]] InterestConfig interest_of(const AreaOfInterestConfig& config,
                                         const CellPartition& cells);
[[nodiscard]] IntroductionConfig introduction_of(const AreaOfInterestConfig& config,
                                                 const CellPartition& cells);

}  // namespace reckon::aoim
