// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What each peer of a scene has: its devices and its entities. Peers are numbered from 1.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "reckon/peer/scene/scene_file.hpp"
#include "reckon/peer/tracks/entity_track.hpp"

namespace reckon::peer {

/// Largest number of a peer that a scene may name.
inline constexpr std::uint32_t kMostPeers = 64;

/// The devices of peer `peer`, in the file's order. Where the scene names any device, exactly those
/// of this peer, perhaps none. Where it names none, one with default limits, held by operator
/// `peer` (beyond the last they are taken in turn, aside); but none for a peer that owns entities
/// and has no operator of its own number.
[[nodiscard]] std::vector<DeviceConfig> devices_of(const SceneFile& scene, std::uint32_t peer);

/// The entities that peer `peer` owns, in the file's order.
[[nodiscard]] std::vector<EntityConfig> entities_of(const SceneFile& scene, std::uint32_t peer);

/// The largest number of a peer that has something; at least 1.
[[nodiscard]] std::uint32_t peers_of(const SceneFile& scene);

/// How the track of `entity` turns it.
[[nodiscard]] TrackTurn turn_of(const EntityConfig& entity);

/// The true motion of each entity, in their order; a file that several follow is read once. @throws
/// CsvError "file:line:column: what" where a track cannot be read.
[[nodiscard]] std::vector<EntityTrack> tracks_of(std::span<const EntityConfig> entities);

}  // namespace reckon::peer
