// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The receiver's choice of extrapolator for each entity: the one with the smallest error on its
// recent updates. Thesis 4.4, adaptive order.
#pragma once

#include <array>
#include <cstddef>

#include "reckon/deadreckon/extrapolators/extrapolators.hpp"

namespace reckon::deadreckon {

struct AdaptiveSettings {
  StepLimits limits;
  /// Share of an extrapolator's score that stays after an update, 0 to < 1. Default 0.5: a handful
  /// of updates decide. A higher value is steadier and follows a change of the motion more slowly.
  double memory = 0.5;
  /// The present choice stays until another score is below its own by this factor, 0 to 1, so that
  /// two equally good extrapolators do not alternate. Default 0.8.
  double better_by = 0.8;
  /// Rates in the sender's updates; extrapolators that need more are excluded.
  SentRates sent = SentRates::acceleration;
};

/// History and choice for one entity. No allocation; not synchronised. An update costs a few
/// hundred ns, a prediction the cost of its extrapolator.
class AdaptiveOrder {
 public:
  explicit AdaptiveOrder(const AdaptiveSettings& settings = {}) noexcept;

  /// Takes an update, and first scores the prediction of each extrapolator for its time. False if
  /// the history rejects it.
  bool add(const MotionSample& sample) noexcept;
  /// Takes an update. `sent` is the pose that the update before predicts for this time. Its error
  /// limits how far the choice may later depart from that prediction.
  bool add(const MotionSample& sample, const Pose& sent) noexcept;
  /// The pose `tau` seconds after the newest update, by the present choice, without a limit.
  [[nodiscard]] Pose predict(double tau) const noexcept;
  /// The same, limited to the neighbourhood of `sent`, the pose that the newest update predicts for
  /// this time. An owner that sends at a threshold crossing and is silent is within the threshold
  /// of `sent`. So the choice is followed as far as the error of that prediction at the last
  /// updates. It is abandoned gradually in a silence much longer than the recent intervals between
  /// updates. |pose - sent| <= stray(tau); the orientation follows the choice and returns in the
  /// same way.
  [[nodiscard]] Pose predict_near(const Pose& sent, double tau) const noexcept;
  /// Greatest distance of predict_near() from `sent` [m]: the recent error of the sent prediction,
  /// times the third power of time, like the error of a second order; 0 from kGivenUp intervals on.
  [[nodiscard]] double stray(double tau) const noexcept;

  [[nodiscard]] const Extrapolator& chosen() const noexcept { return kExtrapolators[chosen_]; }
  [[nodiscard]] const MotionHistory& history() const noexcept { return history_; }
  void clear() noexcept;

  /// Factor for errors that grow a little faster than the last ones.
  static constexpr double kSpare = 1.25;
  /// Silence, in intervals between updates, from which the choice is followed less: three updates
  /// in a row may be lost.
  static constexpr double kFollowed = 4.5;
  /// Silence from which the choice is not followed.
  static constexpr double kGivenUp = 6;

 private:
  void score(const MotionSample& sample) noexcept;
  void choose() noexcept;
  [[nodiscard]] bool takes_part(std::size_t i) const noexcept;
  [[nodiscard]] double silence(double tau) const noexcept;  // in intervals

  AdaptiveSettings settings_;
  MotionHistory history_;
  std::array<double, kExtrapolators.size()> scores_{};  // mean squared error, decaying [m^2]
  std::size_t chosen_ = 0;
  double told_error_ = 0;  // [m], largest recent error of the sent predictions
  double interval_ = 0;    // [s], largest recent interval between updates
};

}  // namespace reckon::deadreckon
