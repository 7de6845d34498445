// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Playback of a delayed blow. While the blow lasts, the remote hand is shown at a stated place of a
// short time ago. Extrapolation does not include the touch that stops a hand, and would move it
// into ours as deep as it travels within the delay. Servo thread, SI units.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>

#include "reckon/deadreckon/motion/drm.hpp"

namespace reckon::haptics {

/// Pose of a hand `age` [s] after its owner stated `state`. Touching hands send an update each 60
/// ms. An acceleration is valid for 70 ms, or for 30 ms if it raises the speed. After that the hand
/// moves on at the stated speed at most, and stops if the acceleration had reversed it. Otherwise
/// the loss of one update would bring back a hand that has left. @param age [s]
[[nodiscard]] deadreckon::Pose hand_pose(const deadreckon::KinematicState& state,
                                         double age) noexcept;

/// The last states of one remote hand, and the delay with which it is shown. A pose is O(kKept),
/// all else O(1); no allocation.
class Playback {
 public:
  /// Number of stored updates: a quarter of a second at 125 /s.
  static constexpr std::size_t kKept = 32;

  /// Stores a received state of this time. A time before the last one discards the older states.
  void receive(const deadreckon::KinematicState& state, std::chrono::nanoseconds time) noexcept;

  /// Whether extrapolation would move an approaching hand deep into ours before an update can show
  /// the touch.
  /// @param closing [m/s]  @param age [s], of updates on arrival
  [[nodiscard]] static bool is_blow(double closing, double age) noexcept;
  /// Begins the playback of a blow, with a delay at which states arrive before they are shown.
  /// Updates of a low age need no delay, because a follower shows them well enough. @param age [s]
  void begin(double age) noexcept;
  /// Reduces the delay by `by` [s].
  void catch_up(double by) noexcept;

  /// Delay [s]; 0 if the hand is extrapolated to the present.
  [[nodiscard]] double behind() const noexcept { return behind_; }

  /// Pose `behind` [s] before `now`, from the newest state that is not later. Needs a state.
  /// @param before [s], evaluates the same state at a time earlier by this, for a velocity that
  /// does not mix two states
  [[nodiscard]] deadreckon::Pose pose(std::chrono::nanoseconds now, double behind,
                                      double before = 0.0) const noexcept;

 private:
  struct Heard {
    deadreckon::KinematicState state;
    std::chrono::nanoseconds time{0};
  };
  [[nodiscard]] static deadreckon::Pose towards(const Heard& next, deadreckon::Pose pose,
                                                const Heard& last, double age) noexcept;

  std::array<Heard, kKept> heard_{};
  std::size_t count_ = 0;
  std::size_t newest_ = 0;
  double behind_ = 0.0;
};

}  // namespace reckon::haptics
