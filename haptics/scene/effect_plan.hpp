// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What the servo runs for a scene: its shapes loaded and placed, and of the effects only those that
// the scene declares. Built once at load; `reckon scene explain` prints stages().
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

/// One object as the servo sees it.
struct PlannedObject {
  std::string name;
  ContactShape shape;  ///< its own axes; meshes are shared between copies of a plan
  Eigen::Matrix3d orientation = Eigen::Matrix3d::Identity();  ///< shape -> S
  /// Of the shape's axes [m], S; not the object's own where a mesh has a SurfaceMesh::origin().
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::AlignedBox3d bounds;  ///< S; everything for a plane
  PlannedEffects effects;      ///< as declared; contacts copy them
  /// Of a mesh that has them, else null. Then `effects` are those of no patch.
  std::shared_ptr<const SurfacePatches> patches;

  /// Of all its springs together [N/m]; of the stiffest patch where there are any.
  [[nodiscard]] double stiffness() const noexcept;
  /// That its effects would have of the device's own damping, beside what the springs need [N s/m];
  /// the most of any patch.
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

/// Copies share their meshes. Immutable after construction, so that many threads may read it.
class EffectPlan {
 public:
  EffectPlan() = default;
  /// Loads meshes and checks every parameter.
  /// @throws std::invalid_argument or std::runtime_error naming the object, the value and the
  /// remedy.
  explicit EffectPlan(const Scene& scene);

  [[nodiscard]] const std::vector<PlannedObject>& objects() const noexcept { return objects_; }
  /// Calls visit(index) once for each object whose bounds meet `box` [m, S], and for some others:
  /// those that have no bounds, or an effect that acts from afar. In no order, no allocation;
  /// logarithmic in the objects that are bounded.
  template <class Visit>
  void visit_near(const Eigen::AlignedBox3d& box, Visit&& visit) const {
    for (const std::uint32_t index : always_) visit(index);
    tree_.overlapping(box, [&](std::uint32_t first, std::uint32_t count) {
      for (std::uint32_t i = first; i < first + count; ++i) visit(in_tree_[tree_.order()[i]]);
    });
  }
  /// Stiffest surface [N/m]; 0 without objects. The device's passive limit is compared with it.
  [[nodiscard]] double max_stiffness() const noexcept;
  /// Every stage in the order of the servo step.
  [[nodiscard]] std::vector<PlanStage> stages() const;

 private:
  void plant_tree();

  std::vector<PlannedObject> objects_;
  std::vector<std::uint32_t> always_;   // indices of objects, ascending
  std::vector<std::uint32_t> in_tree_;  // of the others, as the tree counts them
  BoundingVolumeTree tree_;
};

}  // namespace reckon::haptics
