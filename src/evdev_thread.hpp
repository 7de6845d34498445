// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A force feedback device of Linux as a device of a peer: the device, and the thread that has it.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "reckon/haptics/evdev/evdev_device.hpp"
#include "reckon/haptics/evdev/evdev_loop.hpp"
#include "reckon/haptics/evdev/event_calls.hpp"
#include "reckon/haptics/hid/hid_events.hpp"
#include "reckon/peer/clocks/clock.hpp"
#include "reckon/peer/device_thread.hpp"

namespace reckon::peer {

/// It sleeps until the device has sent something, 1 ms at most.
class EvdevThread {
 public:
  /// @param clock that of the servo; outlives this  @param calls of the kernel
  /// @throws std::invalid_argument as haptics::evdev_limits(), std::system_error if no thread can
  /// be made
  EvdevThread(const Clock& clock, const haptics::EvdevSettings& settings,
              std::unique_ptr<haptics::EventCalls> calls = haptics::force_feedback_calls());
  EvdevThread(const EvdevThread&) = delete;
  EvdevThread& operator=(const EvdevThread&) = delete;

  /// For the servo; its reading fails while the device is not there.
  [[nodiscard]] haptics::EvdevDevice& device() noexcept { return device_; }
  /// Sentences for the user since the last call. Any thread.
  [[nodiscard]] std::vector<std::string> take_notices() { return loop_.take_notices(); }

 private:
  haptics::EvdevExchange exchange_;
  haptics::EvdevDevice device_;
  haptics::EvdevLoop loop_;
  DeviceThread thread_;  // uses all of them
};

}  // namespace reckon::peer
