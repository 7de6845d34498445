// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// How hands touch in the study of contacts: presses, strokes, sweeps and a tap, each with its path,
// its speed and its springs.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "reckon/haptics/devices/simulated_device.hpp"
#include "reckon/peer/scene/scene_file.hpp"

namespace reckon::bench {

/// One way of touching. Hands are in a row along x and touch at rest where nothing else is said.
struct ContactScene {
  std::string_view name;
  std::string_view meaning;
  double seconds = 0;       ///< a run lasts so long
  std::size_t hands = 2;    ///< one a peer
  double stiffness = 500;   ///< [N/m], of each hand to the others, as asked
  double stroke_hz = 0;     ///< 0: no strokes
  double strokes_from = 0;  ///< [s], from here on whole periods are measured,
  double strokes_to = 0;    ///< to here
  bool shipped = false;     ///< the two hands of scenes/two_hands.toml: a stone is there too
  haptics::HandTarget (*path)(std::size_t hand, double time) = nullptr;  ///< frame S
};

/// Those of the bench, light touch first.
[[nodiscard]] std::span<const ContactScene> contact_scenes();

/// The scene for its peers. Hands that are not `shipped`: 20 mm of radius, no friction, grips of
/// 300 N/m, nothing else there. @throws SceneFileError where the shipped one cannot be read.
[[nodiscard]] peer::SceneFile scene_of(const ContactScene& contact);

/// What moves each hand; empty: the operators of the scene do.
[[nodiscard]] std::vector<haptics::HandScript> scripts_of(const ContactScene& contact);

}  // namespace reckon::bench
