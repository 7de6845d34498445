// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// How the twin of one hand hears of the twin of another: updates by the scene's thresholds, over
// what the network does.
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <optional>

#include "reckon/deadreckon/motion/kinematic_state.hpp"
#include "reckon/haptics/servo/ungated_twin.hpp"

namespace reckon::tools {

/// The motion of a twin as an update states it.
struct TwinUpdate {
  std::chrono::nanoseconds time{0};  ///< of the state
  deadreckon::KinematicState state;  ///< of first order, frame S
};

/// Decides when a twin's motion is told: where its last update is too far off, and after
/// kLongestSilence. One thread.
class TwinTeller {
 public:
  static constexpr std::chrono::milliseconds kLongestSilence{60};

  /// @param threshold [m] > 0, at which the error of dead reckoning is told
  explicit TwinTeller(double threshold) : threshold_(threshold) {}

  /// The update that is due at this motion; none: others are near enough.
  [[nodiscard]] std::optional<TwinUpdate> tell(const haptics::HandMotion& motion);

 private:
  double threshold_;
  std::optional<TwinUpdate> last_;
};

/// Updates of one twin on their way to one other. One thread.
class TwinLine {
 public:
  /// On their way at once; beyond it the oldest is lost.
  static constexpr std::size_t kMost = 1024;

  void send(const TwinUpdate& update, std::chrono::nanoseconds arrival);
  /// What arrives until `now`. @return whether last() is another
  bool receive(std::chrono::nanoseconds now);
  /// The newest state that has arrived; none so far.
  [[nodiscard]] const std::optional<TwinUpdate>& last() const noexcept { return last_; }

 private:
  struct OnItsWay {
    std::chrono::nanoseconds arrival{0};
    TwinUpdate update;
  };
  std::deque<OnItsWay> under_way_;
  std::optional<TwinUpdate> last_;
};

}  // namespace reckon::tools
