// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Fast entities may be off by more: over a delay of d a viewer is off by |v| d anyway, so an error
// of that size is bought for nothing.
#pragma once

#include "reckon/deadreckon/sending/pose_error.hpp"

namespace reckon::deadreckon {

/// The threshold grows by Thresholds::speed_allowance seconds of the entity's true speed.
[[nodiscard]] inline double velocity_aware(const PoseError& error,
                                           const Thresholds& thresholds) noexcept {
  return error.position.norm() /
         (thresholds.position + thresholds.speed_allowance * error.true_velocity.norm());
}

}  // namespace reckon::deadreckon
