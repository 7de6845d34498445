// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/scene/scaled_shape.hpp"

#include <variant>

namespace reckon::peer {
namespace {

void enlarge(haptics::PlaneShape&, double) {}  // a half-space is one at any size

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

}  // namespace

bool scale_shape(haptics::Shape& shape, double scale) {
  const auto* const mesh = std::get_if<haptics::MeshShape>(&shape);
  if (scale == 1.0) return true;
  if (mesh != nullptr && mesh->scale_to == 0.0) return false;
  std::visit([&](auto& one) { enlarge(one, scale); }, shape);
  return true;
}

}  // namespace reckon::peer
