// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Reports a file whose loading takes long. Set-up code; no thread of its own.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>

namespace reckon::haptics {

/// Reports the file that this thread loads after 1 s, and then once a second, while it goes on.
/// Readers look at the clock between units of work. It is active for its thread while it exists;
/// one made while another is active reports nothing.
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
  /// Between units of work of microseconds: each 64th call looks at the clock.
  static void look();
  /// Between units of work of milliseconds: looks at the clock.
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
