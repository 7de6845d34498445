// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/scene/scene_extent.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "reckon/tests/support/scratch_folder.hpp"

namespace reckon::peer {
namespace {

/// Two trucks of two peers at a distance of `apart` [m], followed by `more` of a file.
std::string two_trucks(double apart, const std::string& more = "") {
  return fmt::format(
      "[scene]\nname = \"trucks\"\n"
      "[[entity]]\npeer = 1\nmarking = \"A\"\ntype = \"1.1.225.1\"\nposition = [0, 0, 0]\n"
      "[[entity]]\npeer = 2\nmarking = \"B\"\ntype = \"1.1.225.1\"\nposition = [{}, 0, 0]\n{}",
      apart, more);
}

AoimConfig aoim_of(const std::string& text) { return parse_scene_file(text, "x.toml").aoim; }

TEST(SceneExtent, SceneWithoutRadiusSensesAllItsEntities) {
  for (const auto& [apart, radius] : std::vector<std::pair<double, double>>{
           {0.5, 2}, {2, 2}, {2.1, 10}, {30, 100}, {100, 100}, {551, 1000}, {20'000, 100'000}}) {
    const AoimConfig aoim = aoim_of(two_trucks(apart));
    EXPECT_NEAR(aoim.radius, radius, 1e-9 * radius) << apart;
    EXPECT_NEAR(aoim.cell, radius / 2, 1e-9 * radius) << apart;
  }
}

TEST(SceneExtent, TheRadiusIsAtMostAThousandKilometres) {
  const std::string behind =
      "[[entity]]\nmarking = \"C\"\ntype = \"1.1.225.1\"\nposition = [-1e6, 0, 0]\n";
  const AoimConfig aoim = aoim_of(two_trucks(1e6, behind));  // 2000 km between the outermost
  EXPECT_EQ(aoim.radius, 1e6);
  EXPECT_EQ(aoim.cell, 5e5);
  EXPECT_EQ(aoim_of(two_trucks(30, "[aoim]\nradius = \"1000 km\"\n")).radius, 1e6);
  try {
    (void)aoim_of(two_trucks(30, "[aoim]\nradius = \"1001 km\"\n"));
    FAIL() << "a radius of 1001 km is taken";
  } catch (const std::exception& error) {
    EXPECT_THAT(error.what(),
                testing::HasSubstr("'radius' is 1001 km; it must be 10 mm to 1000 km"));
  }
}

TEST(SceneExtent, KeepsValuesStatedInTheFile) {
  const AoimConfig cell = aoim_of(two_trucks(30, "[aoim]\ncell = \"7 m\"\n"));
  EXPECT_EQ(cell.cell, 7);
  EXPECT_NEAR(cell.radius, 100, 1e-9);
  const AoimConfig radius = aoim_of(two_trucks(30, "[aoim]\nradius = \"3 m\"\n"));
  EXPECT_EQ(radius.radius, 3);
  EXPECT_NEAR(radius.cell, 50, 1e-9);
}

TEST(SceneExtent, ContainsWholeTracks) {
  const test::ScratchFolder folder;
  std::ofstream(folder.file("round.csv")) << "t_s,px_m,py_m,pz_m\n0,0,0,0\n10,300,0,0\n20,0,0,0\n";
  std::ofstream(folder.file("track.toml"))
      << "[scene]\nname = \"t\"\n[[entity]]\nmarking = \"A\"\ntype = \"1.1.225.1\"\n"
         "track = \"round.csv\"\nspeed = 2\n";
  const SceneFile scene = load_scene_file(folder.file("track.toml"));
  EXPECT_NEAR(extent_of(scene), 300, 3);
  EXPECT_NEAR(scene.aoim.radius, 1000, 1e-9);
}

TEST(SceneExtent, ASceneOfHandsAloneKeepsTheirReach) {
  const AoimConfig aoim = aoim_of("[scene]\nname = \"hands\"\n");
  EXPECT_EQ(aoim.radius, 2);
  EXPECT_EQ(aoim.cell, 1);
}

TEST(SceneExtent, ReportsEntitiesBeyondTheRadius) {
  EXPECT_EQ(unsensed_note(parse_scene_file(two_trucks(30), "x.toml")), "");
  const std::string note =
      unsensed_note(parse_scene_file(two_trucks(30, "[aoim]\nradius = \"3 m\"\n"), "x.toml"));
  EXPECT_THAT(note, testing::HasSubstr("2 of 2 entities are farther than [aoim] radius = 3 m"));
  EXPECT_THAT(note, testing::HasSubstr("the nearest 30 m"));
  // With a single entity none can be out of range.
  EXPECT_EQ(unsensed_note(parse_scene_file("[scene]\nname = \"one\"\n[[entity]]\nmarking = \"A\"\n"
                                           "type = \"1.1.225.1\"\n",
                                           "x.toml")),
            "");
}

}  // namespace
}  // namespace reckon::peer
