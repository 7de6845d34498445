// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The servo's version of a scene: its shapes loaded and placed, and only the effects that the scene
// declares. Built once at load; `reckon scene explain` prints stages().
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "reckon/haptics/effects/effect_slots.hpp"
#include "reckon/haptics/geometry/bounding_volume_tree.hpp"
#include "reckon/haptics/geometry/shapes.hpp"
#include "reckon/haptics/scene/scene.hpp"
#include "reckon/haptics/scene/surface_patches.hpp"

namespace reckon::haptics {

/// One object for the servo.
struct PlannedObject {
  std::string name;
  ContactShape shape;  ///< its own axes; meshes are shared between copies of a plan
  Eigen::Matrix3d orientation = Eigen::Matrix3d::Identity();  ///< shape -> S
  /// Origin of the shape's axes [m], S. It differs from the object's origin if a mesh has a
  /// SurfaceMesh::origin().
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::AlignedBox3d bounds;  ///< S; unbounded for a plane
  PlannedEffects effects;      ///< as declared; contacts copy them
  /// Patches of a mesh, or null. With patches, `effects` are those of triangles in no patch.
  std::shared_ptr<const SurfacePatches> patches;

  /// Stiffness of all its springs together [N/m]; that of the stiffest patch if there are any.
  [[nodiscard]] double stiffness() const noexcept;
  /// Damping of the device that its effects reserve, besides the need of the springs [N s/m]; the
  /// greatest of any patch.
  [[nodiscard]] double damping() const noexcept;
  [[nodiscard]] Eigen::Vector3d to_object(const Eigen::Vector3d& p_S) const noexcept {
    return orientation.transpose() * (p_S - position);
  }
  [[nodiscard]] Eigen::Vector3d to_scene(const Eigen::Vector3d& p_object) const noexcept {
    return orientation * p_object + position;
  }
};

/// One stage of the servo step for one object.
struct PlanStage {
  std::string name;        ///< "contact" or the effect's name
  std::string object;      ///< the object's name
  std::string parameters;  ///< "stiffness 800 N/m, damping 0 N s/m", or the shape
  std::string cost;        ///< class, e.g. "logarithmic in 5184 triangles"
};

/// Copies share their meshes. Immutable after construction; many threads may read it.
class EffectPlan {
 public:
  EffectPlan() = default;
  /// Loads meshes and checks every parameter.
  /// @throws std::invalid_argument or std::runtime_error naming the object, the value and the
  /// remedy.
  explicit EffectPlan(const Scene& scene);

  [[nodiscard]] const std::vector<PlannedObject>& objects() const noexcept { return objects_; }
  /// Calls visit(index) once for each object whose bounds meet `box` [m, S]. It also visits objects
  /// that have no bounds, or an effect that acts at a distance. Any order, no allocation;
  /// logarithmic in the objects with bounds.
  template <class Visit>
  void visit_near(const Eigen::AlignedBox3d& box, Visit&& visit) const {
    for (const std::uint32_t index : always_) visit(index);
    tree_.overlapping(box, [&](std::uint32_t first, std::uint32_t count) {
      for (std::uint32_t i = first; i < first + count; ++i) visit(in_tree_[tree_.order()[i]]);
    });
  }
  /// Whether a surface, or an effect that acts at a distance, is within `reach` [m] of `at` [m, S].
  /// Surely true where one is; logarithmic in the objects out of reach.
  [[nodiscard]] bool has_within(const Eigen::Vector3d& at, double reach) const noexcept;
  /// Stiffness of the stiffest surface [N/m]; 0 without objects. Compared with the device's passive
  /// limit.
  [[nodiscard]] double max_stiffness() const noexcept;
  /// All stages in the order of the servo step.
  [[nodiscard]] std::vector<PlanStage> stages() const;

 private:
  void plant_tree();

  std::vector<PlannedObject> objects_;
  std::vector<std::uint32_t> always_;   // indices of objects, ascending
  std::vector<std::uint32_t> in_tree_;  // indices of the others, by their number in the tree
  BoundingVolumeTree tree_;
};

}  // namespace reckon::haptics
