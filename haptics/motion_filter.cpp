// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "haptics/motion_filter.hpp"

#include <Eigen/LU>
#include <cmath>

namespace reckon::haptics {

void MotionFilter::add(const Eigen::Vector3d& position, double time) noexcept {
  if (!position.allFinite() || !std::isfinite(time)) return;
  if (count_ > 0 && !(time > samples_[newest_].time)) return;
  newest_ = count_ == 0 ? 0 : (newest_ + 1) % kWindow;
  samples_[newest_] = {time, position};
  if (count_ < kWindow) ++count_;
  fit();
}

// Times are counted from the newest sample in units of the window's length, positions from its position:
// the normal equations stay well conditioned for any epoch.
void MotionFilter::fit() noexcept {
  velocity_.setZero();
  acceleration_.setZero();
  if (count_ < 3) return;
  const Sample& now = samples_[newest_];
  const std::size_t oldest = (newest_ + kWindow + 1 - count_) % kWindow;
  const double span = now.time - samples_[oldest].time;

  std::array<double, 5> moments{};
  Eigen::Matrix3d products = Eigen::Matrix3d::Zero();  // row: power of time, column: axis
  for (std::size_t i = 0; i < count_; ++i) {
    const Sample& sample = samples_[(oldest + i) % kWindow];
    const double t = (sample.time - now.time) / span;
    const Eigen::RowVector3d dp = (sample.position - now.position).transpose();
    double power = 1.0;
    for (std::size_t k = 0; k < 5; ++k, power *= t) {
      moments[k] += power;
      if (k < 3) products.row(static_cast<Eigen::Index>(k)) += power * dp;
    }
  }
  Eigen::Matrix3d normal;
  normal << moments[0], moments[1], moments[2], moments[1], moments[2], moments[3], moments[2],
      moments[3], moments[4];
  const Eigen::Matrix3d parabola = normal.inverse() * products;
  velocity_ = parabola.row(1).transpose() / span;
  acceleration_ = 2.0 * parabola.row(2).transpose() / (span * span);
}

}  // namespace reckon::haptics
