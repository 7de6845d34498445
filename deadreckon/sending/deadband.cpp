// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/deadreckon/sending/deadband.hpp"

#include <algorithm>
#include <cmath>

namespace reckon::deadreckon {
namespace {

// Time constant [s] with which the packet counts of the models decay.
constexpr double kMemory = 1.0;
// The other model replaces the present one if it needs fewer packets by this factor, which prevents
// alternation.
constexpr double kBetterBy = 0.9;

std::size_t index_of(SignalModel model) { return static_cast<std::size_t>(model); }

}  // namespace

double deadband_width(const Deadband& deadband, const Eigen::Vector3d& value) noexcept {
  return std::max(deadband.floor, deadband.weber * value.norm());
}

std::string_view name(SignalModel model) noexcept {
  return model == SignalModel::hold ? "hold" : "line";
}

Eigen::Vector3d predict(const SignalUpdate& update, double time) noexcept {
  const double elapsed = time - update.time;
  if (!(elapsed > 0)) return update.value;
  return update.value + std::min(elapsed, kLongestLine) * update.rate;
}

std::optional<SignalUpdate> DeadbandSender::sample(double time,
                                                   const Eigen::Vector3d& value) noexcept {
  if (!std::isfinite(time) || !value.allFinite()) return std::nullopt;
  if (samples_ > 0 && time <= times_[0]) return std::nullopt;
  const double since = samples_ > 0 ? time - times_[0] : 0;
  remember(time, value);
  if (chooses_) compare(since, value);
  if (has_sent_ && !outside(sent_, time, value)) return std::nullopt;
  sent_ = update_of(model_, time, value);
  has_sent_ = true;
  return sent_;
}

bool DeadbandSender::outside(const SignalUpdate& update, double time,
                             const Eigen::Vector3d& value) const noexcept {
  return !((predict(update, time) - value).norm() <= deadband_width(deadband_, value));
}

void DeadbandSender::remember(double time, const Eigen::Vector3d& value) noexcept {
  std::shift_right(times_.begin(), times_.end(), 1);
  std::shift_right(values_.begin(), values_.end(), 1);
  times_[0] = time;
  values_[0] = value;
  samples_ = std::min(samples_ + 1, kSlopeSamples);
}

// Least squares over the last samples: a difference of two would be mostly noise.
Eigen::Vector3d DeadbandSender::slope() const noexcept {
  if (samples_ < 3) return Eigen::Vector3d::Zero();
  double middle = 0;
  for (std::size_t i = 0; i < samples_; ++i) middle += times_[i];
  middle /= static_cast<double>(samples_);
  double square = 0;
  Eigen::Vector3d product = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < samples_; ++i) {
    square += (times_[i] - middle) * (times_[i] - middle);
    product += (times_[i] - middle) * values_[i];
  }
  const Eigen::Vector3d slope = product / square;
  return slope.allFinite() ? slope : Eigen::Vector3d::Zero();
}

SignalUpdate DeadbandSender::update_of(SignalModel model, double time,
                                       const Eigen::Vector3d& value) const noexcept {
  const bool line = model == SignalModel::line;
  return {time, value, line ? slope() : Eigen::Vector3d(0, 0, 0), model};
}

void DeadbandSender::compare(double since, const Eigen::Vector3d& value) noexcept {
  const double time = times_[0];
  const double forgotten = std::exp(-since / kMemory);
  for (const SignalModel model : {SignalModel::hold, SignalModel::line}) {
    Rival& rival = rivals_[index_of(model)];
    rival.packets *= forgotten;
    if (has_sent_ && !outside(rival.update, time, value)) continue;
    rival.update = update_of(model, time, value);
    rival.packets += 1;
  }
  const SignalModel other = model_ == SignalModel::hold ? SignalModel::line : SignalModel::hold;
  if (rivals_[index_of(other)].packets < kBetterBy * rivals_[index_of(model_)].packets)
    model_ = other;
}

}  // namespace reckon::deadreckon
