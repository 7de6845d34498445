// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A board on a serial line as a device of a peer: the device, and the thread that talks with it.
#pragma once

#include <string>
#include <vector>

#include "reckon/haptics/serial/serial_loop.hpp"
#include "reckon/haptics/usb/usb_device.hpp"
#include "reckon/haptics/usb/usb_exchange.hpp"
#include "reckon/peer/clocks/clock.hpp"
#include "reckon/peer/device_thread.hpp"

namespace reckon::peer {

/// It sleeps until the board has sent something, 1 ms at most.
///
///     SteadyClock clock;
///     SerialThread board(clock, usb_limits(serial_facts(), settings), {"/dev/ttyACM0",
///     1'000'000}); options.devices = {{&board.device()}};
class SerialThread {
 public:
  /// @param clock that of the servo; outlives this  @param limits see haptics::usb_limits()
  /// @throws std::system_error if no thread can be made
  SerialThread(const Clock& clock, const haptics::DeviceLimits& limits, haptics::SerialPlace place);
  SerialThread(const SerialThread&) = delete;
  SerialThread& operator=(const SerialThread&) = delete;

  /// For the servo; its reading fails while the board is not there.
  [[nodiscard]] haptics::UsbDevice& device() noexcept { return device_; }
  /// See haptics::SerialLoop::axes(). Any thread.
  [[nodiscard]] unsigned axes() const noexcept { return loop_.axes(); }
  /// Sentences for the user since the last call. Any thread.
  [[nodiscard]] std::vector<std::string> take_notices() { return loop_.take_notices(); }

 private:
  haptics::UsbExchange exchange_;
  haptics::UsbDevice device_;
  haptics::SerialLoop loop_;
  DeviceThread thread_;  // uses all of them
};

}  // namespace reckon::peer
