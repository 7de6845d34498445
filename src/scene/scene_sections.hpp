// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The sections of a scene file, and what a row of theirs cannot say. Private to the scene reader.
#pragma once

#include "reckon/peer/scene/key_row.hpp"
#include "reckon/peer/scene/scene_file.hpp"

namespace reckon::peer {

/// The whole file with all that is in it.
[[nodiscard]] const Section<SceneFile>& file_section();
/// The tables that a file may have any number of.
[[nodiscard]] Section<haptics::SceneObject> object_section();
[[nodiscard]] Section<OperatorConfig> operator_section();
[[nodiscard]] Section<Outage> outage_section();

/// What the effects say of themselves.
void add_effects(std::vector<SceneKey>& keys);

// Each reads what takes more than one key, and tells what does not fit together.
void check_file(TomlReader& table, SceneFile& file);
void check_object(TomlReader& table, haptics::SceneObject& object);
void check_hand(TomlReader& table, HandModel& hand);
void check_operator(TomlReader& table, OperatorConfig& config);
void check_dead_reckoning(TomlReader& table, DeadReckoningConfig& config);
void check_aoim(TomlReader& table, AoimConfig& config);
void check_network(TomlReader& table, NetworkConfig& config);
void check_impairment(TomlReader& table, ImpairmentConfig& config);

}  // namespace reckon::peer
