// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Converts a scene and an identity into the settings of owned and remote entities and of the
// area-of-interest manager, and into the first announcement.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "reckon/aoim/area_of_interest_manager.hpp"
#include "reckon/deadreckon/motion/geocentric.hpp"
#include "reckon/pdu/codec/records.hpp"
#include "reckon/pdu/reckon/presence_pdu.hpp"
#include "reckon/peer/network/link.hpp"
#include "reckon/peer/scene/scene_file.hpp"
#include "reckon/peer/world/owned_entities.hpp"
#include "reckon/peer/world/remote_entities.hpp"

namespace reckon::peer {

/// The initial identity of this peer.
struct ModelIdentity {
  pdu::SimulationAddress simulation;
  std::string_view name;
  std::uint32_t epoch;    ///< random, not 0: identifies this run of the process
  std::uint32_t started;  ///< UTC second of the start; the older of two peers keeps a disputed
                          ///< address
  bool haptic;            ///< it has devices
  std::uint8_t scene_peer = 0;     ///< number of the peer in the scene, from 1; 0: none
  aoim::ChainLink secret{};        ///< proves this epoch, random
  bool may_own = false;            ///< bodies of the scene
  bool founds = false;             ///< see OwnershipConfig::founds_at_once
  bool requests_at_touch = false;  ///< see PeerOptions
};

/// The rows of tiers by distance with their own groups, except kept ones, the nearest first; else
/// none.
[[nodiscard]] std::vector<aoim::Channel> audience_rows_of(const AoimConfig& aoim);

/// Settings that all entities of this peer share.
[[nodiscard]] OwnerSettings owner_settings(const SceneFile& scene, const ModelIdentity& identity);

/// Settings for receiving and showing remote entities. The thresholds of other peers are not on the
/// wire: all peers take them from the scene.
[[nodiscard]] RemoteSettings remote_settings(const SceneFile& scene);

/// A sender's address; IPv4 addresses as ::ffff:a.b.c.d.
[[nodiscard]] aoim::SourceAddress source_of(const IpEndpoint& sender,
                                            std::uint64_t boot = 0) noexcept;
/// The inverse of source_of.
[[nodiscard]] IpEndpoint endpoint_of(const aoim::SourceAddress& source) noexcept;

/// Cells, bundles and time-outs of the scene.
[[nodiscard]] aoim::AreaOfInterestConfig aoim_config(const SceneFile& scene);
/// The same for a receiver of states, with bundles that its link sends unfragmented.
/// @param frame outlives the manager
[[nodiscard]] aoim::AreaOfInterestConfig aoim_config(const SceneFile& scene,
                                                     const deadreckon::LocalFrame& frame,
                                                     const Link& link);

/// The groups of a scene: the base group, the groups of the cells, and the groups of the other
/// tiers, if any.
[[nodiscard]] GroupPool pool_of(const SceneFile& scene);

/// The groups that are read first: the last ones, which belong to urgent tiers, after their own
/// base. Nothing if there are none.
[[nodiscard]] std::optional<GroupPool> urgent_pool_of(const SceneFile& scene);

/// Numbers of groups for the scene's radius of interest; all 0 in an interop scene, which has no
/// radius.
struct GroupNeeds {
  std::size_t within_radius = 0;  ///< most groups within reach of a focus, at any position
  std::size_t in_use = 0;         ///< groups of the pool that cells use
  std::size_t most_joined = 0;    ///< limit in the scene
  /// Most groups of each tier, in the order of the scene; 0 for a tier without its own groups.
  std::vector<std::size_t> within_tiers;

  /// Whether cells are so small relative to the radius that every group is joined: everything is
  /// received, nothing is saved.
  [[nodiscard]] bool all() const noexcept { return in_use > 1 && within_radius >= in_use; }
  [[nodiscard]] bool capped() const noexcept { return within_radius > most_joined; }
};

/// For set-up and tools: up to 0.1 s.
[[nodiscard]] GroupNeeds group_needs(const SceneFile& scene);

/// The peer's announcement.
[[nodiscard]] pdu::Presence presence(const SceneFile& scene, const deadreckon::LocalFrame& frame,
                                     const GroupPool& pool, const ModelIdentity& identity);

}  // namespace reckon::peer
