// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A part of a recording by its arrival times: --from and --to.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

namespace reckon::tools {

/// An instant as typed: time since the first datagram ("90", "90s", "1.5 min"), a time of day in
/// UTC ("14:03", "14:03:20.5"), or a date with or without it ("2026-11-26T14:03:20Z",
/// "2026-11-26").
class RecordingInstant {
 public:
  /// @param flag as in an error, "--from"
  /// @throws UsageError for any other text.
  RecordingInstant(const std::string& flag, const std::string& text);

  /// Time since 1970-01-01 UTC, in a recording that begins at `start`. A time of day means the
  /// first such time from one hour before the start on.
  /// @throws UsageError for a time of day or a date if the start is 0: no wall time is known
  [[nodiscard]] std::chrono::nanoseconds in_recording(std::chrono::nanoseconds start) const;

 private:
  enum class Origin : std::uint8_t { start, midnight, epoch };
  std::string flag_;
  std::string text_;
  Origin origin_ = Origin::start;
  std::chrono::nanoseconds since_{};
};

/// Range from the first instant up to, but not including, the second.
class TimeRange {
 public:
  /// An empty text sets no bound. @throws UsageError as RecordingInstant.
  TimeRange(const std::string& from, const std::string& to);

  /// Sets the time of the first datagram. @throws UsageError as in_recording(), and if the range
  /// ends before it begins.
  void begin_at(std::chrono::nanoseconds start);

  [[nodiscard]] bool has(std::chrono::nanoseconds time) const {
    return time >= begin_ && !is_past(time);
  }
  [[nodiscard]] bool is_past(std::chrono::nanoseconds time) const {
    return end_.has_value() && time >= *end_;
  }

 private:
  std::optional<RecordingInstant> from_;
  std::optional<RecordingInstant> to_;
  std::chrono::nanoseconds begin_ = std::chrono::nanoseconds::min();
  std::optional<std::chrono::nanoseconds> end_;
};

}  // namespace reckon::tools
