// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Checks the invariants of docs/robustness.md for a device that is unplugged.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "reckon/haptics/exchange/servo_types.hpp"
#include "reckon/tests/fuzz/unplugs/trial.hpp"

namespace reckon::fuzz::unplugs {

/// The observable state of the device and its thread.
struct Sight {
  nanoseconds now{};
  bool runs = false;  ///< the thread reports that forces are shown
  bool motors_rest = true;
  std::uint64_t commands = 0;  ///< that the device has obeyed
};

class Watch {
 public:
  /// @param watchdog of the device itself  @param force_limit [N]
  Watch(nanoseconds watchdog, double force_limit)
      : watchdog_(watchdog), force_limit_(force_limit) {}

  /// The line breaks now.
  void broken(nanoseconds now);
  /// Later commands to the device use another line.
  void plugged() { ran_at_.reset(); }
  void see(const Sight& sight);
  /// @param asked [N], part of its shown force that the servo still requests
  /// @param books [J], from the device's own ledger, including debts and allowances
  void see(const haptics::ServoSnapshot& servo, double asked, double books, nanoseconds now);
  void hear(const std::string& sentence, nanoseconds now);
  /// Counts events; each may cause one notice.
  void happens(unsigned times) { events_ += times; }
  /// @param surplus resource of the host that the thread's loop holds beyond its line, as a
  ///     sentence
  void owns(const std::optional<std::string>& surplus, nanoseconds now) {
    if (surplus) fail(7, now, *surplus);
  }
  void fail(int invariant, nanoseconds now, std::string sentence);

  [[nodiscard]] const std::optional<Finding>& finding() const { return finding_; }

 private:
  nanoseconds watchdog_;
  double force_limit_;
  std::optional<Finding> finding_;
  std::optional<nanoseconds> broken_at_;  // until it is set up again
  bool was_down_ = false;                 // since then
  std::optional<nanoseconds> ran_at_;     // last time, on this plug
  bool runs_ = false;
  std::uint64_t steps_ = 0;  // of the servo since it runs
  std::uint64_t commands_ = 0;
  nanoseconds commanded_at_{};
  std::string heard_;  // the last one
  std::uint64_t sentences_ = 0, events_ = 0, events_before_ = 0;
};

/// Call it after each run: growth of the program's memory or open files, as a sentence.
[[nodiscard]] std::optional<std::string> growth();

}  // namespace reckon::fuzz::unplugs
