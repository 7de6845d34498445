// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/scene/belongings.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>

#include "reckon/haptics/falcon/falcon_driver.hpp"
#include "reckon/haptics/polhem/polhem_driver.hpp"
#include "reckon/haptics/serial/serial_session.hpp"
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

const haptics::UsbFacts* usb_facts_of(const DeviceConfig& device) {
  switch (device.driver) {
    case DeviceDriver::falcon:
      return &haptics::falcon_facts();
    case DeviceDriver::polhem:
      return &haptics::polhem_facts();
    case DeviceDriver::serial:
      return &haptics::serial_facts();
    case DeviceDriver::evdev:
    case DeviceDriver::plugin:
    case DeviceDriver::simulated:
      break;
  }
  return nullptr;
}

haptics::PolhemWeights polhem_weights_of(const DeviceConfig& device) {
  return {device.upper_weight, device.fore_weight};
}

int samples_of(std::chrono::nanoseconds delay, std::chrono::nanoseconds period) {
  return static_cast<int>(std::ceil(pdu::to_seconds(delay) / pdu::to_seconds(period) - 1e-5));
}

void describe(DeviceConfig& device, const DeviceDescriptor& descriptor) {
  device.axes = descriptor.axes;
  device.max_force = descriptor.max_force;
  device.continuous_force = descriptor.continuous_force;
  device.thermal_time = descriptor.thermal_time;
  device.damping = descriptor.damping;
  device.joint_damping = descriptor.joint_damping;
  device.resolution = descriptor.resolution;
  device.max_stiffness = descriptor.max_stiffness;
  device.max_speed = descriptor.max_speed;
  device.max_torque = descriptor.max_torque;
  device.turn_damping = descriptor.turn_damping;
  device.turn_resolution = descriptor.turn_resolution;
  device.described = {descriptor.name,    descriptor.delay,
                      descriptor.mass,    descriptor.friction,
                      descriptor.inertia, {descriptor.work_space.from, descriptor.work_space.to}};
  device.delay_samples = samples_of(descriptor.delay, device.period);
}

void use_driver(DeviceConfig& device, DeviceDriver driver, const SaidOfDevice& said) {
  device.driver = driver;
  const haptics::UsbFacts* const facts = usb_facts_of(device);
  if (facts == nullptr) return;
  haptics::UsbSettings settings;
  // The limits of a serial board are known only to its maker.
  if (driver == DeviceDriver::serial && !said.max_force)
    device.max_force = std::min(device.max_force, haptics::kSerialAssumedForce);
  if (driver == DeviceDriver::serial && said.resolution) settings.resolution = device.resolution;
  settings.max_force = device.max_force;
  settings.max_stiffness = device.max_stiffness;
  settings.max_speed = device.max_speed;
  settings.period = device.period;
  settings.damping = said.damping ? device.damping : facts->assumed_damping;
  settings.spent_damping = haptics::polhem_spent_damping(polhem_weights_of(device));
  if (!(facts->lever > 0)) device.joint_damping = 0.0;
  if (!said.everywhere && !(device.joint_damping > 0))
    device.joint_damping = facts->joints_per_damping * settings.damping;
  settings.joint_damping = device.joint_damping;
  settings.spent_joint_damping = haptics::polhem_spent_joint_damping(polhem_weights_of(device));
  if (said.delay && device.delay_samples > 0) settings.chain = device.delay_samples * device.period;
  const haptics::DeviceLimits limits = haptics::usb_limits(*facts, settings);
  device.max_force = limits.max_force;
  device.damping = limits.damping;
  device.delay_samples = limits.delay_samples;
  device.resolution = limits.resolution;
}

haptics::UsbSettings usb_settings_of(const DeviceConfig& device) {
  haptics::UsbSettings settings;
  settings.max_force = device.max_force;
  // use_driver() stored the damping that the servo gets.
  settings.spent_damping = haptics::polhem_spent_damping(polhem_weights_of(device));
  settings.damping = (device.damping + settings.spent_damping) / usb_facts_of(device)->sure_share;
  settings.joint_damping = device.joint_damping;
  settings.spent_joint_damping = haptics::polhem_spent_joint_damping(polhem_weights_of(device));
  settings.max_stiffness = device.max_stiffness;
  settings.max_speed = device.max_speed;
  settings.resolution = device.resolution;
  settings.period = device.period;
  settings.chain = device.delay_samples * device.period;
  return settings;
}

std::string evdev_fault_of(const DeviceConfig& device) {
  if (device.axes != 3) return "an event device has the axes of 'event_axes': take 'axes' out";
  if (device.scale != 1.0 || device.left_handed || device.clutch_button >= 0)
    return "an event device renders its walls by itself, where its handle is: take 'scale', "
           "'left_handed' and 'clutch_button' out";
  try {
    static_cast<void>(haptics::evdev_limits(evdev_settings_of(device)));
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return {};
}

haptics::EvdevSettings evdev_settings_of(const DeviceConfig& device) {
  haptics::EvdevSettings settings;
  settings.event = device.event;
  settings.axes = device.event_axes;
  settings.scale = {device.travel, device.full_force, device.full_stiffness};
  settings.max_force = device.max_force;
  settings.max_stiffness = device.max_stiffness;
  settings.max_speed = device.max_speed;
  if (device.delay_samples > 0) settings.chain = device.delay_samples * device.period;
  return settings;
}

}  // namespace reckon::peer
