// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The thread that talks with a real device.
#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <thread>

#include "reckon/peer/clocks/clock.hpp"
#include "reckon/peer/threads/real_time_priority.hpp"

namespace reckon::peer {

/// It has SCHED_FIFO where the host grants it, below the servo: what a device sends waits for it.
class DeviceThread {
 public:
  static constexpr int kPriority = 45;  ///< of SCHED_FIFO
  /// What a step may wait for its device at most.
  static constexpr std::chrono::microseconds kLongestWait{1000};

  /// @param clock that of the servo; outlives this  @param name of at most 15 letters
  /// @param step called over and over, waits as said @throws std::system_error if no thread can be
  /// made
  DeviceThread(const Clock& clock, const char* name, std::function<void()> step);
  /// Waits for the step to end.
  ~DeviceThread();
  DeviceThread(const DeviceThread&) = delete;
  DeviceThread& operator=(const DeviceThread&) = delete;

 private:
  void run() noexcept;

  const Clock& clock_;
  std::function<void()> step_;
  OrdinaryPulse pulse_;
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

}  // namespace reckon::peer
