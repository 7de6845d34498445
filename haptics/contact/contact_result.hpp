// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What a step of the contact solver finds: contacts, and bodies nearby.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "reckon/haptics/geometry/surface_contact_point.hpp"
#include "reckon/haptics/scene/effect_plan.hpp"

namespace reckon::haptics {

/// Contact with one object, frame S.
struct ObjectContact {
  /// [m]; the same for all objects that hold it. For a free object, the device point when it was
  /// near.
  Eigen::Vector3d scp = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< unit, out of the solid; zero if free
  Eigen::Vector3d force = Eigen::Vector3d::Zero();   ///< of its springs on the device [N]
  double stored_energy = 0.0;                        ///< 1/2 k depth^2 [J]
  double depth = 0.0;                                ///< [m], this object's share of |device - scp|
                                                     ///< that is not hidden
  std::uint32_t patch = 0;  ///< below the SCP, number in SurfacePatches; 0: none
  std::uint32_t triangle = ContactedObject::kNoTriangle;  ///< of a mesh, below the SCP
  bool in_contact = false;
  bool started_inside = false;  ///< since reset, until this object is left once
};

/// A body near the probe, without contact, frame S.
struct NearBody {
  std::uint32_t index = 0;                           ///< index of the object
  Eigen::Vector3d point = Eigen::Vector3d::Zero();   ///< nearest point of the body [m]
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< unit, out of the body
  double gap = 0.0;                                  ///< distance [m], > 0
};

/// Result of a step, frame S. The spans stay valid until the solver's next call.
struct ContactResult {
  static constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

  Eigen::Vector3d scp = Eigen::Vector3d::Zero();     ///< outside all objects; device if free
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< of the deepest contact; zero if free
  Eigen::Vector3d force = Eigen::Vector3d::Zero();   ///< springs only, summed over objects [N]
  double stored_energy = 0.0;                        ///< summed over objects [J]
  std::size_t deepest = kNone;                       ///< index of the deepest contact in objects
  bool in_contact = false;
  bool started_inside = false;             ///< inside any object: the servo ramps the force up
  std::span<const ObjectContact> objects;  ///< in the plan's order
  std::span<const std::uint32_t> touched;  ///< indices of objects in contact, ascending
};

}  // namespace reckon::haptics
