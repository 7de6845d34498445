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

/// The devices of peer `peer`, in the file's order. If the scene has any device, exactly those of
/// this peer, perhaps none. If it has none, one with default limits, held by operator `peer`
/// (beyond the last operator they repeat, with an offset). A peer that owns entities and has no
/// operator of its own number has no device in that case.
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

/// Servo periods, whole, in which a force is there that takes so long; a hundred thousandth over is
/// rounding of the period.
[[nodiscard]] int samples_of(std::chrono::nanoseconds delay, std::chrono::nanoseconds period);

/// The device is what a descriptor says; of what that does not say it has what a simulated one has.
void describe(DeviceConfig& device, const DeviceDescriptor& descriptor);

/// Which numbers of a device are those of the real one, not of what is simulated.
struct SaidOfDevice {
  bool damping = false;
  bool delay = false;
  bool max_force = false;
  bool resolution = false;
  /// The damping is that of every pose; false: it was found in the middle of the work space.
  bool everywhere = false;
};

/// The device gets this driver, and with it the limits of what the driver drives, as far as they
/// are not its own.
void use_driver(DeviceConfig& device, DeviceDriver driver, const SaidOfDevice& said);
/// What is known of the real device that a driver drives; null: it is simulated.
[[nodiscard]] const haptics::UsbFacts* usb_facts_of(const DeviceConfig& device);
/// What the motors of a Polhem hold up.
[[nodiscard]] haptics::PolhemWeights polhem_weights_of(const DeviceConfig& device);
/// For the driver of a real device.
[[nodiscard]] haptics::UsbSettings usb_settings_of(const DeviceConfig& device);

/// The same for a force feedback device of Linux.
[[nodiscard]] haptics::EvdevSettings evdev_settings_of(const DeviceConfig& device);
/// Why a device cannot be one, with the key that says otherwise: a sentence; empty: it can.
[[nodiscard]] std::string evdev_fault_of(const DeviceConfig& device);

}  // namespace reckon::peer
