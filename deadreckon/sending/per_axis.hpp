// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The threshold on each axis by itself, a cube, as several other programs do it: up to 73 % more
// error towards its corners than the threshold says. Here for comparison.
#pragma once

#include "reckon/deadreckon/sending/pose_error.hpp"

namespace reckon::deadreckon {

[[nodiscard]] inline double per_axis(const PoseError& error,
                                     const Thresholds& thresholds) noexcept {
  return error.position.lpNorm<Eigen::Infinity>() / thresholds.position;
}

}  // namespace reckon::deadreckon
