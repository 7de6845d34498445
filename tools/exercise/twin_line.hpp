// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Updates between the twins of two hands: sent by the scene's thresholds, over the simulated
// network.
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <optional>

#include "reckon/deadreckon/motion/kinematic_state.hpp"
#include "reckon/haptics/servo/ungated_twin.hpp"

namespace reckon::tools {

/// The motion of a twin in an update.
struct TwinUpdate {
  std::chrono::nanoseconds time{0};  ///< of the state
  deadreckon::KinematicState state;  ///< first order, frame S
};

/// Decides when a twin sends its motion: when the error of its last update exceeds the threshold,
/// and after kLongestSilence. One thread.
class TwinTeller {
 public:
  static constexpr std::chrono::milliseconds kLongestSilence{60};

  /// @param threshold [m] > 0, error of dead reckoning that causes an update
  explicit TwinTeller(double threshold) : threshold_(threshold) {}

  /// The update that is due at this motion; none: the prediction is accurate enough.
  [[nodiscard]] std::optional<TwinUpdate> tell(const haptics::HandMotion& motion);

 private:
  double threshold_;
  std::optional<TwinUpdate> last_;
};

/// Updates of one twin in transit to another. One thread.
class TwinLine {
 public:
  /// Capacity of updates in transit; beyond it the oldest is dropped.
  static constexpr std::size_t kMost = 1024;

  void send(const TwinUpdate& update, std::chrono::nanoseconds arrival);
  /// Takes the updates that arrive until `now`. @return whether last() changed
  bool receive(std::chrono::nanoseconds now);
  /// The newest state that has arrived; empty: none yet.
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
