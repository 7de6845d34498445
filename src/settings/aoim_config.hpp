// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The cells of a scene, and how far and what a peer senses.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "reckon/aoim/cells/cell_grid.hpp"
#include "reckon/pdu/codec/records.hpp"
#include "reckon/peer/settings/tier_config.hpp"

namespace reckon::peer {

/// Range at which entities of one type can be sensed beyond themselves.
struct NimbusClass {
  pdu::EntityType type{};  ///< 0 matches any number
  double nimbus = 0.0;     ///< [m] >= 0
};

/// A solid box along the axes of S.
struct OccluderConfig {
  Eigen::Vector3d from = Eigen::Vector3d::Zero(), to = Eigen::Vector3d::Zero();  ///< corners [m]
};

/// Selection among the received entities, and the budget for their updates.
struct AwarenessConfig {
  double budget = 0.0;  ///< [B/s] of updates that this peer can take; 0: unlimited
  std::string kinds;    ///< wanted kinds, as written; empty: all
  std::uint32_t kinds_wanted = 0xFFFFFFFFU;  ///< bit k: kind k
  double aura = 0.0;                         ///< [m]; 0: no bound
  std::vector<NimbusClass> nimbus;           ///< the first match applies
  std::vector<OccluderConfig> occluders;
};

/// A square, quartered repeatedly where there are many entities. The same at all peers of a scene.
struct QuadTreeConfig {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< of the square [m] S; z has no effect
  double side = 1000.0;                              ///< of the square [m] > 0
  double smallest = 10.0;                            ///< no cell has a shorter side [m] > 0
  std::uint32_t most = 0;           ///< cells; 0: as many as can have a group or a number
  std::filesystem::path density;    ///< see read_density(); absolute once loaded; empty: `leaves`
  double reach = 0.0;               ///< [m] range of the entities of the sample, > 0 with `density`
  std::string leaves;               ///< as written
  std::vector<aoim::CellId> cells;  ///< result of either; see aoim::QuadTree::of_cells
};

/// A part of the world with its own frame, for example a room. The same at all peers of a scene.
struct LocaleConfig {
  std::string name;
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< of its frame, the centre [m] S
  double yaw = 0.0;                                  ///< from S's x axis to its x axis [rad]
  Eigen::Vector3d size = Eigen::Vector3d::Zero();    ///< [m] > 0 along its axes; z 0: any height
  std::string neighbours;                            ///< names, as written
};

/// The cells of the area-of-interest manager and the pool of groups that they share.
struct AoimConfig {
  aoim::CellScheme scheme = aoim::CellScheme::hexagonal;
  double cell = 1.0;  ///< [m] > 0: side of a square, or corner radius of a hexagon
  QuadTreeConfig quad_tree;
  std::vector<LocaleConfig> locales;
  double radius = 2.0;  ///< [m] > 0: range of this peer; joins within it, leaves beyond 1.1 of it
  std::uint32_t pool = aoim::kDefaultPool;  ///< groups; see aoim::is_pool
  /// Limit of groups of the pool joined at once, 1 .. aoim::kMaximumPool; further groups are not
  /// received.
  std::uint32_t groups = aoim::kMaximumPool;
  bool leaders = false;  ///< each cell has a leader, which serves newcomers; the same at all peers
  /// The leader of the scene assigns groups of the pool to cells, instead of the fixed tile; the
  /// same at all peers.
  bool hand_out = false;
  Tiers tiers;         ///< the same at all peers
  std::string follow;  ///< names of beacons whose cells are subscribed to; see beacon_names
  AwarenessConfig awareness;
  /// Groups after the base group: the pool, and as many for each tier with its own groups.
  [[nodiscard]] std::size_t all_groups() const noexcept {
    return pool * (1 + group_tier_count(tiers));
  }
};

/// The nimbus of the entities of this type [m]. Some ns for each class.
[[nodiscard]] double nimbus_of(const std::vector<NimbusClass>& classes,
                               const pdu::EntityType& type) noexcept;

}  // namespace reckon::peer
