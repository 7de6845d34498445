// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/loops/tier_foci.hpp"

#include <gtest/gtest.h>

#include "reckon/peer/loops/aoim_setup.hpp"
#include "reckon/tests/support/tier_rows.hpp"

namespace reckon::peer {
namespace {

TEST(TierFoci, TouchTierUsesHandsAndOthersUseSensors) {
  const SceneFile scene = parse_scene_file("[aoim]\npool = 16\n" + test::kAllTiers, "x.toml");
  const aoim::TierTable tiers = tiers_of(aoim_config(scene));
  const deadreckon::LocalFrame frame(0.82, 0.145, 430.0);
  OwnedEntities owned(frame, {});
  const aoim::Focus sensed{{3.0, 0.0, 0.0}, 0.0, scene.aoim.radius};

  const std::vector<TierFoci> foci = tier_foci(scene);
  ASSERT_EQ(foci.size(), tiers.count());
  for (std::size_t tier = 0; tier < tiers.count(); ++tier) {
    const auto of_tier = foci[tier]({owned, {&sensed, 1}, {}, {}});
    if (tiers.kind(tier).is_urgent) {
      EXPECT_TRUE(of_tier.empty());  // without own hands nothing can be touched
    } else {
      EXPECT_EQ(of_tier.data(), &sensed) << tier;
    }
  }
}

}  // namespace
}  // namespace reckon::peer
