// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Splits the displacement between device and surface contact point among the objects that hold it.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "reckon/haptics/contact/object_obstacles.hpp"
#include "reckon/haptics/geometry/contact_walk.hpp"

namespace reckon::haptics {

/// Share of one object in the displacement from the device to the contact point, frame S.
struct ContactShare {
  std::uint32_t object = 0;
  Eigen::Vector3d push = Eigen::Vector3d::Zero();  ///< [m], sum of its planes' loads; not zero
  Eigen::Vector3d way = Eigen::Vector3d::Zero();   ///< [m], its share
  std::uint32_t triangle = 0;  ///< of a mesh: the triangle of its plane with the greatest load
  double load = 0.0;           ///< [m], of that plane
};

/// At most three planes carry load, so at most three objects.
using ContactShares = std::array<ContactShare, 3>;

/// Splits `way` [m] into shares at right angles to each other that add up to it. The shares lie
/// along the orthonormal directions nearest to the pushes. A component outside all of them
/// (friction) goes to the strongest push. Springs of one stiffness K on the shares then store K
/// |way|^2 / 2 together, and springs of different stiffness have no curvature above the greatest.
/// Two pushes within 1e-3 rad of each other count as one, which belongs to the stronger.
void share_way(const Eigen::Vector3d& way, std::span<ContactShare> shares) noexcept;

/// The objects whose planes carry load at the end of a walk. A walk that needs more moves than one
/// step has may end without load. Then the object of a plane that it met holds the point, or else
/// `other`. @return their number
std::size_t find_holders(const ContactWalk<ObjectObstacles>& walk, std::uint32_t other,
                         const Eigen::Vector3d& way, ContactShares& shares) noexcept;

}  // namespace reckon::haptics
