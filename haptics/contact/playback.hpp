// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A blow that comes late is played back: for as long as it lasts the remote hand is shown where its
// owner said that it was, a little ago. Extrapolation knows nothing of the touch that stops a hand,
// and would lead it as deep into ours as it flies within the delay. Servo thread, SI units.
#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>

#include "reckon/deadreckon/motion/drm.hpp"

namespace reckon::haptics {

/// The last states of one remote hand, and how far behind the present it is shown. O(kKept) where
/// it is asked for a pose, else O(1); no allocation.
class Playback {
 public:
  /// Updates that are kept: those of a quarter of a second at 125 /s.
  static constexpr std::size_t kKept = 32;
  /// With less delay [s] a follower shows blows as they are.
  static constexpr double kLate = 0.012;
  /// Farthest behind [s].
  static constexpr double kFarthest = 0.3;

  /// A state that came, of this time. One before the last begins a new story.
  void hear(const deadreckon::KinematicState& state, std::chrono::nanoseconds time) noexcept {
    if (time < heard_[newest_].time) count_ = 0;
    newest_ = (newest_ + 1) % kKept;
    count_ = std::min(count_ + 1, kKept);
    heard_[newest_] = {state, time};
  }

  /// A blow begins: so far behind that states are there before they are shown. @param age [s], of
  /// updates on arrival
  void begin(double age) noexcept {
    if (age > kLate) behind_ = std::max(behind_, std::min(kFarthest, kMargin * age + kJitter));
  }
  /// Comes so much nearer to the present [s].
  void catch_up(double by) noexcept { behind_ = std::max(0.0, behind_ - by); }

  /// [s], 0 where the present is extrapolated.
  [[nodiscard]] double behind() const noexcept { return behind_; }

  /// Where it was `behind` before `now`: by the newest state that is no younger. Needs a state.
  [[nodiscard]] deadreckon::Pose pose(std::chrono::nanoseconds now, double behind) const noexcept {
    const double at = 1e-9 * static_cast<double>(now.count()) - behind;
    std::size_t i = newest_;
    double age = at - seconds(heard_[i].time);
    for (std::size_t k = 1; age < 0 && k < count_; ++k) {
      i = (i + kKept - 1) % kKept;
      age = at - seconds(heard_[i].time);
    }
    return deadreckon::extrapolate(heard_[i].state, age);
  }

 private:
  static constexpr double kMargin = 1.3;    // of the age: jitter
  static constexpr double kJitter = 0.002;  // [s], and the cycle of a peer

  struct Heard {
    deadreckon::KinematicState state;
    std::chrono::nanoseconds time{0};
  };
  static double seconds(std::chrono::nanoseconds time) noexcept {
    return 1e-9 * static_cast<double>(time.count());
  }

  std::array<Heard, kKept> heard_{};
  std::size_t count_ = 0;
  std::size_t newest_ = 0;
  double behind_ = 0.0;
};

}  // namespace reckon::haptics
