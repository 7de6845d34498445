// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The receiver's choice of extrapolator, per entity: the one that would have predicted its recent
// updates best. Thesis 4.4, adaptive order.
#pragma once

#include <array>
#include <cstddef>

#include "reckon/deadreckon/extrapolators/extrapolators.hpp"

namespace reckon::deadreckon {

struct AdaptiveSettings {
  StepLimits limits;
  /// Share of an extrapolator's score that an update leaves, 0 to < 1. Default 0.5: a handful of
  /// updates decide. Higher is steadier and slower to follow a change of the motion.
  double memory = 0.5;
  /// The present choice is kept while another's score is not below its own by this factor, 0 to 1,
  /// so that two equally good ones do not alternate. Default 0.8.
  double better_by = 0.8;
  /// What the sender's updates hold; extrapolators that need more do not take part.
  SentRates sent = SentRates::acceleration;
};

/// History and choice for one entity. No allocation; not synchronised. An update costs a few
/// hundred ns, a prediction what its extrapolator costs.
class AdaptiveOrder {
 public:
  explicit AdaptiveOrder(const AdaptiveSettings& settings = {}) noexcept;

  /// Takes an update; what each extrapolator had predicted for its instant is scored first. False
  /// where the history refuses it.
  bool add(const MotionSample& sample) noexcept;
  /// Takes an update for which the update before had `sent` this pose: what prediction as sent was
  /// off by then bounds how far the choice may later stray from it.
  bool add(const MotionSample& sample, const Pose& sent) noexcept;
  /// The pose `tau` seconds after the newest update, by the present choice, wherever that leads.
  [[nodiscard]] Pose predict(double tau) const noexcept;
  /// The same, kept near `sent`, the pose that the newest update states for this instant. An owner
  /// that sends by a threshold and is silent says by that: I am where I said, but for the
  /// threshold. So the choice is followed as far as the last updates have shown prediction as sent
  /// to be off, and given up in the course of a silence much longer than theirs.
  /// |pose - sent| <= stray(tau); the orientation follows the choice, and comes back alike.
  [[nodiscard]] Pose predict_near(const Pose& sent, double tau) const noexcept;
  /// The most that predict_near() goes from what was sent [m]: what prediction as sent was off by,
  /// growing with the third power of time as the error of a second order does; 0 from kGivenUp
  /// intervals on.
  [[nodiscard]] double stray(double tau) const noexcept;

  [[nodiscard]] const Extrapolator& chosen() const noexcept { return kExtrapolators[chosen_]; }
  [[nodiscard]] const MotionHistory& history() const noexcept { return history_; }
  void clear() noexcept;

  /// Room for errors that grow a little faster than the last ones did.
  static constexpr double kSpare = 1.25;
  /// Silence, in intervals between updates: three updates in a row may be lost. From
  /// then on the choice is followed less,
  static constexpr double kFollowed = 4.5;
  /// and from here on not at all.
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
  double told_error_ = 0;  // [m], largest of late of the predictions as sent
  double interval_ = 0;    // [s], largest of late between updates
};

}  // namespace reckon::deadreckon
