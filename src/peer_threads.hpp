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
#include "reckon/peer/peer.hpp"
#include "reckon/peer/threads/real_time_priority.hpp"
#include "reckon/peer/threads/servo_thread.hpp"
#include "reckon/peer/threads/wake_signal.hpp"

namespace reckon::peer {

/// If the model loop reads the link, it processes all datagrams of this interval in one pass. The
/// interval is kPrompt while a peer waits for an answer.
inline constexpr std::chrono::nanoseconds kTogether = std::chrono::milliseconds(5);
inline constexpr std::chrono::nanoseconds kPrompt = std::chrono::milliseconds(1);

/// How the threads run.
struct PeerThreadsOptions {
  /// The thread for the servo, shared with servos of other peers; it outlives the threads. Null: a
  /// separate thread with the options `own_servo`.
  ServoThread* servo = nullptr;
  ServoThreadOptions own_servo = {};
  /// Requests SCHED_FIFO, below the servo, for the loops between a device and the network. On a
  /// busy host they otherwise wait for milliseconds behind programs that compute. The priority is
  /// given up if it starves ordinary threads (ServoThreadOptions::starvation). Needs
  /// own_servo.real_time.
  bool real_time = true;
  /// Prevents the process's memory from being swapped out, if permitted: a page that comes back
  /// from a disk is milliseconds late.
  bool lock_memory = true;
};

/// Runs a peer from construction to stop() or destruction. The peer must have been started.
///
/// The threads are named after their loop and the peer's application at their start: "rk-read 1",
/// "rk-write 1", "rk-model 1", and "rk-servo 1" if the peer has its own servo thread.
///
/// The model loop runs when a datagram has arrived, after a step of the servo, and at the time of
/// Peer::next_step(). Waking a thread costs more than a datagram. If delays cannot be felt, because
/// no body is within reach of a hand and passes are short, the model loop itself therefore reads
/// and sends. It then takes all arrivals within kTogether together. Otherwise the reader waits at
/// the link and wakes the model loop for each arrival that can be felt, and the writer sends. Other
/// arrivals then wait for the next step of a servo that paces the model loop.
class PeerThreads {
 public:
  /// @param peer, clock outlive the threads. @throws std::system_error with the remedy if a thread
  /// cannot be made; the threads made before it have then ended.
  PeerThreads(Peer& peer, const Clock& clock, const PeerThreadsOptions& options);
  ~PeerThreads() { stop(); }

  PeerThreads(const PeerThreads&) = delete;
  PeerThreads& operator=(const PeerThreads&) = delete;

  /// Ends and joins all threads. The caller has to call the peer's own stop(), which announces the
  /// end.
  void stop() noexcept;

  /// Makes the model loop run soon, for example after a caller has queued work for it. Any thread.
  void wake() noexcept;

  /// Lateness, step time and missed periods of the servo, readable while it runs.
  [[nodiscard]] const DutyCycle& servo_duty() const noexcept { return duty_; }
  /// Durations of the passes of the loops, including the wait for a processor, readable while they
  /// run. A pass longer than a period of the servo is an overrun. Passes of the model loop include
  /// reading and sending if it does both.
  [[nodiscard]] const PassTimes& read_times() const noexcept { return read_times_; }
  [[nodiscard]] const PassTimes& model_times() const noexcept { return model_times_; }
  [[nodiscard]] const PassTimes& write_times() const noexcept { return write_times_; }
  /// The thread that runs the servo, also after stop(); null for a peer without a device.
  [[nodiscard]] const ServoThread* servo() const noexcept { return servo_; }
  /// Whether that thread got real-time priority.
  [[nodiscard]] bool real_time() const noexcept { return servo_ != nullptr && servo_->real_time(); }
  /// Whether the process's memory is kept from being swapped out.
  [[nodiscard]] bool memory_locked() const noexcept { return memory_locked_; }

 private:
  /// The thread that reads the link. The reader returns the task when the model loop has asked for
  /// it.
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
  WakeSignal room_;   // for the reader: the model loop has made room, or takes over reading
  WakeSignal ready_;  // for the writer: something is to be sent
  std::atomic<LinkReader> reads_{LinkReader::model};
  std::atomic<bool> at_link_{false};  // the model loop waits at the link
  std::mutex sending_;                // of the datagrams that are queued for the link
  // Of the model loop.
  std::chrono::nanoseconds urgent_until_{0}, next_look_{0}, last_news_{0};
  std::atomic<bool> paced_{false};  // by the servo
  std::unique_ptr<ServoThread> own_servo_;
  ServoThread* servo_ = nullptr;
  std::optional<std::size_t> seat_;  // at servo_
  std::thread read_, model_, write_;
};

}  // namespace reckon::peer
