// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The surface contact point (SCP, also god-object or proxy): the point that stays outside the solid
// and follows the device. Each update moves it until it settles, within the same servo tick.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "reckon/haptics/geometry/friction_cone.hpp"
#include "reckon/haptics/geometry/implicit_solid.hpp"
#include "reckon/haptics/geometry/near_triangles.hpp"
#include "reckon/haptics/geometry/shapes.hpp"
#include "reckon/haptics/geometry/surface_mesh.hpp"

namespace reckon::haptics {

/// First contact of a sweep with any shape, see SweepHit.
[[nodiscard]] bool sweep_shape(const ContactShape& shape, const Eigen::Vector3d& origin,
                               const Eigen::Vector3d& step, double radius, SweepHit& hit) noexcept;
/// Whether a probe at p overlaps a solid that sweeps can leave freely: any shape but a mesh, whose
/// faces are met from both sides.
[[nodiscard]] bool is_within(const ContactShape& shape, const Eigen::Vector3d& p,
                             double radius) noexcept;
/// Clearance of a shape [m].
[[nodiscard]] double clearance_of(const ContactShape& shape) noexcept;
/// Lower bound of the distance of p from the shape [m]; 0 or below inside it.
[[nodiscard]] double distance_below(const ContactShape& shape, const Eigen::Vector3d& p) noexcept;
/// The nearest point of a half space, ball or block [m]; p itself inside. None for other shapes.
[[nodiscard]] std::optional<Eigen::Vector3d> nearest_inside(const ContactShape& shape,
                                                            const Eigen::Vector3d& p) noexcept;

/// State of one probe, a ball around the device point, against one shape, object axes. The SCP is
/// its centre. A change of the shape needs a reset.
///
/// Invariants for any motion of the device. The SCP keeps the probe's radius and at least half of
/// kRelativeClearance of the object's size from every triangle, and half an
/// ImplicitSolid::clearance() from every implicit surface. So it cannot pass a surface. An update
/// never raises |device - scp|, because every move leads towards the nearest point of a convex set
/// that contains the SCP.
class SurfaceContactPoint {
 public:
  /// @param radius of the probe [m], >= 0
  explicit SurfaceContactPoint(double radius = 0.0) noexcept : radius_(radius) {}

  /// Puts the SCP at `device`, or outside nearby if the probe overlaps the solid there.
  /// @return true if `device` was inside.
  bool reset(const ContactShape& shape, const Eigen::Vector3d& device) noexcept;

  /// Settles for `device`; friction may be null. No allocation; bounded work
  /// (ContactWalk::kMaxMoves sweeps).
  void update(const ContactShape& shape, const Eigen::Vector3d& device,
              FrictionCone* friction) noexcept;

  /// Whether a probe with its centre at p [m] overlaps the solid.
  [[nodiscard]] bool overlaps(const ContactShape& shape, const Eigen::Vector3d& p) const noexcept;

  /// Follows a device whose path is known to be free.
  void set_free(const Eigen::Vector3d& device) noexcept;

  [[nodiscard]] const Eigen::Vector3d& scp() const noexcept { return point_.scp; }
  [[nodiscard]] const Eigen::Vector3d& normal() const noexcept { return point_.normal; }
  [[nodiscard]] bool in_contact() const noexcept { return point_.in_contact; }
  /// The triangle of a mesh in contact with the greatest load.
  [[nodiscard]] std::uint32_t triangle() const noexcept { return triangle_; }

 private:
  template <class Solid>
  void walk(const Solid& solid, const Eigen::Vector3d& device, FrictionCone* friction) noexcept;

  double radius_;
  SettledPoint point_;
  std::array<std::uint32_t, 3> faces_{};  // triangles that held the SCP after the last update
  std::size_t face_count_ = 0;
  std::uint32_t triangle_ = 0;
  NearTriangles near_;
};

}  // namespace reckon::haptics
