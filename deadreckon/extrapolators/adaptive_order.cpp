// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/deadreckon/extrapolators/adaptive_order.hpp"

#include <algorithm>
#include <cmath>

#include "reckon/deadreckon/motion/drm.hpp"

namespace reckon::deadreckon {

AdaptiveOrder::AdaptiveOrder(const AdaptiveSettings& settings) noexcept : settings_(settings) {
  clear();
}

void AdaptiveOrder::clear() noexcept {
  history_.clear();
  scores_.fill(0);
  chosen_ = 0;
  told_error_ = interval_ = 0;
  // At the start: the highest one-step order that the updates allow.
  for (std::size_t i = 0; i < kExtrapolators.size(); ++i)
    if (takes_part(i) && kExtrapolators[i].updates == 1) chosen_ = i;
}

bool AdaptiveOrder::takes_part(std::size_t i) const noexcept {
  return kExtrapolators[i].needs <= settings_.sent;
}

bool AdaptiveOrder::add(const MotionSample& sample) noexcept {
  MotionHistory next = history_;
  if (!next.add(sample)) return false;
  if (history_.size() > 0 && sample.time > history_[0].time) score(sample);
  history_ = next;
  return true;
}

bool AdaptiveOrder::add(const MotionSample& sample, const Pose& sent) noexcept {
  const double before = history_.size() > 0 ? history_[0].time : sample.time;
  if (!add(sample)) return false;
  const double error = (sample.position - sent.position).norm();
  told_error_ = std::max(settings_.memory * told_error_, error);
  interval_ = std::max(settings_.memory * interval_, sample.time - before);
  return true;
}

void AdaptiveOrder::score(const MotionSample& sample) noexcept {
  const double tau = sample.time - history_[0].time;
  for (std::size_t i = 0; i < kExtrapolators.size(); ++i) {
    if (!takes_part(i)) continue;
    const Pose predicted = kExtrapolators[i].predict(history_, tau, settings_.limits);
    scores_[i] = settings_.memory * scores_[i] +
                 (1 - settings_.memory) * (predicted.position - sample.position).squaredNorm();
  }
  choose();
}

void AdaptiveOrder::choose() noexcept {
  std::size_t best = chosen_;
  for (std::size_t i = 0; i < kExtrapolators.size(); ++i)
    if (takes_part(i) && scores_[i] < scores_[best]) best = i;
  if (scores_[best] < settings_.better_by * scores_[chosen_]) chosen_ = best;
}

Pose AdaptiveOrder::predict(double tau) const noexcept {
  return kExtrapolators[chosen_].predict(history_, tau, settings_.limits);
}

double AdaptiveOrder::silence(double tau) const noexcept {
  return interval_ > 0 ? bounded_tau(tau) / interval_ : kGivenUp;
}

double AdaptiveOrder::stray(double tau) const noexcept {
  const double waited = std::max(silence(tau), 1.0);
  if (waited >= kGivenUp) return 0;
  return kSpare * told_error_ * waited * waited * waited;
}

Pose AdaptiveOrder::predict_near(const Pose& sent, double tau) const noexcept {
  const double most = stray(tau);
  if (!(most > 0)) return sent;
  Pose pose = predict(tau);
  const Eigen::Vector3d off = pose.position - sent.position;
  const double distance = off.norm();
  if (!std::isfinite(distance)) return sent;
  const double fade = std::min((kGivenUp - silence(tau)) / (kGivenUp - kFollowed), 1.0);
  const double scale = fade * (distance > most ? most / distance : 1.0);
  pose.position = sent.position + scale * off;
  pose.velocity = sent.velocity + scale * (pose.velocity - sent.velocity);
  if (fade < 1) {
    pose.orientation = sent.orientation.slerp(fade, pose.orientation);
    pose.angular_velocity =
        sent.angular_velocity + fade * (pose.angular_velocity - sent.angular_velocity);
  }
  return pose;
}

}  // namespace reckon::deadreckon
