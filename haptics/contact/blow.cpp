// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/contact/blow.hpp"

#include <cmath>

namespace reckon::haptics {
namespace {

constexpr double kHitSpeed = 0.15;       // [m/s], at first touch; a slower approach is a press
constexpr double kStrikeSpeed = 0.075;   // [m/s], of our hand
constexpr double kBlowTime = 0.5;        // [s], since the last such approach
constexpr double kCatchUp = 0.5;         // [s/s], for the playback delay while the hand is felt
constexpr double kStopped = 0.05;        // [kg], mass assumed until the owner reports the outcome
constexpr double kRelease = 0.003;       // [s], time for a surface to recede
constexpr double kNewsAge = 0.004;       // [s]; with a lower delay the struck hand asks in time
constexpr double kGiftAtOnce = 0.005;    // [J], with the first update
constexpr double kGiftPower = 0.1;       // [W], after it
constexpr double kGiftsOfABlow = 0.015;  // [J], for one blow

}  // namespace

void Blow::expect(double closing, double age) noexcept {
  if (!Playback::is_blow(closing, age)) return;
  left_ = kBlowTime;
  playback_.begin(age);
}

void Blow::see(double closing, double ours) noexcept {
  if (closing > kHitSpeed) left_ = kBlowTime;
  strikes_ = ours > kStrikeSpeed;
}

double Blow::move_on(double dt, bool felt) noexcept {
  const double behind = playback_.behind();
  if (is_on() || !(behind > 0)) return dt;
  playback_.catch_up(dt * (felt ? kCatchUp : 1.0));
  return dt + (behind - playback_.behind());
}

double Blow::deepest_guess(double depth, double closing, double k1) noexcept {
  return depth + closing * std::sqrt(kStopped / std::max(k1, 1.0));
}

double Blow::release(double dt) const noexcept {
  return is_on() ? std::min(1.0, dt / kRelease) : 0.0;
}

double Blow::gift(double age, double surplus, double dt) noexcept {
  if (!is_on() || age < kNewsAge) return 0.0;
  if (strikes_) gifts_ = kGiftsOfABlow;
  const double wanted = strikes_ ? kGiftAtOnce : kGiftPower * dt;
  strikes_ = false;
  const double given = std::min({wanted, gifts_, 0.5 * surplus});
  if (!(given > 0)) return 0.0;
  gifts_ -= given;
  return given;
}

}  // namespace reckon::haptics
