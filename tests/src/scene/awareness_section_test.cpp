// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Awareness in [aoim].
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "reckon/peer/loops/aoim_setup.hpp"
#include "reckon/peer/scene/scene_file.hpp"

namespace reckon::peer {
namespace {

using testing::HasSubstr;

SceneFile read(std::string_view text) { return parse_scene_file(text, "x.toml"); }

std::string awareness_refusal(std::string_view text) {
  try {
    (void)read(text);
    return {};
  } catch (const SceneFileError& error) {
    return error.what();
  }
}

TEST(AwarenessSection, AsksForNothingUnlessTheFileDoes) {
  const aoim::AreaOfInterestConfig config = aoim_config(read(""));
  EXPECT_TRUE(config.channels.empty());
  EXPECT_EQ(config.interest.kinds, 0xFFFFFFFFU);
  EXPECT_TRUE(config.interest.occluders.empty());
  EXPECT_EQ(config.farthest_nimbus, 0.0);
}

TEST(AwarenessSection, ReadsKindsNimbusAndBoxes) {
  const SceneFile file = read(R"([aoim]
kinds = "platform, Life Form"
aura = "500 m"
[[aoim.nimbus]]
type = "1.2"
reach = "3 km"
[[aoim.nimbus]]
type = "1"
reach = "10 m"
[[aoim.occluder]]
from = [10, 0, 0]
to = [0, 5, 3]
)");
  const aoim::AreaOfInterestConfig config = aoim_config(file);
  EXPECT_EQ(config.interest.kinds, 1U << 1 | 1U << 3);
  EXPECT_EQ(config.interest.aura, 500.0);
  EXPECT_EQ(config.farthest_nimbus, 3000.0);
  ASSERT_EQ(config.interest.occluders.size(), 1u);
  EXPECT_EQ(config.interest.occluders[0].lower.x, 0.0);
  EXPECT_EQ(config.interest.occluders[0].upper.x, 10.0);
  const auto& nimbus = file.aoim.awareness.nimbus;
  EXPECT_EQ(nimbus_of(nimbus, {pdu::EntityKind::platform, pdu::EntityDomain::air}), 3000.0);
  EXPECT_EQ(nimbus_of(nimbus, {pdu::EntityKind::platform, pdu::EntityDomain::land}), 10.0);
  EXPECT_EQ(nimbus_of(nimbus, {pdu::EntityKind::life_form}), 0.0);
}

TEST(AwarenessSection, IsEachPeersOwn) {
  const std::uint64_t plain = read("").hash;
  EXPECT_EQ(read("[aoim]\nbudget = 1000\n").hash, plain);
  EXPECT_EQ(read("[aoim]\nkinds = \"platform\"\naura = 5\n").hash, plain);
}

TEST(AwarenessSection, ReportsInconsistentKeys) {
  EXPECT_THAT(awareness_refusal("[aoim]\nkinds = \"platfrom\"\n"), HasSubstr("Platform"));
  EXPECT_THAT(awareness_refusal("[[aoim.occluder]]\nfrom = [0, 0, 0]\nto = [1, 0, 1]\n"),
              HasSubstr("volume"));
  EXPECT_THAT(awareness_refusal("[[aoim.nimbus]]\nreach = 3\n"), HasSubstr("type"));
}

}  // namespace
}  // namespace reckon::peer
