// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A scene file for the verbs: loaded completely, with the plan for a servo.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "reckon/haptics/scene/effect_plan.hpp"
#include "reckon/peer/scene/scene_file.hpp"

namespace reckon::tools {

/// A file and the plan that a servo runs for it.
struct LoadedScene {
  peer::SceneFile file;
  haptics::EffectPlan plan;
};

/// @throws peer::SceneFileError, also if a mesh, an effect or a hand's trace is refused.
[[nodiscard]] LoadedScene load_whole_scene(const std::string& path);

/// Remarks on a valid file: cells that filter nothing, and groups left out.
[[nodiscard]] std::vector<std::string> scene_notes(const peer::SceneFile& file);

/// The hash as peers print it: 16 hexadecimal digits.
[[nodiscard]] std::string hash_text(std::uint64_t hash);

}  // namespace reckon::tools
