// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Real-time priority that is given up if it starves the ordinary threads of the host: then not even
// a thread that could end the program would run.
#pragma once

#include <atomic>
#include <chrono>
#include <thread>

#include "reckon/peer/clocks/clock.hpp"
#include "reckon/peer/threads/wake_signal.hpp"

namespace reckon::peer {

/// Whether a process starves its ordinary threads: such a thread has been silent for at least
/// `most`, and the process ran for at least a tenth of that time. A stopped process did not.
[[nodiscard]] constexpr bool starves_ordinary_threads(std::chrono::nanoseconds silence,
                                                      std::chrono::nanoseconds processor_time,
                                                      std::chrono::nanoseconds most) noexcept {
  return silence >= most && processor_time >= silence / 10;
}

/// A thread of ordinary priority that sends regular pulses. Missing pulses show real-time threads
/// that ordinary threads get no processor time, regardless of which thread uses it. A kernel
/// reserves at best some 5 % of a core for ordinary threads, in one piece each second.
class OrdinaryPulse {
 public:
  /// @param clock steady, outlives this  @param silence > 0, limit of silence; it beats ten times
  /// as often. @throws std::system_error if no thread can be created
  OrdinaryPulse(const Clock& clock, std::chrono::nanoseconds silence);
  ~OrdinaryPulse();

  OrdinaryPulse(const OrdinaryPulse&) = delete;
  OrdinaryPulse& operator=(const OrdinaryPulse&) = delete;

  [[nodiscard]] std::chrono::nanoseconds longest_silence() const noexcept { return silence_; }
  /// Whether it starves now, at least partly by this process. Any thread; some ns, 0.5 us after a
  /// long silence.
  [[nodiscard]] bool starves(std::chrono::nanoseconds now) const noexcept;

 private:
  void beat() noexcept;

  const Clock& clock_;
  const std::chrono::nanoseconds silence_;
  std::atomic<std::chrono::nanoseconds> last_{};            // beat
  std::atomic<std::chrono::nanoseconds> processor_time_{};  // of the process, at that beat
  std::atomic<bool> stop_{false};
  WakeSignal ends_;
  std::thread thread_;
};

/// SCHED_FIFO for the constructing thread; ends only with give_up().
class RealTimePriority {
 public:
  /// @param priority of SCHED_FIFO, 1 to 99. Without permission nothing changes. `pulse` outlives
  /// it.
  RealTimePriority(int priority, const OrdinaryPulse& pulse) noexcept;

  [[nodiscard]] bool held() const noexcept { return held_; }
  /// Whether ordinary threads starve while it is held; true at most once in each longest_silence().
  [[nodiscard]] bool starves_others(std::chrono::nanoseconds now) noexcept;
  void give_up() noexcept;

 private:
  const OrdinaryPulse& pulse_;
  bool held_;
  std::chrono::nanoseconds judged_from_{0};
};

}  // namespace reckon::peer
