// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/loops/tier_foci.hpp"

#include <algorithm>
#include <iterator>
#include <memory>

#include "reckon/peer/loops/contact_foci.hpp"
#include "reckon/peer/scene/scene_words.hpp"

namespace reckon::peer {
namespace {

using Foci = std::span<const aoim::Focus>;

TierFoci sensed(const SceneFile&) {
  return [](const FociInputs& inputs) { return inputs.sensed; };
}

double row_end(const SceneFile& scene, const TierConfig& tier) {
  return std::min(tier.channel.farthest, scene.aoim.radius);
}

// The places where we can touch and be touched. The search for entities that our hands could touch
// also finds large entities whose surface, but not origin, is within reach.
TierFoci touchable(const SceneFile& scene) {
  const auto foci = std::make_shared<ContactFoci>(scene);
  return [foci](const FociInputs& inputs) -> Foci {
    foci->clear();
    for (const EntityNumber number : inputs.owned.touchable())
      foci->add(*inputs.owned.find(number));
    for (const NearBodies& of_hand : inputs.in_reach) {
      for (const NearBody& body : of_hand.bodies()) {
        if (body.row != nullptr) foci->add_near(body.row->predicted(inputs.now).position);
      }
    }
    return foci->foci();
  };
}

// Felt entities are received regardless of the budget.
TierFoci of_cells(const SceneFile& scene) {
  if (!(scene.aoim.awareness.budget > 0.0)) return sensed(scene);
  const auto both = std::make_shared<std::vector<aoim::Focus>>();
  return [both, touch = touchable(scene)](const FociInputs& inputs) -> Foci {
    const auto is_cut = [](const aoim::Focus& focus) { return focus.cut < focus.radius; };
    if (!std::ranges::any_of(inputs.sensed, is_cut)) return inputs.sensed;
    both->assign(inputs.sensed.begin(), inputs.sensed.end());
    const Foci touched = touch(inputs);
    both->insert(both->end(), touched.begin(), touched.end());
    return *both;
  };
}

double reach_of_hands(const SceneFile& scene, const TierConfig&) {
  return contact_reach(scene.hand);
}

struct RecipientsRow {
  Recipients to;
  const aoim::TierKind* kind;
  TierFoci (*foci)(const SceneFile& scene);
  double (*radius)(const SceneFile& scene, const TierConfig& tier);
};

// THE list.
constexpr RecipientsRow kRows[]{{Recipients::distance, &aoim::kDistanceKind, sensed, row_end},
                                {Recipients::touch, &aoim::kTouchKind, touchable, reach_of_hands}};

constexpr const RecipientsRow* row_of(Recipients to) {
  return std::ranges::find(kRows, to, &RecipientsRow::to);
}

static_assert(std::ranges::all_of(kWords<Recipients>,
                                  [](const auto& word) {
                                    return row_of(word.value) != std::end(kRows);
                                  }),
              "each recipient tier has a row");

// Calls visit(RecipientsRow) for each tier with its own groups, in the order of the groups: urgent
// tiers come last.
void for_each_tier(const SceneFile& scene, auto&& visit) {
  for (const bool is_urgent : {false, true}) {
    for (const TierConfig& tier : scene.aoim.tiers) {
      const RecipientsRow& row = *row_of(tier.to);
      if (has_group(tier) && row.kind->is_urgent == is_urgent) visit(row);
    }
  }
}

}  // namespace

std::vector<const aoim::TierKind*> tier_kinds_of(const SceneFile& scene) {
  std::vector<const aoim::TierKind*> kinds;
  for_each_tier(scene, [&](const RecipientsRow& row) { kinds.push_back(row.kind); });
  return kinds;
}

std::vector<TierFoci> tier_foci(const SceneFile& scene) {
  std::vector<TierFoci> foci{of_cells(scene)};
  for_each_tier(scene, [&](const RecipientsRow& row) { foci.push_back(row.foci(scene)); });
  return foci;
}

double tier_radius(const SceneFile& scene, const TierConfig& tier) {
  return row_of(tier.to)->radius(scene, tier);
}

}  // namespace reckon::peer
