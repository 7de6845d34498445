// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Gives each loop of a peer a thread, and is the only place where a running peer reads the time.
#pragma once

#include <atomic>
#include <chrono>
#include <string>
#include <thread>

#include "reckon/peer/clocks/clock.hpp"
#include "reckon/peer/counters/duty_cycle.hpp"
#include "reckon/peer/peer.hpp"

namespace reckon::peer {

/// How the threads run.
struct PeerThreadsOptions {
  std::chrono::nanoseconds servo_period = std::chrono::milliseconds(1);
  std::chrono::nanoseconds model_period = std::chrono::milliseconds(2);
  /// The servo wakes this much early and spins: p99 falls from tens of microseconds to none. Only
  /// where the host grants real-time priority; 0 = never.
  std::chrono::nanoseconds spin = std::chrono::microseconds(100);
  bool real_time = true;  ///< ask for SCHED_FIFO for the servo
};

/// Runs a peer from construction to stop() or destruction. The peer must have been started.
class PeerThreads {
 public:
  /// @param peer, clock outlive the threads. @throws std::system_error where no thread can be made.
  PeerThreads(Peer& peer, const Clock& clock, const PeerThreadsOptions& options);
  ~PeerThreads() { stop(); }

  PeerThreads(const PeerThreads&) = delete;
  PeerThreads& operator=(const PeerThreads&) = delete;

  /// Ends and joins all threads. The peer's own stop(), which says good-bye, is the caller's.
  void stop() noexcept;

  /// Lateness, step time and missed periods of the servo, readable while it runs.
  [[nodiscard]] const DutyCycle& servo_duty() const noexcept { return duty_; }
  /// Whether the host granted SCHED_FIFO; known once the servo has made its first step.
  [[nodiscard]] bool real_time() const noexcept { return real_time_; }

 private:
  void run_servo() noexcept;
  void run_read() noexcept;
  void run_model() noexcept;
  void run_write() noexcept;

  Peer& peer_;
  const Clock& clock_;
  PeerThreadsOptions options_;
  DutyCycle duty_;
  std::atomic<bool> stop_{false};
  std::atomic<bool> real_time_{false};
  std::atomic<std::uint32_t> to_write_{
      0};  // bumped by the model loop, waited for by the write loop
  std::jthread servo_, read_, model_, write_;
};

}  // namespace reckon::peer
