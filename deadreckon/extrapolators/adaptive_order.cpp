// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/deadreckon/extrapolators/adaptive_order.hpp"

namespace reckon::deadreckon {

AdaptiveOrder::AdaptiveOrder(const AdaptiveSettings& settings) noexcept : settings_(settings) {
  clear();
}

void AdaptiveOrder::clear() noexcept {
  history_.clear();
  scores_.fill(0);
  chosen_ = 0;
  // Before anything is known: the highest one-step order that the updates allow.
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

}  // namespace reckon::deadreckon
