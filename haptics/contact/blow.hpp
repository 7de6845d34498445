// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A blow between our hand and one remote hand. It begins with a quick approach, stated or observed,
// and ends half a second after the last one. Display, the depth of an extrapolation and unrequested
// gifts of energy differ from those in a press. Servo thread, SI units.
#pragma once

#include <algorithm>
#include <chrono>

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
  void expect(double closing, double age) noexcept;
  /// For hands apart: a blow begins if they approach quickly. @param closing [m/s], of both hands
  /// @param ours [m/s], the part of our hand
  void see(double closing, double ours) noexcept;
  /// Advances by a step of `dt` [s].
  void pass(double dt) noexcept { left_ = std::max(0.0, left_ - dt); }

  /// Advances the time at which the hand is shown. It runs at the normal rate, and after the blow
  /// faster until it reaches the present. @param felt the hand is touched: the time catches up
  /// slowly
  /// @return the advance [s]
  [[nodiscard]] double move_on(double dt, bool felt) noexcept;
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
  [[nodiscard]] static double deepest_guess(double depth, double closing, double k1) noexcept;

  /// Share of the surface's excess depth in our hand that is removed in dt [s]. In a blow the
  /// surface recedes as fast as updates state: one that a follower leaves in place strikes our hand
  /// harder than its owner does, and after the owner has left. 0 in a press, which keeps the calm
  /// follower, because ripples would cost the energy on which the press relies.
  [[nodiscard]] double release(double dt) const noexcept;

  /// Energy to give without a request [J]. A struck hand can ask only after the blow, so that part
  /// of its need comes with the updates. @param age [s], of updates  @param surplus [J], ours
  [[nodiscard]] double gift(double age, double surplus, double dt) noexcept;

 private:
  Playback playback_;
  double left_ = 0.0;     // [s]
  double gifts_ = 0.0;    // [J], still to give in this blow
  bool strikes_ = false;  // our hand strikes, and nothing has been given for it yet
};

}  // namespace reckon::haptics
