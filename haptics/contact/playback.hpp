// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A blow that comes late is played back: for as long as it lasts the remote hand is shown where its
// owner said that it was, a little ago. Extrapolation knows nothing of the touch that stops a hand,
// and would lead it as deep into ours as it flies within the delay. Servo thread, SI units.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>

#include "reckon/deadreckon/motion/drm.hpp"

namespace reckon::haptics {

/// Where a hand is so long after it said this. Updates come each 60 ms where hands touch: an
/// acceleration that is older than 70 ms, or 30 ms where it makes the hand faster, moves it on no
/// faster than it said that it was, and one that had turned it round has brought it to rest. It
/// would bring a hand back that has gone, its next update lost. @param age [s]
[[nodiscard]] deadreckon::Pose hand_pose(const deadreckon::KinematicState& state,
                                         double age) noexcept;

/// The last states of one remote hand, and how far behind the present it is shown. O(kKept) where
/// it is asked for a pose, else O(1); no allocation.
class Playback {
 public:
  /// Updates that are kept: those of a quarter of a second at 125 /s.
  static constexpr std::size_t kKept = 32;

  /// A state that came, of this time. One before the last begins a new story.
  void hear(const deadreckon::KinematicState& state, std::chrono::nanoseconds time) noexcept;

  /// Whether what comes so fast would by extrapolation be deep in our hand before it is known to
  /// have touched it. @param closing [m/s]  @param age [s], of updates on arrival
  [[nodiscard]] static bool is_blow(double closing, double age) noexcept;
  /// A blow comes: so far behind that states are there before they are shown; where updates are
  /// young a follower shows it well enough. @param age [s]
  void begin(double age) noexcept;
  /// Comes so much nearer to the present [s].
  void catch_up(double by) noexcept;

  /// [s], 0 where the present is extrapolated.
  [[nodiscard]] double behind() const noexcept { return behind_; }

  /// Where it was `behind` [s] before `now`: by the newest state that is no younger. Needs a state.
  /// @param before [s], so much earlier by that state, for a velocity in which no state follows
  /// another
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
