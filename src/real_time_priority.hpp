// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Real-time priority that is given back where it leaves the ordinary threads of the host no time:
// not even one that could end the program would run.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <optional>
#include <thread>

#include "reckon/peer/loops/wake_signal.hpp"

namespace reckon::peer {

/// A thread of ordinary priority that beats. From its beats, threads of real-time priority see what
/// time is left to others, whoever takes it: a kernel leaves some 5 % of a core at best.
class OrdinaryPulse {
 public:
  /// @param beat > 0. @throws std::system_error where no thread can be made
  explicit OrdinaryPulse(std::chrono::nanoseconds beat);
  ~OrdinaryPulse();

  OrdinaryPulse(const OrdinaryPulse&) = delete;
  OrdinaryPulse& operator=(const OrdinaryPulse&) = delete;

  [[nodiscard]] std::chrono::nanoseconds beat() const noexcept { return beat_; }
  [[nodiscard]] std::uint64_t beats() const noexcept {
    return beats_.load(std::memory_order_relaxed);
  }

 private:
  const std::chrono::nanoseconds beat_;
  std::atomic<std::uint64_t> beats_{0};
  std::atomic<bool> stop_{false};
  WakeSignal ends_;
  std::thread thread_;
};

/// What one thread knows of the beats. One thread; no allocation.
class StarvationWatch {
 public:
  static constexpr std::uint64_t kBeats = 40;  ///< that are waited for before it judges
  static constexpr std::uint64_t kFewest = 8;  ///< fewer of these: the ordinary threads starve

  explicit StarvationWatch(const OrdinaryPulse& pulse) noexcept : pulse_(pulse) {}

  /// At each pass of a loop, with the steady time. True where of the last kBeats few came; then it
  /// counts anew. A pause of the caller, a stopped process among them, counts as one beat at most.
  [[nodiscard]] bool starved(std::chrono::nanoseconds now) noexcept;

 private:
  const OrdinaryPulse& pulse_;
  std::optional<std::chrono::nanoseconds> last_;
  std::chrono::nanoseconds watched_{0};
  std::uint64_t first_ = 0;
};

/// SCHED_FIFO for the thread that makes this; ends with give_up() alone.
class RealTimePriority {
 public:
  /// @param priority of SCHED_FIFO, 1 to 99. Without the right nothing changes.
  RealTimePriority(int priority, const OrdinaryPulse& pulse) noexcept;

  [[nodiscard]] bool held() const noexcept { return held_; }
  /// As StarvationWatch::starved(), while it is held.
  [[nodiscard]] bool starves_others(std::chrono::nanoseconds now) noexcept {
    return held_ && watch_.starved(now);
  }
  void give_up() noexcept;

 private:
  StarvationWatch watch_;
  bool held_;
};

}  // namespace reckon::peer
