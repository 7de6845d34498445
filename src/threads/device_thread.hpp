// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The thread that communicates with a real device.
#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <thread>
#include <utility>

#include "reckon/peer/clocks/clock.hpp"
#include "reckon/peer/threads/real_time_priority.hpp"
#include "reckon/peer/threads/thread_name.hpp"

namespace reckon::peer {

/// Uses SCHED_FIFO if the host grants it, below the servo: input from a device waits for the servo.
class DeviceThread {
 public:
  static constexpr int kPriority = 45;  ///< of SCHED_FIFO
  /// Longest wait of a step for its device.
  static constexpr std::chrono::microseconds kLongestWait{1000};

  /// @param clock the servo's clock; outlives this  @param name at most 15 letters
  /// @param step called repeatedly, may wait for kLongestWait @throws std::system_error if no
  /// thread can be created
  DeviceThread(const Clock& clock, const char* name, std::function<void()> step)
      : clock_(clock), step_(std::move(step)), pulse_(clock, kSilence), thread_([this] { run(); }) {
    name_thread(thread_.native_handle(), name);
  }
  /// Waits for the end of the present step.
  ~DeviceThread() {
    stop_ = true;
    thread_.join();
  }
  DeviceThread(const DeviceThread&) = delete;
  DeviceThread& operator=(const DeviceThread&) = delete;

 private:
  static constexpr std::chrono::milliseconds kSilence{500};

  void run() noexcept {
    RealTimePriority priority(kPriority, pulse_);
    while (!stop_) {
      step_();
      if (priority.starves_others(clock_.now())) priority.give_up();
    }
  }

  const Clock& clock_;
  std::function<void()> step_;
  OrdinaryPulse pulse_;
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

}  // namespace reckon::peer
