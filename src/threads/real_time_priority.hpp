// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Real-time priority that is given back where it leaves the ordinary threads of the host no time:
// not even one that could end the program would run.
#pragma once

#include <atomic>
#include <chrono>
#include <thread>

#include "reckon/peer/clocks/clock.hpp"
#include "reckon/peer/loops/wake_signal.hpp"

namespace reckon::peer {

/// Whether a process whose ordinary thread should have run `silence` ago starves such threads: it
/// has been silent for `most`, and the process ran meanwhile, for a tenth of that time at least.
/// One that was stopped did not.
[[nodiscard]] constexpr bool starves_ordinary_threads(std::chrono::nanoseconds silence,
                                                      std::chrono::nanoseconds processor_time,
                                                      std::chrono::nanoseconds most) noexcept {
  return silence >= most && processor_time >= silence / 10;
}

/// A thread of ordinary priority that beats. From its silence, threads of real-time priority see
/// that nothing is left to others, whoever takes it: a kernel keeps some 5 % of a core for them at
/// best, in one piece each second.
class OrdinaryPulse {
 public:
  /// @param clock steady, outlives this  @param silence > 0, that is too long; it beats ten times
  /// as often. @throws std::system_error where no thread can be made
  OrdinaryPulse(const Clock& clock, std::chrono::nanoseconds silence);
  ~OrdinaryPulse();

  OrdinaryPulse(const OrdinaryPulse&) = delete;
  OrdinaryPulse& operator=(const OrdinaryPulse&) = delete;

  [[nodiscard]] std::chrono::nanoseconds longest_silence() const noexcept { return silence_; }
  /// Whether it starves now, by this process too. Any thread; some ns, 0.5 us after a long silence.
  [[nodiscard]] bool starves(std::chrono::nanoseconds now) const noexcept;

 private:
  void beat() noexcept;

  const Clock& clock_;
  const std::chrono::nanoseconds silence_;
  std::atomic<std::chrono::nanoseconds> last_{};            // beat
  std::atomic<std::chrono::nanoseconds> processor_time_{};  // of the process, then
  std::atomic<bool> stop_{false};
  WakeSignal ends_;
  std::thread thread_;
};

/// SCHED_FIFO for the thread that makes this; ends with give_up() alone.
class RealTimePriority {
 public:
  /// @param priority of SCHED_FIFO, 1 to 99. Without the right nothing changes. `pulse` outlives
  /// it.
  RealTimePriority(int priority, const OrdinaryPulse& pulse) noexcept;

  [[nodiscard]] bool held() const noexcept { return held_; }
  /// Whether ordinary threads starve while it is held; true once in each longest_silence().
  [[nodiscard]] bool starves_others(std::chrono::nanoseconds now) noexcept;
  void give_up() noexcept;

 private:
  const OrdinaryPulse& pulse_;
  bool held_;
  std::chrono::nanoseconds judged_from_{0};
};

}  // namespace reckon::peer
