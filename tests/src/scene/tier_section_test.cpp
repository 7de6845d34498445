// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// [[aoim.tier]]: the recipients of an update.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "reckon/peer/loops/aoim_setup.hpp"
#include "reckon/peer/scene/scene_sections.hpp"
#include "reckon/tests/src/support/refusal.hpp"
#include "reckon/tests/support/places.hpp"
#include "reckon/tests/support/tier_rows.hpp"

namespace reckon::peer {
namespace {

using test::refusal;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

SceneFile read_tiers(const std::string& text) { return parse_scene_file(text, "x.toml"); }

const std::string kRow = "[[aoim.tier]]\nactive = 9\noctets = 144\n";
const std::string kTouchRow = "[[aoim.tier]]\nto = \"touch\"\n";
std::string row_to(const std::string& farthest, const std::string& more = "") {
  return kRow + "farthest = " + farthest + "\n" + more;
}
const std::string kOwnGroup = "own_group = true\n";

TEST(TierSection, IsEmptyWithoutRows) {
  const aoim::AreaOfInterestConfig config = aoim_config(read_tiers(""));
  EXPECT_TRUE(config.channels.empty());
  EXPECT_TRUE(config.tiers.empty());
}

TEST(TierSection, ReadsTouchAndDistanceTiers) {
  const SceneFile file = read_tiers(R"([aoim]
budget = "20 kB"
[[aoim.tier]]
to = "touch"
[[aoim.tier]]
farthest = "2 m"
active = "1 kHz"
passive = "1 kHz"
octets = "232 B"
kept = true
[[aoim.tier]]
to = "distance"
farthest = "9 m"
own_group = true
active = 30
passive = 0.5
octets = 232
[[aoim.tier]]
body = "rigid"
active = 2
passive = 0.5
octets = 144
coarser = 8
)");
  const aoim::AreaOfInterestConfig config = aoim_config(file);
  EXPECT_THAT(config.tiers, ElementsAre(&aoim::kDistanceKind, &aoim::kTouchKind))
      << "in the order of their groups";
  const std::vector<aoim::Channel>& rows = config.channels;
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows[0].farthest, 2.0);
  EXPECT_TRUE(rows[0].kept);
  EXPECT_EQ(rows[0].body, aoim::Body::full);
  EXPECT_EQ(rows[1].active_hz, 30.0);
  EXPECT_EQ(rows[2].body, aoim::Body::rigid);
  EXPECT_EQ(rows[2].coarser, 8.0);
  EXPECT_GT(rows[2].farthest, 1e9);
  EXPECT_EQ(file.aoim.all_groups(), 3 * file.aoim.pool);
  EXPECT_EQ(file.aoim.awareness.budget, 20e3);
}

// The hashes that peers of earlier builds compute for the same scenes.
TEST(TierSection, GivesEachKindOfTierItsHash) {
  const auto hash = [](const std::string& tiers) { return read_tiers("[aoim]\n" + tiers).hash; };
  EXPECT_EQ(hash(""), 0x9b74aa729063af23ULL);
  EXPECT_EQ(hash(test::kTouchTier), 0x530d32168a1aed7cULL);
  EXPECT_EQ(hash(test::kDistanceTiers), 0x47acd63c281ef163ULL);
  EXPECT_EQ(hash(test::kOwnTiers), 0xfa32e51a397c9c55ULL);
  EXPECT_EQ(hash("pool = 200\n" + test::kAllTiers), 0xbdfeabfa9f44cd65ULL);
}

TEST(TierSection, OnlyTiersWithOwnGroupsEnterTheHash) {
  const auto hash = [](const std::string& rows) { return read_tiers(rows).hash; };
  EXPECT_EQ(hash(row_to("9") + kRow), hash(row_to("8") + kRow));
  EXPECT_NE(hash(row_to("9", kOwnGroup) + kRow), hash(row_to("8", kOwnGroup) + kRow));
}

TEST(TierSection, HasOneTouchRowFirstWithoutOtherKeys) {
  EXPECT_THAT(refusal(kTouchRow + kRow), IsEmpty());
  EXPECT_THAT(refusal(kRow + kTouchRow),
              HasSubstr("x.toml:5:6: the tier with to = \"touch\" is the nearest: move it before"));
  EXPECT_THAT(refusal(kTouchRow + kTouchRow),
              HasSubstr("x.toml:4:6: there is a tier with to = \"touch\" already: keep one"));
  for (const char* key : {"farthest = 1", "active = 1", "octets = 1", "own_group = false"})
    EXPECT_THAT(refusal(kTouchRow + key + "\n"),
                HasSubstr("to = \"touch\" takes no other key: remove it"))
        << key;
}

TEST(TierSection, RefusesImpossibleOwnGroupsWithTheReason) {
  EXPECT_THAT(refusal(row_to("9", kOwnGroup) + kRow), IsEmpty());
  EXPECT_THAT(refusal(kRow + kOwnGroup),
              HasSubstr("x.toml:4:13: 'own_group': the last tier uses the group of the cell"));
  EXPECT_THAT(refusal(row_to("9", "kept = true\n" + kOwnGroup) + kRow),
              HasSubstr("x.toml:6:13: 'own_group': a tier that is 'kept' uses the group of the "
                        "next one: remove it here"));
}

TEST(TierSection, RefusesGroupsThatOnlySomeRowsHave) {
  const std::string two = row_to("8", kOwnGroup) + row_to("9");
  EXPECT_THAT(refusal(two + kOwnGroup + kRow), IsEmpty());
  EXPECT_THAT(refusal(two + kRow),
              HasSubstr("x.toml:6:1: 'own_group' applies to all tiers by distance that are neither "
                        "'kept' nor the last, or to none: write own_group = true here too, or"));
  EXPECT_THAT(refusal(row_to("1", "kept = true\n") + two + kOwnGroup + kRow), IsEmpty());
}

TEST(TierSection, NearestOwnGroupNeedsTheScenesThresholds) {
  const std::string coarse = "coarser = 2\n";
  EXPECT_THAT(refusal(row_to("9", coarse) + kRow + coarse), IsEmpty());
  EXPECT_THAT(refusal(row_to("9", kOwnGroup + coarse) + kRow + coarse),
              HasSubstr("x.toml:6:11: 'own_group' needs the thresholds of the scene in the nearest "
                        "tier: write coarser = 1"));
}

TEST(TierSection, RefusesRowsOutOfOrderAtTheirPlace) {
  EXPECT_THAT(refusal(kTouchRow + row_to("5") + row_to("4")),
              HasSubstr("x.toml:7:1: 'tier': farthest must grow from row to row"));
  EXPECT_THAT(refusal(row_to("5") + row_to("6", "kept = true\n")),
              HasSubstr("x.toml:5:1: 'tier': kept rows must come first"));
  EXPECT_THAT(refusal("[[aoim.tier]]\nfarthest = 5\n"), HasSubstr("needs 'active'"));
}

TEST(TierSection, OfTheDocumentationHasTheUsualRows) {
  std::ifstream file(test::source_dir() + "/docs/area_of_interest_mechanisms.md");
  const std::string page{std::istreambuf_iterator<char>(file), {}};
  const std::size_t tier = page.find("[[aoim.tier]]\n");
  ASSERT_NE(tier, std::string::npos);
  const std::size_t begin = page.rfind("```toml\n", tier) + 8;
  const Tiers tiers = read_tiers(page.substr(begin, page.find("```", begin) - begin)).aoim.tiers;
  Tiers usual = distance_tiers(aoim::default_channels(), true);
  usual.insert(usual.begin(), {Recipients::touch, {}, false});
  EXPECT_EQ(tiers_text(tiers), tiers_text(usual));
}

TEST(TierSection, IsWrittenAsItIsRead) {
  for (const std::string& line : {test::kTouchTier, test::kOwnTiers, test::kAllTiers}) {
    const std::string pool = "[aoim]\npool = 200\n";
    const Tiers tiers = read_tiers(pool + line).aoim.tiers;
    const std::string text = tiers_text(tiers);
    const Tiers again = read_tiers(pool + text).aoim.tiers;
    ASSERT_EQ(again.size(), tiers.size()) << text;
    EXPECT_EQ(tiers_text(again), text);
    EXPECT_EQ(read_tiers(pool + text).hash, read_tiers(pool + line).hash) << text;
  }
}

}  // namespace
}  // namespace reckon::peer
