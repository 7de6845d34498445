// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// How bodies move that nothing touches: in closed form, within the work space, past nothing.
#pragma once

#include <Eigen/Core>

#include "reckon/haptics/bodies/body_geoms.hpp"
#include "reckon/haptics/bodies/body_slots.hpp"
#include "reckon/haptics/bodies/flight.hpp"

namespace reckon::haptics {

/// Motion beside the solver's. One thread; allocates nothing after construction.
class FreeMotion {
 public:
  /// @param geoms, slots outlive this  @param gravity [m/s^2], S
  FreeMotion(const BodyGeoms& geoms, BodySlots& slots, const Eigen::Vector3d& gravity,
             const WorkSpace& work_space);
  ~FreeMotion() { dGeomDestroy(ray_); }
  FreeMotion(const FreeMotion&) = delete;
  FreeMotion& operator=(const FreeMotion&) = delete;

  /// A body goes on alone for dt [s] >= 0 from where it is; it keeps its angular momentum.
  void fly(std::size_t slot, double dt) noexcept;
  /// Those of a step of dt [s] that fly, from RigidBody::before; others stay in the work space.
  void fly_exactly(BodySet bodies, double dt) noexcept;
  /// Those that would be behind what they hit are put where they meet it.
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
  dGeomID ray_;  // in no space
};

}  // namespace reckon::haptics
