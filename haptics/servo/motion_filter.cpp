// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/servo/motion_filter.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace reckon::haptics {

void MotionFilter::add(const Eigen::Vector3d& position, double time) noexcept {
  if (!position.allFinite() || !std::isfinite(time)) return;
  if (count_ > 0 && !(time > samples_[newest_].time)) return;
  newest_ = count_ == 0 ? 0 : (newest_ + 1) % kWindow;
  samples_[newest_] = {time, position};
  if (count_ < kWindow) ++count_;
  velocity_.setZero();
  acceleration_.setZero();
  if (count_ < 3) return;
  Parabola parabola = fit(count_);
  acceleration_ = parabola.acceleration;
  for (std::size_t window = count_ / 2; window >= 8 && parabola.misfit > tolerance_; window /= 2) {
    parabola = fit(window);
  }
  velocity_ = parabola.velocity;
}

const MotionFilter::Sample& MotionFilter::back(std::size_t age) const noexcept {
  return samples_[(newest_ + kWindow - age) % kWindow];
}

// Times are counted from the newest sample in units of the window's length, positions from its
// position: the normal equations stay well conditioned for any epoch.
MotionFilter::Parabola MotionFilter::fit(std::size_t count) const noexcept {
  const Sample& now = back(0);
  const double span = now.time - back(count - 1).time;
  std::array<double, 5> moments{};
  Eigen::Matrix3d products = Eigen::Matrix3d::Zero();  // row: power of time, column: axis
  for (std::size_t i = 0; i < count; ++i) {
    const double t = (back(i).time - now.time) / span;
    const Eigen::RowVector3d dp = (back(i).position - now.position).transpose();
    double power = 1.0;
    for (std::size_t k = 0; k < 5; ++k, power *= t) {
      moments[k] += power;
      if (k < 3) products.row(static_cast<Eigen::Index>(k)) += power * dp;
    }
  }
  Eigen::Matrix3d normal;
  normal << moments[0], moments[1], moments[2], moments[1], moments[2], moments[3], moments[2],
      moments[3], moments[4];
  const Eigen::Matrix3d c = normal.inverse() * products;

  Parabola out;
  out.velocity = c.row(1).transpose() / span;
  out.acceleration = 2.0 * c.row(2).transpose() / (span * span);
  for (std::size_t i = 0; i < count; ++i) {
    const double t = (back(i).time - now.time) / span;
    const Eigen::RowVector3d model = c.row(0) + t * (c.row(1) + t * c.row(2));
    const double miss = (back(i).position - now.position - model.transpose()).cwiseAbs().maxCoeff();
    out.misfit = std::max(out.misfit, miss);
  }
  return out;
}

}  // namespace reckon::haptics
