// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/loops/tier_foci.hpp"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <memory>

#include "reckon/peer/loops/contact_foci.hpp"
#include "reckon/peer/scene/scene_words.hpp"

namespace reckon::peer {
namespace {

using Foci = std::span<const aoim::Focus>;

TierFoci sensed(const SceneFile&, const TierConfig&) {
  return [](const FociInputs& inputs) { return inputs.sensed; };
}

// The places where we can touch and be touched. The search for what our hands could touch also
// finds large entities whose surface, but not whose origin, is near.
TierFoci touchable(const SceneFile& scene, const TierConfig&) {
  const auto foci = std::make_shared<ContactFoci>(scene);
  return [foci](const FociInputs& inputs) -> Foci {
    foci->clear();
    for (const EntityNumber number : inputs.owned.touchable())
      foci->add(*inputs.owned.find(number));
    for (const NearBodies& of_hand : inputs.near) {
      for (const NearBody& body : of_hand.bodies()) {
        if (body.row != nullptr) foci->add_near(body.row->predicted(inputs.now).position);
      }
    }
    return foci->foci();
  };
}

struct FociRow {
  Recipients to;
  TierFoci (*make)(const SceneFile& scene, const TierConfig& tier);
};

// THE list.
constexpr FociRow kRows[]{{Recipients::distance, sensed}, {Recipients::touch, touchable}};

constexpr const FociRow* row_of(Recipients to) {
  return std::ranges::find(kRows, to, &FociRow::to);
}

static_assert(std::ranges::all_of(kWords<Recipients>,
                                  [](const auto& word) {
                                    return row_of(word.value) != std::end(kRows);
                                  }),
              "all kinds of recipients have a row");

TierFoci foci_of(const SceneFile& scene, const TierConfig& tier) {
  return row_of(tier.to)->make(scene, tier);
}

}  // namespace

std::vector<TierFoci> tier_foci(const SceneFile& scene, const aoim::TierTable& tiers) {
  std::vector<TierFoci> foci(tiers.count(), sensed(scene, {}));
  std::size_t row = 0;
  for (const TierConfig& tier : scene.aoim.tiers) {
    if (tier.own_group && row < tiers.near_rows()) foci[tiers.of_row(row++)] = foci_of(scene, tier);
    if (tier.to == Recipients::touch && tiers.has_felt()) foci[tiers.felt()] = foci_of(scene, tier);
  }
  return foci;
}

}  // namespace reckon::peer
