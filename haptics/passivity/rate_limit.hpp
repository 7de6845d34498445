// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// How far a force may go in one servo step: it may fall as it likes, grow and turn only so fast.
#pragma once

#include <Eigen/Core>

namespace reckon::haptics {

/// Whether `wanted` is no farther than `most` [N] from what `held` can fall to, which is any part
/// of it.
[[nodiscard]] bool within_reach(const Eigen::Vector3d& held, const Eigen::Vector3d& wanted,
                                double most) noexcept;

/// `wanted` where that is within reach, else the nearest force that is: `held` falls first, then
/// `most` is spent towards `wanted`. All [N], one frame, finite. @param most >= 0
[[nodiscard]] Eigen::Vector3d nearest_in_reach(const Eigen::Vector3d& held,
                                               const Eigen::Vector3d& wanted, double most) noexcept;

/// The largest part of `wanted`, in [0, 1], that is within reach.
[[nodiscard]] double part_in_reach(const Eigen::Vector3d& held, const Eigen::Vector3d& wanted,
                                   double most) noexcept;

}  // namespace reckon::haptics
