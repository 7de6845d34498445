// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Scenes of touch in the study of contacts: presses, strokes, sweeps and a tap, each with its path,
// speed and springs.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "reckon/haptics/devices/simulated_device.hpp"
#include "reckon/peer/scene/scene_file.hpp"

namespace reckon::bench {

/// One kind of touch. Hands are in a row along x and touch at rest unless stated otherwise.
struct ContactScene {
  std::string_view name;
  std::string_view meaning;
  double seconds = 0;       ///< length of a run
  std::size_t hands = 2;    ///< one for each peer
  double stiffness = 500;   ///< [N/m], of each hand towards the others, as requested
  double stroke_hz = 0;     ///< 0: no strokes
  double strokes_from = 0;  ///< [s], start of the whole periods that are measured
  double strokes_to = 0;    ///< [s], their end
  bool shipped = false;     ///< uses the two hands of scenes/two_hands.toml, which also has a stone
  haptics::HandTarget (*path)(std::size_t hand, double time) = nullptr;  ///< frame S
};

/// The scenes of the bench, light touch first.
[[nodiscard]] std::span<const ContactScene> contact_scenes();

/// The scene for its peers. Hands that are not `shipped` have a radius of 20 mm, no friction and
/// grips of 300 N/m; the scene has no other object. @throws SceneFileError if the shipped one
/// cannot be read.
[[nodiscard]] peer::SceneFile scene_of(const ContactScene& contact);

/// The script of each hand; empty: the operators of the scene move them.
[[nodiscard]] std::vector<haptics::HandScript> scripts_of(const ContactScene& contact);

}  // namespace reckon::bench
