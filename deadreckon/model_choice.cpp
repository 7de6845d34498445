// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "deadreckon/model_choice.hpp"

#include "deadreckon/drm.hpp"
#include "deadreckon/rotation.hpp"

namespace reckon::deadreckon {
namespace {

bool is_off(const MotionSample& truth, const Pose& seen, const Thresholds& thresholds,
            const SendRule& rule) {
  const PoseError error{truth.position - seen.position, truth.velocity};
  return !(rule.share(error, thresholds) <= 1) ||
         !(angle_between(truth.orientation, seen.orientation) <= thresholds.angle);
}

}  // namespace

void ModelChoice::note(const MotionSample& truth, const Thresholds& thresholds,
                       const SendRule& rule) noexcept {
  if (!is_finite(truth)) return;
  bool chosen_sends = false;
  for (std::size_t i = 0; i < rivals_.size(); ++i) {
    Rival& rival = rivals_[i];
    const Pose seen = extrapolate(rival.sent, truth.time - rival.time);
    if (started_ && !is_off(truth, seen, thresholds, rule)) continue;
    rival.sent = kinematic_state(truth, kChosenModels[i]);
    rival.time = truth.time;
    if (started_) rival.updates += 1;
    chosen_sends = chosen_sends || i == chosen_;
  }
  started_ = true;

  for (std::size_t i = 0; i < rivals_.size(); ++i) {
    if (rivals_[i].updates < settings_.better_by * rivals_[chosen_].updates) chosen_ = i;
  }
  if (!chosen_sends) return;
  for (Rival& rival : rivals_) rival.updates *= settings_.memory;
}

}  // namespace reckon::deadreckon
