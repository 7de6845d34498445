// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The touchable objects that a scene declares, as plain structs. `src/scene_file` fills them from
// TOML, and EffectPlan (effect_plan.hpp) prepares them for the servo. Nothing here computes.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "reckon/haptics/effects/effect_custom.hpp"
#include "reckon/haptics/effects/effect_declarations.hpp"
#include "reckon/haptics/geometry/shape.hpp"
#include "reckon/haptics/regions/region_types.hpp"
#include "reckon/haptics/scene/grab_spring.hpp"

namespace reckon::haptics {

/// Pose of an object in the scene frame S: p_S = orientation * p_object + position.
struct ObjectPose {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< [m], S
  Eigen::Quaterniond orientation =
      Eigen::Quaterniond::Identity();  ///< object -> S; normalised on use
};

/// A part of a mesh with its own surface: the triangles of a material or group of its file.
struct SurfacePatch {
  std::string name;  ///< of the material or group; SurfaceMesh::names()
  Surface surface;
  std::optional<Friction> friction;  ///< none: smooth
};

/// Properties of an object for the simulation of bodies.
struct Matter {
  double mass = 0.0;         ///< [kg]; above 0: it is a body, and pushes move it
  double friction = 0.5;     ///< >= 0; a pair has the geometric mean
  double restitution = 0.0;  ///< 0 to 1; a pair has the greater one
  double drag = 0.0;         ///< [N s/m] >= 0, against the velocity of a body
};

/// A box that no body leaves (thesis fig. 5.6); hands do not feel it.
struct WorkSpace {
  Eigen::Vector3d size = Eigen::Vector3d::Zero();      ///< [m]; no workspace unless all are > 0
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< [m], center, S
  double restitution = 0.5;                            ///< 0 to 1, of a rebound

  [[nodiscard]] bool is_set() const noexcept { return (size.array() > 0.0).all(); }
};

/// One touchable object. An effect that is not declared is never constructed.
struct SceneObject {
  std::string name;
  Shape shape;
  ObjectPose pose;
  DeclaredEffects effects;            ///< effects.of<SpringDamper>().stiffness = 900.0
  std::vector<SurfacePatch> patches;  ///< for a mesh; other triangles have `effects`
  /// Custom effects, in the order of their keys.
  std::vector<DeclaredCustomEffect> custom_effects{};
  Matter matter{};
  GrabSpring grab{};  ///< of a body: it sticks to the hand that touches it
  /// An ObjectMover moves it, and no push does, whatever its mass.
  bool carried = false;
};

/// A part of space in which effects act; nothing solid.
struct SceneRegion {
  std::string name;
  std::optional<Shape> shape;  ///< a plane (below it), sphere or box; none: everywhere
  ObjectPose pose;
  DeclaredRegionEffects effects;
  /// Custom effects, in the order of their keys.
  std::vector<DeclaredCustomRegionEffect> custom_effects{};
};

struct Scene {
  std::string name;
  std::vector<SceneObject> objects;
  std::vector<SceneRegion> regions{};
  Eigen::Vector3d gravity = {0.0, 0.0, -9.81};  ///< [m/s^2], S; of bodies
  WorkSpace work_space = {};                    ///< of bodies
};

}  // namespace reckon::haptics
