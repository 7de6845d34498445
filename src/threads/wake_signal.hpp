// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Wakes a sleeping thread that has new work, without a lock between the threads.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>

namespace reckon::peer {

/// One thread waits, any may notify. The waiter sees all writes before notify(). Several
/// notifications before a wait count as one. No allocation.
class WakeSignal {
 public:
  /// Ends the present wait, or the next one. Never blocks: about 10 ns if nobody sleeps, else one
  /// system call that wakes a processor, 4 to 20 us on a virtual machine. Any thread.
  void notify() noexcept {
    if (state_.exchange(kNotified, std::memory_order_acq_rel) == kSleeping) wake_sleeper();
  }

  /// Sleeps until notify(), `timeout` [steady time] or a signal to the process; true after
  /// notify(). Zero or less only polls, nanoseconds::max() waits without limit. One thread.
  bool wait(std::chrono::nanoseconds timeout) noexcept;

 private:
  static constexpr std::uint32_t kIdle = 0, kNotified = 1, kSleeping = 2;
  void wake_sleeper() noexcept;

  alignas(64) std::atomic<std::uint32_t> state_{kIdle};
};

}  // namespace reckon::peer
