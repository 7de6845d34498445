// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The devices and entities of each peer of a scene. Peers are numbered from 1.
#pragma once

#include <chrono>
#include <cstdint>
#include <span>
#include <vector>

#include "reckon/peer/scene/device_descriptor.hpp"
#include "reckon/peer/scene/scene_file.hpp"
#include "reckon/peer/tracks/entity_track.hpp"

namespace reckon::peer {

/// Largest number of a peer that a scene may name.
inline constexpr std::uint32_t kMostPeers = 64;

/// The devices of peer `peer`, in the file's order. If the scene lists devices, the result has the
/// ones of this peer, perhaps none. If it lists none, the result is one device with default limits,
/// held by operator `peer` (beyond the last operator they repeat, with an offset). In that case, a
/// peer that owns entities and has no operator of its own number has no device.
[[nodiscard]] std::vector<DeviceConfig> devices_of(const SceneFile& scene, std::uint32_t peer);

/// The entities that peer `peer` owns, in the file's order.
[[nodiscard]] std::vector<EntityConfig> entities_of(const SceneFile& scene, std::uint32_t peer);

/// The largest number of a peer with devices or entities; at least 1.
[[nodiscard]] std::uint32_t peers_of(const SceneFile& scene);

/// The rule by which the track of `entity` turns it.
[[nodiscard]] TrackTurn turn_of(const EntityConfig& entity);

/// The true motion of each entity, in their order; a file shared by several is read once.
/// @throws CsvError "file:line:column: what" if a track cannot be read.
[[nodiscard]] std::vector<EntityTrack> tracks_of(std::span<const EntityConfig> entities);

/// Number of whole servo periods for this delay; an excess of a hundred thousandth is rounding of
/// the period.
[[nodiscard]] int samples_of(std::chrono::nanoseconds delay, std::chrono::nanoseconds period);

/// Sets the device to its descriptor's values; values missing there are as for a simulated device.
void describe(DeviceConfig& device, const DeviceDescriptor& descriptor);

}  // namespace reckon::peer
