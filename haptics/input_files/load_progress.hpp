// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Reports a file whose loading takes long. Set-up code; no thread of its own.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>

namespace reckon::haptics {

/// Reports the file that this thread loads: after 1 s, and then once a second while loading
/// continues. Readers check the clock between units of work. An object is active for its thread
/// while it exists; a second one made meanwhile reports nothing.
class LoadProgress {
 public:
  using Clock = std::function<std::chrono::nanoseconds()>;
  using Report = std::function<void(const std::filesystem::path&, std::chrono::seconds)>;

  /// @param clock monotonic  @param report gets the file and the time since its opening
  LoadProgress(Clock clock, Report report);
  ~LoadProgress();
  LoadProgress(const LoadProgress&) = delete;
  LoadProgress& operator=(const LoadProgress&) = delete;

  /// The loading of a file begins.
  static void begin(const std::filesystem::path& file);
  /// Between units of work of microseconds: each 64th call checks the clock.
  static void look();
  /// Between units of work of milliseconds: checks the clock.
  static void look_now();

 private:
  bool holds_ = false;
  Clock clock_;
  Report report_;
  std::filesystem::path file_;
  std::chrono::nanoseconds begin_{0};
  std::chrono::seconds reported_{0};
  std::uint32_t calls_ = 0;
};

}  // namespace reckon::haptics
