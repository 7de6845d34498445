// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/deadreckon/sending/model_choice.hpp"

#include <numbers>

#include "reckon/deadreckon/motion/acceleration_trust.hpp"
#include "reckon/deadreckon/motion/drm.hpp"
#include "reckon/deadreckon/motion/rotation.hpp"

namespace reckon::deadreckon {
namespace {

using Model = pdu::DeadReckoningAlgorithm;

bool is_off(const MotionSample& truth, const Pose& seen, const Thresholds& thresholds,
            const SendRule& rule) {
  const PoseError error{truth.position - seen.position, truth.velocity};
  return !(rule.share(error, thresholds) <= 1) ||
         !(angle_between(truth.orientation, seen.orientation) <= thresholds.angle);
}

// Two models are alike for a motion if their poses after this time [s]...
constexpr double kHorizon = 1.0;
// ...differ by at most this share of the thresholds.
constexpr double kAlike = 0.1;

// A rotation of no more than that share after this time [s], longer than most update intervals,
// counts as none.
constexpr double kLongUpdate = 10.0;

bool tells_turn(const MotionSample& truth, const Thresholds& thresholds) {
  const double angle = truth.angular_velocity.norm() * kLongUpdate;
  const double way = truth.velocity.norm() * kLongUpdate;
  return !(angle <= kAlike * thresholds.angle && angle * way / 2 <= kAlike * thresholds.position);
}

constexpr std::size_t place_of(pdu::DeadReckoningAlgorithm model) {
  std::size_t i = 0;
  while (kChosenModels[i] != model) ++i;
  return i;
}

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
  // A motion without a rotation may rotate later. If its orientation counts, RPB is used: it states
  // the angular velocity of the body, which the path alone does not give.
  constexpr std::size_t kStraight = place_of(Model::fpw), kArc = place_of(Model::rpb);
  if (chosen_ == kStraight && thresholds.angle < std::numbers::pi) chosen_ = kArc;
  started_ = true;
}

void ModelChoice::note(const MotionSample& truth, const Thresholds& thresholds,
                       const SendRule& rule) noexcept {
  if (!is_finite(truth)) return;
  turns_ = tells_turn(truth, thresholds);
  if (!started_) return start(truth, thresholds);
  bool chosen_sends = false;
  for (std::size_t i = 0; i < rivals_.size(); ++i) {
    Rival& rival = rivals_[i];
    if (!is_due(rival, truth, thresholds, rule)) continue;
    rival = {kinematic_state(truth, kChosenModels[i]), truth.time, rival.updates + 1};
    chosen_sends = chosen_sends || i == chosen_;
  }
  decide();
  if (!chosen_sends) return;
  for (Rival& rival : rivals_) rival.updates *= settings_.memory;
}

// As in UpdatePolicy::decide().
bool ModelChoice::is_due(const Rival& rival, const MotionSample& truth,
                         const Thresholds& thresholds, const SendRule& rule) noexcept {
  const double age = truth.time - rival.time;
  if (is_off(truth, extrapolate(rival.sent, age), thresholds, rule)) return true;
  return is_beyond_trust(rival.sent, age) &&
         is_off(truth, extrapolate_trusted(rival.sent, age), thresholds, rule);
}

void ModelChoice::decide() noexcept {
  for (std::size_t i = 0; i < rivals_.size(); ++i) {
    const double least = settings_.better_by * rivals_[chosen_].updates - settings_.margin;
    if (rivals_[i].updates < least) chosen_ = i;
  }
}

Model ModelChoice::chosen() const noexcept {
  const Model model = kChosenModels[chosen_];
  if (turns_) return model;
  if (model == Model::rpb) return Model::fpw;
  return model == Model::rvb ? Model::rvw : model;
}

}  // namespace reckon::deadreckon
