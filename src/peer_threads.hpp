// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Gives each loop of a peer a thread, and is the only place where a running peer reads the time.
#pragma once

#include <atomic>
#include <chrono>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

#include "reckon/peer/clocks/clock.hpp"
#include "reckon/peer/counters/duty_cycle.hpp"
#include "reckon/peer/loops/wake_signal.hpp"
#include "reckon/peer/peer.hpp"
#include "reckon/peer/threads/real_time_priority.hpp"
#include "reckon/peer/threads/servo_thread.hpp"

namespace reckon::peer {

/// How the threads run.
struct PeerThreadsOptions {
  /// The thread that serves the servo, with those of other peers; it outlives the threads. Null: a
  /// thread of its own, as `own_servo` says.
  ServoThread* servo = nullptr;
  ServoThreadOptions own_servo = {};
  /// Ask for SCHED_FIFO, below the servo, for the loops between a device and the network: on a busy
  /// host they otherwise wait for milliseconds behind programs that compute. It is given up where
  /// it starves ordinary threads (ServoThreadOptions::starvation). Needs own_servo.real_time.
  bool real_time = true;
  /// Keep the process's memory from being swapped out, where the right is there: a page that comes
  /// back from a disk is milliseconds late.
  bool lock_memory = true;
};

/// Runs a peer from construction to stop() or destruction. The peer must have been started.
///
/// The threads are named after their loop and the peer's application when they start: "rk-read 1",
/// "rk-write 1", "rk-model 1", and the servo's, where it is the peer's own, "rk-servo 1".
///
/// The model loop runs when a datagram has come, when the servo has made a step, and when
/// Peer::next_step() says. Waking a thread costs more than a datagram, so one thread does all where
/// a delay is not felt: while no body is within reach of a hand and passes are short, the model
/// loop itself reads and sends. It then takes what arrives within 1 ms together. Otherwise the
/// reader waits at the link and wakes the model loop for each arrival that can be felt, and the
/// writer sends; what else arrives waits for the next step of a servo that paces the model loop.
class PeerThreads {
 public:
  /// @param peer, clock outlive the threads. @throws std::system_error with the remedy where a
  /// thread cannot be made; those made before it have ended then.
  PeerThreads(Peer& peer, const Clock& clock, const PeerThreadsOptions& options);
  ~PeerThreads() { stop(); }

  PeerThreads(const PeerThreads&) = delete;
  PeerThreads& operator=(const PeerThreads&) = delete;

  /// Ends and joins all threads. The peer's own stop(), which says good-bye, is the caller's.
  void stop() noexcept;

  /// Makes the model loop run soon, as when a caller has queued work for it. Any thread.
  void wake() noexcept;

  /// Lateness, step time and missed periods of the servo, readable while it runs.
  [[nodiscard]] const DutyCycle& servo_duty() const noexcept { return duty_; }
  /// What passes of the loops take, waiting for a processor included, readable while they run. One
  /// that is longer than a period of the servo is an overrun. Passes of the model loop contain
  /// reading and sending where it does both.
  [[nodiscard]] const PassTimes& read_times() const noexcept { return read_times_; }
  [[nodiscard]] const PassTimes& model_times() const noexcept { return model_times_; }
  [[nodiscard]] const PassTimes& write_times() const noexcept { return write_times_; }
  /// The thread that serves the servo, also after stop(); null for a peer without a device.
  [[nodiscard]] const ServoThread* servo() const noexcept { return servo_; }
  /// Whether that thread got real-time priority.
  [[nodiscard]] bool real_time() const noexcept { return servo_ != nullptr && servo_->real_time(); }
  /// Whether the process's memory is kept from being swapped out.
  [[nodiscard]] bool memory_locked() const noexcept { return memory_locked_; }

 private:
  /// Which thread reads the link. The reader returns it when the model loop has asked.
  enum class LinkReader : std::uint8_t { model, reader, asked_back };

  void start();
  using Priority = std::optional<RealTimePriority>;
  void run_read(Priority& priority) noexcept;
  void run_model(Priority& priority) noexcept;
  void run_write(Priority& priority) noexcept;
  void leave_time(Priority& priority) noexcept;
  void announce_arrivals() noexcept;
  std::size_t read_in_model_loop(std::chrono::nanoseconds now) noexcept;
  void send_out() noexcept;
  void choose_reader(std::chrono::nanoseconds now) noexcept;
  void wait_for_work(std::chrono::nanoseconds begun, std::size_t taken) noexcept;
  void wait_at_link(std::chrono::nanoseconds timeout, std::chrono::nanoseconds together) noexcept;
  void note_pace(bool news) noexcept;
  [[nodiscard]] bool reads_in_model_loop() const noexcept {
    return reads_.load(std::memory_order_acquire) == LinkReader::model;
  }

  Peer& peer_;
  const Clock& clock_;
  PeerThreadsOptions options_;
  DutyCycle duty_;
  PassTimes read_times_, model_times_, write_times_;
  bool memory_locked_;
  const bool felt_;  // the peer has a device, so these threads are urgent
  std::atomic<bool> stop_{false};
  WakeSignal news_;   // for the model loop: something arrived, the servo made a step
  WakeSignal room_;   // for the reader: the model loop has made room, or is to read no longer
  WakeSignal ready_;  // for the writer: something is to be sent
  std::atomic<LinkReader> reads_{LinkReader::model};
  std::atomic<bool> at_link_{false};  // the model loop waits at the link
  std::mutex sending_;                // of what is queued for the link
  // Of the model loop.
  std::chrono::nanoseconds urgent_until_{0}, next_look_{0}, last_news_{0};
  std::atomic<bool> paced_{false};  // by the servo
  std::unique_ptr<ServoThread> own_servo_;
  ServoThread* servo_ = nullptr;
  std::optional<std::size_t> seat_;  // at servo_
  std::thread read_, model_, write_;
};

}  // namespace reckon::peer
