// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Motions in closed form: input of extrapolators and reference for them.
#pragma once

#include <cmath>

#include "reckon/deadreckon/extrapolators/multi_step.hpp"

namespace reckon::deadreckon::test {

/// A circle of 10 m at 1 rad/s, as in the thesis.
inline MotionSample on_circle(double t) {
  const Eigen::Vector3d x(10 * std::cos(t), 10 * std::sin(t), 0);
  const Eigen::Vector3d v(-x.y(), x.x(), 0);
  return {t, x,  Eigen::Quaterniond(Eigen::AngleAxisd(t, Eigen::Vector3d::UnitZ())),
          v, -x, {0, 0, 1}};
}

/// Positions of any polynomial motion up to the third degree.
struct Polynomial {
  Eigen::Vector3d x, v, a;
  Eigen::Vector3d j = Eigen::Vector3d::Zero();
  [[nodiscard]] MotionSample at(double t) const {
    return {t,
            x + t * v + 0.5 * t * t * a + t * t * t / 6 * j,
            Eigen::Quaterniond::Identity(),
            v + t * a + 0.5 * t * t * j,
            a + t * j,
            {0, 0, 0}};
  }
};

}  // namespace reckon::deadreckon::test
