// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The objects of a plan as collision shapes of ODE.
#pragma once

#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "reckon/haptics/bodies/mesh_contacts.hpp"
#include "reckon/haptics/bodies/ode_calls.hpp"
#include "reckon/haptics/queries/query_shape.hpp"
#include "reckon/haptics/scene/effect_plan.hpp"

namespace reckon::haptics {

/// @throws std::invalid_argument "object '..' {why}"
[[noreturn]] void refuse_body(const PlannedObject& object, const std::string& why);

/// Dimensions of a cylinder; null: another shape.
[[nodiscard]] const CylinderShape* cylinder_of(const PlannedObject& object);

/// User data of a geom.
struct GeomMatter {
  Matter matter;
  const ProbedMesh* mesh = nullptr;  ///< of a mesh, if some mesh has a mass
  /// Of a ball, box, cylinder or plane, in the axes of the object; std::nullopt: another shape.
  std::optional<QueryShape> swept;
  Eigen::Matrix3d turned =
      Eigen::Matrix3d::Identity();  ///< initial rotation of the object, object -> S
};

/// A collision space: boxes, spheres, cylinders, planes, meshes, and solids as meshes. One thread
/// at a time.
class BodyGeoms {
 public:
  /// @param objects that will be added
  explicit BodyGeoms(std::span<const PlannedObject> objects);
  ~BodyGeoms();
  BodyGeoms(const BodyGeoms&) = delete;
  BodyGeoms& operator=(const BodyGeoms&) = delete;

  /// Adds a shape for the object, at its pose if it is static; the body of a moving object places
  /// it.
  /// @return null for an unbounded solid, which bodies pass through, or without bodies @throws
  /// std::invalid_argument for a shape that cannot move, or is too thin to collide
  dGeomID add(const PlannedObject& object);
  /// Contacts of two geoms, as dCollide: the ones that hold best, 4 at most.
  [[nodiscard]] static std::span<dContactGeom> meet(dGeomID a, dGeomID b,
                                                    std::span<dContactGeom> room) noexcept;
  [[nodiscard]] static const GeomMatter& matter_of(dGeomID geom) noexcept {
    return *static_cast<const GeomMatter*>(dGeomGetData(geom));
  }
  [[nodiscard]] dSpaceID space() const noexcept { return space_; }

 private:
  [[nodiscard]] std::shared_ptr<const SurfaceMesh> mesh_for(const PlannedObject& object);
  [[nodiscard]] dGeomID make(const PlannedObject& object, const SurfaceMesh* mesh);
  [[nodiscard]] dGeomID make_mesh(const SurfaceMesh& mesh);

  dSpaceID space_;
  bool has_bodies_ = false;   // an object has a mass
  bool meshes_meet_ = false;  // an object with a mass is a mesh or a solid
  std::vector<dTriMeshDataID> meshes_;
  std::deque<std::vector<double>> corners_;  // ODE keeps pointers to them
  std::deque<std::vector<dTriIndex>> indices_;
  std::deque<GeomMatter> matters_;
  std::map<const SurfaceMesh*, std::unique_ptr<const ProbedMesh>> probed_;  // shared by copies
  std::map<const ImplicitSolid*, std::shared_ptr<const SurfaceMesh>> solids_;
};

}  // namespace reckon::haptics
