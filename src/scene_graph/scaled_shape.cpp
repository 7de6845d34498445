// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/scene_graph/scaled_shape.hpp"

#include <fmt/format.h>

#include <variant>

namespace reckon::peer {
namespace {

constexpr double kFarthest = 1e6;  // [m]

void enlarge(haptics::PlaneShape&, double) {}  // a half-space has no size

void enlarge(haptics::SphereShape& sphere, double scale) { sphere.radius *= scale; }

void enlarge(haptics::BoxShape& box, double scale) { box.size *= scale; }

void enlarge(haptics::CylinderShape& cylinder, double scale) {
  cylinder.radius *= scale;
  cylinder.height *= scale;
}

void enlarge(haptics::ConeShape& cone, double scale) {
  cone.radius *= scale;
  cone.top_radius *= scale;
  cone.height *= scale;
}

void enlarge(haptics::TorusShape& torus, double scale) {
  torus.radius *= scale;
  torus.tube *= scale;
}

void enlarge(haptics::EllipsoidShape& ellipsoid, double scale) { ellipsoid.semi_axes *= scale; }

void enlarge(haptics::MeshShape& mesh, double scale) { mesh.scale_to *= scale; }

void enlarge(haptics::HeightsShape& heights, double scale) {
  heights.width *= scale;
  heights.length *= scale;
  heights.height *= scale;
  heights.base *= scale;
}

void enlarge(haptics::CsgShape& solid, double scale) {
  for (haptics::CsgPart& part : solid.parts) {
    std::visit([&](auto& shape) { enlarge(shape, scale); }, part.shape);
    part.position *= scale;
    part.rounding *= scale;
  }
}

// Scales `shape` about its origin. False for a mesh whose size is defined only by its file.
bool scale_shape(haptics::Shape& shape, double scale) {
  const auto* const mesh = std::get_if<haptics::MeshShape>(&shape);
  if (scale == 1.0) return true;
  if (mesh != nullptr && mesh->scale_to == 0.0) return false;
  std::visit([&](auto& one) { enlarge(one, scale); }, shape);
  return true;
}

}  // namespace

std::optional<std::string> put_at(const NodePose& pose, haptics::SceneObject& object) {
  object.pose.position = pose.position;
  object.pose.orientation = pose.orientation;
  if (!(pose.position.cwiseAbs().maxCoeff() <= kFarthest))
    return fmt::format("'{}' is farther than 1000 km from the origin of S: move its nodes nearer",
                       object.name);
  if (!(pose.scale >= 1e-3 && pose.scale <= 1e3))
    return fmt::format(
        "the scales of the parents of '{}' multiply to {:.3g}; the range is 0.001 to 1000",
        object.name, pose.scale);
  if (scale_shape(object.shape, pose.scale)) return std::nullopt;
  return fmt::format(
      "'{}' is a mesh without 'scale_to', and the scales of its parents multiply to {:.3g}: add "
      "'scale_to', or remove the scales",
      object.name, pose.scale);
}

}  // namespace reckon::peer
