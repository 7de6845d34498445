// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Regions of a scene file and their effects.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "reckon/peer/scene/scene_file.hpp"
#include "reckon/tests/src/support/refusal.hpp"

namespace reckon::peer::region_section_test {
namespace {

TEST(SceneFile, ReadsRegionsAndTheirEffects) {
  const SceneFile file = parse_scene_file(R"(
[[region]]
name = "pool"
box = "1 2 0.5 m"
position = "0 0 -0.25 m"
orientation = "0 0 90 deg"
viscosity = {linear = "4 N s/m"}
dry_friction = {}

[[region]]
name = "wind"
constant_force = {x = "300 mN"}
)",
                                          "regions.toml");
  ASSERT_EQ(file.scene.regions.size(), 2U);
  const haptics::SceneRegion& pool = file.scene.regions[0];
  EXPECT_EQ(std::get<haptics::BoxShape>(*pool.shape).size, Eigen::Vector3d(1, 2, 0.5));
  EXPECT_EQ(pool.effects.find<haptics::Viscosity>()->linear, 4);
  EXPECT_EQ(pool.effects.find<haptics::DryFriction>()->force, haptics::Yield{}.force);
  EXPECT_EQ(pool.effects.find<haptics::Attraction>(), nullptr);
  EXPECT_FALSE(file.scene.regions[1].shape);
  EXPECT_EQ(file.scene.regions[1].effects.find<haptics::ConstantForce>()->x, 0.3);
}

}  // namespace
}  // namespace reckon::peer::region_section_test
