// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The recipient tiers of a scene: the kind of each, and the places around which a peer receives its
// updates. THE list, by recipients, is in tier_foci.cpp. Part of the model loop.
#pragma once

#include <chrono>
#include <functional>
#include <span>
#include <vector>

#include "reckon/aoim/interest/subscription.hpp"
#include "reckon/aoim/tiers/tier_table.hpp"
#include "reckon/peer/scene/scene_file.hpp"
#include "reckon/peer/world/near_bodies.hpp"
#include "reckon/peer/world/owned_entities.hpp"

namespace reckon::peer {

/// Input for foci.
struct FociInputs {
  const OwnedEntities& owned;
  std::span<const aoim::Focus> sensed;   ///< cover the ranges of our entities
  std::span<const NearBodies> in_reach;  ///< bodies within reach of each of our hands
  std::chrono::nanoseconds now;
};

/// The foci of a tier, valid until the next call. One thread; must not throw.
using TierFoci = std::function<std::span<const aoim::Focus>(const FociInputs&)>;

/// The kinds of the scene's tiers with their own groups, in the order of their groups. For set-up.
[[nodiscard]] std::vector<const aoim::TierKind*> tier_kinds_of(const SceneFile& scene);

/// The foci of each tier of the scene, by its number: the cell tier first. If the budget cuts the
/// foci of our entities, the cell tier also has foci for touchable entities. For set-up.
/// @param scene outlives them
[[nodiscard]] std::vector<TierFoci> tier_foci(const SceneFile& scene);

/// Largest distance from a focus up to which groups of this tier are joined [m]. For set-up.
[[nodiscard]] double tier_radius(const SceneFile& scene, const TierConfig& tier);

}  // namespace reckon::peer
