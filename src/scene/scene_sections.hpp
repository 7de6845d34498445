// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The sections of a scene file, and their checks beyond single rows. Private to the scene reader.
#pragma once

#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "reckon/peer/scene/key_row.hpp"
#include "reckon/peer/scene/scene_file.hpp"

namespace reckon::peer {

struct DriverKey;

/// Initial values of an entity's force model: the defaults of [hand], without a kind.
struct TouchModel : deadreckon::ForceModel {
  TouchModel() : ForceModel(to_force_model(HandModel{})) { kind = pdu::ForceModelKind::none; }
};

/// The whole file with all sections.
[[nodiscard]] const Section<SceneFile>& file_section();
/// Tables that may occur repeatedly.
[[nodiscard]] Section<haptics::SceneObject> object_section();
[[nodiscard]] Section<haptics::SurfacePatch> patch_section();
[[nodiscard]] Section<haptics::SceneRegion> region_section();
[[nodiscard]] Section<OperatorConfig> operator_section();
[[nodiscard]] Section<Outage> outage_section();
[[nodiscard]] Section<EntityConfig> entity_section();
[[nodiscard]] Section<TouchModel> force_model_section();
[[nodiscard]] Section<DeviceConfig> device_section();
/// The key `driver`.
[[nodiscard]] Row<DeviceConfig> driver_row();
/// A key of a driver, whose value is stored by its name.
[[nodiscard]] Row<DeviceConfig> driver_key_row(const DriverKey& key);
/// Tables with their own source files.
[[nodiscard]] Section<AoimConfig> aoim_section();
[[nodiscard]] Section<NetworkConfig> network_section();
[[nodiscard]] Section<ImpairmentConfig> impairment_section();
/// Tables inside other tables.
[[nodiscard]] std::vector<Row<AoimConfig>> awareness_rows();
[[nodiscard]] std::vector<Row<AoimConfig>> cell_rows();
[[nodiscard]] Section<TierConfig> tier_section();
[[nodiscard]] Section<OriginConfig> origin_section();
[[nodiscard]] Section<DeadReckoningConfig> dead_reckoning_section();

/// Adds the keys of the effects.
void add_effects(std::vector<SceneKey>& keys);
/// Adds the keys of effects that a patch may change.
void add_patch_effects(std::vector<SceneKey>& keys);
/// Adds the keys of a program's own effects. @throws std::invalid_argument if a key already exists
void add_custom_effects(const haptics::CustomEffects& effects, std::vector<SceneKey>& keys);
/// Adds the keys of the effects of regions.
void add_region_effects(std::vector<SceneKey>& keys);

// Functions that read values depending on several keys, and report contradictions.
void check_file(TomlReader& table, SceneFile& file);
void check_hand(TomlReader& table, HandModel& hand);
void check_operator(TomlReader& table, OperatorConfig& config);
void check_dead_reckoning(TomlReader& table, DeadReckoningConfig& config);
void check_entity(TomlReader& table, EntityConfig& entity);
void check_device(TomlReader& table, DeviceConfig& device);
void check_device_driver(TomlReader& table, DeviceConfig& device);
void check_awareness(TomlReader& table, AwarenessConfig& config);
void check_cells(TomlReader& table, AoimConfig& config);
/// @param aoim the table that contains them
void check_tiers(TomlReader& aoim, const Tiers& tiers);
/// The rows of [[aoim.tier]] with these tiers, each line with its end.
[[nodiscard]] std::string tiers_text(const Tiers& tiers);
/// Reports conflicts of [aoim] with other parts of the file.
void check_aoim_of(TomlReader& file, const SceneFile& scene);

/// Reads the tables [[region]].
void read_regions(TomlReader& file, SceneFile& out);
// Reads the tables [[entity]] and [[device]], which use values from elsewhere in the file.
void read_entities(TomlReader& file, SceneFile& out);
void read_devices(TomlReader& file, SceneFile& out);

/// The one of `keys` that the table has; any other number of them is a problem, reported with
/// `what`.
std::string only_one(TomlReader& table, const std::vector<std::string_view>& keys,
                     std::string_view what);
/// The key type, by numbers or in words.
void read_entity_type(TomlReader& table, pdu::EntityType& type);
/// At most 11 printable ASCII characters; else a problem at the key marking.
void check_marking(TomlReader& table, const std::string& marking);
/// The key orientation, three angles about S's axes; the identity if it is absent.
[[nodiscard]] Eigen::Quaterniond read_orientation(TomlReader& table);
/// The keys heading, pitch and roll; nothing if all are absent.
[[nodiscard]] std::optional<Attitude> read_attitude(TomlReader& table);

/// Largest extent for which a local tangent frame is meaningful [m].
inline constexpr double kWorld = 1e6;

/// The keys heading, pitch and roll of an S, whose check reads them.
template <class S>
[[nodiscard]] std::vector<Row<S>> attitude_rows() {
  const auto no_turn = [](const S&) { return 0.0; };
  constexpr Range kTurn = within("rad", -4 * std::numbers::pi, 4 * std::numbers::pi);
  return {
      {"heading", no_turn, kTurn, "clockwise from north, seen from above"},
      {"pitch", no_turn, kTurn, "then nose up"},
      {"roll", no_turn, kTurn, "then right side down"},
  };
}

}  // namespace reckon::peer
