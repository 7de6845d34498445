// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/drivers/serial.hpp"

#include <fmt/format.h>

#include <charconv>
#include <stdexcept>
#include <system_error>

#include "reckon/haptics/serial/serial_session.hpp"
#include "reckon/haptics/usb/usb_device.hpp"
#include "reckon/peer/drivers/serial_lines.hpp"
#include "reckon/peer/threads/threaded_device.hpp"

namespace reckon::peer {
namespace {

constexpr std::uint32_t kLeastBaud = 1'200, kMostBaud = 12'000'000;

const std::string& port_of(const DeviceConfig& device) {
  return driver_value<std::string>(device, "port");
}

bool is_port(const std::string& text) {
  return text.starts_with("/dev/") && !text.starts_with("/dev/input/") &&
         !text.starts_with("/dev/hidraw");
}

// PORT or PORT@BAUD.
void put_port(DeviceConfig& device, const std::string& text) {
  const std::size_t at = std::min(text.rfind('@'), text.size());
  device.driver_values["port"] = text.substr(0, at);
  device.driver_values.erase("baud");
  if (at == text.size()) return;
  std::uint32_t baud = 0;
  const char* const end = text.data() + text.size();
  const auto read = std::from_chars(text.data() + at + 1, end, baud);
  if (read.ec != std::errc() || read.ptr != end || baud < kLeastBaud || baud > kMostBaud)
    throw std::invalid_argument(
        fmt::format("'{}' is not a baud rate from {} to {}: write /dev/ttyACM0@115200, or omit it",
                    text.substr(at + 1), kLeastBaud, kMostBaud));
  device.driver_values["baud"] = baud;
}

OpenedDevice open_port(const DeviceConfig& device, const DeviceOpening& opening) {
  const haptics::DeviceLimits limits =
      haptics::usb_limits(haptics::serial_facts(), usb_settings_of(device));
  return {serial_device(opening.clock, limits,
                        {port_of(device), driver_value<std::uint32_t>(device, "baud")}),
          force_notice(device, limits)};
}

}  // namespace

std::unique_ptr<RealDevice> serial_device(const Clock& clock, const haptics::DeviceLimits& limits,
                                          haptics::SerialPlace place) {
  return std::make_unique<
      ThreadedDevice<haptics::UsbExchange, haptics::UsbDevice, haptics::SerialLoop>>(
      clock, "rk-serial", limits, limits, std::move(place), [&clock] { return clock.now(); });
}

const Driver& serial_driver() {
  static const ForceSide kForce{.facts = haptics::serial_facts,
                                .silence = haptics::SerialSession::kSilence,
                                .assumed_force = haptics::kSerialAssumedForce,
                                .line = port_of};
  static const DevicePlace kPlace{
      "the port of a serial board (/dev/ttyACM0, or /dev/ttyUSB0@115200)", is_port, put_port};
  static const Driver kDriver{
      .name = "serial",
      .is_named = false,
      .article = "a serial board",
      .summary = "a board on a serial port",
      .keys = {{.key = "port",
                .standard = std::string(),
                .help = "of a serial board: its port, such as \"/dev/ttyACM0\", or better a path "
                        "in /dev/serial/by-id"},
               {.key = "baud",
                .standard = std::uint32_t{1'000'000},
                .least = kLeastBaud,
                .most = kMostBaud,
                .help = "of that port; a board with its own USB interface ignores it"}},
      .fault =
          [](const DeviceConfig& device) {
            return std::string(port_of(device).empty()
                                   ? "a serial board needs a port: add port = \"/dev/ttyACM0\""
                                   : "");
          },
      .force = &kForce,
      .place = &kPlace,
      .ports = [] { return look_at_serial_lines(); },
      .open = open_port};
  return kDriver;
}

}  // namespace reckon::peer
