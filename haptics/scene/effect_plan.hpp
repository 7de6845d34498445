// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The servo's version of a scene: its shapes loaded and placed, and only the effects that the scene
// declares. Built once at load; `reckon scene explain` prints stages().
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "reckon/haptics/effects/effect_set.hpp"
#include "reckon/haptics/geometry/bounding_volume_tree.hpp"
#include "reckon/haptics/geometry/shapes.hpp"
#include "reckon/haptics/scene/scene.hpp"
#include "reckon/haptics/scene/surface_patches.hpp"

namespace reckon::haptics {

/// Motion of an object. Frame S.
struct ObjectMotion {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();               ///< [m]
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();  ///< object -> S
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();               ///< [m/s], of its origin
  Eigen::Vector3d turn_rate = Eigen::Vector3d::Zero();              ///< [rad/s]
  double step = 0.0;  ///< [s]; the velocity lags the position by half of it
  /// Of a copy, in the last advance: the part of its way [m] and turn [rad] by which its owner's
  /// answer drew it. S.
  Eigen::Vector3d drawn = Eigen::Vector3d::Zero(), drawn_turn = Eigen::Vector3d::Zero();

  /// Velocity of the object's material point at `point` [m], [m/s].
  [[nodiscard]] Eigen::Vector3d velocity_at(const Eigen::Vector3d& point) const noexcept {
    return velocity + turn_rate.cross(point - position);
  }
};

/// One object for the servo.
struct PlannedObject {
  /// Greatest viscosity of one hand's effects, as a share of least mass over period. Three hands
  /// together stay below 1.
  static constexpr double kViscousShare = 0.3;

  std::string name;
  ContactShape shape;  ///< its own axes; meshes are shared between copies of a plan
  Eigen::Matrix3d orientation = Eigen::Matrix3d::Identity();  ///< shape -> S
  /// Origin of the shape's axes [m], S. It differs from the object's origin if a mesh has a
  /// SurfaceMesh::origin().
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  /// Origin of the shape's axes in the object's axes [m]; both have the same orientation.
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::AlignedBox3d bounds;  ///< S; unbounded for a plane
  PlannedEffects effects;      ///< as declared; contacts copy them
  /// Patches of a mesh, or null. With patches, `effects` apply to triangles in no patch.
  std::shared_ptr<const SurfacePatches> patches;
  Matter matter;
  GrabSpring grab;       ///< of a body: it sticks to the hand that touches it
  bool carried = false;  ///< by an ObjectMover; if it has a mass, until its peer owns it
  /// For a body, the result of least_mass_of() [kg]; infinite if no effect depends on its velocity.
  double least_mass = std::numeric_limits<double>::infinity();

  /// Whether it moves; its pose here is then the initial one.
  [[nodiscard]] bool moves() const noexcept { return is_body() || carried; }
  /// Whether pushes and its weight move it while its peer owns it.
  [[nodiscard]] bool is_body() const noexcept { return matter.mass > 0; }
  /// Takes another pose. @param at [m], S
  void place(const Eigen::Vector3d& at, const Eigen::Matrix3d& turned) noexcept;
  /// Stiffness of all its springs together [N/m]; with patches, of the stiffest one.
  [[nodiscard]] double stiffness() const noexcept;
  /// Damping of the device that its effects reserve, in addition to the need of the springs [N
  /// s/m]; with patches, the greatest value.
  [[nodiscard]] double damping() const noexcept;
  /// Greatest coefficient of a velocity-dependent drag [N s/m], so that the object does not reverse
  /// within a `period` [s].
  [[nodiscard]] double most_viscosity(double period) const noexcept {
    return kViscousShare * least_mass / period;
  }
  [[nodiscard]] Eigen::Vector3d to_object(const Eigen::Vector3d& p_S) const noexcept {
    return orientation.transpose() * (p_S - position);
  }
  /// Position in the object's own axes, as in its file or scene [m].
  [[nodiscard]] Eigen::Vector3d place_of(const Eigen::Vector3d& p_S) const noexcept {
    return to_object(p_S) + origin;
  }
  /// Whether one of its effects gives a force without contact.
  [[nodiscard]] bool acts_from_afar() const noexcept;
  [[nodiscard]] bool is_mesh() const noexcept {
    return std::holds_alternative<std::shared_ptr<const SurfaceMesh>>(shape);
  }
  [[nodiscard]] Eigen::Vector3d to_scene(const Eigen::Vector3d& p_object) const noexcept {
    return orientation * p_object + position;
  }
};

/// One region for the servo.
struct PlannedRegion {
  std::string name;
  std::variant<std::monostate, HalfSpace, Ball, Block> shape;  ///< none: everywhere
  Eigen::Matrix3d orientation = Eigen::Matrix3d::Identity();   ///< region -> S
  Eigen::Vector3d position = Eigen::Vector3d::Zero();          ///< of its origin [m], S
  PlannedRegionEffects effects;                                ///< as declared; devices copy them

  /// Vector from the nearest point inside to `place`, both in its axes [m]; zero inside.
  [[nodiscard]] Eigen::Vector3d beyond(const Eigen::Vector3d& place) const noexcept;
  /// Upper bound of the curvature of all its potentials together [N/m].
  [[nodiscard]] double stiffness() const noexcept;
};

/// One stage of the servo step for one object or region.
struct PlanStage {
  std::string name;        ///< "contact", "region" or the effect's name
  std::string object;      ///< the object's or region's name
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
  /// From parts of another plan; meshes are shared.
  EffectPlan(std::vector<PlannedObject> objects, std::vector<PlannedRegion> regions)
      : objects_(std::move(objects)), regions_(std::move(regions)) {
    plant_tree();
  }

  [[nodiscard]] const std::vector<PlannedObject>& objects() const noexcept { return objects_; }
  [[nodiscard]] const std::vector<PlannedRegion>& regions() const noexcept { return regions_; }
  [[nodiscard]] bool has_moving() const noexcept { return has_moving_; }
  /// Calls visit(index) once for each static object whose bounds overlap `box` [m, S], and for
  /// objects without bounds or with an effect that acts at a distance. Any order, no allocation;
  /// logarithmic in the objects with bounds.
  void visit_near(const Eigen::AlignedBox3d& box, auto&& visit) const {
    for (const std::uint32_t index : always_) visit(index);
    tree_.overlapping(box, [&](std::uint32_t first, std::uint32_t count) {
      for (std::uint32_t i = first; i < first + count; ++i) visit(in_tree_[tree_.order()[i]]);
    });
  }
  /// Whether a surface, a region, or an effect that acts at a distance, is within `reach` [m] of
  /// `at` [m, S]. Never false if one is; logarithmic in the objects out of reach.
  [[nodiscard]] bool has_within(const Eigen::Vector3d& at, double reach) const noexcept;
  /// Stiffness of the stiffest surface [N/m], to compare with the device's passive limit; 0 without
  /// objects.
  [[nodiscard]] double max_stiffness() const noexcept;
  /// The same for the stiffest region.
  [[nodiscard]] double max_region_stiffness() const noexcept;
  /// Reports on the program's own effects from running servos, one for each declared effect.
  [[nodiscard]] std::vector<std::shared_ptr<const GuardReport>> custom_effects() const;
  /// All stages in the order of the servo step.
  [[nodiscard]] std::vector<PlanStage> stages() const;

 private:
  void plant_tree();

  std::vector<PlannedObject> objects_;
  std::vector<PlannedRegion> regions_;
  std::vector<std::uint32_t> always_;   // indices of objects, ascending
  std::vector<std::uint32_t> in_tree_;  // indices of the others, by their number in the tree
  BoundingVolumeTree tree_;
  bool has_moving_ = false;
};

}  // namespace reckon::haptics
