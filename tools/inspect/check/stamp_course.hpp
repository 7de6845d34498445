// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Compares the timestamps of one entity with the arrivals of its updates. Three rules, each with
// its own remedy: stamps do not advance, count in another unit, or have a constant error.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace reckon::tools {

inline constexpr std::string_view kStampStillRule = "W-TIMESTAMP-STILL";
inline constexpr std::string_view kStampPaceRule = "W-TIMESTAMP-PACE";
inline constexpr std::string_view kToleranceRule = "W-TIMESTAMP-TOLERANCE";

/// The stamps of one entity in order of arrival; one thread, some 100 octets. Compares over windows
/// of at least 2 s of arrivals. A wrong rate is reported after two equal windows. An error (from
/// UTC if the stamp is absolute, else from the entity's first stamp) is reported after a window
/// with the right rate, because synchronised clocks do not help if the stamps count in another
/// unit. Each is reported once until it is right again.
class StampCourse {
 public:
  /// Greatest accepted error of a stamp [s].
  static constexpr double kTolerance = 5.0;

  struct Finding {
    std::string_view rule;
    std::string reason;  ///< a clause without full stop
  };

  /// Takes the next update. Finds nothing if the source has no time (`arrival` 0).
  [[nodiscard]] std::optional<Finding> take(std::uint32_t stamp, std::chrono::nanoseconds arrival);
  /// At the end of the source: an error that no complete window has decided.
  [[nodiscard]] std::optional<Finding> finish() const;

 private:
  struct Stamp {
    std::uint32_t value = 0;
    std::chrono::nanoseconds arrival{};
  };
  enum class Course : std::uint8_t {
    even,
    still,
    slow,
    fast,
    turns  ///< alternates between absolute and relative
  };

  [[nodiscard]] std::optional<Finding> end_window(double passed);
  [[nodiscard]] Course course_of(double counts, double passed) const;
  [[nodiscard]] Finding pace_finding(double counts, double passed) const;
  [[nodiscard]] Finding still_finding() const;
  /// Error of the last stamp [s]; no value if there is nothing to compare it with.
  [[nodiscard]] std::optional<double> error() const;
  [[nodiscard]] std::optional<Finding> error_finding() const;

  std::optional<Stamp> first_;
  Stamp window_;  // first stamp of the present window
  Stamp last_;
  Stamp changed_;                 // first stamp with the last value
  std::uint8_t turns_ = 0;        // changes between absolute and relative in the window
  Course course_ = Course::even;  // of the last complete window
  bool told_course_ = false;
  bool told_error_ = false;
};

}  // namespace reckon::tools
