// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/datagrams/time_range.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <string_view>

#include "reckon/tools/command_line/console.hpp"
#include "reckon/tools/command_line/duration_text.hpp"

namespace reckon::tools {
namespace {

using std::chrono::nanoseconds;

/// Takes a number of digits from the front of `rest`, in a range.
std::optional<int> digits(std::string_view& rest, std::size_t count, int least, int most) {
  int value = 0;
  if (rest.size() < count || rest.find_first_not_of("0123456789") < count) return std::nullopt;
  const auto read = std::from_chars(rest.data(), rest.data() + count, value);
  if (read.ec != std::errc{} || value < least || value > most) return std::nullopt;
  rest.remove_prefix(count);
  return value;
}

bool take(std::string_view& rest, char letter) {
  if (!rest.starts_with(letter)) return false;
  rest.remove_prefix(1);
  return true;
}

/// Takes ".25" as a fraction of a second.
std::optional<nanoseconds> fraction(std::string_view& rest) {
  const std::size_t count = std::min(rest.find_first_not_of("0123456789"), rest.size());
  if (count == 0) return std::nullopt;
  std::int64_t value = 0;
  for (std::size_t i = 0; i < 9; ++i) value = value * 10 + (i < count ? rest[i] - '0' : 0);
  rest.remove_prefix(count);
  return nanoseconds(value);
}

/// Takes "14:03", "14:03:20" or "14:03:20.5".
std::optional<nanoseconds> time_of_day(std::string_view& rest) {
  const auto hour = digits(rest, 2, 0, 23);
  if (!hour.has_value() || !take(rest, ':')) return std::nullopt;
  const auto minute = digits(rest, 2, 0, 59);
  if (!minute.has_value()) return std::nullopt;
  nanoseconds time = std::chrono::hours(*hour) + std::chrono::minutes(*minute);
  if (!take(rest, ':')) return time;
  const auto second = digits(rest, 2, 0, 59);
  if (!second.has_value()) return std::nullopt;
  time += std::chrono::seconds(*second);
  if (!take(rest, '.')) return time;
  const auto part = fraction(rest);
  if (!part.has_value()) return std::nullopt;
  return time + *part;
}

/// Takes "2026-11-26".
std::optional<nanoseconds> date(std::string_view& rest) {
  using namespace std::chrono;
  const auto year_ = digits(rest, 4, 1970, 2200);
  if (!year_.has_value() || !take(rest, '-')) return std::nullopt;
  const auto month_ = digits(rest, 2, 1, 12);
  if (!month_.has_value() || !take(rest, '-')) return std::nullopt;
  const auto day_ = digits(rest, 2, 1, 31);
  if (!day_.has_value()) return std::nullopt;
  const year_month_day when{year(*year_), month(static_cast<unsigned>(*month_)),
                            day(static_cast<unsigned>(*day_))};
  if (!when.ok()) return std::nullopt;
  return sys_days(when).time_since_epoch();
}

/// "2026-11-26", "2026-11-26T14:03:20Z", "2026-11-26 14:03".
std::optional<nanoseconds> date_and_time(std::string_view text) {
  const auto day = date(text);
  if (!day.has_value() || text.empty()) return day;
  if (!take(text, 'T') && !take(text, ' ')) return std::nullopt;
  const auto time = time_of_day(text);
  (void)take(text, 'Z');
  if (!time.has_value() || !text.empty()) return std::nullopt;
  return *day + *time;
}

std::optional<nanoseconds> seconds_in(const std::string& text) {
  double seconds = 0;
  const char* end = text.data() + text.size();
  const auto read = std::from_chars(text.data(), end, seconds);
  if (read.ec != std::errc{} || read.ptr != end) return parse_duration(text);
  return parse_duration(text + "s");
}

}  // namespace

RecordingInstant::RecordingInstant(const std::string& flag, const std::string& text)
    : flag_(flag), text_(text) {
  std::string_view rest = text;
  if (const auto since_start = seconds_in(text)) {
    since_ = *since_start;
  } else if (const auto epoch = date_and_time(text)) {
    origin_ = Origin::epoch;
    since_ = *epoch;
  } else if (const auto time = time_of_day(rest);
             time.has_value() && (rest.empty() || rest == "Z")) {
    origin_ = Origin::midnight;
    since_ = *time;
  } else {
    throw UsageError(fmt::format(
        "{} {}: write the time since the first datagram (90s, 1.5min), a time of day in UTC "
        "(14:03:20) or a date with it (2026-11-26T14:03:20Z)",
        flag, text));
  }
}

nanoseconds RecordingInstant::in_recording(nanoseconds start) const {
  if (origin_ == Origin::start) return start + std::min(since_, nanoseconds::max() - start);
  if (start == nanoseconds::zero())
    throw UsageError(fmt::format(
        "{} {}: no time of day is known of this source; give the time since its first datagram",
        flag_, text_));
  if (origin_ == Origin::epoch) return since_;
  const nanoseconds earliest = start - std::chrono::hours(1);
  nanoseconds instant = std::chrono::floor<std::chrono::days>(earliest) + since_;
  if (instant < earliest) instant += std::chrono::days(1);
  return instant;
}

TimeRange::TimeRange(const std::string& from, const std::string& to) {
  if (!from.empty()) from_.emplace("--from", from);
  if (!to.empty()) to_.emplace("--to", to);
}

void TimeRange::begin_at(nanoseconds start) {
  if (from_.has_value()) begin_ = from_->in_recording(start);
  if (to_.has_value()) end_ = to_->in_recording(start);
  if (end_.has_value() && *end_ <= begin_)
    throw UsageError("the range is empty: --to is not later than --from");
}

}  // namespace reckon::tools
