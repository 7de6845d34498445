// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Implicit solids in a scene file: cylinder, cone, torus, ellipsoid, and the parts of a composite
// solid. Private to the scene reader.
#pragma once

#include <variant>
#include <vector>

#include "reckon/peer/scene/scene_sections.hpp"

namespace reckon::peer {

/// The shape of an object or of a part, set to kind S.
template <class S>
auto as_shape() {
  return [](auto& owner) -> S& {
    if (!std::holds_alternative<S>(owner.shape)) owner.shape = S{};
    return std::get<S>(owner.shape);
  };
}

/// A member of that shape.
template <class S, class T>
auto of_shape(T S::*member) {
  return [member](auto& owner) -> T& { return as_shape<S>()(owner).*member; };
}

[[nodiscard]] Section<haptics::CylinderShape> cylinder_section();
[[nodiscard]] Section<haptics::ConeShape> cone_section();
[[nodiscard]] Section<haptics::TorusShape> torus_section();
[[nodiscard]] Section<haptics::CsgPart> part_section();
[[nodiscard]] Section<haptics::HeightsShape> heights_section();

/// The shape keys common to objects and parts.
template <class Owner>
[[nodiscard]] std::vector<Row<Owner>> solid_rows() {
  return {
      {"plane", of_shape(&haptics::PlaneShape::normal), declared("", -1e6, 1e6),
       "a half-space; its outward normal, as [0, 0, 1]"},
      {"sphere", of_shape(&haptics::SphereShape::radius), declared("m", 1e-4, 1e3),
       "radius of a sphere"},
      {"box", of_shape(&haptics::BoxShape::size), declared("m", -1e3, 1e3),
       "edge lengths of a box about its centre"},
      {"cylinder", as_shape<haptics::CylinderShape>(), cylinder_section(),
       "about z, the origin at its centre"},
      {"cone", as_shape<haptics::ConeShape>(), cone_section(),
       "cone or frustum about z, base down, the origin at half its height"},
      {"torus", as_shape<haptics::TorusShape>(), torus_section(), "a ring about z"},
      {"ellipsoid", of_shape(&haptics::EllipsoidShape::semi_axes), declared("m", -1e3, 1e3),
       "its semi-axes along x, y and z"},
  };
}

/// Checks the values of these keys beyond single ranges.
void check_solid(TomlReader& table, const haptics::SceneObject& object);

}  // namespace reckon::peer
