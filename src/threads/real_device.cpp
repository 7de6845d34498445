// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/threads/real_device.hpp"

#include <utility>

#include "reckon/haptics/usb/usb_device.hpp"
#include "reckon/peer/threads/threaded_device.hpp"

namespace reckon::peer {

std::unique_ptr<RealDevice> usb_device(const Clock& clock, const haptics::DeviceLimits& limits,
                                       std::unique_ptr<haptics::UsbDriver> driver,
                                       haptics::UsbLoopOptions options) {
  options.clock = [&clock] { return clock.now(); };
  return std::make_unique<
      ThreadedDevice<haptics::UsbExchange, haptics::UsbDevice, haptics::UsbLoop>>(
      clock, "rk-usb", limits, std::move(driver), std::move(options));
}

}  // namespace reckon::peer
