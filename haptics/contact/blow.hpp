// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A blow between our hand and one remote hand: from the news or the sight of a quick approach until
// half a second after the last one. What is shown, how deep a guess may lead and what is given
// unasked are others then than in a press. Servo thread, SI units.
#pragma once

#include <algorithm>
#include <chrono>

#include "reckon/haptics/contact/playback.hpp"

namespace reckon::haptics {

/// Tells blows from presses and has what goes on with one: the playback of a hand that comes from
/// far off, and the gifts to who is struck. O(1), but for the pose of what is played back.
class Blow {
 public:
  /// Whether there is one.
  [[nodiscard]] bool is_on() const noexcept { return left_ > 0; }

  /// Its owner says where the hand was at this time.
  void hear(const deadreckon::KinematicState& state, std::chrono::nanoseconds time) noexcept {
    playback_.hear(state, time);
  }
  /// By what its owner says, before extrapolation leads the hand into ours. @param closing [m/s],
  /// towards ours  @param age [s], of updates on arrival
  void expect(double closing, double age) noexcept;
  /// Hands that are apart: a blow begins where they close in quickly. @param closing [m/s], of both
  /// @param ours [m/s], of it by our hand
  void see(double closing, double ours) noexcept;
  /// A step of `dt` [s] goes by.
  void pass(double dt) noexcept { left_ = std::max(0.0, left_ - dt); }

  /// Moves on the time of which the hand is shown: with the present, and once the blow is over
  /// faster until it is the present. @param felt it is touched: slowly  @return by how much [s]
  [[nodiscard]] double move_on(double dt, bool felt) noexcept;
  /// [s], by which what is shown is behind the present; 0 where that is extrapolated.
  [[nodiscard]] double behind() const noexcept { return playback_.behind(); }
  /// Where the hand was so long ago, see Playback::pose().
  [[nodiscard]] deadreckon::Pose pose(std::chrono::nanoseconds now, double before) const noexcept {
    return playback_.pose(now, playback_.behind(), before);
  }

  /// Its owner has not said yet how it went on. @param since [s], it said something
  [[nodiscard]] bool is_guessed(double since) const noexcept {
    return is_on() && since > playback_.behind();
  }
  /// How deep a hand comes into ours that was stated to be `depth` [m] deep and closes in at
  /// `closing` [m/s]: as a light hand would that a spring of k1 [N/m] stops.
  [[nodiscard]] static double deepest_guess(double depth, double closing, double k1) noexcept;

  /// Share of what a surface stands too deep in our hand that it goes back in dt [s]: in a blow as
  /// fast as the news says. What a follower would leave standing strikes our hand harder than its
  /// owner does, and after that one has gone. 0 in a press: it keeps the calm follower, for it
  /// would lose in ripples the energy that it rests on.
  [[nodiscard]] double release(double dt) const noexcept;

  /// What to give unasked [J]: who is struck can ask only when the blow is over, so some of what it
  /// needs comes with the news. @param age [s], of updates  @param surplus [J], ours
  [[nodiscard]] double gift(double age, double surplus, double dt) noexcept;

 private:
  Playback playback_;
  double left_ = 0.0;     // [s]
  double gifts_ = 0.0;    // [J], still to give for it
  bool strikes_ = false;  // ours comes down on it, and has not given for that yet
};

}  // namespace reckon::haptics
