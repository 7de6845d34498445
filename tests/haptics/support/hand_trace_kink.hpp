// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Whether a recorded hand moves at its stated velocity.
#pragma once

#include <Eigen/Core>
#include <algorithm>

#include "reckon/haptics/devices/hand_trace.hpp"

namespace reckon::test {

/// Greatest difference between the stated velocity and the slope of the stated position
/// [m/s], up to a time [s].
inline double kink(const haptics::HandTrace& trace, double until) {
  double worst = 0;
  const double h = 1e-5;
  for (double t = h; t < until; t += 1e-3) {
    const Eigen::Vector3d slope = (trace.at(t + h).position - trace.at(t - h).position) / (2 * h);
    worst = std::max(worst, (slope - trace.at(t).velocity).norm());
  }
  return worst;
}

}  // namespace reckon::test
