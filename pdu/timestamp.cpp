// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/pdu/timestamp.hpp"

namespace reckon::pdu {
namespace {

using std::chrono::nanoseconds;

constexpr std::int64_t kHour = 3'600'000'000'000;  // ns
constexpr std::int64_t kUnits = kTimestampUnitsPerHour;

// 0 to kUnits - 1: a count of 2^31 - 1 becomes 0.
std::int64_t count_of(std::uint32_t timestamp) noexcept {
  return static_cast<std::int64_t>(timestamp >> 1) % kUnits;
}

// units x 3.6e12 / (2^31 - 1), rounded, within 64 bits: the quotient 1676 and its remainder.
nanoseconds duration_of(std::int64_t units) noexcept {
  constexpr std::int64_t quotient = kHour / kUnits;
  constexpr std::int64_t rest = kHour % kUnits;
  const std::int64_t scaled = units * rest;
  const std::int64_t half = scaled < 0 ? -kUnits / 2 : kUnits / 2;
  return nanoseconds(units * quotient + (scaled + half) / kUnits);
}

}  // namespace

std::uint32_t to_dis_timestamp(nanoseconds since_hour_or_utc, bool absolute) noexcept {
  std::int64_t past = since_hour_or_utc.count() % kHour;
  if (past < 0) past += kHour;

  const double units = static_cast<double>(past) * (static_cast<double>(kUnits) / 3.6e12);
  const auto nearest = static_cast<std::int64_t>(units + 0.5);  // 0 to kUnits
  const std::int64_t count = nearest == kUnits ? 0 : nearest;
  return (static_cast<std::uint32_t>(count) << 1) | (absolute ? 1U : 0U);
}

nanoseconds past_the_hour(std::uint32_t timestamp) noexcept {
  return duration_of(count_of(timestamp));
}

std::int32_t difference_units(std::uint32_t to, std::uint32_t from) noexcept {
  std::int64_t units = count_of(to) - count_of(from);
  if (units > kUnits / 2) units -= kUnits;
  if (units < -(kUnits / 2)) units += kUnits;
  return static_cast<std::int32_t>(units);
}

nanoseconds difference(std::uint32_t to, std::uint32_t from) noexcept {
  return duration_of(difference_units(to, from));
}

nanoseconds nearest_instant(std::uint32_t timestamp, nanoseconds reference) noexcept {
  std::int64_t hour = reference.count() / kHour;
  if (reference.count() % kHour < 0) --hour;

  nanoseconds instant = nanoseconds(hour * kHour) + past_the_hour(timestamp);
  if (instant - reference > nanoseconds(kHour / 2)) instant -= nanoseconds(kHour);
  if (reference - instant > nanoseconds(kHour / 2)) instant += nanoseconds(kHour);
  return instant;
}

}  // namespace reckon::pdu
