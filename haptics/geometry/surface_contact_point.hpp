// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The surface contact point (SCP, also god-object or proxy): the point that stays outside the solid
// and follows the device. Each update moves it until it settles, within the same servo tick.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>

#include "reckon/haptics/geometry/friction_cone.hpp"
#include "reckon/haptics/geometry/shapes.hpp"
#include "reckon/haptics/geometry/surface_mesh.hpp"

namespace reckon::haptics {

/// State of one device point against one shape, object axes.
///
/// Invariants, whatever the device does: the SCP keeps at least half of kRelativeClearance of the
/// object's size from every triangle, so it cannot pass a surface; an update never raises
/// |device - scp|, since every move is towards the nearest point of a convex set that the SCP is
/// in.
class SurfaceContactPoint {
 public:
  /// Puts the SCP at `device`, or, where that is inside the solid or too close to its surface, at
  /// the nearest point outside. @return true when `device` was inside.
  bool reset(const ContactShape& shape, const Eigen::Vector3d& device) noexcept;

  /// Settles for `device`; friction may be null. No allocation; bounded work (kMaxMoves sweeps).
  void update(const ContactShape& shape, const Eigen::Vector3d& device,
              FrictionCone* friction) noexcept;

  /// Follows a device that is known to touch nothing on its way.
  void set_free(const Eigen::Vector3d& device) noexcept;

  [[nodiscard]] const Eigen::Vector3d& scp() const noexcept { return point_.scp; }
  [[nodiscard]] const Eigen::Vector3d& normal() const noexcept { return point_.normal; }
  [[nodiscard]] bool in_contact() const noexcept { return point_.in_contact; }

  /// Most sweeps of one update on a mesh; a way that needs more is finished in the next ticks.
  static constexpr int kMaxMoves = 256;

 private:
  struct MeshWalk;
  void update_mesh(const SurfaceMesh& mesh, const Eigen::Vector3d& device,
                   FrictionCone* friction) noexcept;

  SettledPoint point_;
  std::array<std::uint32_t, 3> faces_{};  // triangles that held the SCP after the last update
  std::size_t face_count_ = 0;
};

}  // namespace reckon::haptics
