// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Channels and awareness in [aoim].
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

TEST(AwarenessSection, TakesTheUsualTableOrTheFilesOwn) {
  EXPECT_EQ(aoim_config(read("[aoim]\nchannels = true\n")).channels.size(),
            aoim::default_channels().size());
  const SceneFile file = read(R"([aoim]
channels = true
budget = "20 kB"
[[aoim.channel]]
farthest = "2 m"
active = "1 kHz"
passive = "1 kHz"
octets = "232 B"
kept = true
[[aoim.channel]]
body = "rigid"
active = 2
passive = 0.5
octets = 144
)");
  const std::vector<aoim::Channel> rows = aoim_config(file).channels;
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0].farthest, 2.0);
  EXPECT_TRUE(rows[0].kept);
  EXPECT_EQ(rows[0].body, aoim::Body::full);
  EXPECT_EQ(rows[1].body, aoim::Body::rigid);
  EXPECT_GT(rows[1].farthest, 1e9);
  EXPECT_EQ(file.aoim.awareness.budget, 20e3);
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

TEST(AwarenessSection, ChannelsAreAFactOfTheSceneAndAllElseIsEachPeersOwn) {
  const std::uint64_t plain = read("").hash;
  EXPECT_NE(read("[aoim]\nchannels = true\n").hash, plain);
  EXPECT_EQ(read("[aoim]\nchannels = true\nbudget = 1000\n").hash,
            read("[aoim]\nchannels = true\n").hash);
  EXPECT_EQ(read("[aoim]\nkinds = \"platform\"\naura = 5\n").hash, plain);
}

TEST(AwarenessSection, TellsWhatDoesNotFitTogether) {
  EXPECT_THAT(awareness_refusal("[aoim]\n[[aoim.channel]]\nactive = 1\noctets = 144\n"),
              HasSubstr("channels"));
  EXPECT_THAT(awareness_refusal("[aoim]\nkinds = \"platfrom\"\n"), HasSubstr("Platform"));
  EXPECT_THAT(awareness_refusal("[[aoim.occluder]]\nfrom = [0, 0, 0]\nto = [1, 0, 1]\n"),
              HasSubstr("volume"));
  EXPECT_THAT(awareness_refusal("[[aoim.nimbus]]\nreach = 3\n"), HasSubstr("type"));
  EXPECT_THAT(
      awareness_refusal("[aoim]\nchannels = true\n[[aoim.channel]]\nfarthest = 5\nactive = 1\n"
                        "octets = 144\n[[aoim.channel]]\nfarthest = 4\nactive = 1\noctets = 144\n"),
      HasSubstr("farthest must grow"));
}

}  // namespace
}  // namespace reckon::peer
