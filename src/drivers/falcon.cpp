// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/falcon/falcon_driver.hpp"
#include "reckon/peer/drivers/driver.hpp"

namespace reckon::peer {
namespace {

std::unique_ptr<haptics::UsbDriver> make_falcon(const DeviceConfig& device) {
  const auto& file = driver_value<std::filesystem::path>(device, "firmware");
  haptics::FalconFirmware firmware;
  if (!file.empty()) firmware = haptics::FalconFirmware::load(file.string());
  return std::make_unique<haptics::FalconDriver>(std::move(firmware));
}

}  // namespace

const Driver& falcon_driver() {
  static const ForceSide kForce{
      .facts = haptics::falcon_facts,
      .make = make_falcon,
      .product = "Novint Falcon",
      .use = "3 axes, 8.9 N in a cube of 80 mm: reckon demo --device falcon"};
  static const Driver kDriver{
      .name = "falcon",
      .article = "a Falcon",
      .summary = "a Novint Falcon on USB",
      .keys = {{.key = "firmware",
                .standard = std::filesystem::path(),
                .help = "of a Falcon: firmware file of its manufacturer; when absent, the Falcon "
                        "must have its firmware already",
                .flag = "--firmware",
                .flag_help = "firmware file, for a Falcon that has lost its firmware",
                .check_file =
                    [](const std::string& file) {
                      static_cast<void>(haptics::FalconFirmware::load(file));
                    }}},
      .force = &kForce};
  return kDriver;
}

}  // namespace reckon::peer
