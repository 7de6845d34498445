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
  /// The pose `tau` seconds after the newest update, by the present choice.
  [[nodiscard]] Pose predict(double tau) const noexcept;

  [[nodiscard]] const Extrapolator& chosen() const noexcept { return kExtrapolators[chosen_]; }
  [[nodiscard]] const MotionHistory& history() const noexcept { return history_; }
  void clear() noexcept;

 private:
  void score(const MotionSample& sample) noexcept;
  void choose() noexcept;
  [[nodiscard]] bool takes_part(std::size_t i) const noexcept;

  AdaptiveSettings settings_;
  MotionHistory history_;
  std::array<double, kExtrapolators.size()> scores_{};  // mean squared error, decaying [m^2]
  std::size_t chosen_ = 0;
};

}  // namespace reckon::deadreckon
