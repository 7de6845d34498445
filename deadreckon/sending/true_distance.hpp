// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The default rule: the prediction may be off by the threshold in any direction, a sphere.
#pragma once

#include "reckon/deadreckon/sending/pose_error.hpp"

namespace reckon::deadreckon {

[[nodiscard]] inline double true_distance(const PoseError& error,
                                          const Thresholds& thresholds) noexcept {
  return error.position.norm() / thresholds.position;
}

}  // namespace reckon::deadreckon
