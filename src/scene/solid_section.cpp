// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/scene/solid_section.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <string>
#include <type_traits>
#include <variant>

#include "reckon/haptics/geometry/height_field.hpp"
#include "reckon/haptics/geometry/implicit_solid.hpp"

namespace reckon::peer {
namespace {

constexpr Range kLength = declared("m", 1e-4, 1e3);
constexpr Range kRadiusOrTip = declared("m", 0, 1e3);

/// The key of a shape.
template <class S>
constexpr std::string_view key_of() {
  using namespace haptics;
  if constexpr (std::is_same_v<S, CylinderShape>) return "cylinder";
  if constexpr (std::is_same_v<S, ConeShape>) return "cone";
  if constexpr (std::is_same_v<S, TorusShape>) return "torus";
  if constexpr (std::is_same_v<S, EllipsoidShape>) return "ellipsoid";
  return "part";
}

/// Checks whether the values make a solid; if not, a problem states the reason.
void try_solid(TomlReader& table, std::string_view key, const auto& shape) {
  try {
    const haptics::ImplicitSolid solid(shape);
  } catch (const std::invalid_argument& error) {
    table.problem(key, error.what());
  }
}

template <class... Keys>
void require_all(TomlReader& table, Keys... keys) {
  (table.require(keys), ...);
}

void check_part(TomlReader& table, haptics::CsgPart& part) {
  const std::string key = only_one(
      table, {"plane", "sphere", "box", "cylinder", "cone", "torus", "ellipsoid"}, "its shape");
  part.orientation = read_orientation(table);
  if (key.empty()) return;
  haptics::CsgPart alone;
  alone.shape = part.shape;
  try_solid(table, key, haptics::CsgShape{{alone}});
}

}  // namespace

Section<haptics::CylinderShape> cylinder_section() {
  using Shape = haptics::CylinderShape;
  return {{{"radius", &Shape::radius, kLength, "required"},
           {"height", &Shape::height, kLength, "required"}},
          [](TomlReader& table, Shape&) { require_all(table, "radius", "height"); }};
}

Section<haptics::ConeShape> cone_section() {
  using Shape = haptics::ConeShape;
  return {{{"radius", &Shape::radius, kRadiusOrTip, "required; of its base"},
           {"top_radius", &Shape::top_radius, within("m", 0, 1e3), "of its top face; 0 is a tip"},
           {"height", &Shape::height, kLength, "required"}},
          [](TomlReader& table, Shape&) { require_all(table, "radius", "height"); }};
}

Section<haptics::TorusShape> torus_section() {
  using Shape = haptics::TorusShape;
  return {{{"radius", &Shape::radius, kLength, "required; of the centre circle of its tube"},
           {"tube", &Shape::tube, kLength, "required; radius of the tube"}},
          [](TomlReader& table, Shape&) { require_all(table, "radius", "tube"); }};
}

Section<haptics::CsgPart> part_section() {
  using Part = haptics::CsgPart;
  const auto no_turn = [](const Part&) { return Eigen::Vector3d(0, 0, 0); };
  Section<Part> section{{{"operation", &Part::operation,
                          "combines it with the previous parts: add, subtract, or intersect"}},
                        check_part};
  const std::vector<Row<Part>> solids = solid_rows<Part>();
  section.rows.insert(section.rows.end(), solids.begin(), solids.end());
  const std::vector<Row<Part>> rest = {
      {"position", &Part::position, within("m", -1e3, 1e3), "of its origin, in the object's axes"},
      {"orientation", no_turn, within("rad", -4 * std::numbers::pi, 4 * std::numbers::pi),
       "rotations about the object's x, then y, then z axis"},
      {"rounding", &Part::rounding, within("m", 0, 1e3),
       "radius of the edges between it and the previous parts; 0 is sharp"},
  };
  section.rows.insert(section.rows.end(), rest.begin(), rest.end());
  return section;
}

Section<haptics::HeightsShape> heights_section() {
  using Shape = haptics::HeightsShape;
  return {
      {{"file", &Shape::file, "required; PNG or PGM of 8 or 16 bits beside the scene file"},
       {"width", &Shape::width, within("m", 1e-4, 1e3),
        "along x, between the centres of the outermost pixels"},
       {"length", &Shape::length, declared("m", 1e-4, 1e3),
        "the same along y; when absent, pixels are square"},
       {"height", &Shape::height, within("m", 0, 1e3), "of white above black; black is at z = 0"},
       {"base", &Shape::base, within("m", 1e-4, 1e3), "of black above the flat bottom"}},
      [](TomlReader& table, Shape& shape) {
        table.require("file");
        if (shape.file.empty()) return;
        try {
          static_cast<void>(haptics::heights_of(shape));
        } catch (const std::invalid_argument& error) {
          table.problem("file", error.what());
        }
      }};
}

void check_solid(TomlReader& table, const haptics::SceneObject& object) {
  const bool has_parts = std::holds_alternative<haptics::CsgShape>(object.shape);
  if (table.has("part") && !has_parts) {
    table.problem("part", "a solid needs parts: write [[object.part]] for each");
  }
  std::visit(
      [&]<class S>(const S& shape) {
        if constexpr (std::is_same_v<S, haptics::CsgShape>) {
          if (shape.parts.front().operation != haptics::CsgOperation::add) {
            return table.problem("part",
                                 "the first part has no previous part: remove its 'operation', and "
                                 "write it in a later part");
          }
          try_solid(table, key_of<S>(), shape);
        } else if constexpr (std::is_constructible_v<haptics::ImplicitSolid, S>) {
          try_solid(table, key_of<S>(), shape);
        }
      },
      object.shape);
}

}  // namespace reckon::peer
