// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/listener/update_pace.hpp"

#include <algorithm>
#include <cstring>

#include "reckon/pdu/seconds.hpp"
#include "reckon/pdu/timestamp.hpp"

namespace reckon::tools {
namespace {

using pdu::to_seconds;

constexpr double kDuplicateWithin = 1.0;  // a network copy arrives within this time [s]
constexpr double kLateWithin = 5.0;       // an overtaken update arrives within this time [s]
constexpr std::uint8_t kLateInARow = 3;   // more in a row: the clock was set back
constexpr double kPace = 100;    // factor by which timestamps may be faster than arrivals (a
                                 // replay)
constexpr double kSlowness = 4;  // factor by which they may be slower,
constexpr double kSlack = 0.25;  // plus this, for delays [s]
constexpr double kTimestampNoise = 4e-6;  // units of 1.7 us [s]
constexpr double kArrivalNoise = 0.02;    // [s]
constexpr std::size_t kBodyAt = 12;

}  // namespace

Interval UpdatePace::interval(const FixedOctets& before, const FixedOctets& now,
                              double passed) const noexcept {
  Interval between{passed, kArrivalNoise};
  const std::uint32_t stamp = timestamp_of(now);
  const std::uint32_t last = timestamp_of(before);
  if (pdu::is_absolute(stamp) != pdu::is_absolute(last)) return between;
  const double stated = to_seconds(pdu::difference(stamp, last));
  if (stated == 0) {
    between.duplicate = passed < kDuplicateWithin &&
                        std::memcmp(&before[kBodyAt], &now[kBodyAt], kFixedOctets - kBodyAt) == 0;
    return between;
  }
  if (stated < 0) {
    between.late = stated > -kLateWithin && late_in_a_row_ < kLateInARow;
    between.set_back = !between.late;
    return between;
  }
  const double stated_sum = stated_time_ + stated;
  const double arrival_sum = arrival_time_ + passed;
  if (stated_sum <= kPace * arrival_sum + 1 && arrival_sum <= kSlowness * stated_sum + kSlack)
    return {stated, kTimestampNoise};
  return between;
}

void UpdatePace::advance(const FixedOctets& before, const FixedOctets& now,
                         double passed) noexcept {
  arrival_time_ += passed;
  stated_time_ +=
      std::max(to_seconds(pdu::difference(timestamp_of(now), timestamp_of(before))), 0.0);
  late_in_a_row_ = 0;
}

}  // namespace reckon::tools
