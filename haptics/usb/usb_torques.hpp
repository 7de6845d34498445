// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Converts forces at the handle to joint torques and limits them. Pure functions, any thread.
#pragma once

#include <Eigen/Core>

#include "reckon/haptics/usb/usb_exchange.hpp"

namespace reckon::haptics {

/// Singular values of the Jacobian, ascending: motion of the handle per turn of its joints [m/rad].
/// About 60 ns. @param jacobian dx / dtheta
///
/// Joints with a viscous friction b [N m s/rad] each give the handle a damping of b / lever^2,
/// least in the direction of the longest lever.
[[nodiscard]] Eigen::Vector3d levers_of(const Eigen::Matrix3d& jacobian) noexcept;

/// Share of a force that its lever covers, [0, 1]. @param torques [N m] of the whole force
[[nodiscard]] double paid_share(const UsbForce& force, const Eigen::Vector3d& torques) noexcept;

/// Largest share of `wanted` with no element beyond its `most`, [0, 1]. @param most >= 0
[[nodiscard]] double share_within(const Eigen::Vector3d& wanted,
                                  const Eigen::Vector3d& most) noexcept;

}  // namespace reckon::haptics
