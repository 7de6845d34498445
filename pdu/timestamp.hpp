// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// DIS timestamps (IEEE 1278.1-2012 6.2.88): 31 bits of time past the hour, and one bit that marks
// an absolute clock (UTC) of the sender. One hour is 2^31 - 1 units, so that one unit is about 1.68
// us.
#pragma once

#include <chrono>
#include <cstdint>

namespace reckon::pdu {

/// Units in an hour; a count of 2^31 - 1 is the same time as 0.
inline constexpr std::uint32_t kTimestampUnitsPerHour = 0x7FFFFFFF;

/// The 32-bit field for a time: UTC since 1970 if `absolute`, else time since any origin of the
/// sender. Only the part past the hour is kept, rounded to the nearest unit.
[[nodiscard]] std::uint32_t to_dis_timestamp(std::chrono::nanoseconds since_hour_or_utc,
                                             bool absolute) noexcept;

/// Whether the sender's clock is UTC.
[[nodiscard]] constexpr bool is_absolute(std::uint32_t timestamp) noexcept {
  return (timestamp & 1U) != 0;
}

/// Time past the hour, 0 to 3600 s, within half a nanosecond.
[[nodiscard]] std::chrono::nanoseconds past_the_hour(std::uint32_t timestamp) noexcept;

/// Signed shortest difference around the hour in units, to - from; within +-(2^30 - 1). The low
/// bits are ignored.
[[nodiscard]] std::int32_t difference_units(std::uint32_t to, std::uint32_t from) noexcept;

/// The same in time: within +-1800 s, to half a nanosecond.
[[nodiscard]] std::chrono::nanoseconds difference(std::uint32_t to, std::uint32_t from) noexcept;

/// The time with this timestamp that is nearest to `reference`. For a reference in UTC and an
/// absolute timestamp this is the sender's UTC, correct while the clocks differ by less than half
/// an hour.
[[nodiscard]] std::chrono::nanoseconds nearest_instant(std::uint32_t timestamp,
                                                       std::chrono::nanoseconds reference) noexcept;

}  // namespace reckon::pdu
