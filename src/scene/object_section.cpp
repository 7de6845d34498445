// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// [[object]] and its patches: shapes, effects, and refused combinations of them.
#include <fmt/format.h>

#include <numbers>
#include <set>
#include <string>
#include <variant>
#include <vector>

#include "reckon/peer/scene/effect_reader.hpp"
#include "reckon/peer/scene/scene_sections.hpp"
#include "reckon/peer/scene/solid_section.hpp"

namespace reckon::peer {
namespace {

/// A patch inherits missing values from the object.
void read_patches(TomlReader& object_table, haptics::SceneObject& object) {
  const Section<haptics::SurfacePatch> section = patch_section();
  std::set<std::string> names;
  for (TomlReader& table : object_table.tables("patch")) {
    haptics::SurfacePatch& patch = object.patches.emplace_back();
    patch.surface = object.effects.of<haptics::SpringDamper>();
    patch.friction = object.effects.of<haptics::StickSlipFriction>();
    section.read(table, patch);
    if (!patch.name.empty() && !names.insert(patch.name).second) {
      table.problem("name", fmt::format("there is another patch '{}': keep one", patch.name));
    }
  }
}

void check_shape(TomlReader& table, const haptics::Shape& shape) {
  (void)only_one(table,
                 {"mesh", "heights", "plane", "sphere", "box", "cylinder", "cone", "torus",
                  "ellipsoid", "part"},
                 "the shape");
  for (const char* key : {"scale_to", "centre"}) {
    if (!table.has(key) || table.has("mesh")) continue;
    table.problem(key, fmt::format("'{}' needs a mesh, and this object has none", key));
  }
  if (table.has("patch") && !table.has("mesh") && !table.has("heights"))
    table.problem("patch", "'patch' needs 'mesh' or 'heights', and this object has neither");
  const auto* box = std::get_if<haptics::BoxShape>(&shape);
  if (box != nullptr && box->size.minCoeff() <= 0) {
    table.problem("box", "'box' has an edge that is not above 0 m");
  }
  const auto* plane = std::get_if<haptics::PlaneShape>(&shape);
  if (plane != nullptr && plane->normal.norm() < 1e-6) {
    table.problem("plane", "'plane' has no direction: write its outward normal, such as [0, 0, 1]");
  }
}

// A body must be bounded, and must have no patches.
void check_body(TomlReader& table, const haptics::SceneObject& object) {
  const bool is_body = object.matter.mass > 0;
  if (table.has("grab") && !is_body)
    table.problem("grab", "only a body sticks to a hand: add a mass, or remove it");
  if (table.has("grab") && !(object.grab.stiffness > 0))
    table.problem("grab", "needs a stiffness to hold: add stiffness = \"200 N/m\"");
  if (!is_body) return;
  if (std::holds_alternative<haptics::PlaneShape>(object.shape))
    table.problem("mass", "a plane is infinite and cannot move: use a box, or remove the mass");
  if (table.has("patch"))
    table.problem("patch", "a body has the same surface everywhere: remove patch or the mass");
}

void check_object(TomlReader& table, haptics::SceneObject& object) {
  table.require("name");
  check_shape(table, object.shape);
  check_body(table, object);
  check_solid(table, object);
  object.pose.orientation = read_orientation(table);
  read_effects(table, object.effects);
  read_custom_effects<haptics::GuardedEffect>(table, object.name, object.custom_effects);
  read_patches(table, object);
}

void check_patch(TomlReader& table, haptics::SurfacePatch& patch) {
  using haptics::SpringDamper;
  using haptics::StickSlipFriction;
  table.require("name");
  if (auto surface = table.table(SpringDamper::kKey)) {
    read_parameters<SpringDamper>(table, *surface, patch.surface);
  }
  if (auto friction = table.table(StickSlipFriction::kKey)) {
    if (!patch.friction) patch.friction.emplace();
    read_parameters<StickSlipFriction>(table, *friction, *patch.friction);
  }
}

}  // namespace

Section<haptics::SurfacePatch> patch_section() {
  return {{
              {"name", &haptics::SurfacePatch::name,
               "required; of a material or group of the mesh file"},
          },
          check_patch,
          add_patch_effects};
}

namespace {

Section<haptics::GrabSpring> grab_section() {
  using haptics::GrabSpring;
  return {{
      {"stiffness", &GrabSpring::stiffness, within("N/m", 0, 1e5),
       "of its spring, limited by device and body"},
      {"viscosity", &GrabSpring::viscosity, within("N s/m", 0, 100), "of its spring"},
      {"most", &GrabSpring::most, declared("N", 1e-3, 1e3),
       "a greater pull tears it off; absent: it holds any pull"},
  }};
}

}  // namespace

Section<haptics::SceneObject> object_section() {
  using Object = haptics::SceneObject;
  const auto patches = [](const Object& object) { return object.patches; };
  const auto no_turn = [](const Object&) { return Eigen::Vector3d(0, 0, 0); };
  const auto no_node = [](const Object&) { return std::string(); };
  Section<Object> section{
      {
          {"name", &Object::name, "required; unique"},
          {"mesh", of_shape(&haptics::MeshShape::file),
           "an OBJ, PLY, STL or OFF file beside the scene file"},
          {"heights", as_shape<haptics::HeightsShape>(), heights_section(),
           "a block whose upper side follows a height image; its centre is the origin"},
      },
      check_object,
      add_effects};
  const std::vector<Row<Object>> solids = solid_rows<Object>();
  section.rows.insert(section.rows.end(), solids.begin(), solids.end());
  const std::vector<Row<Object>> rest = {
      {"part", of_shape(&haptics::CsgShape::parts), part_section(),
       "one part of a solid; parts are combined in order"},
      {"scale_to", of_shape(&haptics::MeshShape::scale_to), declared("m", 1e-4, 1e3),
       "mesh: it is scaled to this diagonal of its bounding box; when absent, its units are "
       "metres"},
      {"centre", of_shape(&haptics::MeshShape::centre),
       "mesh: moves its origin to the centre of its bounding box"},
      {"position", in(&Object::pose, &haptics::ObjectPose::position), within("m", -kWorld, kWorld),
       "of its origin, in S or in its node"},
      {"orientation", no_turn, within("rad", -4 * std::numbers::pi, 4 * std::numbers::pi),
       "rotations about the x, then y, then z axis of S or of its node"},
      {"node", no_node, "its parent [[node]]; absent: none, it stands in S"},
      {"mass", in(&Object::matter, &haptics::Matter::mass), declared("kg", 1e-3, 1e3),
       "makes a box, sphere, solid or closed mesh a movable body; absent: it stands still"},
      {"body_friction", in(&Object::matter, &haptics::Matter::friction), within("", 0, 10),
       "coefficient between bodies and to fixed objects; a pair uses the geometric mean"},
      {"restitution", in(&Object::matter, &haptics::Matter::restitution), within("", 0, 1),
       "share of its speed that a body keeps in a collision; a pair uses the greater value"},
      {"body_drag", in(&Object::matter, &haptics::Matter::drag), within("N s/m", 0, 1e3),
       "body: drag force per m/s"},
      {"grab", &Object::grab, grab_section(),
       "body: it sticks to the hand that touches it, until it is torn off"},
      {"patch", patches, patch_section(),
       "mesh: the faces of a material or group with other properties; heights: top, side or "
       "bottom"},
  };
  section.rows.insert(section.rows.end(), rest.begin(), rest.end());
  return section;
}

}  // namespace reckon::peer
