// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A force feedback device of Linux as a device of a peer: the device, and the thread that has it.
#pragma once

#include <atomic>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "reckon/haptics/evdev/evdev_device.hpp"
#include "reckon/haptics/evdev/evdev_loop.hpp"
#include "reckon/haptics/evdev/event_calls.hpp"
#include "reckon/peer/clocks/clock.hpp"
#include "reckon/peer/real_time_priority.hpp"

namespace reckon::peer {

/// The thread has SCHED_FIFO where the host grants it, below the servo. It sleeps until the device
/// has sent something, 1 ms at most.
class EvdevThread {
 public:
  static constexpr int kPriority = 45;  ///< of SCHED_FIFO

  /// @param clock that of the servo; outlives this  @param calls of the kernel
  /// @throws std::invalid_argument as haptics::evdev_limits(), std::system_error if no thread can
  /// be made
  EvdevThread(const Clock& clock, const haptics::EvdevSettings& settings,
              std::unique_ptr<haptics::EventCalls> calls = haptics::kernel_event_calls());
  ~EvdevThread();
  EvdevThread(const EvdevThread&) = delete;
  EvdevThread& operator=(const EvdevThread&) = delete;

  /// For the servo; its reading fails while the device is not there.
  [[nodiscard]] haptics::EvdevDevice& device() noexcept { return device_; }
  /// Sentences for the user since the last call. Any thread.
  [[nodiscard]] std::vector<std::string> take_notices() { return loop_.take_notices(); }

 private:
  void run() noexcept;

  const Clock& clock_;
  haptics::EvdevExchange exchange_;
  haptics::EvdevDevice device_;
  haptics::EvdevLoop loop_;
  OrdinaryPulse pulse_;
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

}  // namespace reckon::peer
