// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/listener/update_cause.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "reckon/deadreckon/motion/drm.hpp"
#include "reckon/deadreckon/motion/rotation.hpp"
#include "reckon/pdu/timestamp.hpp"

namespace reckon::tools {
namespace {

using std::chrono::nanoseconds;

constexpr double kDuplicateWithin = 1.0;  // a copy on the network comes soon [s]
constexpr double kLateWithin = 5.0;       // what was overtaken comes soon [s]
constexpr std::uint8_t kLateInARow = 3;   // then the clock was set back
constexpr double kPace = 100;    // timestamps may run so much faster than arrivals (a replay)
constexpr double kSlowness = 4;  // or so much slower,
constexpr double kSlack = 0.25;  // and so much beside that, for delays [s]
constexpr double kNearHeartbeat = 0.85;  // of the period
constexpr double kOldHeartbeat = 5.0;    // of everything, before DIS 7 [s]
constexpr double kOldSpread = 0.6;       // [s]

// Noise of an extrapolation: float32 fields, timestamps of 1.7 us, arrivals of some ms.
constexpr double kLeastJump = 5e-5;         // [m]
constexpr double kLeastTurn = 1e-4;         // [rad]
constexpr double kTimestampNoise = 4e-6;    // [s]
constexpr double kArrivalNoise = 0.02;      // [s]
constexpr double kVelocityRounding = 2e-7;  // of a float32, of both updates

double seconds(nanoseconds time) { return std::chrono::duration<double>(time).count(); }

// Fields of which a change is an event: force, types, appearance, algorithm, marking, capabilities.
struct OctetRange {
  std::size_t begin, size;
};
constexpr std::array<OctetRange, 5> kEventOctets{{{18, 1}, {20, 16}, {84, 4}, {88, 1}, {128, 16}}};
constexpr std::size_t kBodyAt = 12;

bool same(const std::byte* a, const std::byte* b, OctetRange range) {
  return std::memcmp(a + range.begin, b + range.begin, range.size) == 0;
}

std::uint32_t timestamp_of(const FixedOctets& octets) {
  std::uint32_t value = 0;
  for (std::size_t i = 4; i < 8; ++i)
    value = value << 8 | std::to_integer<std::uint32_t>(octets[i]);
  return value;
}

bool is_near_heartbeat(double interval, double heartbeat) {
  return interval >= kNearHeartbeat * heartbeat || std::abs(interval - kOldHeartbeat) <= kOldSpread;
}

}  // namespace

std::string_view name(UpdateCause cause) noexcept {
  constexpr std::array<std::string_view, kUpdateCauses> kNames{
      "none", "first", "event", "threshold", "force", "heartbeat", "repeat"};
  return kNames[static_cast<std::size_t>(cause)];
}

bool is_event(const FixedOctets& before, const FixedOctets& now) noexcept {
  return std::any_of(kEventOctets.begin(), kEventOctets.end(),
                     [&](OctetRange range) { return !same(before.data(), now.data(), range); });
}

Interval interval(const LastUpdate& last, const FixedOctets& octets, nanoseconds arrival) noexcept {
  Interval between{seconds(arrival - last.arrival), kArrivalNoise};
  const std::uint32_t now = timestamp_of(octets);
  const std::uint32_t then = timestamp_of(last.octets);
  if (pdu::is_absolute(now) != pdu::is_absolute(then)) return between;
  const double told = seconds(pdu::difference(now, then));
  if (told == 0) {
    between.duplicate = between.seconds < kDuplicateWithin &&
                        same(last.octets.data(), octets.data(), {kBodyAt, kFixedOctets - kBodyAt});
    return between;
  }
  if (told < 0) {
    between.late = told > -kLateWithin && last.late_in_a_row < kLateInARow;
    between.set_back = !between.late;
    return between;
  }
  const double told_sum = last.told_time + told;
  const double arrival_sum = last.arrival_time + between.seconds;
  if (told_sum <= kPace * arrival_sum + 1 && arrival_sum <= kSlowness * told_sum + kSlack)
    return {told, kTimestampNoise};
  return between;
}

double told_seconds(const LastUpdate& last, const FixedOctets& octets) noexcept {
  const auto told = pdu::difference(timestamp_of(octets), timestamp_of(last.octets));
  return std::max(seconds(told), 0.0);
}

Innovation innovation(const deadreckon::KinematicState& before,
                      const deadreckon::KinematicState& now, const Interval& between) noexcept {
  const deadreckon::Pose told = deadreckon::extrapolate(before, between.seconds);
  Innovation found;
  found.jump = (now.position - told.position).norm();
  const bool turned = now.orientation.coeffs() != told.orientation.coeffs();
  if (turned) found.turn = deadreckon::angle_between(now.orientation, told.orientation);
  const double timing = between.noise + kVelocityRounding * between.seconds;
  found.above_noise =
      found.jump > kLeastJump + timing * std::max(told.velocity.norm(), now.velocity.norm()) ||
      found.turn > kLeastTurn + timing * told.angular_velocity.norm();
  return found;
}

UpdateCause cause_of(LastUpdate& last, const Innovation& found, double interval) noexcept {
  const bool due = is_near_heartbeat(interval, last.heartbeat);
  if (!found.above_noise) return due ? UpdateCause::heartbeat : UpdateCause::repeat;
  const double least = last.least_early_jump;
  if (due) {
    return least == 0 || found.jump < least ? UpdateCause::heartbeat : UpdateCause::threshold;
  }
  if (found.jump > 0) last.least_early_jump = least == 0 ? found.jump : std::min(least, found.jump);
  return UpdateCause::threshold;
}

}  // namespace reckon::tools
