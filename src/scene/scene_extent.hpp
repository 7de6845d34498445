// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The distances between the entities and devices of a scene, and the defaults that follow from
// them.
#pragma once

#include <string>

#include "reckon/peer/scene/scene_file.hpp"

namespace reckon::peer {

/// The diagonal of the box, along the axes of S, around all entities with their whole tracks and
/// around all devices [m]; 0 without entities. Reads the tracks.
/// @throws CsvError or std::invalid_argument for a track that cannot be read
[[nodiscard]] double extent_of(const SceneFile& scene);

/// The keys of [aoim] that a file gives.
struct StatedReach {
  bool cell, radius;
};

/// Sets the size of cells and the sensing radius if the file gives none. While all entities fit
/// into the reach of hands, these are 1 m and 2 m. Else the radius is the power of ten [m] that
/// covers all, and a cell is half of it. By the power of ten, files of peers with slightly
/// different entities agree on the cells. Does nothing for tracks that cannot be read.
void set_reach_by_extent(SceneFile& scene, const StatedReach& stated);

/// A sentence about entities that no other peer of the scene senses at the start; empty if there
/// are none, or if there are more than 20,000 entities and devices, as each pair is compared.
[[nodiscard]] std::string unsensed_note(const SceneFile& scene);

}  // namespace reckon::peer
