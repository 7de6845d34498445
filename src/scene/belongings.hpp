// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The devices and entities of each peer of a scene. Peers are numbered from 1.
#pragma once

#include <chrono>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "reckon/haptics/evdev/evdev_device.hpp"
#include "reckon/haptics/polhem/polhem_kinematics.hpp"
#include "reckon/haptics/usb/usb_limits.hpp"
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

/// Which values of a device were measured on the real device.
struct SaidOfDevice {
  bool damping = false;
  bool delay = false;
  bool max_force = false;
  bool resolution = false;
  /// The damping holds in every pose; false: it was measured in the middle of the work space.
  bool everywhere = false;
};

/// Sets the driver of a device, and the limits of the real device unless the file gives them.
void use_driver(DeviceConfig& device, DeviceDriver driver, const SaidOfDevice& said);
/// Known facts of the real device of a driver; null: not on USB or a serial port.
[[nodiscard]] const haptics::UsbFacts* usb_facts_of(const DeviceConfig& device);
/// The link weights that the motors of a Polhem compensate.
[[nodiscard]] haptics::PolhemWeights polhem_weights_of(const DeviceConfig& device);
/// Settings for the driver of a real device.
[[nodiscard]] haptics::UsbSettings usb_settings_of(const DeviceConfig& device);

/// The same for a Linux force feedback device.
[[nodiscard]] haptics::EvdevSettings evdev_settings_of(const DeviceConfig& device);
/// Why the device cannot be an event device, with the key to change: a sentence; empty: it can.
[[nodiscard]] std::string evdev_fault_of(const DeviceConfig& device);

}  // namespace reckon::peer
