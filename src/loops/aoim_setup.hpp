// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// From a scene and an identity to the settings of owned and of remote entities and of the
// area-of-interest manager, and to its first words.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "reckon/aoim/area_of_interest_manager.hpp"
#include "reckon/deadreckon/motion/geocentric.hpp"
#include "reckon/pdu/codec/records.hpp"
#include "reckon/pdu/reckon/presence_pdu.hpp"
#include "reckon/peer/network/link.hpp"
#include "reckon/peer/scene/scene_file.hpp"
#include "reckon/peer/world/owned_entities.hpp"
#include "reckon/peer/world/remote_entities.hpp"

namespace reckon::peer {

/// Who this peer is at first.
struct ModelIdentity {
  pdu::SimulationAddress simulation;
  std::string_view name;
  std::uint32_t epoch;    ///< random, not 0: names this life of the process
  std::uint32_t started;  ///< UTC second of the start; the older of two keeps a disputed address
  bool haptic;            ///< it has devices
  std::uint8_t scene_peer = 0;  ///< which peer of the scene it is, from 1; 0: none
  aoim::ChainLink secret{};     ///< by which this life proves itself, random
};

/// Where tiers by distance have groups of their own: the rows of those that are not kept, the
/// nearest first; else none.
[[nodiscard]] std::vector<aoim::Channel> audience_rows_of(const AoimConfig& aoim);

/// What all entities of this peer share.
[[nodiscard]] OwnerSettings owner_settings(const SceneFile& scene, const ModelIdentity& identity);

/// How remote entities are read and shown. What others let their copies be off by is not on the
/// wire: the peers of a scene agree on it.
[[nodiscard]] RemoteSettings remote_settings(const SceneFile& scene);

/// A sender's address; an IPv4 one as ::ffff:a.b.c.d.
[[nodiscard]] aoim::SourceAddress source_of(const IpEndpoint& sender,
                                            std::uint64_t boot = 0) noexcept;
/// The other way round.
[[nodiscard]] IpEndpoint endpoint_of(const aoim::SourceAddress& source) noexcept;

/// Cells, bundles and patience as the scene asks for them.
[[nodiscard]] aoim::AreaOfInterestConfig aoim_config(const SceneFile& scene);
/// The same for who hears states. @param frame outlives what is made of it
[[nodiscard]] aoim::AreaOfInterestConfig aoim_config(const SceneFile& scene,
                                                     const deadreckon::LocalFrame& frame);

/// The groups of a scene: the base group, those of the cells, of near rows and of what is felt, if
/// there are any.
[[nodiscard]] GroupPool pool_of(const SceneFile& scene);

/// Of these, the contact groups, the last ones: those behind its base. Nothing where there are
/// none.
[[nodiscard]] std::optional<GroupPool> contact_pool_of(const SceneFile& scene);

/// How a scene's radius of interest stands to its groups; all 0 in an interop scene, which has
/// none.
struct GroupNeeds {
  std::size_t within_radius = 0;  ///< most groups whose cells a focus can reach, wherever it is
  std::size_t in_use = 0;         ///< groups that cells are laid out on, of the pool
  std::size_t most_joined = 0;    ///< as the scene allows
  std::size_t within_touch =
      0;                        ///< most contact groups that one hand listens to; 0: there are none
  std::size_t within_rows = 0;  ///< most near groups that a focus listens to; 0: there are none

  /// Cells so small beside the radius that every group is joined: all is heard, nothing is saved.
  [[nodiscard]] bool all() const noexcept { return in_use > 1 && within_radius >= in_use; }
  [[nodiscard]] bool capped() const noexcept { return within_radius > most_joined; }
};

/// For set-up and tools: up to 0.1 s.
[[nodiscard]] GroupNeeds group_needs(const SceneFile& scene);

/// What the peer announces of itself.
[[nodiscard]] pdu::Presence presence(const SceneFile& scene, const deadreckon::LocalFrame& frame,
                                     const GroupPool& pool, const ModelIdentity& identity);

}  // namespace reckon::peer
