// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// One thread for all servos of a process, as punctual as the host allows. A spinning thread
// occupies a core, so a process has only one.
#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "reckon/peer/clocks/clock.hpp"
#include "reckon/peer/counters/duty_cycle.hpp"
#include "reckon/peer/threads/real_time_priority.hpp"
#include "reckon/peer/threads/wake_signal.hpp"

namespace reckon::peer {

/// How a ServoThread keeps time.
struct ServoThreadOptions {
  /// It wakes this early and spins, which reduces the p99 of the lateness from tens of microseconds
  /// to zero. Only if the host grants real-time priority; 0 = never.
  std::chrono::nanoseconds spin = std::chrono::microseconds(100);
  bool real_time = true;  ///< request SCHED_FIFO
  /// If this process starves ordinary threads for this long, the servo thread stops spinning. The
  /// second time it gives up SCHED_FIFO. Otherwise nothing could end the program.
  std::chrono::nanoseconds starvation = std::chrono::milliseconds(500);
  std::string name = "rk-servo";  ///< of the thread, see name_thread()
};

/// A servo as a ServoThread calls it. The thread calls all functions; they must not throw.
struct Servo {
  std::chrono::nanoseconds period = std::chrono::milliseconds(1);  ///< > 0
  std::function<void(std::chrono::nanoseconds now)> step;
  /// Called after one or more steps, when no other servo is due: wakes the readers of the results.
  std::function<void()> tell;
  /// Whether the next step must be punctual, so that the thread wakes early and spins; called
  /// between steps. Empty: always.
  std::function<bool()> is_urgent;
  DutyCycle* duty = nullptr;  ///< counts lateness, step time and misses; outlives the servo
};

/// Calls the steps of any number of servos, each at its own period, in the order in which they are
/// due. Missed periods are counted in the DutyCycle and not repeated.
class ServoThread {
 public:
  static constexpr int kPriority = 50;             ///< of SCHED_FIFO
  static constexpr std::size_t kMostServos = 256;  ///< at the same time

  /// @param clock outlives the thread. @throws std::system_error if no thread can be started.
  explicit ServoThread(const Clock& clock, const ServoThreadOptions& options = {});
  ~ServoThread() { stop(); }

  ServoThread(const ServoThread&) = delete;
  ServoThread& operator=(const ServoThread&) = delete;

  /// Steps `servo` from now on, first after one period, and returns its number. Any thread except
  /// the servo thread. @throws std::runtime_error if there are kMostServos already.
  [[nodiscard]] std::size_t add(Servo servo);
  /// Removes a servo. After the return none of its functions runs or will be called. Any thread
  /// except the servo thread.
  void remove(std::size_t number) noexcept;

  /// Ends and joins the thread; all servos must have been removed. Its statistics remain.
  void stop() noexcept;

  /// Lets other SCHED_FIFO threads detect starving ordinary threads; null without `real_time`.
  [[nodiscard]] const OrdinaryPulse* pulse() const noexcept { return pulse_ ? &*pulse_ : nullptr; }
  /// Whether it has SCHED_FIFO: granted by the host and not given up.
  [[nodiscard]] bool real_time() const noexcept { return real_time_; }
  /// "SCHED_FIFO 50, wakes 100 us early and spins", or the reason why not.
  [[nodiscard]] std::string describe() const;

 private:
  enum class State : std::uint8_t { free, served, leaving };
  struct Seat {
    std::atomic<State> state{State::free};
    Servo servo;
    std::chrono::nanoseconds due{0};
    bool untold = false;
  };

  void run(std::optional<RealTimePriority>& priority) noexcept;
  [[nodiscard]] Seat* next_due() noexcept;
  [[nodiscard]] bool is_urgent() const noexcept;
  void step(Seat& seat) noexcept;
  void tell() noexcept;
  void leave_time(RealTimePriority& priority) noexcept;

  const Clock& clock_;
  ServoThreadOptions options_;
  std::optional<OrdinaryPulse> pulse_;
  std::atomic<std::chrono::nanoseconds> spin_{std::chrono::nanoseconds(0)};
  std::array<Seat, kMostServos> seats_;
  std::atomic<std::size_t> seats_used_{0};  // number of seats at the front that may be in use
  std::mutex adding_;                       // never locked by the servo thread
  WakeSignal changed_, left_;
  std::atomic<bool> real_time_{false};
  std::atomic<bool> gave_way_{false};
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

}  // namespace reckon::peer
