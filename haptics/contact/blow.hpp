// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A blow between our hand and one remote hand. It begins with a quick approach, stated or observed,
// and ends half a second after the last one. Display, the depth of an extrapolation and unrequested
// gifts of energy differ from those in a press. Servo thread, SI units.
#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>

#include "reckon/haptics/contact/playback.hpp"

namespace reckon::haptics {

/// Distinguishes blows from presses, plays back a distant hand and gives energy to the struck hand.
/// O(1), except for the pose of a playback.
class Blow {
 public:
  /// Whether a blow is on.
  [[nodiscard]] bool is_on() const noexcept { return left_ > 0; }

  /// Stores the state of the hand that its owner states for this time.
  void receive(const deadreckon::KinematicState& state, std::chrono::nanoseconds time) noexcept {
    playback_.receive(state, time);
  }
  /// Detects a blow from stated states, before extrapolation leads the hand into ours. @param
  /// closing [m/s], towards ours  @param age [s], of updates on arrival
  void expect(double closing, double age) noexcept {
    if (!Playback::is_blow(closing, age)) return;
    left_ = kBlowTime;
    playback_.begin(age);
  }
  /// For hands apart: a blow begins if they approach quickly. @param closing [m/s], of both hands
  /// @param ours [m/s], the part of our hand
  void see(double closing, double ours) noexcept {
    if (closing > kHitSpeed) left_ = kBlowTime;
    strikes_ = ours > kStrikeSpeed;
  }
  /// Advances by a step of `dt` [s].
  void pass(double dt) noexcept { left_ = std::max(0.0, left_ - dt); }

  /// Advances the time at which the hand is shown. It runs at the normal rate, and after the blow
  /// faster until it reaches the present. @param felt the hand is touched: the time catches up
  /// slowly
  /// @return the advance [s]
  [[nodiscard]] double move_on(double dt, bool felt) noexcept {
    const double behind = playback_.behind();
    if (is_on() || !(behind > 0)) return dt;
    playback_.catch_up(dt * (felt ? kCatchUp : 1.0));
    return dt + (behind - playback_.behind());
  }
  /// Delay of the playback [s]; 0 if the hand is extrapolated to the present.
  [[nodiscard]] double behind() const noexcept { return playback_.behind(); }
  /// Pose of the hand `before` [s] earlier, see Playback::pose().
  [[nodiscard]] deadreckon::Pose pose(std::chrono::nanoseconds now, double before) const noexcept {
    return playback_.pose(now, playback_.behind(), before);
  }

  /// Whether the outcome of the blow is still unknown. @param since [s], age of the owner's last
  /// state
  [[nodiscard]] bool is_guessed(double since) const noexcept {
    return is_on() && since > playback_.behind();
  }
  /// Greatest depth of a hand that was stated `depth` [m] deep and approaches at `closing` [m/s]:
  /// the depth at which a spring of k1 [N/m] stops a light hand.
  [[nodiscard]] static double deepest_guess(double depth, double closing, double k1) noexcept {
    return depth + closing * std::sqrt(kStopped / std::max(k1, 1.0));
  }

  /// Share of the surface's excess depth in our hand that is removed in dt [s]. In a blow the
  /// surface recedes as fast as updates state: one that a follower leaves in place strikes our hand
  /// harder than its owner does, and after the owner has left. 0 in a press, which keeps the calm
  /// follower, because ripples would cost the energy on which the press relies.
  [[nodiscard]] double release(double dt) const noexcept {
    return is_on() ? std::min(1.0, dt / kRelease) : 0.0;
  }

  /// Energy to give without a request [J]. A struck hand can ask only after the blow, so that part
  /// of its need comes with the updates. @param age [s], of updates  @param surplus [J], ours
  [[nodiscard]] double gift(double age, double surplus, double dt) noexcept {
    if (!is_on() || age < kNewsAge) return 0.0;
    if (strikes_) gifts_ = kGiftsOfABlow;
    const double wanted = strikes_ ? kGiftAtOnce : kGiftPower * dt;
    strikes_ = false;
    const double given = std::min({wanted, gifts_, 0.5 * surplus});
    if (!(given > 0)) return 0.0;
    gifts_ -= given;
    return given;
  }

 private:
  static constexpr double kHitSpeed = 0.15;  // [m/s], at first touch; a slower approach is a press
  static constexpr double kStrikeSpeed = 0.075;  // [m/s], of our hand
  static constexpr double kBlowTime = 0.5;       // [s], since the last such approach
  static constexpr double kCatchUp = 0.5;  // [s/s], for the playback delay while the hand is felt
  static constexpr double kStopped =
      0.05;  // [kg], mass assumed until the owner reports the outcome
  static constexpr double kRelease = 0.003;  // [s], time for a surface to recede
  static constexpr double kNewsAge = 0.004;  // [s]; with a lower delay the struck hand asks in time
  static constexpr double kGiftAtOnce = 0.005;    // [J], with the first update
  static constexpr double kGiftPower = 0.1;       // [W], after it
  static constexpr double kGiftsOfABlow = 0.015;  // [J], for one blow

  Playback playback_;
  double left_ = 0.0;     // [s]
  double gifts_ = 0.0;    // [J], still to give in this blow
  bool strikes_ = false;  // our hand strikes, and nothing has been given for it yet
};

}  // namespace reckon::haptics
