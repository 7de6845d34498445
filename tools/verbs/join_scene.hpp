// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// `reckon peer --join`: gets the scene that is played from the peers that play it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "reckon/tools/command_line/console.hpp"
#include "reckon/tools/exercise/scene_options.hpp"

namespace reckon::tools {

/// Fetches without a question up to this size [octets]; above it asks on a terminal, and refuses
/// without one.
inline constexpr std::uint64_t kUnaskedOctets = 64'000'000;

/// Where to look for a scene.
struct JoinPlace {
  std::string group;  ///< base group of the exercise, with or without a port; "true": the default
  std::optional<std::uint64_t> exercise;  ///< absent: any; with a key 1
};

/// Gets the scene, reports from whom and how large, and names its file in `options`.
/// @throws UsageError, EnvironmentError with the remedy
void join_scene(const JoinPlace& where, SceneOptions& options, const Console& console);

}  // namespace reckon::tools
