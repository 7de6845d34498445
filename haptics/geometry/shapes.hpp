// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Shapes with a closed form for the settled surface contact point (SCP): half space, ball and
// block. All in object axes, metres. Meshes are in surface_mesh.hpp, signed functions in
// implicit_solid.hpp. A probe is a ball of some radius [m] >= 0, and the SCP is its centre.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <memory>
#include <variant>

#include "reckon/haptics/geometry/friction_cone.hpp"
#include "reckon/haptics/geometry/shape.hpp"
#include "reckon/haptics/geometry/sweep_hit.hpp"

namespace reckon::haptics {

class ImplicitSolid;
class SurfaceMesh;

/// An SCP and the normal of its contact.
struct SettledPoint {
  Eigen::Vector3d scp = Eigen::Vector3d::Zero();     ///< [m]
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< unit, out of the solid; zero if free
  bool in_contact = false;
};

/// Solid where normal . x < 0. It has no size: its clearance is 1 nm.
class HalfSpace {
 public:
  /// @throws std::invalid_argument for a zero or non-finite normal.
  explicit HalfSpace(const PlaneShape& shape);
  /// Whether a probe at p overlaps the solid.
  [[nodiscard]] const Eigen::Vector3d& normal() const noexcept { return normal_; }
  [[nodiscard]] bool contains(const Eigen::Vector3d& p, double radius = 0.0) const noexcept;
  /// A point near p at which an SCP may rest; p is inside. The nearest such point for a radius of
  /// 0.
  [[nodiscard]] Eigen::Vector3d nearest_outside(const Eigen::Vector3d& p,
                                                double radius = 0.0) const noexcept;
  /// Moves the SCP from `scp` to where it settles for `device`; friction may be null.
  [[nodiscard]] SettledPoint settle(const Eigen::Vector3d& scp, const Eigen::Vector3d& device,
                                    FrictionCone* friction, double radius = 0.0) const noexcept;
  /// First time at which a probe that moves from `origin` by `step` meets the surface. A probe that
  /// overlaps it already is stopped only if it would come closer. @return false for a free path.
  [[nodiscard]] bool sweep(const Eigen::Vector3d& origin, const Eigen::Vector3d& step,
                           double radius, SweepHit& hit) const noexcept;
  /// Lower bound of the distance of p from the solid [m]; below 0 inside some solids.
  [[nodiscard]] double distance_below(const Eigen::Vector3d& p) const noexcept;
  /// Greatest error of a settled SCP by rounding [m].
  [[nodiscard]] double clearance() const noexcept;
  /// The nearest point of the solid; p itself inside.
  [[nodiscard]] Eigen::Vector3d nearest_inside(const Eigen::Vector3d& p) const noexcept;
  [[nodiscard]] Eigen::AlignedBox3d bounds() const noexcept;

 private:
  Eigen::Vector3d normal_;
};

/// Solid where |x| < radius. An SCP pushed beyond the centre slides to the other side.
class Ball {
 public:
  /// @throws std::invalid_argument unless radius is finite and > 0.
  explicit Ball(const SphereShape& shape);
  [[nodiscard]] bool contains(const Eigen::Vector3d& p, double radius = 0.0) const noexcept;
  [[nodiscard]] Eigen::Vector3d nearest_outside(const Eigen::Vector3d& p,
                                                double radius = 0.0) const noexcept;
  [[nodiscard]] SettledPoint settle(const Eigen::Vector3d& scp, const Eigen::Vector3d& device,
                                    FrictionCone* friction, double radius = 0.0) const noexcept;
  [[nodiscard]] bool sweep(const Eigen::Vector3d& origin, const Eigen::Vector3d& step,
                           double radius, SweepHit& hit) const noexcept;
  [[nodiscard]] double distance_below(const Eigen::Vector3d& p) const noexcept;
  [[nodiscard]] double clearance() const noexcept;
  [[nodiscard]] Eigen::Vector3d nearest_inside(const Eigen::Vector3d& p) const noexcept;
  [[nodiscard]] Eigen::AlignedBox3d bounds() const noexcept;

 private:
  [[nodiscard]] bool lands(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double reach,
                           Eigen::Vector3d& at) const noexcept;
  double radius_;
};

/// Solid where |x_i| < size_i / 2 for each axis. Its closed form is for a radius of 0.
class Block {
 public:
  /// @throws std::invalid_argument unless each edge is finite and > 0.
  explicit Block(const BoxShape& shape);
  [[nodiscard]] bool contains(const Eigen::Vector3d& p, double radius = 0.0) const noexcept;
  [[nodiscard]] Eigen::Vector3d nearest_outside(const Eigen::Vector3d& p,
                                                double radius = 0.0) const noexcept;
  [[nodiscard]] SettledPoint settle(const Eigen::Vector3d& scp, const Eigen::Vector3d& device,
                                    FrictionCone* friction) const noexcept;
  [[nodiscard]] bool sweep(const Eigen::Vector3d& origin, const Eigen::Vector3d& step,
                           double radius, SweepHit& hit) const noexcept;
  [[nodiscard]] double distance_below(const Eigen::Vector3d& p) const noexcept;
  [[nodiscard]] double clearance() const noexcept;
  [[nodiscard]] Eigen::Vector3d nearest_inside(const Eigen::Vector3d& p) const noexcept;
  [[nodiscard]] Eigen::AlignedBox3d bounds() const noexcept;
  [[nodiscard]] double size() const noexcept { return 2.0 * half_.norm(); }

 private:
  [[nodiscard]] int entry_axis(const Eigen::Vector3d& from,
                               const Eigen::Vector3d& step) const noexcept;
  [[nodiscard]] std::array<Eigen::Vector3d, 4> face_corners(std::uint32_t face) const noexcept;
  Eigen::Vector3d half_;
  double clearance_;
};

/// A shape in the form that contacts use.
using ContactShape = std::variant<HalfSpace, Ball, Block, std::shared_ptr<const SurfaceMesh>,
                                  std::shared_ptr<const ImplicitSolid>>;

}  // namespace reckon::haptics
