// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The objects of a plan as the shapes that ODE finds contacts of.
#pragma once

#include <deque>
#include <string>
#include <vector>

#include "reckon/haptics/bodies/ode_calls.hpp"
#include "reckon/haptics/scene/effect_plan.hpp"

namespace reckon::haptics {

/// @throws std::invalid_argument "object '..' {why}"
[[noreturn]] void refuse_body(const PlannedObject& object, const std::string& why);

/// A space of shapes: boxes, spheres, planes, meshes. One thread at a time.
class BodyGeoms {
 public:
  BodyGeoms();
  ~BodyGeoms();
  BodyGeoms(const BodyGeoms&) = delete;
  BodyGeoms& operator=(const BodyGeoms&) = delete;

  /// A shape for the object, at its place if it stands still; one that moves is placed by its body.
  /// @return null for a solid that bodies pass through  @throws std::invalid_argument for one that
  /// cannot move
  dGeomID add(const PlannedObject& object);
  [[nodiscard]] dSpaceID space() const noexcept { return space_; }

 private:
  [[nodiscard]] dGeomID make_mesh(const SurfaceMesh& mesh);

  dSpaceID space_;
  std::vector<dTriMeshDataID> meshes_;
  std::deque<std::vector<double>> corners_;  // ODE points to them
  std::deque<std::vector<dTriIndex>> indices_;
};

}  // namespace reckon::haptics
