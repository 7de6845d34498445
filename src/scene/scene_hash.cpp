// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The hash by which peers compare their scenes.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <type_traits>
#include <vector>

#include "reckon/haptics/effects/effect_types.hpp"
#include "reckon/haptics/input_files/input_file.hpp"
#include "reckon/peer/scene/scene_cells.hpp"
#include "reckon/peer/scene/scene_file.hpp"
#include "reckon/peer/scene/scene_words.hpp"
#include "reckon/peer/scene/toml_reader.hpp"

namespace reckon::peer {
namespace {

/// FNV-1a, 64 bits: not cryptographic, the same on every host.
class Hash {
 public:
  void bytes(std::string_view text) {
    for (const char letter : text) {
      value_ = (value_ ^ static_cast<unsigned char>(letter)) * 0x100000001B3ULL;
    }
  }

  /// Adds one named value. A mark ends it, so that "ab" "c" and "a" "bc" differ.
  void fact(std::string_view name, std::string_view value) {
    bytes(name);
    bytes({"\0", 1});
    bytes(value);
    bytes({"\n", 1});
  }

  /// Twelve digits: the same quantity in other units rounds differently in the last ones.
  void fact(std::string_view name, double value) {
    fact(name, fmt::format("{:.12g}", value == 0.0 ? 0.0 : value));
  }

  void fact(std::string_view name, const Eigen::Vector3d& v) {
    for (const double component : v) fact(name, component);
  }

  /// Adds the content of a file, which is read once for all objects that name it.
  void content(std::string_view name, const std::filesystem::path& file) {
    const auto [entry, is_new] = contents_.try_emplace(file);
    if (is_new) {
      Hash octets;
      octets.bytes(read_bytes(file, haptics::kMostMeshOctets));
      entry->second = fmt::format("{:016x}", octets.value());
    }
    fact(name, entry->second);
  }

  [[nodiscard]] std::uint64_t value() const { return value_; }

 private:
  std::map<std::filesystem::path, std::string> contents_;
  std::uint64_t value_ = 0xCBF29CE484222325ULL;
};

void add(Hash& hash, const haptics::PlaneShape& plane) {
  hash.fact("plane", plane.normal.normalized());
}

void add(Hash& hash, const haptics::SphereShape& sphere) { hash.fact("sphere", sphere.radius); }

void add(Hash& hash, const haptics::BoxShape& box) { hash.fact("box", box.size); }

void add(Hash& hash, const haptics::MeshShape& mesh) {
  hash.content("mesh", mesh.file);
  hash.fact("scale_to", mesh.scale_to);
  hash.fact("centre", mesh.centre ? "true" : "false");
}

void add(Hash& hash, const haptics::HeightsShape& heights) {
  hash.content("heights", heights.file);
  hash.fact("width", heights.width);
  hash.fact("length", heights.length);
  hash.fact("height", heights.height);
  hash.fact("base", heights.base);
}

void add(Hash& hash, const haptics::CylinderShape& cylinder) {
  hash.fact("cylinder", cylinder.radius);
  hash.fact("height", cylinder.height);
}

void add(Hash& hash, const haptics::ConeShape& cone) {
  hash.fact("cone", cone.radius);
  hash.fact("top_radius", cone.top_radius);
  hash.fact("height", cone.height);
}

void add(Hash& hash, const haptics::TorusShape& torus) {
  hash.fact("torus", torus.radius);
  hash.fact("tube", torus.tube);
}

void add(Hash& hash, const haptics::EllipsoidShape& ellipsoid) {
  hash.fact("ellipsoid", ellipsoid.semi_axes);
}

/// As a matrix, because a quaternion and its negative are the same orientation; differences below
/// 1e-9 are ignored.
void add(Hash& hash, const Eigen::Quaterniond& orientation) {
  const Eigen::Matrix3d rotation = orientation.normalized().toRotationMatrix();
  for (const double entry : rotation.reshaped()) {
    hash.fact("orientation", std::round(entry * 1e9) / 1e9);
  }
}

void add(Hash& hash, const haptics::CsgShape& solid) {
  for (const haptics::CsgPart& part : solid.parts) {
    hash.fact("part", word_of(part.operation));
    std::visit([&](const auto& shape) { add(hash, shape); }, part.shape);
    hash.fact("position", part.position);
    add(hash, part.orientation);
    hash.fact("rounding", part.rounding);
  }
}

template <class Effect>
void add_values(Hash& hash, const typename Effect::Parameters& values) {
  hash.fact("effect", Effect::kName);
  if constexpr (haptics::TakesFile<Effect>) {
    if (!values.file.empty()) hash.content(Effect::kFile.key, values.file);
  }
  for (const auto& row : Effect::kParameters) hash.fact(row.key, values.*row.field);
}

template <class Types>
void add_effects_of(Hash& hash, const haptics::EffectDeclarations<Types>& effects) {
  haptics::for_each_effect<Types>([&]<class Effect>(std::type_identity<Effect>) {
    if (const auto* values = effects.template find<Effect>()) add_values<Effect>(hash, *values);
  });
}

/// The code of an effect cannot be hashed, only its name and parameters.
void add_custom_effects_of(Hash& hash, const auto& owner) {
  for (const auto& declared : owner.custom_effects) {
    hash.fact("custom effect", declared.effect->name());
    for (std::size_t i = 0; i < declared.values.size(); ++i)
      hash.fact(declared.effect->parameters()[i].key, declared.values[i]);
  }
}

/// In the order of their names, because the order in a file has no meaning.
void add_patches(Hash& hash, std::vector<haptics::SurfacePatch> patches) {
  std::ranges::sort(patches, {}, &haptics::SurfacePatch::name);
  for (const haptics::SurfacePatch& patch : patches) {
    hash.fact("patch", patch.name);
    add_values<haptics::SpringDamper>(hash, patch.surface);
    if (patch.friction) add_values<haptics::StickSlipFriction>(hash, *patch.friction);
  }
}

/// For equal cells their size; for others the resulting cells, independent of their spelling.
void add_cells(Hash& hash, const AoimConfig& aoim) {
  const auto cells = uneven_cells(aoim);
  if (!cells) hash.fact("cell", aoim.cell);
  if (const auto* tree = cells ? cells->as<aoim::QuadTree>() : nullptr) {
    hash.fact("x", tree->config().centre.x);
    hash.fact("y", tree->config().centre.y);
    hash.fact("side", tree->config().side);
    for (const aoim::CellId leaf : tree->leaves()) hash.fact("leaf", aoim::QuadTree::path_of(leaf));
  }
  const auto* map = cells ? cells->as<aoim::LocaleMap>() : nullptr;
  if (map == nullptr) return;
  for (const aoim::Locale& locale : map->locales()) {
    for (const double value : {locale.origin.x, locale.origin.y, locale.origin.z, locale.yaw,
                               locale.half_x, locale.half_y, locale.half_z})
      hash.fact("locale", value);
    for (const std::uint16_t neighbour : locale.neighbours)
      hash.fact("neighbour", static_cast<double>(neighbour));
  }
}

/// The tiers with own groups and their accuracy: the groups follow from the rows.
void add_own_groups(Hash& hash, const Tiers& tiers) {
  hash.fact("near_groups", "true");
  for (const aoim::Channel& row : channels_of(tiers)) {
    hash.fact("farthest", row.farthest);
    hash.fact("kept", row.kept ? "true" : "false");
    hash.fact("coarser", row.coarser);
  }
}

void add(Hash& hash, const haptics::SceneObject& object) {
  hash.fact("object", object.name);
  std::visit([&](const auto& shape) { add(hash, shape); }, object.shape);
  hash.fact("position", object.pose.position);
  add(hash, object.pose.orientation);
  add_effects_of(hash, object.effects);
  add_custom_effects_of(hash, object);
  add_patches(hash, object.patches);
}

void add_bodies(Hash& hash, const haptics::Scene& scene) {
  bool any = false;
  for (const haptics::SceneObject& object : scene.objects) any = any || object.matter.mass > 0;
  if (!any) return;
  hash.fact("gravity", scene.gravity);
  hash.fact("work space", scene.work_space.size);
  hash.fact("work space position", scene.work_space.position);
  hash.fact("work space restitution", scene.work_space.restitution);
  for (const haptics::SceneObject& object : scene.objects) {
    hash.fact("mass", object.matter.mass);
    hash.fact("body friction", object.matter.friction);
    hash.fact("restitution", object.matter.restitution);
    hash.fact("drag", object.matter.drag);
  }
}

void add(Hash& hash, const NodeMotion& motion) {
  hash.fact("turn_axis", motion.turn_axis.normalized());
  hash.fact("turn_rate", motion.turn_rate);
  hash.fact("swing", motion.swing);
  hash.fact("swing_rate", motion.swing_rate);
  hash.fact("swing_phase", motion.swing_phase);
}

/// With copies expanded, so that a file may also write them out.
void add(Hash& hash, const SceneGraph& graph) {
  for (NodeIndex node = 0; node < graph.size(); ++node) {
    hash.fact("node", graph.name(node));
    if (graph.parent(node) != kNoNode) hash.fact("parent", graph.name(graph.parent(node)));
    hash.fact("kind", word_of(graph.kind(node)));
    hash.fact("position", graph.rest(node).position);
    add(hash, graph.rest(node).orientation);
    hash.fact("scale", graph.rest(node).scale);
    if (const NodeMotion* const motion = graph.motion(node)) add(hash, *motion);
    if (graph.kind(node) == NodeKind::switch_ && graph.chosen(node) != kNoNode)
      hash.fact("shows", graph.name(graph.chosen(node)));
    if (std::isfinite(graph.farthest(node))) hash.fact("farthest", graph.farthest(node));
  }
}

void add(Hash& hash, const haptics::SceneRegion& region) {
  hash.fact("region", region.name);
  if (region.shape) std::visit([&](const auto& shape) { add(hash, shape); }, *region.shape);
  hash.fact("position", region.pose.position);
  add(hash, region.pose.orientation);
  add_effects_of(hash, region.effects);
  add_custom_effects_of(hash, region);
}

}  // namespace

std::uint64_t scene_hash(const SceneFile& file) {
  Hash hash;
  hash.fact("latitude", file.origin.latitude);
  hash.fact("longitude", file.origin.longitude);
  hash.fact("height", file.origin.height);
  hash.fact("scheme", word_of(file.aoim.scheme));
  add_cells(hash, file.aoim);
  hash.fact("pool", static_cast<double>(file.aoim.pool));
  if (has_distance_tiers(file.aoim.tiers)) hash.fact("channels", "by distance");
  // The default is not added, so that scenes without the key keep their hash.
  if (file.dead_reckoning.acceleration != deadreckon::AccelerationReading::component_rate) {
    hash.fact("acceleration", word_of(file.dead_reckoning.acceleration));
  }
  if (file.aoim.leaders) hash.fact("leaders", "true");
  if (file.aoim.hand_out) hash.fact("hand_out", "true");
  if (has_touch_tier(file.aoim.tiers)) hash.fact("contact_groups", "true");
  if (own_group_count(file.aoim.tiers) > 0) add_own_groups(hash, file.aoim.tiers);
  if (file.network.compression != pdu::CompressedForm::none) {
    hash.fact("compression", word_of(file.network.compression));
  }
  for (const haptics::SceneObject& object : file.scene.objects) add(hash, object);
  add_bodies(hash, file.scene);
  add(hash, file.nodes.graph);
  for (const haptics::SceneRegion& region : file.scene.regions) add(hash, region);
  return hash.value();
}

}  // namespace reckon::peer
