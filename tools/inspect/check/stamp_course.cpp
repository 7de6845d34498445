// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/inspect/check/stamp_course.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "reckon/pdu/seconds.hpp"
#include "reckon/pdu/timestamp.hpp"

namespace reckon::tools {
namespace {

using std::chrono::nanoseconds;

constexpr double kWindow = 2.0;  // longer than the jitter of arrivals [s]
// Rates between these may be a drifting clock; others count in another unit, or are replayed.
constexpr double kSlowest = 0.6;
constexpr double kFastest = 1.9;
constexpr double kCountsPerSecond = 0x1p32 / 3600.0;  // of the whole field, bit 0 included
constexpr double kDay = 86400;                        // [s]

/// Another unit that senders use in the field.
struct Unit {
  double counts;  ///< per second
  std::string_view name;
};
constexpr std::array kUnits{
    Unit{1, "seconds"}, Unit{1e3, "milliseconds"}, Unit{1e6, "microseconds"},
    Unit{kCountsPerSecond / 2, "units that are not shifted left by one bit"}};
constexpr double kUnitError = 0.01;  // of the rate, in addition to one count

/// The unit that matches `counts` in this time; null if there is none.
const Unit* unit_of(double counts, double passed) {
  const auto* found = std::ranges::find_if(kUnits, [&](const Unit& unit) {
    const double expected = unit.counts * passed;
    return std::abs(counts - expected) <= 1 + kUnitError * expected;
  });
  return found == kUnits.end() ? nullptr : found;
}

}  // namespace

std::optional<StampCourse::Finding> StampCourse::take(std::uint32_t stamp, nanoseconds arrival) {
  if (arrival == nanoseconds::zero()) return std::nullopt;
  const Stamp now{stamp, arrival};
  const bool set_back = arrival < last_.arrival - pdu::from_seconds(kWindow);
  if (!first_.has_value() || set_back) {
    *this = {};
    first_ = window_ = last_ = changed_ = now;
    return std::nullopt;
  }
  if (pdu::is_absolute(stamp) != pdu::is_absolute(last_.value) && turns_ < 2) ++turns_;
  if (stamp != last_.value) changed_ = now;
  last_ = now;
  if (told_error_ && std::abs(error().value_or(kTolerance + 1)) <= kTolerance) told_error_ = false;
  const double passed = pdu::to_seconds(arrival - window_.arrival);
  return passed < kWindow ? std::nullopt : end_window(passed);
}

std::optional<StampCourse::Finding> StampCourse::end_window(double passed) {
  const double counts = static_cast<std::int32_t>(last_.value - window_.value);
  const Course course = course_of(counts, passed);
  const Course before = std::exchange(course_, course);
  window_ = last_;
  turns_ = 0;
  if (course == Course::even) {
    told_course_ = false;
    if (told_error_) return std::nullopt;
    auto found = error_finding();
    told_error_ = found.has_value();
    return found;
  }
  if (course != before || std::exchange(told_course_, true)) return std::nullopt;
  return course == Course::still ? still_finding() : pace_finding(counts, passed);
}

StampCourse::Course StampCourse::course_of(double counts, double passed) const {
  if (changed_.arrival <= window_.arrival) return Course::still;
  const double pace = counts / passed / kCountsPerSecond;
  if (pace > kFastest) return Course::fast;
  if (pace < kSlowest || (pace < 1 && unit_of(counts, passed) != nullptr)) return Course::slow;
  return turns_ > 1 ? Course::turns : Course::even;
}

StampCourse::Finding StampCourse::still_finding() const {
  return {kStampStillRule,
          fmt::format("the timestamp stays {:#010x} while {:.3f} s pass", last_.value,
                      pdu::to_seconds(last_.arrival - changed_.arrival))};
}

StampCourse::Finding StampCourse::pace_finding(double counts, double passed) const {
  if (course_ == Course::turns)
    return {kStampPaceRule,
            "timestamps alternate between absolute and relative: the sender counts in bit 0"};
  std::string reason = fmt::format("timestamps advance {:.3g} s while {:.3g} s pass",
                                   counts / kCountsPerSecond, passed);
  const Unit* unit = unit_of(counts, passed);
  const double since_1970 = pdu::to_seconds(last_.arrival);
  if (std::abs(static_cast<double>(last_.value) - since_1970) < kDay)
    reason += ": they are seconds since 1970, so bit 0 (absolute) alternates";
  else if (unit != nullptr)
    reason += fmt::format(": they count {}?", unit->name);
  return {kStampPaceRule, std::move(reason)};
}

std::optional<double> StampCourse::error() const {
  const auto [stamp, arrival] = last_;
  if (pdu::is_absolute(stamp))
    return pdu::to_seconds(pdu::nearest_instant(stamp, arrival) - arrival);
  if (pdu::is_absolute(first_->value)) return std::nullopt;
  const nanoseconds stated = pdu::past_the_hour(stamp) - pdu::past_the_hour(first_->value);
  return std::remainder(pdu::to_seconds(stated) - pdu::to_seconds(arrival - first_->arrival),
                        3600.0);
}

std::optional<StampCourse::Finding> StampCourse::error_finding() const {
  const double off = error().value_or(0);
  if (std::abs(off) <= kTolerance) return std::nullopt;
  return Finding{kToleranceRule,
                 fmt::format("{} timestamp is {:.3f} s {} the arrival; {:g} s are allowed",
                             pdu::is_absolute(last_.value) ? "absolute" : "relative", std::abs(off),
                             off > 0 ? "ahead of" : "behind", kTolerance)};
}

std::optional<StampCourse::Finding> StampCourse::finish() const {
  if (!first_.has_value() || told_course_ || told_error_) return std::nullopt;
  auto found = error_finding();
  const bool stands = pdu::to_seconds(last_.arrival - changed_.arrival) > kTolerance;
  return found.has_value() && stands ? still_finding() : found;
}

}  // namespace reckon::tools
