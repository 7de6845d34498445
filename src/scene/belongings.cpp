// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/scene/belongings.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "reckon/pdu/seconds.hpp"

namespace reckon::peer {

std::vector<DeviceConfig> devices_of(const SceneFile& scene, std::uint32_t peer) {
  const auto of_peer = [peer](const auto& row) { return row.peer == peer; };
  std::vector<DeviceConfig> devices;
  std::ranges::copy_if(scene.devices, std::back_inserter(devices), of_peer);
  if (!scene.devices.empty()) return devices;
  const bool owns = std::ranges::any_of(scene.entities, of_peer);
  if (owns && peer > scene.operators.size()) return devices;
  DeviceConfig& device = devices.emplace_back();
  device.peer = peer;
  device.operator_number = peer;
  return devices;
}

std::vector<EntityConfig> entities_of(const SceneFile& scene, std::uint32_t peer) {
  std::vector<EntityConfig> entities;
  std::ranges::copy_if(scene.entities, std::back_inserter(entities),
                       [peer](const EntityConfig& entity) { return entity.peer == peer; });
  return entities;
}

std::uint32_t peers_of(const SceneFile& scene) {
  std::uint32_t most = 1;
  for (const DeviceConfig& device : scene.devices) most = std::max(most, device.peer);
  for (const EntityConfig& entity : scene.entities) most = std::max(most, entity.peer);
  if (scene.devices.empty()) {
    most = std::max(most, static_cast<std::uint32_t>(scene.operators.size()));
  }
  return most;
}

TrackTurn turn_of(const EntityConfig& entity) {
  if (!entity.turns) return TrackTurn::held;
  return entity.model ? TrackTurn::sampled : TrackTurn::nose_ahead;
}

std::vector<EntityTrack> tracks_of(std::span<const EntityConfig> entities) {
  TrackShelf shelf;
  std::vector<EntityTrack> tracks;
  tracks.reserve(entities.size());
  for (const EntityConfig& entity : entities) {
    if (entity.track.empty()) {
      tracks.emplace_back(entity.position, entity.orientation);
    } else {
      tracks.emplace_back(shelf.curve(entity.track, entity.repeat, turn_of(entity)),
                          entity.position, entity.orientation, entity.speed);
    }
  }
  return tracks;
}

int samples_of(std::chrono::nanoseconds delay, std::chrono::nanoseconds period) {
  return static_cast<int>(std::ceil(pdu::to_seconds(delay) / pdu::to_seconds(period) - 1e-5));
}

void describe(DeviceConfig& device, const DeviceDescriptor& descriptor) {
  static_cast<DeviceAbility&>(device) = descriptor;
  device.described = {descriptor.name,    descriptor.delay,
                      descriptor.mass,    descriptor.friction,
                      descriptor.inertia, {descriptor.work_space.from, descriptor.work_space.to}};
  device.delay_samples = samples_of(descriptor.delay, device.period);
}

}  // namespace reckon::peer
