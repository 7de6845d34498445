// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Shapes with a closed form for where the surface contact point (SCP) settles: half space, ball and
// block. All in object axes, metres. Meshes are in surface_mesh.hpp.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <memory>
#include <variant>

#include "reckon/haptics/geometry/friction_cone.hpp"
#include "reckon/haptics/geometry/shape.hpp"

namespace reckon::haptics {

class SurfaceMesh;

/// Distance of a settled SCP from the true surface, relative to the object's size. Small enough not
/// to be felt (0.02 um on a 0.2 m object), a billion times the rounding of a double.
inline constexpr double kRelativeClearance = 1e-7;

/// Where an SCP is and what holds it there.
struct SettledPoint {
  Eigen::Vector3d scp = Eigen::Vector3d::Zero();     ///< [m]
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< unit, out of the solid; zero when free
  bool in_contact = false;
};

/// Solid where normal . x < 0.
class HalfSpace {
 public:
  /// @throws std::invalid_argument for a zero or non-finite normal.
  explicit HalfSpace(const PlaneShape& shape);
  [[nodiscard]] bool contains(const Eigen::Vector3d& p) const noexcept;
  /// Nearest point to p, which is inside, at which an SCP may rest.
  [[nodiscard]] Eigen::Vector3d nearest_outside(const Eigen::Vector3d& p) const noexcept;
  /// Moves the SCP from `scp` to where it settles for `device`; friction may be null.
  [[nodiscard]] SettledPoint settle(const Eigen::Vector3d& scp, const Eigen::Vector3d& device,
                                    FrictionCone* friction) const noexcept;
  [[nodiscard]] Eigen::AlignedBox3d bounds() const noexcept;

 private:
  Eigen::Vector3d normal_;
};

/// Solid where |x| < radius. An SCP pushed beyond the centre slides round to the other side.
class Ball {
 public:
  /// @throws std::invalid_argument unless radius is finite and > 0.
  explicit Ball(const SphereShape& shape);
  [[nodiscard]] bool contains(const Eigen::Vector3d& p) const noexcept;
  [[nodiscard]] Eigen::Vector3d nearest_outside(const Eigen::Vector3d& p) const noexcept;
  [[nodiscard]] SettledPoint settle(const Eigen::Vector3d& scp, const Eigen::Vector3d& device,
                                    FrictionCone* friction) const noexcept;
  [[nodiscard]] Eigen::AlignedBox3d bounds() const noexcept;

 private:
  [[nodiscard]] bool lands(const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                           Eigen::Vector3d& at) const noexcept;
  double radius_;
};

/// Solid where |x_i| < size_i / 2 for each axis.
class Block {
 public:
  /// @throws std::invalid_argument unless each edge is finite and > 0.
  explicit Block(const BoxShape& shape);
  [[nodiscard]] bool contains(const Eigen::Vector3d& p) const noexcept;
  [[nodiscard]] Eigen::Vector3d nearest_outside(const Eigen::Vector3d& p) const noexcept;
  [[nodiscard]] SettledPoint settle(const Eigen::Vector3d& scp, const Eigen::Vector3d& device,
                                    FrictionCone* friction) const noexcept;
  [[nodiscard]] Eigen::AlignedBox3d bounds() const noexcept;

 private:
  [[nodiscard]] int entry_axis(const Eigen::Vector3d& from,
                               const Eigen::Vector3d& step) const noexcept;
  Eigen::Vector3d half_;
  double clearance_;
};

/// What a contact is computed with.
using ContactShape = std::variant<HalfSpace, Ball, Block, std::shared_ptr<const SurfaceMesh>>;

}  // namespace reckon::haptics
