// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Quad-trees and locales in [aoim].
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <numbers>

#include "reckon/peer/loops/aoim_setup.hpp"
#include "reckon/peer/scene/scene_cells.hpp"
#include "reckon/peer/scene/scene_file.hpp"
#include "reckon/tests/src/support/refusal.hpp"
#include "reckon/tests/support/scratch_folder.hpp"

namespace reckon::peer {
namespace {

using testing::HasSubstr;

const std::string kTree = "[aoim]\nscheme = \"quadtree\"\nradius = \"200 m\"\npool = 64\n";
const std::string kSquare =
    "[aoim.quadtree]\nside = \"4 km\"\ncentre = [2000, 2000, 0]\nsmallest = \"60 m\"\n";
const std::string kRooms = R"([aoim]
scheme = "locales"
radius = "8 m"
[[aoim.locale]]
name = "hall"
origin = [0, 0, 0]
size = [10, 20, 4]
neighbours = "study, store"
[[aoim.locale]]
name = "study"
origin = [10, 0, 0]
size = [10, 10, 4]
yaw = "90 deg"
[[aoim.locale]]
name = "store"
origin = [0, 0, 4]
size = [10, 20, 4]
)";

SceneFile read_cells(const std::string& text, const std::filesystem::path& folder = ".") {
  return parse_scene_file(text, "x.toml", folder);
}

const aoim::QuadTree& tree_of(const aoim::CellPartition& cells) {
  return *cells.as<aoim::QuadTree>();
}

// A crowd of 300 within 200 m, and 100 spread over the square; every fourth row has a second
// instant.
void write_sample(const std::filesystem::path& file, bool backwards = false, int count = 400) {
  std::ofstream out(file);
  out << "t_s,x_m,y_m\n";
  for (int n = 0; n < count; ++n) {
    const int i = backwards ? count - 1 - n : n;
    const bool far = i % 4 == 0;
    out << (i % 8 < 4 ? 0.5 : 1.5) << ',' << (far ? (i * 37) % 4000 : 3000 + (i * 37) % 200) << ','
        << (far ? (i * 91) % 4000 : 500 + (i * 91) % 200) << '\n';
  }
}

TEST(CellsSection, MakesATreeOfTheNamedLeaves) {
  const SceneFile file = read_cells(kTree + kSquare + "leaves = \"0 1 30 31 32 33\"\n");
  const aoim::CellPartition cells = cells_of(file.aoim);
  EXPECT_EQ(tree_of(cells).cells(), 7U);
  EXPECT_EQ(cells.finest(), 1000.0);
  EXPECT_EQ(tree_of(cells).config().side, 4000.0);
  EXPECT_EQ(cells.group(aoim::Position{3900, 3900, 0}), aoim::GroupIndex{7});
  const aoim::AreaOfInterestConfig config = aoim_config(file);
  ASSERT_TRUE(config.cells);
  EXPECT_EQ(config.subscription.leave_factor, kTreeLeave);
  EXPECT_EQ(config.interest.leave_factor, kTreeLeave);
  const GroupNeeds needs = group_needs(file);
  EXPECT_EQ(needs.in_use, 7U);
  EXPECT_EQ(needs.within_radius, 4U) << "where the four small ones meet";
}

TEST(CellsSection, DividesWhereTheSampleHasMost) {
  const test::ScratchFolder folder;
  write_sample(folder.file("town.csv"));
  const std::string text = kTree + kSquare + "density = \"town.csv\"\nreach = \"200 m\"\n";
  const aoim::CellPartition cells = cells_of(read_cells(text, folder.file("")).aoim);
  EXPECT_GT(tree_of(cells).cells(), 60U);
  EXPECT_LE(tree_of(cells).cells(), 64U);
  EXPECT_GT(cells.cell({3100, 600, 0}).r, cells.cell({1000, 3000, 0}).r);
  EXPECT_GE(cells.finest(), 60.0);
}

// Peers with equal positions in the sample have the same tree and meet; peers with others do not.
TEST(CellsSection, HashesTheTreeInsteadOfItsText) {
  const test::ScratchFolder folder;
  write_sample(folder.file("town.csv"));
  write_sample(folder.file("backwards.csv"), true);
  write_sample(folder.file("fewer.csv"), false, 120);
  const auto hash = [&](const std::string& more, const std::string& square = kSquare) {
    return read_cells(kTree + square + more, folder.file("")).hash;
  };
  const std::string reach = "reach = \"200 m\"\n";
  const std::uint64_t town = hash("density = \"town.csv\"\n" + reach);
  EXPECT_EQ(hash("density = \"backwards.csv\"\n" + reach), town);
  EXPECT_NE(hash("density = \"fewer.csv\"\n" + reach), town);

  const SceneFile file =
      read_cells(kTree + kSquare + "density = \"town.csv\"\n" + reach, folder.file(""));
  std::string leaves;
  for (const aoim::CellId leaf : file.aoim.quad_tree.cells)
    leaves = aoim::QuadTree::path_of(leaf) + ' ' + leaves;
  EXPECT_EQ(hash("leaves = \"" + leaves + "\"\n"), town);

  const std::uint64_t four = hash("leaves = \"0\"\n");
  EXPECT_NE(hash("leaves = \"00\"\n"), four);
  EXPECT_EQ(hash("leaves = \"3 1\"\n"), four);
  EXPECT_NE(hash("leaves = \"0\"\n", "[aoim.quadtree]\nside = \"3 km\"\n"), four);
  EXPECT_NE(hash("leaves = \"0\"\n", "[aoim.quadtree]\nside = \"4 km\"\n"), four);
}

TEST(CellsSection, RefusesTreesThatCannotBe) {
  const auto tree = [](const std::string& more) { return test::refusal(kTree + kSquare + more); };
  EXPECT_THAT(tree(""), HasSubstr("density, leaves"));
  EXPECT_THAT(tree("leaves = \"0 4\"\n"), HasSubstr("\"4\""));
  EXPECT_THAT(tree("leaves = \"0 01\"\n"), HasSubstr("remove it"));
  EXPECT_THAT(tree("leaves = \"0123012\"\n"), HasSubstr("there is no cell"));  // cells of 31 m
  EXPECT_THAT(tree("leaves = \"0\"\nreach = \"1 m\"\n"), HasSubstr("'reach'"));
  EXPECT_THAT(tree("leaves = \"0\"\nmost = 65\n"), HasSubstr("hand_out"));
  EXPECT_THAT(tree("leaves = \"00 10 20 30\"\nmost = 12\n"), HasSubstr("16 cells"));
  EXPECT_THAT(tree("density = \"none.csv\"\nreach = \"1 m\"\n"), HasSubstr("none.csv"));
  EXPECT_THAT(test::refusal(kTree), HasSubstr("[aoim.quadtree]"));
  EXPECT_THAT(test::refusal("[aoim]\n" + kSquare + "leaves = \"0\"\n"),
              HasSubstr("scheme = \"quadtree\""));
  EXPECT_THAT(test::refusal(kTree + "cell = 3\n" + kSquare + "leaves = \"0\"\n"),
              HasSubstr("'cell'"));
  EXPECT_EQ(test::refusal(kTree + "leaders = true\nhand_out = true\n" + kSquare +
                          "leaves = \"0\"\nmost = 900\n"),
            "");
}

TEST(CellsSection, RefusesSamplesThatCannotBeRead) {
  const test::ScratchFolder folder;
  const auto refusal = [&](const char* octets) {
    std::ofstream(folder.file("town.csv")) << octets;
    return test::refusal(kTree + kSquare + "density = \"town.csv\"\nreach = \"200 m\"\n",
                         folder.file(""));
  };
  EXPECT_THAT(refusal("a,b\n1,2\n"), HasSubstr("x_m and y_m"));
  EXPECT_THAT(refusal("x_m,y_m\n"), HasSubstr("no positions"));
  EXPECT_THAT(refusal("x_m,y_m\n1,nan\n"), HasSubstr("town.csv:2"));
  EXPECT_EQ(refusal("px_m,py_m\n1,2\n"), "");
  std::string many = "x_m,y_m\n", often = "t_s,x_m,y_m\n";
  for (int i = 0; i <= 10'000; ++i) many += "1,2\n";
  EXPECT_THAT(refusal(many.c_str()), HasSubstr("more than 10000 positions at one instant"));
  for (int i = 0; i <= 50'000; ++i) often += std::to_string(i / 100) + ",1,2\n";
  EXPECT_THAT(refusal(often.c_str()), HasSubstr("more than 50000 positions;"));
}

TEST(CellsSection, LaysOutLocales) {
  const SceneFile file = read_cells(kRooms);
  const aoim::CellPartition cells = cells_of(file.aoim);
  const aoim::LocaleMap& map = *cells.as<aoim::LocaleMap>();
  ASSERT_EQ(map.locales().size(), 3U);
  EXPECT_EQ(map.locales()[1].neighbours, (std::vector<std::uint16_t>{0}));
  EXPECT_NEAR(map.locales()[1].yaw, std::numbers::pi / 2, 1e-12);
  EXPECT_EQ(cells.group(aoim::Position{1, 1, 1}), aoim::GroupIndex{1});
  EXPECT_EQ(cells.group(aoim::Position{1, 1, 3}), aoim::GroupIndex{3}) << "a floor higher";
  EXPECT_EQ(cells.group(aoim::Position{9, 1, 1}), aoim::GroupIndex{2});
  EXPECT_EQ(group_needs(file).within_radius, 3U);
  EXPECT_EQ(aoim_config(file).subscription.leave_factor, 1.1);
}

TEST(CellsSection, HashesLocalesWithTheirWays) {
  const std::uint64_t rooms = read_cells(kRooms).hash;
  const auto changed = [&](const std::string& what, const std::string& to) {
    std::string text = kRooms;
    return read_cells(text.replace(text.find(what), what.size(), to)).hash;
  };
  EXPECT_EQ(changed("radius = \"8 m\"", "radius = \"9 m\""), rooms);
  EXPECT_EQ(changed("\"study, store\"", "\"store , study\""), rooms);
  EXPECT_NE(changed("study, store", "study"), rooms);
  EXPECT_NE(changed("[0, 0, 4]", "[0, 0, 5]"), rooms);
  EXPECT_NE(changed("[10, 20, 4]", "[10, 21, 4]"), rooms);
  EXPECT_NE(changed("90 deg", "80 deg"), rooms);
}

TEST(CellsSection, RefusesLocalesThatCannotBe) {
  const auto changed = [&](const std::string& what, const std::string& to) {
    std::string text = kRooms;
    return test::refusal(text.replace(text.find(what), what.size(), to));
  };
  EXPECT_THAT(changed("study, store", "study, cellar"), HasSubstr("'cellar'"));
  EXPECT_THAT(changed("study, store", "hall"), HasSubstr("'hall'"));
  EXPECT_THAT(changed("name = \"study\"", "name = \"hall\""), HasSubstr("two locales 'hall'"));
  EXPECT_THAT(changed("size = [10, 10, 4]", "size = [10, 0, 4]"), HasSubstr("'size'"));
  EXPECT_THAT(changed("name = \"study\"", "name = \"a,b\""), HasSubstr("comma"));
  EXPECT_THAT(changed("radius", "pool = 1\nradius"), HasSubstr("3 locales"));
  EXPECT_THAT(changed("\"locales\"", "\"square\""), HasSubstr("scheme = \"locales\""));
  EXPECT_THAT(test::refusal(kRooms + "[network]\ninterop = true\n"), HasSubstr("'interop'"));
  EXPECT_THAT(test::refusal("[aoim]\nscheme = \"locales\"\n"), HasSubstr("[[aoim.locale]]"));
}

}  // namespace
}  // namespace reckon::peer
