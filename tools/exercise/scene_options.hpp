// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The flags that change a scene before a demo or a peer runs it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "reckon/peer/scene/scene_file.hpp"
#include "reckon/peer/step_cost/step_too_dear.hpp"
#include "reckon/tools/command_line/command_line.hpp"

namespace reckon::tools {

/// Scene options of the command line.
struct SceneOptions {
  std::string scene;   ///< file; empty: the shipped scene
  std::string mesh;    ///< replaces the first object's shape
  std::string hand;    ///< hand trace that the hands follow
  std::string impair;  ///< see impairment_text.hpp
  std::string iface;
  std::string key;  ///< key file of a sealed exercise
  std::optional<std::uint64_t> seed;
  bool is_received = false;          ///< from other peers: see peer::load_received_scene
  bool even_if_slow = false;         ///< see FederateOptions
  double pace = 0.0;                 ///< FederateOptions::body_pace; 0: absent
  haptics::CustomEffects effects{};  ///< of the program that reads the scene
};

/// Declares --mesh, --hand, --impair, --seed, --iface, --key, --even-if-slow and --pace.
void add_scene_options(CommandLine& line, SceneOptions& options);

/// The problem of the scene, and the remedy.
[[nodiscard]] std::string refusal_of(const peer::StepTooDear& slow);

/// Whether the impairment uses random numbers.
[[nodiscard]] bool draws_by_seed(const peer::ImpairmentLaw& law) noexcept;

/// options.pace for FederateOptions.
[[nodiscard]] std::optional<double> pace_of(const SceneOptions& options) noexcept;

/// Reads the scene, applies the options, and opens every file that `hands` hands need.
/// @param shipped default scene. @throws UsageError with the place and the remedy.
[[nodiscard]] peer::SceneFile load_scene(const SceneOptions& options, std::string_view shipped,
                                         std::size_t hands);

}  // namespace reckon::tools
