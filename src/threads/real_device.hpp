// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A real device of a peer: the device interface for its servo, and the thread that communicates
// with it.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "reckon/haptics/devices/haptic_device.hpp"
#include "reckon/haptics/usb/usb_loop.hpp"
#include "reckon/peer/clocks/clock.hpp"

namespace reckon::peer {

/// Its thread, if it has one, sleeps until the device has sent something, 1 ms at most.
///
///     SteadyClock clock;
///     auto driver = std::make_unique<FalconDriver>(FalconFirmware::load("falcon.bin"));
///     auto falcon = usb_device(clock, usb_limits(driver->facts(), settings), std::move(driver));
///     options.devices = {{&falcon->device()}};
class RealDevice {
 public:
  virtual ~RealDevice() = default;
  RealDevice(const RealDevice&) = delete;
  RealDevice& operator=(const RealDevice&) = delete;

  /// For the servo; reading fails while the device is absent.
  [[nodiscard]] virtual haptics::HapticDevice& device() noexcept = 0;
  /// Sentences for the user since the last call. Any thread.
  [[nodiscard]] virtual std::vector<std::string> take_notices() = 0;
  /// See haptics::DeviceSession::axes(). Any thread.
  [[nodiscard]] virtual unsigned axes() const noexcept { return 0; }

 protected:
  RealDevice() = default;
};

/// A USB device. @param clock the servo's clock; outlives the device, as below
/// @param limits see haptics::usb_limits()  @param options for finding it; their clock is ignored
/// @throws std::runtime_error if the host has no USB, std::system_error if no thread can be
/// created
[[nodiscard]] std::unique_ptr<RealDevice> usb_device(const Clock& clock,
                                                     const haptics::DeviceLimits& limits,
                                                     std::unique_ptr<haptics::UsbDriver> driver,
                                                     haptics::UsbLoopOptions options = {});

}  // namespace reckon::peer
