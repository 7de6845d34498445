// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/exercise/real_devices.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <iterator>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <utility>

#include "reckon/haptics/falcon/falcon_driver.hpp"
#include "reckon/haptics/plugin/plugin_device.hpp"
#include "reckon/haptics/polhem/polhem_driver.hpp"
#include "reckon/pdu/seconds.hpp"
#include "reckon/peer/notation/nearest_word.hpp"
#include "reckon/peer/scene/belongings.hpp"
#include "reckon/peer/scene/device_descriptor.hpp"
#include "reckon/peer/scene/scene_words.hpp"
#include "reckon/tools/command_line/console.hpp"
#include "reckon/tools/exercise/native_code.hpp"
#include "reckon/tools/exercise/simulated_hand.hpp"

namespace reckon::tools {
namespace {

using peer::DeviceConfig;
using peer::DeviceDriver;

// Drivers that need no further argument.
std::vector<std::string_view> driver_words() {
  std::vector<std::string_view> words;
  for (const auto& word : peer::kWords<DeviceDriver>) {
    if (word.value == DeviceDriver::falcon || word.value == DeviceDriver::polhem ||
        word.value == DeviceDriver::evdev)
      words.push_back(word.name);
  }
  return words;
}

bool is_serial(const std::string& device) {
  return device.starts_with("/dev/") && !is_event_device(device);
}

bool is_descriptor(const std::string& device) {
  return !is_serial(device) && device.ends_with(".toml");
}

bool is_plugin(const std::string& device) {
  return !device.starts_with("/dev/") && !is_descriptor(device) &&
         (device.find('/') != std::string::npos || device.ends_with(".so"));
}

// Parses PORT or PORT@BAUD.
haptics::SerialPlace place_of(const std::string& device) {
  const std::size_t at = device.rfind('@');
  if (at == std::string::npos) return {device};
  unsigned baud = 0;
  const char* const end = device.data() + device.size();
  const auto read = std::from_chars(device.data() + at + 1, end, baud);
  if (read.ec != std::errc() || read.ptr != end || baud < 1'200 || baud > 12'000'000) {
    throw UsageError(
        fmt::format("--device: '{}' is no baud from 1200 to 12000000: write "
                    "/dev/ttyACM0@115200, or leave it out",
                    device.substr(at + 1)));
  }
  return {device.substr(0, at), baud};
}

// The driver for one of these USB IDs.
DeviceDriver driver_of(const peer::DeviceDescriptor& described, const std::string& file) {
  DeviceConfig device;
  std::string known;
  for (const DeviceDriver driver : {DeviceDriver::falcon, DeviceDriver::polhem}) {
    device.driver = driver;
    const haptics::UsbFacts& facts = *peer::usb_facts_of(device);
    const peer::UsbId id{facts.vendor, facts.product};
    if (std::ranges::find(described.usb, id) != described.usb.end()) return driver;
    known += fmt::format("{}{} has {:04x}:{:04x}", known.empty() ? "" : ", ", facts.name, id.vendor,
                         id.product);
  }
  throw UsageError(fmt::format(
      "--device: no driver is for the USB numbers of {} ({}); of a serial board, a wheel "
      "or a driver of yours write descriptor = \"{}\" in a [[device]]",
      file, known, file));
}

peer::DeviceDescriptor described_by(const std::string& file) {
  try {
    return peer::load_device_descriptor(peer::find_device_descriptor(file, ""));
  } catch (const std::exception& error) {
    throw UsageError(fmt::format("--device: {}", error.what()));
  }
}

DeviceDriver driver_of(const std::string& device) {
  if (is_descriptor(device)) return driver_of(described_by(device), device);
  if (is_event_device(device)) return DeviceDriver::evdev;
  if (is_serial(device)) return DeviceDriver::serial;
  if (is_plugin(device)) return DeviceDriver::plugin;
  return *peer::value_of<DeviceDriver>(device);
}

// Adds the default devices of all peers to a scene that lists none.
void say_devices(peer::SceneFile& scene, std::size_t peers) {
  if (!scene.devices.empty()) return;
  std::vector<DeviceConfig> devices;
  for (std::uint32_t peer = 1; peer <= peers; ++peer)
    std::ranges::copy(peer::devices_of(scene, peer), std::back_inserter(devices));
  scene.devices = std::move(devices);
}

std::unique_ptr<haptics::UsbDriver> usb_driver_of(const DeviceConfig& device) {
  if (device.driver == DeviceDriver::polhem)
    return std::make_unique<haptics::PolhemDriver>(peer::polhem_weights_of(device));
  haptics::FalconFirmware firmware;
  if (!device.firmware.empty()) firmware = haptics::FalconFirmware::load(device.firmware.string());
  return std::make_unique<haptics::FalconDriver>(std::move(firmware));
}

// The servo calls it directly; it has no thread of its own.
class LoadedPlugin final : public peer::RealDevice {
 public:
  LoadedPlugin(const std::filesystem::path& file, const std::string& options)
      : device_(file, options) {}
  [[nodiscard]] const std::string& name() const noexcept { return device_.name(); }
  haptics::HapticDevice& device() noexcept override { return device_; }
  std::vector<std::string> take_notices() override { return device_.take_notices(); }

 private:
  haptics::PluginDevice device_;
};

}  // namespace

bool is_event_device(const std::string& device) {
  return device.starts_with("/dev/input/") || device.starts_with("/dev/hidraw");
}

void add_device_flags(CommandLine& line, DeviceChoice& choice) {
  line.option(
      "--device", choice.device,
      fmt::format(
          "a real device, by its driver, in the place of the peer's first: {} (see "
          "reckon devices), the line of a serial board (/dev/ttyACM0, or /dev/ttyUSB0@115200), a "
          "wheel or stick (/dev/input/event7, /dev/hidraw0), its descriptor (MINE.toml), or the "
          "file of a driver (DRIVER.so)",
          fmt::join(driver_words(), ", ")));
  line.option("--firmware", choice.firmware,
              "file of the program that a Falcon runs, where it has lost it");
  line.option("--plugin", choice.plugins,
              "file of a driver that the scene may load by its name; may be given again");
}

std::vector<std::string> plugins_of(const DeviceChoice& choice) {
  std::vector<std::string> files = choice.plugins;
  if (is_plugin(choice.device)) files.push_back(choice.device);
  return files;
}

void check_device_choice(const DeviceChoice& choice) {
  const std::string& name = choice.device;
  const std::vector<std::string_view> words = driver_words();
  if (name == "serial")
    throw UsageError("--device: a serial board goes by its line: --device /dev/ttyACM0");
  if (is_serial(name)) static_cast<void>(place_of(name));
  if (is_descriptor(name)) static_cast<void>(driver_of(name));
  if (!name.empty() && !is_plugin(name) && !is_serial(name) && !is_descriptor(name) &&
      !is_event_device(name) && std::ranges::find(words, name) == words.end()) {
    const std::string_view nearest = peer::nearest_word(name, words);
    const std::string meant =
        nearest.empty() ? std::string() : fmt::format(", did you mean '{}'?", nearest);
    throw UsageError(fmt::format(
        "--device: there is no driver '{}'{}; there are {} (see reckon devices), "
        "lines of serial boards: /dev/ttyACM0, descriptors: mine.toml, and files of drivers: "
        "./DRIVER.so",
        name, meant, fmt::join(words, ", ")));
  }
  for (const std::string& file : choice.plugins)
    if (std::error_code none; !std::filesystem::is_regular_file(file, none))
      throw UsageError(fmt::format("--plugin: there is no file '{}'", file));
  if (choice.firmware.empty()) return;
  try {
    static_cast<void>(haptics::FalconFirmware::load(choice.firmware));
  } catch (const std::runtime_error& error) {
    throw UsageError(fmt::format("--firmware: {}", error.what()));
  }
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
    const DeviceDriver chosen = driver_of(choice.device);
    if (chosen == DeviceDriver::plugin) first->plugin = std::filesystem::absolute(choice.device);
    if (chosen == DeviceDriver::serial) {
      const haptics::SerialPlace place = place_of(choice.device);
      first->port = place.port;
      first->baud = place.baud;
    }
    if (is_event_device(choice.device)) first->event = choice.device;
    if (is_descriptor(choice.device)) {
      peer::describe(*first, described_by(choice.device));
      peer::use_driver(*first, chosen, {true, true, true, true, false});
    } else if (first->driver != chosen) {
      peer::use_driver(*first, chosen, {});
    }
    const std::string fault =
        chosen == DeviceDriver::evdev ? peer::evdev_fault_of(*first) : std::string();
    if (!fault.empty()) throw UsageError("--device evdev: " + fault);
  }
  if (choice.firmware.empty()) return;
  const auto falcon = std::ranges::find_if(scene.devices, [&](const DeviceConfig& device) {
    return of_peer(device) && device.driver == DeviceDriver::falcon;
  });
  if (falcon == scene.devices.end())
    throw UsageError("--firmware: no device of this peer takes one; add --device falcon");
  falcon->firmware = std::filesystem::absolute(choice.firmware);
}

}  // namespace

void choose_device(const DeviceChoice& choice, peer::SceneFile& scene, std::uint32_t number,
                   std::size_t peers) {
  choose_driver(choice, scene, number, peers);
  if (scene.operators.empty()) return;
  for (DeviceConfig& device : scene.devices) {
    if (device.peer == number && device.driver != DeviceDriver::simulated && !device.is_placed)
      device.position = begin_of(scene, device.operator_number);
  }
}

haptics::HapticDevice* RealDevices::as_mapped(haptics::HapticDevice& device,
                                              const DeviceConfig& config) {
  const haptics::HandMapping mapping = mapping_of(config);
  if (mapping.is_plain()) return &device;
  return mapped_.emplace_back(std::make_unique<haptics::MappedDevice>(device, mapping)).get();
}

void RealDevices::plug_in(const peer::SceneFile& scene, std::uint32_t number,
                          std::vector<peer::PeerDevice>& wired) {
  const std::vector<DeviceConfig> devices = peer::devices_of(scene, number);
  for (std::size_t i = 0; i < devices.size(); ++i) {
    const DeviceConfig& device = devices[i];
    if (device.driver == DeviceDriver::simulated) continue;
    driven_.push_back({device.driver, device.port, open(device)});
    haptics::HapticDevice& real = driven_.back().real->device();
    // A device that renders springs takes no force that could be mapped.
    wired[i].device = device.driver == DeviceDriver::evdev ? &real : as_mapped(real, device);
  }
}

std::unique_ptr<peer::RealDevice> RealDevices::open(const DeviceConfig& config) {
  if (config.driver == DeviceDriver::plugin) return open_plugin(config);
  if (config.driver == DeviceDriver::evdev) return open_evdev(config);
  return open_by_forces(config);
}

std::unique_ptr<peer::RealDevice> RealDevices::open_plugin(const DeviceConfig& config) {
  const std::filesystem::path file = trusted_plugin(config.plugin, trusted_);
  auto plugin = std::make_unique<LoadedPlugin>(file, config.plugin_options);
  sentences_.push_back(fmt::format(
      "{}: {:.2g} N s/m of damping are relied on, as its driver says; it was loaded from {}",
      plugin->name(), plugin->device().limits().damping, file.string()));
  return plugin;
}

std::unique_ptr<peer::RealDevice> RealDevices::open_evdev(const DeviceConfig& config) {
  const haptics::EvdevSettings settings = peer::evdev_settings_of(config);
  auto device = peer::evdev_device(clock_, settings);
  sentences_.push_back(
      fmt::format("evdev: its walls begin where a hand of {:.3g} m/s cannot be {:.2g} ms "
                  "later; what others "
                  "have is felt along its axes, and pushes no hand that does not press",
                  settings.max_speed, 1e3 * pdu::to_seconds(settings.chain)));
  return device;
}

// A device that takes forces and reports its position.
std::unique_ptr<peer::RealDevice> RealDevices::open_by_forces(const DeviceConfig& config) {
  const haptics::UsbFacts& facts = *peer::usb_facts_of(config);
  const haptics::DeviceLimits limits = haptics::usb_limits(facts, peer::usb_settings_of(config));
  const bool is_on_line = config.driver == DeviceDriver::serial;
  check_free(config);
  auto device = is_on_line ? peer::serial_device(clock_, limits, {config.port, config.baud})
                           : peer::usb_device(clock_, limits, usb_driver_of(config));
  sentences_.push_back(fmt::format(
      "{}: {:.2g} N s/m of damping{} are relied on, and forces are {:.2g} ms late; where you "
      "know more of the one or less of the other, 'damping' and 'delay' of its [[device]] give "
      "stiffer walls, and `reckon devices measure {}` finds them",
      is_on_line ? config.port : facts.name, limits.damping,
      limits.lever > 0 ? " in the middle of its work space, elsewhere by its joints," : "",
      1e3 * limits.delay_samples * pdu::to_seconds(config.period),
      is_on_line ? config.port : std::string(peer::word_of(config.driver))));
  return device;
}

void RealDevices::check_free(const DeviceConfig& config) const {
  const bool is_on_line = config.driver == DeviceDriver::serial;
  const bool is_free = std::ranges::none_of(driven_, [&](const Driven& one) {
    return one.driver == config.driver && (!is_on_line || one.port == config.port);
  });
  if (is_free) return;
  if (is_on_line)
    throw std::runtime_error(fmt::format("two devices are on {}: a line has one", config.port));
  throw std::runtime_error(
      fmt::format("one program drives one {}: start another peer for the second",
                  peer::usb_facts_of(config)->name));
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
