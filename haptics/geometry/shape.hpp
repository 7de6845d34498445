// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Shapes as a scene declares them, plain structs. shapes.hpp converts them for contacts.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <filesystem>
#include <variant>
#include <vector>

namespace reckon::haptics {

/// A half space: solid below the plane through the object's origin.
struct PlaneShape {
  Eigen::Vector3d normal =
      Eigen::Vector3d::UnitZ();  ///< object axes, out of the solid; any length > 0
};

/// A solid ball around the object's origin.
struct SphereShape {
  double radius = 0.05;  ///< [m], > 0
};

/// A solid box around the object's origin, edges along the object's axes.
struct BoxShape {
  Eigen::Vector3d size = Eigen::Vector3d::Constant(0.1);  ///< whole edge lengths [m], each > 0
};

/// A solid cylinder around the object's origin, its axis along z.
struct CylinderShape {
  double radius = 0.03;  ///< [m], > 0
  double height = 0.1;   ///< [m], > 0
};

/// A solid cone, or a frustum, its axis along z, the origin at half its height.
struct ConeShape {
  double radius = 0.03;     ///< of the lower base [m], >= 0
  double top_radius = 0.0;  ///< of the upper face [m], >= 0; 0 is a tip. Not both 0
  double height = 0.1;      ///< [m], > 0
};

/// A solid ring around the object's z axis.
struct TorusShape {
  double radius = 0.04;  ///< of the centre line of its tube [m], > tube
  double tube = 0.01;    ///< radius of the tube [m], > 0
};

/// A solid ellipsoid around the object's origin.
struct EllipsoidShape {
  Eigen::Vector3d semi_axes = Eigen::Vector3d(0.06, 0.04, 0.03);  ///< along x, y, z [m], each > 0
};

/// Operation of a part on the parts before it.
enum class CsgOperation : std::uint8_t {
  add,        ///< union
  subtract,   ///< difference: the part is removed
  intersect,  ///< intersection: only the common volume stays
};

/// One step of constructive solid geometry (CSG).
struct CsgPart {
  CsgOperation operation = CsgOperation::add;  ///< of the first part: add
  std::variant<PlaneShape, SphereShape, BoxShape, CylinderShape, ConeShape, TorusShape,
               EllipsoidShape>
      shape;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< of the part's origin, object axes [m]
  Eigen::Quaterniond orientation =
      Eigen::Quaterniond::Identity();  ///< part -> object; normalised on use
  double rounding = 0.0;               ///< radius of the edges from the operation [m], >= 0
};

/// A solid from a sequence of parts: 1 to SignedFunction::kMostLeaves.
struct CsgShape {
  std::vector<CsgPart> parts;
};

/// A triangle mesh from a file (OBJ, PLY, STL, OFF).
struct MeshShape {
  std::filesystem::path file;  ///< path to open; a scene reader resolves it against the scene file
  double scale_to = 0.0;  ///< bounding-box diagonal after uniform scaling [m]; 0 keeps the file's
                          ///< coordinates as metres
  bool centre = false;    ///< moves the centre of the bounding box to the object's origin
};

/// A solid block whose upper side has the heights of a picture, seen from +z with its top towards
/// +y. The origin lies in the middle of the rectangle, at the height of black.
struct HeightsShape {
  std::filesystem::path file;  ///< PNG or PGM, as for MeshShape
  double width = 0.1;          ///< along x, between the outermost columns [m], 1e-4 to 1e3
  double length = 0.0;         ///< along y [m], to 1e3; 0: pixels are squares
  double height = 0.01;        ///< of white above black [m], 0 to 1e3
  double base = 0.01;          ///< of black above the bottom [m], 1e-4 to 1e3
};

using Shape = std::variant<PlaneShape, SphereShape, BoxShape, MeshShape, CylinderShape, ConeShape,
                           TorusShape, EllipsoidShape, CsgShape, HeightsShape>;

}  // namespace reckon::haptics
