// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What a scene declares that can be touched, as plain structs. `src/scene_file` fills them from
// TOML, EffectPlan (effect_plan.hpp) turns them into what the servo runs. Nothing here computes.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace reckon::haptics {

/// A half space: solid below the plane through the object's origin, free above it.
struct PlaneShape {
  Eigen::Vector3d normal =
      Eigen::Vector3d::UnitZ();  ///< object axes, out of the solid; any length > 0
};

/// A solid ball about the object's origin.
struct SphereShape {
  double radius = 0.05;  ///< [m], > 0
};

/// A solid box about the object's origin, edges along the object's axes.
struct BoxShape {
  Eigen::Vector3d size = Eigen::Vector3d::Constant(0.1);  ///< whole edge lengths [m], each > 0
};

/// A triangle mesh from a file (OBJ, PLY, STL, OFF).
struct MeshShape {
  std::filesystem::path
      file;  ///< as it can be opened; a scene reader resolves it against the scene file
  double scale_to =
      0.0;  ///< bounding-box diagonal after uniform scaling [m]; 0 keeps the file's units as metres
  bool centre = false;  ///< moves the centre of the bounding box to the object's origin
};

using Shape = std::variant<PlaneShape, SphereShape, BoxShape, MeshShape>;

/// Place of an object in the scene frame S: p_S = orientation * p_object + position.
struct ObjectPose {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< [m], S
  Eigen::Quaterniond orientation =
      Eigen::Quaterniond::Identity();  ///< object -> S; normalised on use
};

/// How a surface pushes back (effects/spring_damper.hpp holds ranges and help).
struct Surface {
  double stiffness = 800.0;  ///< [N/m]
  double damping = 0.0;      ///< [N s/m], along the surface normal
};

/// Stick-slip friction of a surface (effects/stick_slip_friction.hpp holds ranges and help).
struct Friction {
  double static_coefficient = 0.5;
  double kinetic_coefficient = 0.35;  ///< at most static_coefficient
};

/// One thing that can be touched. An effect that is not declared is never constructed.
struct SceneObject {
  std::string name;
  Shape shape;
  ObjectPose pose;
  Surface surface;
  std::optional<Friction> friction;
};

struct Scene {
  std::string name;
  std::vector<SceneObject> objects;
};

}  // namespace reckon::haptics
