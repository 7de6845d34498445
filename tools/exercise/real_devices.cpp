// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/exercise/real_devices.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <utility>

#include "reckon/peer/notation/nearest_word.hpp"
#include "reckon/peer/scene/belongings.hpp"
#include "reckon/peer/scene/device_descriptor.hpp"
#include "reckon/tools/command_line/console.hpp"
#include "reckon/tools/exercise/native_code.hpp"
#include "reckon/tools/exercise/simulated_hand.hpp"

namespace reckon::tools {
namespace {

using peer::DeviceConfig;
using peer::Driver;
using peer::DriverKey;

// Drivers that need no further argument.
std::vector<std::string_view> driver_words() {
  std::vector<std::string_view> words;
  for (const Driver* driver : peer::drivers())
    if (driver->is_named) words.push_back(driver->name);
  return words;
}

// "the line of a serial board (/dev/ttyACM0), .."
std::string place_help() {
  std::vector<std::string_view> places;
  for (const Driver* driver : peer::drivers())
    if (driver->place != nullptr) places.push_back(driver->place->help);
  return fmt::format("{}", fmt::join(places, ", "));
}

bool is_descriptor(const std::string& device) {
  return !device.starts_with("/dev/") && device.ends_with(".toml");
}

// Null: the text is no place of a device.
const Driver* driver_by_place(const std::string& device) {
  for (const Driver* driver : peer::drivers())
    if (driver->place != nullptr && driver->place->is(device)) return driver;
  return nullptr;
}

void put_place(DeviceConfig& config, const Driver& driver, const std::string& device) {
  if (driver.place == nullptr || !driver.place->is(device)) return;
  try {
    driver.place->put(config, device);
  } catch (const std::invalid_argument& error) {
    throw UsageError(fmt::format("--device: {}", error.what()));
  }
}

// The driver for one of these USB IDs.
const Driver& driver_by_id(const peer::DeviceDescriptor& described, const std::string& file) {
  std::string known;
  for (const Driver* driver : peer::drivers()) {
    if (driver->force == nullptr || driver->force->make == nullptr) continue;
    const haptics::UsbFacts& facts = driver->force->facts();
    const peer::UsbId id{facts.vendor, facts.product};
    if (std::ranges::find(described.usb, id) != described.usb.end()) return *driver;
    known += fmt::format("{}{} has {:04x}:{:04x}", known.empty() ? "" : ", ", facts.name, id.vendor,
                         id.product);
  }
  throw UsageError(
      fmt::format("--device: no driver has the USB IDs of {} ({}); for a serial board, a wheel or "
                  "a plugin, write descriptor = \"{}\" in a [[device]]",
                  file, known, file));
}

peer::DeviceDescriptor described_by(const std::string& file) {
  try {
    return peer::load_device_descriptor(peer::find_device_descriptor(file, ""));
  } catch (const std::exception& error) {
    throw UsageError(fmt::format("--device: {}", error.what()));
  }
}

// Adds the default devices of all peers to a scene that lists none.
void say_devices(peer::SceneFile& scene, std::size_t peers) {
  if (!scene.devices.empty()) return;
  std::vector<DeviceConfig> devices;
  for (std::uint32_t peer = 1; peer <= peers; ++peer)
    std::ranges::copy(peer::devices_of(scene, peer), std::back_inserter(devices));
  scene.devices = std::move(devices);
}

// Calls use(driver, key) for each key with a flag.
template <typename Use>
void for_each_flag(Use&& use) {
  for (const Driver* driver : peer::drivers())
    for (const DriverKey& key : driver->keys)
      if (!key.flag.empty()) use(*driver, key);
}

// Calls use(driver, key, value) for each flag that the user gave.
template <typename Use>
void for_each_given(const DeviceChoice& choice, Use&& use) {
  for_each_flag([&](const Driver& driver, const DriverKey& key) {
    const auto given = choice.keys.find(key.key);
    if (given != choice.keys.end() && !given->second.empty()) use(driver, key, given->second);
  });
}

}  // namespace

const Driver& driver_of(const std::string& device) {
  if (is_descriptor(device)) return driver_by_id(described_by(device), device);
  if (const Driver* const driver = driver_by_place(device)) return *driver;
  return *peer::find_driver(device);
}

void add_driver_flags(CommandLine& line, DeviceChoice& choice, std::string_view prefix) {
  for_each_flag([&](const Driver&, const DriverKey& key) {
    line.option(std::string(key.flag), choice.keys[key.key],
                fmt::format("{}{}", prefix, key.flag_help));
  });
}

std::vector<std::string_view> driver_flags_of(const DeviceChoice& choice) {
  std::vector<std::string_view> flags;
  for_each_given(choice, [&](const Driver&, const DriverKey& key, const std::string&) {
    flags.push_back(key.flag);
  });
  return flags;
}

void add_device_flags(CommandLine& line, DeviceChoice& choice) {
  line.option("--device", choice.device,
              fmt::format("use a real device instead of the peer's first: its driver, {} (see "
                          "`reckon devices`), {}, or its descriptor (MINE.toml)",
                          fmt::join(driver_words(), ", "), place_help()));
  add_driver_flags(line, choice);
  line.option("--plugin", choice.plugins,
              "driver file that the scene may load by name; repeatable");
}

std::vector<std::string> plugins_of(const DeviceChoice& choice) {
  std::vector<std::string> files = choice.plugins;
  const Driver* const driver = driver_by_place(choice.device);
  if (driver != nullptr && driver->native_code != nullptr) files.push_back(choice.device);
  return files;
}

namespace {

void check_device(const std::string& device) {
  if (is_descriptor(device)) return static_cast<void>(driver_of(device));
  if (const Driver* const driver = driver_by_place(device)) {
    DeviceConfig tried;
    return put_place(tried, *driver, device);
  }
  const Driver* const driver = peer::find_driver(device);
  if (driver != nullptr && driver->is_named) return;
  if (driver != nullptr)
    throw UsageError(fmt::format("--device: the driver '{}' needs a place: write {}", device,
                                 driver->place->help));
  const std::vector<std::string_view> words = driver_words();
  const std::string_view nearest = peer::nearest_word(device, words);
  const std::string meant =
      nearest.empty() ? std::string() : fmt::format(", did you mean '{}'?", nearest);
  throw UsageError(
      fmt::format("--device: there is no driver '{}'{}; write {} (see `reckon devices`), {}, or a "
                  "descriptor (mine.toml)",
                  device, meant, fmt::join(words, ", "), place_help()));
}

}  // namespace

void check_device_choice(const DeviceChoice& choice) {
  if (!choice.device.empty()) check_device(choice.device);
  for (const std::string& file : choice.plugins)
    if (std::error_code none; !std::filesystem::is_regular_file(file, none))
      throw UsageError(fmt::format("--plugin: file '{}' does not exist", file));
  for_each_given(choice, [&](const Driver&, const DriverKey& key, const std::string& file) {
    try {
      key.check_file(file);
    } catch (const std::runtime_error& error) {
      throw UsageError(fmt::format("{}: {}", key.flag, error.what()));
    }
  });
}

namespace {

void choose_driver(const DeviceChoice& choice, peer::SceneFile& scene, std::uint32_t number,
                   std::size_t peers) {
  if (!choice.device.empty()) say_devices(scene, peers);
  const auto of_peer = [&](const DeviceConfig& device) { return device.peer == number; };
  const auto first = std::ranges::find_if(scene.devices, of_peer);
  if (!choice.device.empty()) {
    if (first == scene.devices.end())
      throw UsageError(fmt::format("--device: peer {} has no device in this scene", number));
    first->source = peer::DeviceSource::simulated;
    first->admittance.mass = 0.0;
    // The scene's friction and delay are those simulated, and do not apply to a real device.
    const Driver& chosen = driver_of(choice.device);
    put_place(*first, chosen, choice.device);
    if (is_descriptor(choice.device)) {
      peer::describe(*first, described_by(choice.device));
      peer::use_driver(*first, chosen, {true, true, true, true, false});
    } else if (first->driver != &chosen) {
      peer::use_driver(*first, chosen, {});
    }
    const std::string fault = chosen.fault != nullptr ? chosen.fault(*first) : std::string();
    if (!fault.empty()) throw UsageError(fmt::format("--device {}: {}", chosen.name, fault));
  }
  for_each_given(choice, [&](const Driver& driver, const DriverKey& key, const std::string& file) {
    const auto device = std::ranges::find_if(scene.devices, [&](const DeviceConfig& one) {
      return of_peer(one) && one.driver == &driver;
    });
    if (device == scene.devices.end())
      throw UsageError(fmt::format("{}: no device of this peer uses it; add --device {}", key.flag,
                                   driver.name));
    device->driver_values[key.key] = std::filesystem::absolute(file);
  });
}

}  // namespace

void choose_device(const DeviceChoice& choice, peer::SceneFile& scene, std::uint32_t number,
                   std::size_t peers) {
  choose_driver(choice, scene, number, peers);
  if (scene.operators.empty()) return;
  for (DeviceConfig& device : scene.devices) {
    if (device.peer == number && device.driver != nullptr && !device.is_placed)
      device.position = begin_of(scene, device.operator_number);
  }
}

namespace {

// Empty: its driver finds it by its USB IDs, or by itself.
std::string line_of(const DeviceConfig& device) {
  const peer::ForceSide* const force = device.driver->force;
  return force != nullptr && force->line != nullptr ? force->line(device) : std::string();
}

}  // namespace

haptics::HapticDevice* RealDevices::as_mapped(haptics::HapticDevice& device,
                                              const DeviceConfig& config) {
  const haptics::HandMapping mapping = mapping_of(config);
  if (mapping.is_plain()) return &device;
  return mapped_.emplace_back(std::make_unique<haptics::MappedDevice>(device, mapping)).get();
}

void RealDevices::plug_in(const peer::SceneFile& scene, std::uint32_t number,
                          std::vector<peer::PeerDevice>& wired) {
  const std::vector<DeviceConfig> devices = peer::devices_of(scene, number);
  const peer::DeviceOpening opening{
      clock_, [this](const std::filesystem::path& name) { return trusted_plugin(name, trusted_); }};
  for (std::size_t i = 0; i < devices.size(); ++i) {
    const DeviceConfig& device = devices[i];
    if (device.driver == nullptr) continue;
    check_free(device);
    peer::OpenedDevice opened = peer::open_device(device, opening);
    sentences_.push_back(std::move(opened.notice));
    driven_.push_back({device.driver, line_of(device), std::move(opened.device)});
    haptics::HapticDevice& real = driven_.back().real->device();
    // A device that renders springs takes no force that could be mapped.
    wired[i].device = peer::renders_springs(device) ? &real : as_mapped(real, device);
  }
}

void RealDevices::check_free(const DeviceConfig& config) const {
  if (config.driver->force == nullptr) return;
  const std::string line = line_of(config);
  const bool is_free = std::ranges::none_of(
      driven_, [&](const Driven& one) { return one.driver == config.driver && one.line == line; });
  if (is_free) return;
  if (!line.empty())
    throw std::runtime_error(fmt::format("two devices use {}: give each its own port", line));
  throw std::runtime_error(
      fmt::format("a program uses at most one {}: start another peer for the second",
                  config.driver->force->facts().name));
}

unsigned RealDevices::axes() const noexcept {
  constexpr unsigned kAll = 7;
  const unsigned known = driven_.empty() ? 0 : driven_.front().real->axes();
  return known == 0 ? kAll : known;
}

const haptics::UsbDevice* RealDevices::reports() const noexcept {
  if (driven_.empty()) return nullptr;
  return dynamic_cast<const haptics::UsbDevice*>(&driven_.front().real->device());
}

std::vector<std::string> RealDevices::take_notices() {
  std::vector<std::string> all = std::exchange(sentences_, {});
  for (const Driven& one : driven_)
    for (std::string& sentence : one.real->take_notices()) all.push_back(std::move(sentence));
  return all;
}

}  // namespace reckon::tools
