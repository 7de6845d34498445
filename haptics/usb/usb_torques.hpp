// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What forces at the handle are to the joints that hold them. Pure functions, any thread.
#pragma once

#include <Eigen/Core>

#include "reckon/haptics/usb/usb_exchange.hpp"

namespace reckon::haptics {

/// Ways of the handle for a turn of its joints [m/rad], from that in the worst direction to that in
/// the best: the singular values. About 60 ns. @param jacobian dx / dtheta
///
/// Joints of a friction b [N m s/rad] each are a friction of b / lever^2 to the handle, of the
/// longest lever in the direction that has least.
[[nodiscard]] Eigen::Vector3d levers_of(const Eigen::Matrix3d& jacobian) noexcept;

/// Share of a force that its lever pays for, [0, 1]. @param torques that hold all of it [N m]
[[nodiscard]] double paid_share(const UsbForce& force, const Eigen::Vector3d& torques) noexcept;

/// Largest share of `wanted` with which no element is beyond its `most`, [0, 1]. @param most >= 0
[[nodiscard]] double share_within(const Eigen::Vector3d& wanted,
                                  const Eigen::Vector3d& most) noexcept;

}  // namespace reckon::haptics
