// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/loops/aoim_setup.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "reckon/peer/clocks/clock.hpp"
#include "reckon/peer/network/simulated_network.hpp"
#include "reckon/peer/scene/scene_keys.hpp"
#include "reckon/tests/src/support/refusal.hpp"
#include "reckon/tests/support/soak.hpp"
#include "reckon/tests/support/tier_rows.hpp"

namespace reckon::peer {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::Ge;
using testing::Le;

/// Least, greatest and default value of a key, as text of a scene file.
std::vector<std::string> corners(const SceneKey& key) {
  if (key.kind == KeyKind::boolean) return {"true", "false"};
  if (key.key == "tier") {
    std::vector<std::string> tiers;
    for (const std::string& line : {test::kTouchTier, test::kDistanceTiers, test::kOwnTiers})
      tiers.push_back(line.substr(line.find('['), line.rfind(']') + 1 - line.find('[')));
    return tiers;
  }
  std::vector<std::string> values;
  if (key.kind == KeyKind::choice) {
    for (const std::string_view word : key.words) values.push_back(fmt::format("\"{}\"", word));
    return values;
  }
  const bool whole = key.kind == KeyKind::integer;
  for (const double value : {key.least, key.most}) {
    values.push_back(key.unit.empty() && whole ? fmt::format("{:.0f}", value)
                                               : fmt::format("\"{:.17g} {}\"", value, key.unit));
  }
  return values;
}

/// Constructs the parts that a demo constructs from [aoim] and [network].
void construct(const SceneFile& scene) {
  const GroupPool pool = pool_of(scene);
  const aoim::AreaOfInterestConfig config = aoim_config(scene);
  pdu::Presence own;
  own.epoch = 1;
  own.header.exercise_id = scene.network.exercise;
  aoim::AreaOfInterestManager manager(config, own);
  for (const double away : {0.0, 1e6, -1e6}) {
    const aoim::Focus focus{{away, -away, away}, 10.0, scene.aoim.radius};
    const auto change = manager.listen(aoim::kCellTier, {&focus, 1}, std::chrono::nanoseconds(0));
    EXPECT_LE(manager.subscriptions().cells().joined().size(), scene.aoim.groups);
    for (const aoim::GroupIndex group : change.join) {
      EXPECT_LE(group.value, scene.aoim.pool);
      EXPECT_TRUE(pool.address(group.value - 1u).is_multicast());
    }
  }
}

// Plain DIS programs neither read compressed states nor support leaders, which send plain and whole
// states and hand out groups.
bool excludes_itself(const std::string& text) {
  const auto says = [&](const char* words) { return text.find(words) != std::string::npos; };
  const bool compressed = says("compression") && !says("compression = \"none\"");
  const bool led = says("leaders = true");
  // These schemes need tables of their own.
  if (says("scheme = \"quadtree\"") || says("scheme = \"locales\"")) return true;
  const bool apart = says("\"touch\"") || says("own_group");
  if (apart && (says("interop = true") || says("pool = 1\n") || says("pool = 1000\n"))) return true;
  if (says("own_group") && says("compression = \"residual\"")) return true;
  const bool budgeted = says("budget") && !says("budget = \"0 B\"");
  if (says("lenient = true") && !says("interop = true")) return true;
  return (says("interop = true") && (compressed || led || budgeted)) ||
         (led && (compressed || says("farthest"))) || (says("hand_out = true") && !led);
}

TEST(AoimSetup, TakesEveryCornerOfTheSceneKeys) {
  std::vector<SceneKey> keys;
  for (const SceneKey& key : scene_keys()) {
    const bool ours =
        key.section == "aoim" || key.section == "network" || key.section == "network.bundle";
    const bool measured = key.kind != KeyKind::text && key.kind != KeyKind::texts &&
                          key.kind != KeyKind::table && key.kind != KeyKind::tables;
    if (ours && (measured || key.key == "tier")) keys.push_back(key);
  }
  ASSERT_GE(keys.size(), 11u);
  int taken = 0;
  for (const SceneKey& a : keys) {
    for (const SceneKey& b : keys) {
      if (a.section == b.section && a.key == b.key) continue;
      // One order of each pair; a soak tries both.
      if (!test::soaks() && &b < &a) continue;
      for (const std::string& first : corners(a)) {
        for (const std::string& second : corners(b)) {
          const std::string text =
              a.section == b.section
                  ? fmt::format("[{}]\n{} = {}\n{} = {}\n", a.section, a.key, first, b.key, second)
                  : fmt::format("[{}]\n{} = {}\n[{}]\n{} = {}\n", a.section, a.key, first,
                                b.section, b.key, second);
          try {
            construct(parse_scene_file(text, "corner.toml"));
            ++taken;
            EXPECT_FALSE(excludes_itself(text)) << text;
          } catch (const std::exception& error) {
            if (!excludes_itself(text)) ADD_FAILURE() << text << error.what();
          }
        }
      }
    }
  }
  EXPECT_GT(taken, 300);
}

TEST(AoimSetup, TakesUnevenCellsWithAllCellOptions) {
  const std::string tree =
      "scheme = \"quadtree\"\nradius = 20\n[aoim.quadtree]\nside = 100\nleaves = \"00 3\"\n";
  const std::string rooms =
      "scheme = \"locales\"\nradius = 20\n[[aoim.locale]]\nname = \"a\"\nsize = [4, 4, 0]\n";
  for (const std::string& cells : {tree, rooms}) {
    for (const std::string& more :
         {std::string(), std::string("leaders = true\n"),
          std::string("leaders = true\nhand_out = true\n"), test::kTouchTier,
          "leaders = true\n" + test::kTouchTier, test::kDistanceTiers, std::string("pool = 8\n")}) {
      const SceneFile scene = parse_scene_file("[aoim]\n" + more + cells, "x.toml");
      EXPECT_NO_THROW(construct(scene)) << more << cells;
      EXPECT_LE(group_needs(scene).within_radius, group_needs(scene).in_use) << more << cells;
    }
  }
}

TEST(AoimSetup, RefusesAPoolExactlyWhereTheGridDoes) {
  for (std::uint32_t pool = 0; pool <= 1002; ++pool) {
    aoim::GridConfig grid;
    grid.pool = pool;
    bool laid_out = true, read = true;
    try {
      (void)aoim::CellGrid(grid);
    } catch (const std::invalid_argument&) {
      laid_out = false;
    }
    try {
      (void)parse_scene_file(fmt::format("[aoim]\npool = {}\n", pool), "x.toml");
    } catch (const SceneFileError& error) {
      read = false;
      EXPECT_NE(std::string(error.what()).find("x.toml:2:8: 'pool'"), std::string::npos);
    }
    EXPECT_EQ(read, laid_out) << pool;
  }
}

TEST(AoimSetup, CountsTheGroupsThatARadiusNeeds) {
  SceneFile scene;
  scene.aoim.scheme = aoim::CellScheme::square;
  scene.aoim.radius = 3.0;
  GroupNeeds needs = group_needs(scene);
  EXPECT_GE(needs.within_radius, 45u);  // 37 about a centre, more about a corner
  EXPECT_LE(needs.within_radius, 49u);
  EXPECT_EQ(needs.in_use, 256u);
  EXPECT_FALSE(needs.all());
  EXPECT_FALSE(needs.capped());
  scene.aoim.groups = 20;
  EXPECT_TRUE(group_needs(scene).capped());
  scene.aoim.pool = 16;
  EXPECT_TRUE(group_needs(scene).all());
  EXPECT_FALSE(group_needs(scene).capped()) << "16 groups are all there are";
  scene.aoim.pool = 1;
  EXPECT_FALSE(group_needs(scene).all()) << "a world that is not divided";
  scene.network.interop = true;
  EXPECT_EQ(group_needs(scene).within_radius, 0u);
}

TEST(AoimSetup, DoublesGroupsForContact) {
  SceneFile scene;
  scene.aoim.pool = 16;
  const auto last = scene.network.group;
  EXPECT_EQ(pool_of(scene).size(), 16u);
  EXPECT_TRUE(group_needs(scene).within_tiers.empty());
  const std::uint64_t hash = scene_hash(scene);
  scene.aoim.tiers = {{Recipients::touch, {}, false}};
  EXPECT_EQ(pool_of(scene).size(), 32u);
  EXPECT_EQ(pool_of(scene).base(), last);
  EXPECT_NE(scene_hash(scene), hash) << "all peers have to agree";
  scene.aoim.cell = 100.0;
  EXPECT_THAT(group_needs(scene).within_tiers, ElementsAre(AllOf(Ge(3u), Le(4u))))
      << "a corner of hexagons";
}

TEST(AoimSetup, AddsGroupsForEachNearRowAndContact) {
  SceneFile scene;
  scene.aoim.pool = 16;
  scene.aoim.cell = 100.0;
  scene.aoim.radius = 300.0;
  scene.aoim.tiers = distance_tiers(aoim::default_channels());
  const std::uint64_t hash = scene_hash(scene);
  scene.aoim.tiers = distance_tiers(aoim::default_channels(), true);
  EXPECT_EQ(pool_of(scene).size(), 48u) << "to 50 m and to 200 m";
  EXPECT_NE(scene_hash(scene), hash) << "all peers have to agree";
  EXPECT_THAT(group_needs(scene).within_tiers, ElementsAre(0u, Ge(2u), Ge(4u), 0u))
      << "none of what is kept, and of what is farthest by the cell's";
  EXPECT_EQ(audience_rows_of(scene.aoim).size(), 3u) << "but the one that is kept";
  scene.aoim.tiers.insert(scene.aoim.tiers.begin(), {Recipients::touch, {}, false});
  EXPECT_EQ(pool_of(scene).size(), 64u);
  ASSERT_TRUE(urgent_pool_of(scene).has_value());
  EXPECT_EQ(urgent_pool_of(scene)->address(0), pool_of(scene).address(48));
  SceneFile other = scene;
  other.aoim.tiers[2].channel.farthest = 60.0;
  EXPECT_NE(scene_hash(other), scene_hash(scene)) << "who hears what follows from the rows";
}

TEST(AoimSetup, RefusesOwnGroupTiersWhereImpossible) {
  const auto refusal = [](const std::string& tiers, const char* more) {
    return test::refusal("[aoim]\n" + tiers + more);
  };
  const auto says = [&](const std::string& tiers, const char* more, const char* what) {
    EXPECT_NE(refusal(tiers, more).find(what), std::string::npos) << more << refusal(tiers, more);
  };
  EXPECT_EQ(refusal(test::kOwnTiers, ""), "");
  says(test::kOwnTiers, "pool = 1\n", "write 4 to 333");
  says(test::kOwnTiers, "pool = 334\n", "4 to 333");
  says(test::kAllTiers, "pool = 256\n", "4 to 250");
  says(test::kOwnTiers, "leaders = true\n", "'leaders'");
  says(test::kOwnTiers, "[network]\ncompression = \"residual\"\n", "own_group = true excludes");
  EXPECT_EQ(refusal(test::kOwnTiers, "[network]\ncompression = \"compact\"\n"), "");
  says(test::kOwnTiers, "[network]\ninterop = true\n", "'interop'");
}

// The thresholds of other peers are not on the wire.
TEST(AoimSetup, ShowsRemoteEntitiesByTheScenesThresholds) {
  const SceneFile scene = parse_scene_file(
      "[dead_reckoning]\nposition = \"0.25 m\"\nangle = \"0.125 rad\"\n[convergence]\ncurve = "
      "\"linear\"\n[aoim]\n" +
          test::kDistanceTiers + "[hand]\nradius = \"8 mm\"\n",
      "x.toml");
  const RemoteSettings settings = remote_settings(scene);
  EXPECT_EQ(settings.convergence.settings.threshold, 0.25);
  EXPECT_EQ(settings.convergence.settings.threshold_angle, 0.125);
  EXPECT_EQ(settings.convergence.settings.curve, deadreckon::ConvergenceCurve::linear);
  EXPECT_EQ(settings.probe_radius, 0.008);
  EXPECT_TRUE(settings.bodies_in_part);
  EXPECT_EQ(settings.near_rows, 0u);
}

TEST(AoimSetup, RefusesATouchTierWhereImpossible) {
  const auto refusal = [](const char* more) {
    return test::refusal("[aoim]\n" + test::kTouchTier + more);
  };
  EXPECT_EQ(refusal(""), "");
  EXPECT_EQ(refusal("leaders = true\n"), "");
  EXPECT_NE(refusal("pool = 1\n").find("write 4 to 500"), std::string::npos);
  EXPECT_NE(refusal("pool = 501\n").find("4 to 500"), std::string::npos);
  EXPECT_NE(refusal("leaders = true\nhand_out = true\n").find("'hand_out'"), std::string::npos);
  EXPECT_NE(refusal("[network]\ninterop = true\n").find("'interop'"), std::string::npos);
}

TEST(AoimSetup, BundlesFitTheUnfragmentedPayload) {
  const SceneFile scene =
      parse_scene_file("[scene]\nname = \"b\"\n[network.bundle]\nmax = \"9000 B\"\n", "b.toml");
  const deadreckon::LocalFrame frame(0.82, 0.145, 430.0);
  ManualClock clock;
  for (const auto& [payload, longest] : {std::pair{1372U, 1372U}, {9100U, 9000U}, {100U, 280U}}) {
    SimulatedNetworkOptions options;
    options.max_payload = payload;
    SimulatedNetwork network(options, clock);
    const aoim::AggregatorConfig bundles = aoim_config(scene, frame, network.link(0)).aggregator;
    EXPECT_EQ(bundles.payload_limit, longest + bundles.reserved) << payload;
  }
}

}  // namespace
}  // namespace reckon::peer
