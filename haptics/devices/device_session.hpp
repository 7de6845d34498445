// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Base of the sessions of real devices: opens the device, exchanges data with it, reports its loss
// and opens it again.
#pragma once

#include <chrono>
#include <functional>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

namespace reckon::haptics {

/// Session of one device. Its thread calls step() repeatedly; any thread may take the notices.
///
/// After any failure the force is zero here within 10 ms, one notice reports it, and the device is
/// opened again as soon as possible.
class DeviceSession {
 public:
  /// Steady clock of the servo's writes.
  using SteadyTime = std::function<std::chrono::nanoseconds()>;

  virtual ~DeviceSession() = default;
  DeviceSession(const DeviceSession&) = delete;
  DeviceSession& operator=(const DeviceSession&) = delete;

  /// Runs the session. Waits for the device at most `longest`, except during set-up.
  void step(std::chrono::microseconds longest) {
    if (is_open()) return exchange(longest);
    if (now() < next_try_) return wait(longest);
    std::string problem = open();
    const std::chrono::nanoseconds tried = now();
    next_try_ = tried + retry_;
    opened(tried, problem);
    if (!problem.empty()) tell_problem(problem);
  }
  /// Notices since the last call. It locks, so any thread except the servo's.
  [[nodiscard]] std::vector<std::string> take_notices() {
    const std::lock_guard lock(mutex_);
    return std::exchange(notices_, {});
  }
  /// Aborts a set-up of the device. Any thread.
  virtual void stop() noexcept {}
  /// Axes of frame D of the last device that was ready, bit 0 for x; 0: unknown. Any thread.
  [[nodiscard]] virtual unsigned axes() const noexcept { return 0; }

 protected:
  /// @param retry time between two attempts to open the device
  DeviceSession(SteadyTime time, std::chrono::nanoseconds retry)
      : time_(std::move(time)), retry_(retry) {}

  /// Name of the device, the prefix of its notices.
  [[nodiscard]] virtual std::string name() const = 0;
  [[nodiscard]] virtual bool is_open() const noexcept = 0;
  /// @return why the device cannot be used, as a sentence; empty: it is open
  [[nodiscard]] virtual std::string open() = 0;
  /// Follows every attempt to open the device. @param problem of the attempt; may be changed
  virtual void opened(std::chrono::nanoseconds now, std::string& problem) = 0;
  /// A step without a device.
  virtual void wait(std::chrono::microseconds longest) = 0;
  /// A step with a device.
  virtual void exchange(std::chrono::microseconds longest) = 0;

  /// The next attempt follows after `pause`.
  void retry_after(std::chrono::nanoseconds pause) { next_try_ = now() + pause; }
  [[nodiscard]] std::chrono::nanoseconds now() const { return time_(); }
  [[nodiscard]] const SteadyTime& time() const noexcept { return time_; }
  void tell(const std::string& sentence) {
    const std::lock_guard lock(mutex_);
    notices_.push_back(name() + ": " + sentence);
  }
  /// A problem that persists is reported once.
  void tell_problem(const std::string& problem) {
    if (problem == problem_) return;
    tell(problem);
    problem_ = problem;
  }
  void clear_problem() { problem_.clear(); }
  /// [ms], rounded up to tenths.
  [[nodiscard]] static std::string in_tenths(std::chrono::nanoseconds time) {
    const auto tenths = (time + std::chrono::microseconds(99)) / std::chrono::microseconds(100);
    return std::to_string(tenths / 10) + "." + std::to_string(tenths % 10) + " ms";
  }
  /// Suffix of the notice of a loss.
  static constexpr const char* kIsTakenUpAgain = "; it reconnects automatically";

 private:
  SteadyTime time_;
  std::chrono::nanoseconds retry_;
  std::chrono::nanoseconds next_try_{0};
  std::string problem_;  // last reported problem
  std::mutex mutex_;
  std::vector<std::string> notices_;
};

}  // namespace reckon::haptics
