// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/drivers/driver.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <stdexcept>

#include "reckon/pdu/seconds.hpp"
#include "reckon/peer/threads/real_device.hpp"

namespace reckon::peer {
namespace {

SpentDamping spent_of(const DeviceConfig& device) {
  const auto spent = device.driver->force->spent;
  return spent != nullptr ? spent(device) : SpentDamping{};
}

haptics::UsbSettings common_settings(const DeviceConfig& device) {
  haptics::UsbSettings settings;
  settings.max_force = device.max_force;
  settings.max_stiffness = device.max_stiffness;
  settings.max_speed = device.max_speed;
  settings.period = device.period;
  const SpentDamping spent = spent_of(device);
  settings.spent_damping = spent.handle;
  settings.spent_joint_damping = spent.joints;
  return settings;
}

}  // namespace

const Driver* find_driver(std::string_view name) {
  const auto found =
      std::ranges::find(drivers(), name, [](const Driver* driver) { return driver->name; });
  return found == drivers().end() ? nullptr : *found;
}

std::string_view driver_name(const DeviceConfig& device) {
  return device.driver == nullptr ? driver_names().front() : device.driver->name;
}

const std::vector<std::string_view>& driver_names() {
  static const std::vector<std::string_view> kNames = [] {
    std::vector<std::string_view> names{"simulated"};
    for (const Driver* driver : drivers()) names.push_back(driver->name);
    return names;
  }();
  return kNames;
}

std::vector<AttachedDevice> driver_ports() {
  std::vector<AttachedDevice> ports;
  for (const Driver* driver : drivers())
    if (driver->ports != nullptr) std::ranges::move(driver->ports(), std::back_inserter(ports));
  return ports;
}

const DriverValue& driver_value(const DeviceConfig& device, std::string_view key) {
  if (const auto given = device.driver_values.find(key); given != device.driver_values.end())
    return given->second;
  for (const Driver* driver : drivers()) {
    const auto row = std::ranges::find(driver->keys, key, &DriverKey::key);
    if (row != driver->keys.end()) return row->standard;
  }
  throw std::invalid_argument(fmt::format("no driver has the key '{}'", key));
}

void use_driver(DeviceConfig& device, const Driver& driver, const MeasuredFlags& measured) {
  device.driver = &driver;
  if (driver.force == nullptr) return;
  const haptics::UsbFacts& facts = driver.force->facts();
  const double assumed = driver.force->assumed_force;
  if (assumed > 0 && !measured.max_force) device.max_force = std::min(device.max_force, assumed);
  haptics::UsbSettings settings = common_settings(device);
  if (assumed > 0 && measured.resolution) settings.resolution = device.resolution;
  settings.damping = measured.damping ? device.damping : facts.assumed_damping;
  if (!(facts.lever > 0)) device.joint_damping = 0.0;
  if (!measured.everywhere && !(device.joint_damping > 0))
    device.joint_damping = facts.joints_per_damping * settings.damping;
  settings.joint_damping = device.joint_damping;
  if (measured.delay && device.delay_samples > 0)
    settings.chain = device.delay_samples * device.period;
  const haptics::DeviceLimits limits = haptics::usb_limits(facts, settings);
  device.max_force = limits.max_force;
  device.damping = limits.damping;
  device.delay_samples = limits.delay_samples;
  device.resolution = limits.resolution;
}

const haptics::UsbFacts* usb_facts_of(const DeviceConfig& device) {
  const bool is_forced = device.driver != nullptr && device.driver->force != nullptr;
  return is_forced ? &device.driver->force->facts() : nullptr;
}

bool renders_springs(const DeviceConfig& device) noexcept {
  return device.driver != nullptr && device.driver->springs != nullptr;
}

haptics::UsbSettings usb_settings_of(const DeviceConfig& device) {
  haptics::UsbSettings settings = common_settings(device);
  // use_driver() stored the damping that the servo gets.
  settings.damping = (device.damping + settings.spent_damping) / usb_facts_of(device)->sure_share;
  settings.joint_damping = device.joint_damping;
  settings.resolution = device.resolution;
  settings.chain = device.delay_samples * device.period;
  return settings;
}

OpenedDevice open_device(const DeviceConfig& device, const DeviceOpening& opening) {
  const Driver& driver = *device.driver;
  if (driver.open != nullptr) return driver.open(device, opening);
  const haptics::DeviceLimits limits =
      haptics::usb_limits(driver.force->facts(), usb_settings_of(device));
  return {usb_device(opening.clock, limits, driver.force->make(device)),
          force_notice(device, limits)};
}

std::string force_notice(const DeviceConfig& device, const haptics::DeviceLimits& limits) {
  const ForceSide& force = *device.driver->force;
  const bool is_on_line = force.line != nullptr;
  return fmt::format(
      "{}: assumes {:.2g} N s/m of damping{} and a force delay of {:.2g} ms; more damping or less "
      "delay allows stiffer walls: run `reckon devices measure {}` and set 'damping' and 'delay' "
      "in its [[device]]",
      is_on_line ? force.line(device) : force.facts().name, limits.damping,
      limits.lever > 0 ? " in the middle of its work space (elsewhere, that of its joints)" : "",
      1e3 * limits.delay_samples * pdu::to_seconds(device.period),
      is_on_line ? force.line(device) : std::string(device.driver->name));
}

std::string udev_line(std::string_view subsystem, std::string_view attribute, std::uint16_t vendor,
                      std::uint16_t product) {
  return fmt::format(
      "SUBSYSTEM==\"{0}\", {1}{{idVendor}}==\"{2:04x}\", {1}{{idProduct}}==\"{3:04x}\", "
      "MODE=\"0660\", GROUP=\"plugdev\", TAG+=\"uaccess\"\n",
      subsystem, attribute, vendor, product);
}

}  // namespace reckon::peer
