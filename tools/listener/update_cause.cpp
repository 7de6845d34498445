// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/listener/update_cause.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "reckon/deadreckon/motion/drm.hpp"
#include "reckon/deadreckon/motion/rotation.hpp"

namespace reckon::tools {
namespace {

constexpr double kNearHeartbeat = 0.85;  // share of the period
constexpr double kOldHeartbeat = 5.0;    // of all kinds, before DIS 7 [s]
constexpr double kOldSpread = 0.6;       // [s]

// Noise of an extrapolation by float32 fields; the interval adds the noise of its time.
constexpr double kLeastJump = 5e-5;         // [m]
constexpr double kTurnTolerance = 1e-4;     // [rad]
constexpr double kVelocityRounding = 2e-7;  // of a float32, of both updates

// Fields whose change is an event: force ID, types, appearance, algorithm, marking, capabilities.
struct OctetRange {
  std::size_t begin, size;
};
constexpr std::array<OctetRange, 5> kEventOctets{{{18, 1}, {20, 16}, {84, 4}, {88, 1}, {128, 16}}};

bool same(const std::byte* a, const std::byte* b, OctetRange range) {
  return std::memcmp(a + range.begin, b + range.begin, range.size) == 0;
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

Innovation innovation(const deadreckon::KinematicState& before,
                      const deadreckon::KinematicState& now, const Interval& between) noexcept {
  const deadreckon::Pose predicted = deadreckon::extrapolate(before, between.seconds);
  Innovation found;
  found.jump = (now.position - predicted.position).norm();
  const bool turned = now.orientation.coeffs() != predicted.orientation.coeffs();
  if (turned) found.turn = deadreckon::angle_between(now.orientation, predicted.orientation);
  const double timing = between.noise + kVelocityRounding * between.seconds;
  found.above_noise =
      found.jump > kLeastJump + timing * std::max(predicted.velocity.norm(), now.velocity.norm()) ||
      found.turn > kTurnTolerance + timing * predicted.angular_velocity.norm();
  return found;
}

UpdateCause cause_of(const Innovation& found, double interval, double heartbeat,
                     double& least_early_jump) noexcept {
  const bool due = is_near_heartbeat(interval, heartbeat);
  if (!found.above_noise) return due ? UpdateCause::heartbeat : UpdateCause::repeat;
  double& least = least_early_jump;
  if (due) {
    return least == 0 || found.jump < least ? UpdateCause::heartbeat : UpdateCause::threshold;
  }
  if (found.jump > 0) least = least == 0 ? found.jump : std::min(least, found.jump);
  return UpdateCause::threshold;
}

}  // namespace reckon::tools
