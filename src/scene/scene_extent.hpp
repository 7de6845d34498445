// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// How far the entities and devices of a scene are apart, and the defaults that follow from it.
#pragma once

#include <string>

#include "reckon/peer/scene/scene_file.hpp"

namespace reckon::peer {

/// The diagonal of the box, along the axes of S, around all entities with their whole tracks and
/// around all devices [m]; 0 without entities. Reads the tracks.
/// @throws CsvError or std::invalid_argument for a track that cannot be read
[[nodiscard]] double extent_of(const SceneFile& scene);

/// Which keys of [aoim] a file has.
struct StatedReach {
  bool cell, radius;
};

/// Sets the size of cells and the sensing radius where the file states none: 1 m and 2 m, the reach
/// of hands, while all entities fit in there; beyond that the radius is the power of ten [m] that
/// holds them all, and a cell half of it. A power of ten, so that files of peers whose entities lie
/// somewhat differently agree on the cells. Does nothing for tracks that cannot be read.
void set_reach_by_extent(SceneFile& scene, const StatedReach& stated);

/// A sentence about entities that no other peer of the scene senses where all are at the start;
/// empty if there are none, or if entities and devices are more than 20,000: each pair is compared.
[[nodiscard]] std::string unsensed_note(const SceneFile& scene);

}  // namespace reckon::peer
