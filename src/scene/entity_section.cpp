// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// [[entity]]: an entity that a peer owns, without a device.
#include <fmt/format.h>

#include <optional>
#include <set>
#include <string>
#include <type_traits>
#include <vector>

#include "reckon/aoim/leader/beacon_book.hpp"
#include "reckon/deadreckon/motion/geocentric.hpp"
#include "reckon/deadreckon/sending/update_policy.hpp"
#include "reckon/pdu/seconds.hpp"
#include "reckon/peer/notation/beacon_names.hpp"
#include "reckon/peer/notation/entity_type_text.hpp"
#include "reckon/peer/scene/belongings.hpp"
#include "reckon/peer/scene/scene_sections.hpp"
#include "reckon/peer/tracks/entity_track.hpp"

namespace reckon::peer {
namespace {

constexpr double kJitter = 1.1;  // a heartbeat is sent after at most this multiple of its period

void check_force_model(TomlReader& table, TouchModel& model) {
  table.require("kind");
  if (model.normal.norm() < 1e-6) {
    table.problem("normal",
                  "'normal' has no direction: write the outward normal, such as [0, 0, -1] for up");
  } else {
    model.normal.normalize();
  }
  if (model.kinetic_friction > model.static_friction) {
    table.problem("kinetic_friction",
                  fmt::format("'kinetic_friction' ({}) is above 'static_friction' ({}): lower it",
                              model.kinetic_friction, model.static_friction));
  }
}

/// A rule given here does not inherit the parameters of the scene's rule.
void check_own_rule(TomlReader& table, DeadReckoningConfig& config) {
  deadreckon::for_each_send_rule([&]<class Rule>(std::type_identity<Rule>) {
    if (config.rule->name == Rule::kName) return;
    for (const auto& row : Rule::kParameters) {
      if (!table.has(row.key)) config.thresholds.of<Rule>().*row.field = row.default_value;
    }
  });
  check_dead_reckoning(table, config);
}

/// Keys as in [dead_reckoning], except the one that all peers share.
Section<DeadReckoningConfig> own_dead_reckoning_section() {
  Section<DeadReckoningConfig> section{{}, check_own_rule};
  for (const auto& row : dead_reckoning_section().rows) {
    if (row.key().key != "acceleration") section.rows.push_back(row.without_default());
  }
  return section;
}

void read_force_model(TomlReader& table, EntityConfig& entity) {
  static const Section<TouchModel> section = force_model_section();
  if (auto inside = table.table("force_model")) {
    TouchModel model;
    section.read(*inside, model);
    entity.model = model;
  }
  if (table.has("power") && !table.has("force_model")) {
    table.problem("power", "'power' needs a force_model, and this entity has none");
  }
}

void read_place(TomlReader& table, const deadreckon::LocalFrame& frame, EntityConfig& entity) {
  static const Section<OriginConfig> section = origin_section();
  auto inside = table.table("place");
  if (!inside) return;
  OriginConfig place;
  inside->require("latitude");
  inside->require("longitude");
  section.read(*inside, place);
  if (table.has("position")) {
    return table.problem("place", "the position is given twice, by position and place: keep one");
  }
  entity.position = frame.scene_from_world(
      deadreckon::geocentric_position(place.latitude, place.longitude, place.height));
  if (inside->has("latitude") && inside->has("longitude") && entity.position.norm() > kWorld) {
    table.problem(
        "place",
        fmt::format("'place' is {} from the scene's origin; it must be within {}",
                    format_quantity(entity.position.norm(), "m"), format_quantity(kWorld, "m")));
  }
}

/// The scene's settings, except defaults for an entity that is not felt.
DeadReckoningConfig inherited(const DeadReckoningConfig& scene, const EntityConfig& entity) {
  DeadReckoningConfig config = scene;
  if (entity.model) return config;
  const deadreckon::Thresholds standard;
  config.thresholds.position = standard.position;
  config.thresholds.angle = standard.angle;
  config.heartbeat =
      to_nanoseconds(deadreckon::nominal_heartbeat(entity.type, entity.track.empty()));
  return config;
}

void read_dead_reckoning(TomlReader& table, const DeadReckoningConfig& scene,
                         EntityConfig& entity) {
  static const Section<DeadReckoningConfig> section = own_dead_reckoning_section();
  entity.dead_reckoning = inherited(scene, entity);
  if (auto inside = table.table("dead_reckoning")) section.read(*inside, entity.dead_reckoning);
  if (!entity.model) return;
  const double needed = kJitter * pdu::to_seconds(entity.dead_reckoning.heartbeat);
  if (entity.model->validity >= needed) return;
  table.problem("force_model",
                fmt::format("its force fades out {} after an update, and the heartbeat is {}: "
                            "raise 'validity' to {} or lower the heartbeat",
                            format_quantity(entity.model->validity, "s"),
                            format_quantity(needed, "s"), format_quantity(needed, "s")));
}

/// @param checked files that were already read
void check_track(TomlReader& table, std::set<std::filesystem::path>& checked,
                 const EntityConfig& entity) {
  for (const char* key : {"speed", "repeat"}) {
    if (!table.has(key) || table.has("track")) continue;
    table.problem(key, fmt::format("'{}' needs a track, and this entity has none", key));
  }
  if (entity.track.empty() || !checked.insert(entity.track).second) return;
  try {
    (void)read_track_samples(entity.track);
  } catch (const CsvError& error) {
    table.problem("track", fmt::format("'track': {}", error.what()));
  }
}

}  // namespace

void read_entity_type(TomlReader& table, pdu::EntityType& type) {
  std::optional<std::string> text;
  table.read("type", text);
  if (!text) return;
  const EntityTypeText parsed = parse_entity_type(*text);
  if (!parsed.good()) {
    return table.problem("type", fmt::format("'type' is \"{}\": {}", *text, parsed.error));
  }
  type = parsed.type;
}

Section<TouchModel> force_model_section() {
  using Model = TouchModel;
  return {
      {
          {"kind", &Model::kind,
           "required; sphere: a ball about `point`; plane: the half-space below `point`; field: a "
           "ball that only the centre of the hand feels; region: a round patch of a plane"},
          {"radius", &Model::radius, within("m", 1e-4, 1e3), "of sphere, field or region"},
          {"k1", &Model::k1, within("N/m", 0, 1e6),
           "stiffness; each receiver limits it to that of its device"},
          {"k3", &Model::k3, within("N/m3", 0, 1e13), "hardening: F = k1 d + k3 d^3"},
          {"damping", &Model::damping, within("N s/m", 0, 1e4), "along the contact normal"},
          {"static_friction", &Model::static_friction, within("", 0, 10),
           "coefficient, at least kinetic_friction"},
          {"kinetic_friction", &Model::kinetic_friction, within("", 0, 10),
           "coefficient; 0 is no friction"},
          {"point", &Model::point, within("m", -1e4, 1e4),
           "centre or touched point, body axes (forward, right, down)"},
          {"normal", &Model::normal, within("", -1e6, 1e6),
           "outwards, body axes; the default is up"},
          {"validity", &Model::validity, within("s", 12, 65),
           "the force fades out after this time without an update"},
          {"mass", &Model::mass, within("kg", 0, 1e9), "of the entity; 0: not stated"},
          {"restitution", &Model::restitution, within("", 0, 1), "0 plastic, 1 elastic"},
      },
      check_force_model};
}

void check_beacon(TomlReader& table, const SceneFile& scene, const EntityConfig& entity,
                  std::set<std::uint32_t>& tags) {
  if (!table.has("beacon")) return;
  if (!is_beacon_name(entity.beacon)) {
    return table.problem(
        "beacon", fmt::format("'beacon' is \"{}\"; use 1 to {} letters, digits, '-', '_', '.'",
                              entity.beacon, kLongestBeacon));
  }
  if (!scene.aoim.hand_out) {
    return table.problem(
        "beacon",
        "'beacon' needs assigned groups: set 'leaders' and 'hand_out' of [aoim], or remove it");
  }
  if (!tags.insert(aoim::beacon_tag(entity.beacon)).second) {
    table.problem("beacon", fmt::format("there is another beacon '{}': rename one", entity.beacon));
  }
}

void check_entity(TomlReader& table, EntityConfig& entity) {
  check_marking(table, entity.marking);
  read_entity_type(table, entity.type);
  read_force_model(table, entity);
  const auto attitude = read_attitude(table);
  if (attitude) entity.orientation = orientation_of(*attitude);
  entity.turns = !attitude;
}

Section<EntityConfig> entity_section() {
  using Entity = EntityConfig;
  const auto text = [](const Entity&) { return std::string(); };
  const auto place = [](const Entity&) { return OriginConfig(); };
  const auto dead_reckoning = [](const Entity&) { return DeadReckoningConfig(); };
  const auto model = [](const Entity&) { return TouchModel(); };
  constexpr double kWord = 4294967295.0;
  Section<Entity> section{
      {
          {"peer", &Entity::peer, within("", 1, kMostPeers), "number of its owner"},
          {"marking", &Entity::marking, "at most 11 printable ASCII characters"},
          {"type", text,
           "kind.domain.country.category.subcategory.specific.extra as numbers, missing ones 0, or "
           "in words, as `reckon inspect` prints them: \"Platform Land United States Tank\""},
          {"force_id", &Entity::force_id, within("", 0, 255), "its force ID"},
          {"appearance", &Entity::appearance, within("", 0, kWord), "bits as on the wire"},
          {"capabilities", &Entity::capabilities, within("", 0, kWord), "bits as on the wire"},
          {"position", &Entity::position, within("m", -kWorld, kWorld),
           "in S; with a track: added to every point"},
          {"place", place, origin_section(), "instead of `position`: its geodetic position"},
      },
      check_entity};
  const std::vector<Row<Entity>> attitude = attitude_rows<Entity>();
  section.rows.insert(section.rows.end(), attitude.begin(), attitude.end());
  const std::vector<Row<Entity>> rest = {
      {"track", &Entity::track,
       "its motion, CSV with t_s,px_m,py_m,pz_m and optionally qw,qx,qy,qz or heading_rad, beside "
       "the scene file"},
      {"speed", &Entity::speed, within("", 0.01, 100), "of the track; 2 is twice as fast"},
      {"repeat", &Entity::repeat,
       "the track starts again at its end, otherwise the entity stays there; when absent: true if "
       "its ends meet"},
      {"dead_reckoning", dead_reckoning, own_dead_reckoning_section(),
       "error of remote copies at which an update is sent"},
      {"force_model", model, force_model_section(),
       "force that hands feel; when absent, they pass through it"},
      {"power", &Entity::power, within("W", 0, 1e3),
       "greatest power that it gives to hands while it moves"},
      {"beacon", &Entity::beacon,
       "with `hand_out`: a unique name by which peers find its current cell: letters, digits, '-', "
       "'_', '.'"},
  };
  section.rows.insert(section.rows.end(), rest.begin(), rest.end());
  return section;
}

void read_entities(TomlReader& file, SceneFile& out) {
  static const Section<EntityConfig> section = entity_section();
  const deadreckon::LocalFrame frame(out.origin.latitude, out.origin.longitude, out.origin.height);
  std::set<std::filesystem::path> checked_tracks;
  std::set<std::uint32_t> tags;
  for (TomlReader& table : file.tables("entity")) {
    EntityConfig& entity = out.entities.emplace_back();
    section.read(table, entity);
    read_place(table, frame, entity);
    read_dead_reckoning(table, out.dead_reckoning, entity);
    check_track(table, checked_tracks, entity);
    check_beacon(table, out, entity, tags);
  }
}

}  // namespace reckon::peer
