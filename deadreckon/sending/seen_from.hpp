// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What the nearest viewer can see: far away, an error below the eye's resolution is none.
#pragma once

#include <algorithm>

#include "reckon/deadreckon/sending/pose_error.hpp"

namespace reckon::deadreckon {

/// The threshold is Thresholds::visual_angle at Thresholds::viewer_distance, but not less than
/// Thresholds::position.
[[nodiscard]] inline double seen_from(const PoseError& error,
                                      const Thresholds& thresholds) noexcept {
  return error.position.norm() /
         std::max(thresholds.position, thresholds.visual_angle * thresholds.viewer_distance);
}

}  // namespace reckon::deadreckon
