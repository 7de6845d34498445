// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/loops/aoim_setup.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "reckon/peer/scene/scene_keys.hpp"

namespace reckon::peer {
namespace {

/// As a file would say a key's least, most and standard value.
std::vector<std::string> corners(const SceneKey& key) {
  if (key.kind == KeyKind::boolean) return {"true", "false"};
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

/// Constructs what a demo constructs of [aoim] and [network].
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

// Plain DIS programs read no compressed form and know no leaders, who tell plain and whole states
// and hand out groups.
bool excludes_itself(const std::string& text) {
  const auto says = [&](const char* words) { return text.find(words) != std::string::npos; };
  const bool compressed = says("compression") && !says("compression = \"none\"");
  const bool led = says("leaders = true");
  // What these are made of stands in tables of its own.
  if (says("scheme = \"quadtree\"") || says("scheme = \"locales\"")) return true;
  const bool apart = says("contact_groups = true");
  if (apart && (says("interop = true") || says("pool = 1\n") || says("pool = 1000\n"))) return true;
  if (says("near_groups = true") && !says("channels = true")) return true;
  return (says("interop = true") && (compressed || led)) ||
         (led && (compressed || says("channels = true"))) || (says("hand_out = true") && !led);
}

TEST(AoimSetup, TakesEveryCornerOfWhatASceneMaySay) {
  std::vector<SceneKey> keys;
  for (const SceneKey& key : scene_keys()) {
    const bool ours =
        key.section == "aoim" || key.section == "network" || key.section == "network.bundle";
    const bool measured = key.kind != KeyKind::text && key.kind != KeyKind::texts &&
                          key.kind != KeyKind::table && key.kind != KeyKind::tables;
    if (ours && measured) keys.push_back(key);
  }
  ASSERT_GE(keys.size(), 11u);
  int taken = 0;
  for (const SceneKey& a : keys) {
    for (const SceneKey& b : keys) {
      if (a.section == b.section && a.key == b.key) continue;
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

TEST(AoimSetup, TakesUnevenCellsWithAllThatGoesByCells) {
  const std::string tree =
      "scheme = \"quadtree\"\nradius = 20\n[aoim.quadtree]\nside = 100\nleaves = \"00 3\"\n";
  const std::string rooms =
      "scheme = \"locales\"\nradius = 20\n[[aoim.locale]]\nname = \"a\"\nsize = [4, 4, 0]\n";
  for (const std::string& cells : {tree, rooms}) {
    for (const char* more :
         {"", "leaders = true\n", "leaders = true\nhand_out = true\n", "contact_groups = true\n",
          "leaders = true\ncontact_groups = true\n", "channels = true\n", "pool = 8\n"}) {
      const SceneFile scene = parse_scene_file(std::string("[aoim]\n") + more + cells, "x.toml");
      EXPECT_NO_THROW(construct(scene)) << more << cells;
      EXPECT_LE(group_needs(scene).within_radius, group_needs(scene).in_use) << more << cells;
    }
  }
}

TEST(AoimSetup, RefusesAPoolInTheFileExactlyWhereTheGridWould) {
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

TEST(AoimSetup, TellsHowManyGroupsARadiusNeedsOfThosePoolAndCap) {
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

TEST(AoimSetup, HasAsManyContactGroupsAgainWhereTheSceneAsksForThem) {
  SceneFile scene;
  scene.aoim.pool = 16;
  const auto last = scene.network.group;
  EXPECT_EQ(pool_of(scene).size(), 16u);
  EXPECT_EQ(group_needs(scene).within_touch, 0u);
  const std::uint64_t hash = scene_hash(scene);
  scene.aoim.contact_groups = true;
  EXPECT_EQ(pool_of(scene).size(), 32u);
  EXPECT_EQ(pool_of(scene).base(), last);
  EXPECT_NE(scene_hash(scene), hash) << "all peers have to agree";
  scene.aoim.cell = 100.0;
  EXPECT_GE(group_needs(scene).within_touch, 3u) << "a corner of hexagons";
  EXPECT_LE(group_needs(scene).within_touch, 4u);
}

TEST(AoimSetup, HasAsManyGroupsAgainForEachNearRowAndThoseOfContactBehindThem) {
  SceneFile scene;
  scene.aoim.pool = 16;
  scene.aoim.cell = 100.0;
  scene.aoim.radius = 300.0;
  scene.aoim.awareness.channels = true;
  const std::uint64_t hash = scene_hash(scene);
  scene.aoim.near_groups = true;
  EXPECT_EQ(pool_of(scene).size(), 48u) << "to 50 m and to 200 m";
  EXPECT_NE(scene_hash(scene), hash) << "all peers have to agree";
  const GroupNeeds needs = group_needs(scene);
  EXPECT_GE(needs.within_rows, 6u);
  EXPECT_EQ(audience_rows_of(scene.aoim).size(), 3u) << "but the one that is kept";
  scene.aoim.contact_groups = true;
  EXPECT_EQ(pool_of(scene).size(), 64u);
  ASSERT_TRUE(contact_pool_of(scene).has_value());
  EXPECT_EQ(contact_pool_of(scene)->address(0), pool_of(scene).address(48));
  SceneFile other = scene;
  other.aoim.awareness.rows.assign(aoim::default_channels().begin(),
                                   aoim::default_channels().end());
  EXPECT_EQ(scene_hash(other), scene_hash(scene));
  other.aoim.awareness.rows[1].farthest = 60.0;
  EXPECT_NE(scene_hash(other), scene_hash(scene)) << "who hears what follows from the rows";
}

TEST(AoimSetup, RefusesNearGroupsWhereThereCanBeNone) {
  const auto refusal = [](const char* more) -> std::string {
    try {
      (void)parse_scene_file(fmt::format("[aoim]\nnear_groups = true\n{}", more), "x.toml");
    } catch (const SceneFileError& error) {
      return error.what();
    }
    return "";
  };
  const auto says = [&](const char* more, const char* what) {
    EXPECT_NE(refusal(more).find(what), std::string::npos) << more << ": " << refusal(more);
  };
  EXPECT_EQ(refusal("channels = true\n"), "");
  says("", "set 'channels' too, or take 'near_groups' out");
  says("channels = true\npool = 1\n", "take 4 to 333");
  says("channels = true\npool = 334\n", "4 to 333");
  says("channels = true\ncontact_groups = true\n", "4 to 250");
  says("channels = true\nleaders = true\n", "'leaders'");
  says("channels = true\n[network]\ncompression = \"residual\"\n", "which 'near_groups' excludes");
  EXPECT_EQ(refusal("channels = true\n[network]\ncompression = \"delta\"\n"), "");
  says("channels = true\n[network]\ncompression = \"residual\"\n", "which 'near_groups' excludes");
  EXPECT_EQ(refusal("channels = true\n[network]\ncompression = \"delta\"\n"), "");
  says("channels = true\n[network]\ninterop = true\n", "'interop'");
  says("channels = true\nchannel = [{active = \"1 Hz\", octets = \"144 B\"}]\n",
       "a row of 'channel' that is not 'kept'");
  says(
      "channels = true\nchannel = [{farthest = \"9 m\", active = \"9 Hz\", octets = \"144 B\", "
      "coarser = 2}, {active = \"1 Hz\", octets = \"144 B\", coarser = 2}]\n",
      "a 'coarser' of 1");
}

// What others let their copies be off by is not on the wire.
TEST(AoimSetup, ShowsRemoteEntitiesNearTheThresholdsOfTheScene) {
  const SceneFile scene = parse_scene_file(
      "[dead_reckoning]\nposition = \"0.25 m\"\nangle = \"0.125 rad\"\n[convergence]\ncurve = "
      "\"linear\"\n[aoim]\nchannels = true\n[hand]\nradius = \"8 mm\"\n",
      "x.toml");
  const RemoteSettings settings = remote_settings(scene);
  EXPECT_EQ(settings.convergence.settings.threshold, 0.25);
  EXPECT_EQ(settings.convergence.settings.threshold_angle, 0.125);
  EXPECT_EQ(settings.convergence.settings.curve, deadreckon::ConvergenceCurve::linear);
  EXPECT_EQ(settings.probe_radius, 0.008);
  EXPECT_TRUE(settings.bodies_in_part);
  EXPECT_EQ(settings.near_rows, scene.aoim.near_rows());
}

TEST(AoimSetup, RefusesContactGroupsWhereThereCanBeNone) {
  const auto refusal = [](const char* more) -> std::string {
    try {
      (void)parse_scene_file(fmt::format("[aoim]\ncontact_groups = true\n{}", more), "x.toml");
    } catch (const SceneFileError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(refusal(""), "");
  EXPECT_EQ(refusal("leaders = true\n"), "");
  EXPECT_EQ(refusal("channels = true\n"), "");
  EXPECT_NE(refusal("pool = 1\n").find("take 4 to 500"), std::string::npos);
  EXPECT_NE(refusal("pool = 501\n").find("4 to 500"), std::string::npos);
  EXPECT_NE(refusal("leaders = true\nhand_out = true\n").find("'hand_out'"), std::string::npos);
  EXPECT_NE(refusal("[network]\ninterop = true\n").find("'interop'"), std::string::npos);
}

}  // namespace
}  // namespace reckon::peer
