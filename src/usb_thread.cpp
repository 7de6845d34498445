// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/usb_thread.hpp"

#include <utility>

namespace reckon::peer {
namespace {

haptics::UsbLoopOptions options_of(haptics::UsbLoopOptions options, const Clock& clock) {
  options.clock = [&clock] { return clock.now(); };
  return options;
}

}  // namespace

UsbThread::UsbThread(const Clock& clock, const haptics::DeviceLimits& limits,
                     std::unique_ptr<haptics::UsbDriver> driver, haptics::UsbLoopOptions options)
    : device_(exchange_, limits),
      loop_(exchange_, std::move(driver), options_of(std::move(options), clock)),
      thread_(clock, "rk-usb", [this] { loop_.step(DeviceThread::kLongestWait); }) {}

}  // namespace reckon::peer
