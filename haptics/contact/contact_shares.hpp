// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Several objects hold one surface contact point: which part of its way from the device is whose.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace reckon::haptics {

/// What one object has of the way from the device to the contact point, frame S.
struct ContactShare {
  std::uint32_t object = 0;
  Eigen::Vector3d push = Eigen::Vector3d::Zero();  ///< [m], sum of its planes' loads; not zero
  Eigen::Vector3d way = Eigen::Vector3d::Zero();   ///< [m], its share
  std::uint32_t triangle = 0;  ///< of a mesh: that of its plane with the greatest load
  double load = 0.0;           ///< [m], of that plane
};

/// At most three planes carry load, so at most three objects.
using ContactShares = std::array<ContactShare, 3>;

/// Splits `way` [m] into shares that are at right angles to each other and add up to it: along the
/// orthonormal directions nearest to the pushes, what is beside all of them (friction) to the
/// strongest push. Springs of one stiffness K on the shares are then together K |way|^2 / 2, and
/// springs of several have no curvature above the greatest. Two pushes within 1e-3 rad of each
/// other are one: the stronger's.
void share_way(const Eigen::Vector3d& way, std::span<ContactShare> shares) noexcept;

}  // namespace reckon::haptics
