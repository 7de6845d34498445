// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The owner's choice of dead-reckoning model, per entity: the one that would have needed the fewest
// updates lately. Peers read it from each Entity State, as the standard has it. Thesis 4.4: the
// order follows from the nature of the data.
#pragma once

#include <array>
#include <cstddef>

#include "reckon/deadreckon/motion/motion_history.hpp"
#include "reckon/deadreckon/sending/send_rules.hpp"

namespace reckon::deadreckon {

/// The models that take part, simple ones first: of two that are equally good the first is kept.
/// The others are never better: static is FPW at rest, FVW is RVW without a turn, FPB and FVB are
/// FPW and FVW.
inline constexpr std::array<pdu::DeadReckoningAlgorithm, 5> kChosenModels{
    pdu::DeadReckoningAlgorithm::fpw, pdu::DeadReckoningAlgorithm::rpw,
    pdu::DeadReckoningAlgorithm::rvw, pdu::DeadReckoningAlgorithm::rpb,
    pdu::DeadReckoningAlgorithm::rvb};

struct ModelChoiceSettings {
  /// Share of the counts that an update of the present choice leaves, 0 to < 1. Default 0.95: some
  /// twenty updates decide. Higher is steadier and slower to follow a change of the motion.
  double memory = 0.95;
  /// The present choice is kept while another's count is not below its own by this factor, 0
  /// to 1...
  double better_by = 0.8;
  /// ...and by so many updates besides, >= 0. Default 2: one update more or less of the first few
  /// says nothing of the motion. Higher is steadier and costs as many updates at each true change.
  double margin = 2;
};

/// Runs all of kChosenModels beside each other, each from the updates it would have sent: their
/// lateness is in the count, and so is their price, as updates of all models have one size. A
/// switch is free: the model is named in an update that is due anyway. No allocation; not
/// synchronised; some 0.3 us a call of note().
class ModelChoice {
 public:
  explicit ModelChoice(const ModelChoiceSettings& settings = {}) noexcept : settings_(settings) {}

  /// Takes the true motion of this tick, sample times growing. A sample that is not finite is
  /// passed over.
  void note(const MotionSample& truth, const Thresholds& thresholds,
            const SendRule& rule = kDefaultSendRule) noexcept;

  /// The model to send the latest sample with; FPW before the first. The first sample decides for
  /// the simplest model whose pose a second later is that of RVB, which uses all that is sent.
  /// Where that is FPW it decides for RPB if orientations count (a threshold below half a turn), so
  /// that the first bend is sent too. While the sample tells no turn, FPW is named for RPB and RVW
  /// for RVB: the same prediction in reference axes.
  [[nodiscard]] pdu::DeadReckoningAlgorithm chosen() const noexcept;

 private:
  void start(const MotionSample& truth, const Thresholds& thresholds) noexcept;
  void decide() noexcept;

  struct Rival {
    KinematicState sent;
    double time = 0;
    double updates = 0;  // decaying
  };

  ModelChoiceSettings settings_;
  std::array<Rival, kChosenModels.size()> rivals_;
  std::size_t chosen_ = 0;
  bool started_ = false;
  bool turns_ = false;  // as the latest sample tells
};

}  // namespace reckon::deadreckon
