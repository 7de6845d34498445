// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/exercise/real_devices.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <iterator>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "reckon/pdu/seconds.hpp"
#include "reckon/peer/scene/belongings.hpp"
#include "reckon/peer/scene/nearest_word.hpp"
#include "reckon/tools/command_line/console.hpp"
#include "reckon/tools/exercise/simulated_hand.hpp"

namespace reckon::tools {
namespace {

using peer::DeviceConfig;
using peer::DeviceDriver;

constexpr std::array<std::string_view, 1> kDrivers{"falcon"};

// All devices by name, where the file has none.
void say_devices(peer::SceneFile& scene, std::size_t peers) {
  if (!scene.devices.empty()) return;
  std::vector<DeviceConfig> devices;
  for (std::uint32_t peer = 1; peer <= peers; ++peer)
    std::ranges::copy(peer::devices_of(scene, peer), std::back_inserter(devices));
  scene.devices = std::move(devices);
}

}  // namespace

void add_device_flags(CommandLine& line, DeviceChoice& choice) {
  line.option("--device", choice.device,
              "a real device, by its driver, in the place of the peer's first: falcon (see reckon "
              "devices)");
  line.option("--firmware", choice.firmware,
              "file of the program that a Falcon runs, where it has lost it");
}

void check_device_choice(const DeviceChoice& choice) {
  const std::string& name = choice.device;
  if (!name.empty() && std::ranges::find(kDrivers, name) == kDrivers.end()) {
    const std::string_view nearest = peer::nearest_word(name, kDrivers);
    const std::string meant =
        nearest.empty() ? std::string() : fmt::format(", did you mean '{}'?", nearest);
    throw UsageError(
        fmt::format("--device: there is no driver '{}'{}; there is falcon (see reckon "
                    "devices)",
                    name, meant));
  }
  if (choice.firmware.empty()) return;
  try {
    static_cast<void>(haptics::FalconFirmware::load(choice.firmware));
  } catch (const std::runtime_error& error) {
    throw UsageError(fmt::format("--firmware: {}", error.what()));
  }
}

void choose_device(const DeviceChoice& choice, peer::SceneFile& scene, std::uint32_t number,
                   std::size_t peers) {
  if (!choice.device.empty()) say_devices(scene, peers);
  const auto of_peer = [&](const DeviceConfig& device) { return device.peer == number; };
  const auto first = std::ranges::find_if(scene.devices, of_peer);
  if (!choice.device.empty()) {
    if (first == scene.devices.end())
      throw UsageError(fmt::format("--device: peer {} has no device in this scene", number));
    first->source = peer::DeviceSource::simulated;
    // What the scene says of a simulated device's friction and delay is not said of this one.
    if (first->driver != DeviceDriver::falcon)
      peer::use_driver(*first, DeviceDriver::falcon, false, false);
  }
  if (choice.firmware.empty()) return;
  const auto falcon = std::ranges::find_if(scene.devices, [&](const DeviceConfig& device) {
    return of_peer(device) && device.driver == DeviceDriver::falcon;
  });
  if (falcon == scene.devices.end())
    throw UsageError("--firmware: no device of this peer takes one; add --device falcon");
  falcon->firmware = std::filesystem::absolute(choice.firmware);
}

void RealDevices::plug_in(const peer::SceneFile& scene, std::uint32_t number,
                          std::vector<peer::PeerDevice>& wired) {
  const std::vector<DeviceConfig> devices = peer::devices_of(scene, number);
  for (std::size_t i = 0; i < devices.size(); ++i) {
    if (devices[i].driver != DeviceDriver::falcon) continue;
    if (falcon_ != nullptr)
      throw std::runtime_error("one program drives one Falcon: start another peer for the second");
    haptics::FalconFirmware firmware;
    if (!devices[i].firmware.empty())
      firmware = haptics::FalconFirmware::load(devices[i].firmware.string());
    falcon_ = std::make_unique<peer::FalconThread>(clock_, peer::falcon_settings_of(devices[i]),
                                                   std::move(firmware));
    wired[i].device = &falcon_->device();
    if (const haptics::HandMapping mapping = mapping_of(devices[i]); !mapping.is_plain())
      wired[i].device =
          mapped_.emplace_back(std::make_unique<haptics::MappedDevice>(*wired[i].device, mapping))
              .get();
    const haptics::DeviceLimits limits = falcon_->device().limits();
    sentences_.push_back(fmt::format(
        "Falcon: {:.2g} N s/m of damping are relied on, and forces are {:.2g} ms late; where you "
        "know more of the one or less of the other, 'damping' and 'delay' of its [[device]] give "
        "stiffer walls",
        limits.damping, 1e3 * limits.delay_samples * pdu::to_seconds(devices[i].period)));
  }
}

std::vector<std::string> RealDevices::take_notices() {
  std::vector<std::string> all = std::exchange(sentences_, {});
  if (falcon_ == nullptr) return all;
  for (std::string& sentence : falcon_->take_notices()) all.push_back(std::move(sentence));
  return all;
}

}  // namespace reckon::tools
