// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/deadreckon/sending/model_choice.hpp"

#include "reckon/deadreckon/motion/drm.hpp"
#include "reckon/deadreckon/motion/rotation.hpp"

namespace reckon::deadreckon {
namespace {

bool is_off(const MotionSample& truth, const Pose& seen, const Thresholds& thresholds,
            const SendRule& rule) {
  const PoseError error{truth.position - seen.position, truth.velocity};
  return !(rule.share(error, thresholds) <= 1) ||
         !(angle_between(truth.orientation, seen.orientation) <= thresholds.angle);
}

// Which models are alike for a motion is told by their poses after so long [s]...
constexpr double kHorizon = 1.0;
// ...being within this share of the thresholds.
constexpr double kAlike = 0.1;

}  // namespace

void ModelChoice::start(const MotionSample& truth, const Thresholds& thresholds) noexcept {
  for (std::size_t i = 0; i < rivals_.size(); ++i)
    rivals_[i] = {kinematic_state(truth, kChosenModels[i]), truth.time, 0};
  const Pose whole = extrapolate(rivals_.back().sent, kHorizon);
  const auto is_alike = [&](const Rival& rival) {
    const Pose pose = extrapolate(rival.sent, kHorizon);
    return (pose.position - whole.position).norm() <= kAlike * thresholds.position &&
           angle_between(pose.orientation, whole.orientation) <= kAlike * thresholds.angle;
  };
  chosen_ = 0;
  while (chosen_ + 1 < rivals_.size() && !is_alike(rivals_[chosen_])) ++chosen_;
  started_ = true;
}

void ModelChoice::note(const MotionSample& truth, const Thresholds& thresholds,
                       const SendRule& rule) noexcept {
  if (!is_finite(truth)) return;
  if (!started_) return start(truth, thresholds);
  bool chosen_sends = false;
  for (std::size_t i = 0; i < rivals_.size(); ++i) {
    Rival& rival = rivals_[i];
    const Pose seen = extrapolate(rival.sent, truth.time - rival.time);
    if (!is_off(truth, seen, thresholds, rule)) continue;
    rival = {kinematic_state(truth, kChosenModels[i]), truth.time, rival.updates + 1};
    chosen_sends = chosen_sends || i == chosen_;
  }

  for (std::size_t i = 0; i < rivals_.size(); ++i) {
    if (rivals_[i].updates < settings_.better_by * rivals_[chosen_].updates) chosen_ = i;
  }
  if (!chosen_sends) return;
  for (Rival& rival : rivals_) rival.updates *= settings_.memory;
}

}  // namespace reckon::deadreckon
