// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The places whose updates a peer receives by the groups of a tier, for each kind of recipients:
// THE list is in tier_foci.cpp. Part of the model loop.
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

/// What foci are made from.
struct FociInputs {
  const OwnedEntities& owned;
  std::span<const aoim::Focus> sensed;  ///< they cover the range of each entity of ours
  std::span<const NearBodies> near;     ///< bodies near each of our hands
  std::chrono::nanoseconds now;
};

/// The foci of a tier, valid until the next call. One thread; must not throw.
using TierFoci = std::function<std::span<const aoim::Focus>(const FociInputs&)>;

/// The foci of each tier of the table, the cell tier first. For set-up.
/// @param scene outlives them; the table has its tiers
[[nodiscard]] std::vector<TierFoci> tier_foci(const SceneFile& scene, const aoim::TierTable& tiers);

}  // namespace reckon::peer
