// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Shapes as a scene declares them, plain structs; shapes.hpp makes of them what a contact is
// computed with.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <variant>

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

}  // namespace reckon::haptics
