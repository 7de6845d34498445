// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The owner's choice of dead-reckoning model for each entity: the model that would recently have
// needed the fewest updates. Each Entity State names the model, according to the standard. Thesis
// 4.4: the order follows from the nature of the data.
#pragma once

#include <array>
#include <cstddef>

#include "reckon/deadreckon/motion/motion_history.hpp"
#include "reckon/deadreckon/sending/send_rules.hpp"

namespace reckon::deadreckon {

/// The candidate models, simple ones first: the first of two equally good ones is used. The others
/// are never better: static is FPW at rest, FVW is RVW without rotation, FPB and FVB are FPW and
/// FVW.
inline constexpr std::array<pdu::DeadReckoningAlgorithm, 5> kChosenModels{
    pdu::DeadReckoningAlgorithm::fpw, pdu::DeadReckoningAlgorithm::rpw,
    pdu::DeadReckoningAlgorithm::rvw, pdu::DeadReckoningAlgorithm::rpb,
    pdu::DeadReckoningAlgorithm::rvb};

struct ModelChoiceSettings {
  /// Share of the counts that stays after an update of the present choice, 0 to < 1. Default 0.95:
  /// some twenty updates decide. A higher value is steadier and follows a change of the motion more
  /// slowly.
  double memory = 0.95;
  /// The present choice stays until another's count is below its own by this factor, 0 to 1...
  double better_by = 0.8;
  /// ...and also by this number of updates, >= 0. Default 2, because one update more or less of the
  /// first few means little. A higher value is steadier, and costs that many updates at each true
  /// change.
  double margin = 2;
};

/// Runs all of kChosenModels in parallel, each from the updates that it would have sent. The count
/// therefore includes their delays and their traffic, because updates of all models have the same
/// size. A switch costs no update, because the next update names the model. No allocation; not
/// synchronised; some 0.3 us a call of note().
class ModelChoice {
 public:
  explicit ModelChoice(const ModelChoiceSettings& settings = {}) noexcept : settings_(settings) {}

  /// Takes the true motion of this tick; sample times must increase. Ignores a sample that is not
  /// finite.
  void note(const MotionSample& truth, const Thresholds& thresholds,
            const SendRule& rule = kDefaultSendRule) noexcept;

  /// The model to send the latest sample with; FPW before the first. The first sample selects the
  /// simplest model whose pose a second later is nearly the pose of RVB, which uses all rates. RPB
  /// replaces FPW if orientations count (a threshold below half a turn), so that the start of a
  /// turn is sent too. While the sample has no rotation, FPW is returned for RPB and RVW for RVB:
  /// the same prediction in reference axes.
  [[nodiscard]] pdu::DeadReckoningAlgorithm chosen() const noexcept;

 private:
  struct Rival {
    KinematicState sent;
    double time = 0;
    double updates = 0;  // decaying count
  };

  void start(const MotionSample& truth, const Thresholds& thresholds) noexcept;
  void decide() noexcept;
  [[nodiscard]] static bool is_due(const Rival& rival, const MotionSample& truth,
                                   const Thresholds& thresholds, const SendRule& rule) noexcept;

  ModelChoiceSettings settings_;
  std::array<Rival, kChosenModels.size()> rivals_;
  std::size_t chosen_ = 0;
  bool started_ = false;
  bool turns_ = false;  // the latest sample has a rotation
};

}  // namespace reckon::deadreckon
