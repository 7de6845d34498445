// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Free motion of bodies in closed form, within the workspace and without tunneling.
#pragma once

#include <Eigen/Core>

#include "reckon/haptics/bodies/body_geoms.hpp"
#include "reckon/haptics/bodies/body_slots.hpp"
#include "reckon/haptics/bodies/flight.hpp"

namespace reckon::haptics {

/// Motion outside the solver. One thread; allocates nothing after construction.
class FreeMotion {
 public:
  /// @param geoms, slots outlive this  @param gravity [m/s^2], S
  FreeMotion(const BodyGeoms& geoms, BodySlots& slots, const Eigen::Vector3d& gravity,
             const WorkSpace& work_space);
  ~FreeMotion() { dGeomDestroy(ray_); }
  FreeMotion(const FreeMotion&) = delete;
  FreeMotion& operator=(const FreeMotion&) = delete;

  /// Moves a body freely for dt [s] >= 0; it keeps its angular momentum.
  void fly(std::size_t slot, double dt) noexcept;
  /// Moves the flying bodies of a step of dt [s], from RigidBody::before; keeps the others in the
  /// workspace.
  void fly_exactly(BodySet bodies, double dt) noexcept;
  /// Puts bodies that would tunnel where they meet the obstacle.
  void catch_fast(BodySet bodies) noexcept;

 private:
  [[nodiscard]] Walls walls_of(const RigidBody& body, int axis) const noexcept;
  void turn(RigidBody& body, double dt) const noexcept;
  [[nodiscard]] Flight flown(const RigidBody& body, int axis, const Flight& from,
                             double dt) const noexcept;
  [[nodiscard]] double length_free(const RigidBody& body, const Eigen::Vector3d& from,
                                   const Eigen::Vector3d& way, double length) noexcept;

  const BodyGeoms& geoms_;
  BodySlots& slots_;
  Eigen::Vector3d gravity_;
  WorkSpace work_space_;
  dGeomID ray_;  // outside all spaces
};

}  // namespace reckon::haptics
