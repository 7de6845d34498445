// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A device on USB as a device of a peer: the device, and the thread that talks with it.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "reckon/haptics/usb/usb_device.hpp"
#include "reckon/haptics/usb/usb_driver.hpp"
#include "reckon/haptics/usb/usb_exchange.hpp"
#include "reckon/haptics/usb/usb_loop.hpp"
#include "reckon/peer/clocks/clock.hpp"
#include "reckon/peer/device_thread.hpp"

namespace reckon::peer {

/// The thread sleeps until the device has sent something, 1 ms at most.
///
///     SteadyClock clock;
///     auto driver = std::make_unique<FalconDriver>(FalconFirmware::load("falcon.bin"));
///     UsbThread falcon(clock, usb_limits(driver->facts(), settings), std::move(driver));
///     options.devices = {{&falcon.device()}};
class UsbThread {
 public:
  /// @param clock that of the servo; outlives this  @param limits see haptics::usb_limits()
  /// @param options how the device is found, but for their clock
  /// @throws std::runtime_error where the host has no USB, std::system_error if no thread can be
  /// made
  UsbThread(const Clock& clock, const haptics::DeviceLimits& limits,
            std::unique_ptr<haptics::UsbDriver> driver, haptics::UsbLoopOptions options = {});
  ~UsbThread() { loop_.stop(); }
  UsbThread(const UsbThread&) = delete;
  UsbThread& operator=(const UsbThread&) = delete;

  /// For the servo; its reading fails while the device is not there.
  [[nodiscard]] haptics::UsbDevice& device() noexcept { return device_; }
  /// Sentences for the user since the last call. Any thread.
  [[nodiscard]] std::vector<std::string> take_notices() { return loop_.take_notices(); }

 private:
  haptics::UsbExchange exchange_;
  haptics::UsbDevice device_;
  haptics::UsbLoop loop_;
  DeviceThread thread_;  // uses all of them
};

}  // namespace reckon::peer
