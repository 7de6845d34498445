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

/// Where an object that moves is, and how. Frame S.
struct ObjectMotion {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();               ///< [m]
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();  ///< object -> S
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();               ///< [m/s], of its origin
  Eigen::Vector3d turn_rate = Eigen::Vector3d::Zero();              ///< [rad/s]
  double step = 0.0;  ///< [s]; its speed is that of half of it before its place

  /// Of the place of the object that is at `point` [m] now [m/s].
  [[nodiscard]] Eigen::Vector3d velocity_at(const Eigen::Vector3d& point) const noexcept {
    return velocity + turn_rate.cross(point - position);
  }
};

/// One object for the servo.
struct PlannedObject {
  /// Share of the least mass over the period that the viscous effects of one hand may have. Three
  /// hands together stay below 1.
  static constexpr double kViscousShare = 0.3;

  std::string name;
  ContactShape shape;  ///< its own axes; meshes are shared between copies of a plan
  Eigen::Matrix3d orientation = Eigen::Matrix3d::Identity();  ///< shape -> S
  /// Origin of the shape's axes [m], S. It differs from the object's origin if a mesh has a
  /// SurfaceMesh::origin().
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  /// Of the shape's axes in the object's own [m], of the same orientation.
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::AlignedBox3d bounds;  ///< S; unbounded for a plane
  PlannedEffects effects;      ///< as declared; contacts copy them
  /// Patches of a mesh, or null. With patches, `effects` are those of triangles in no patch.
  std::shared_ptr<const SurfacePatches> patches;
  Matter matter;
  GrabSpring grab;       ///< of a body: it sticks to the hand that touches it
  bool carried = false;  ///< by an ObjectMover
  /// Of a body, the result of least_mass_of() [kg]; infinite where no effect depends on its speed.
  double least_mass = std::numeric_limits<double>::infinity();

  /// Its pose here is the one that it has at the start.
  [[nodiscard]] bool moves() const noexcept { return is_body() || carried; }
  /// Moved by pushes and its weight.
  [[nodiscard]] bool is_body() const noexcept { return matter.mass > 0 && !carried; }
  /// Takes another pose. @param at [m], S
  void place(const Eigen::Vector3d& at, const Eigen::Matrix3d& turned) noexcept;
  /// Stiffness of all its springs together [N/m]; that of the stiffest patch if there are any.
  [[nodiscard]] double stiffness() const noexcept;
  /// Damping of the device that its effects reserve, besides the need of the springs [N s/m]; the
  /// greatest of any patch.
  [[nodiscard]] double damping() const noexcept;
  /// Greatest coefficient of an effect that holds back by the speed of the object, for a period
  /// [s], so that the object does not turn around within it [N s/m].
  [[nodiscard]] double most_viscosity(double period) const noexcept {
    return kViscousShare * least_mass / period;
  }
  [[nodiscard]] Eigen::Vector3d to_object(const Eigen::Vector3d& p_S) const noexcept {
    return orientation.transpose() * (p_S - position);
  }
  /// In the object's own axes, as its file or scene has them [m].
  [[nodiscard]] Eigen::Vector3d place_of(const Eigen::Vector3d& p_S) const noexcept {
    return to_object(p_S) + origin;
  }
  /// Whether one of its effects gives a force where it is not touched.
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

  /// From the nearest place inside to `place`, both in its axes [m]; zero inside.
  [[nodiscard]] Eigen::Vector3d beyond(const Eigen::Vector3d& place) const noexcept;
  /// Curvature of all its potentials together, at most [N/m].
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
  /// Of parts of another plan; meshes are shared.
  EffectPlan(std::vector<PlannedObject> objects, std::vector<PlannedRegion> regions)
      : objects_(std::move(objects)), regions_(std::move(regions)) {
    plant_tree();
  }

  [[nodiscard]] const std::vector<PlannedObject>& objects() const noexcept { return objects_; }
  [[nodiscard]] const std::vector<PlannedRegion>& regions() const noexcept { return regions_; }
  [[nodiscard]] bool has_moving() const noexcept { return has_moving_; }
  /// Calls visit(index) once for each object that stands still and whose bounds meet `box` [m, S].
  /// It also visits those that have no bounds, or an effect that acts at a distance. Any order, no
  /// allocation; logarithmic in the objects with bounds.
  template <class Visit>
  void visit_near(const Eigen::AlignedBox3d& box, Visit&& visit) const {
    for (const std::uint32_t index : always_) visit(index);
    tree_.overlapping(box, [&](std::uint32_t first, std::uint32_t count) {
      for (std::uint32_t i = first; i < first + count; ++i) visit(in_tree_[tree_.order()[i]]);
    });
  }
  /// Whether a surface, a region, or an effect that acts at a distance, is within `reach` [m] of
  /// `at` [m, S].
  /// Surely true where one is; logarithmic in the objects out of reach.
  [[nodiscard]] bool has_within(const Eigen::Vector3d& at, double reach) const noexcept;
  /// Stiffness of the stiffest surface [N/m]; 0 without objects. Compared with the device's passive
  /// limit.
  [[nodiscard]] double max_stiffness() const noexcept;
  /// The same of the stiffest region.
  [[nodiscard]] double max_region_stiffness() const noexcept;
  /// What is seen of the program's own effects while servos run, one for each that is declared.
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
