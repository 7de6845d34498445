// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A scene file as the verbs look at it: read whole, with the plan of what a servo runs for it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "reckon/haptics/scene/effect_plan.hpp"
#include "reckon/peer/scene/scene_file.hpp"

namespace reckon::tools {

/// A file with the plan of what a servo runs for it.
struct LoadedScene {
  peer::SceneFile file;
  haptics::EffectPlan plan;
};

/// @throws peer::SceneFileError, also where a mesh, an effect or a hand's trace is refused.
[[nodiscard]] LoadedScene load_whole_scene(const std::string& path);

/// What a good file still wants to have said: cells that filter nothing, and groups left out.
[[nodiscard]] std::vector<std::string> scene_notes(const peer::SceneFile& file);

/// As peers show it: 16 hexadecimal digits.
[[nodiscard]] std::string hash_text(std::uint64_t hash);

}  // namespace reckon::tools
