// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// `reckon scene explain`: what a scene declares and omits, and the settings between peers.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "reckon/tests/support/places.hpp"
#include "reckon/tests/support/scratch_folder.hpp"
#include "reckon/tests/support/tier_rows.hpp"
#include "reckon/tests/tools/support/captured_console.hpp"
#include "reckon/tests/tools/support/temporary_scene.hpp"

namespace reckon::tools {
namespace {

using test::kFriction;
using test::kPlain;
using test::run_reckon;
using test::TemporaryScene;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

constexpr const char* kOperator = "[[operator]]\npassive = true\n";

TEST(SceneExplain, CountsTheGroupsOfTheRadius) {
  const TemporaryScene scene("[aoim]\nscheme = \"square\"\nradius = \"3 m\"\ngroups = 20\n");
  const auto result = run_reckon({"scene", "explain", scene.path()});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("square, 1 m; senses 3 m"));
  EXPECT_THAT(result.out, ::testing::ContainsRegex("the radius needs up to 4[5-9] of them"));
  EXPECT_THAT(result.out, HasSubstr("[aoim] groups is 20"));
}

TEST(SceneExplain, NamesTheRecipientsOfAnUpdate) {
  const auto explain = [](const std::string& tiers) {
    const TemporaryScene scene("[aoim]\npool = 100\nradius = \"90 m\"\n" + tiers);
    return run_reckon({"scene", "explain", scene.path()}).out;
  };
  EXPECT_THAT(explain(""), HasSubstr("one: all updates to all peers"));
  EXPECT_THAT(explain(test::kTouchTier),
              HasSubstr("peers that can touch, then all updates to all peers"));
  EXPECT_THAT(explain(test::kDistanceTiers),
              HasSubstr("to 200 m 10 Hz approximate, beyond 1 Hz rigid of the nearest receiver;"));
  const std::string all = explain(test::kAllTiers);
  EXPECT_THAT(all,
              HasSubstr("peers that can touch, to 1 m 1000 Hz full, to 50 m 30 Hz full, to 200 m "
                        "10 Hz approximate 4 x as coarse, beyond 1 Hz rigid 16 x as coarse;"));
  EXPECT_THAT(all, HasSubstr("in 100 more groups, which only peers that can touch"));
  EXPECT_THAT(all, HasSubstr("2 tiers in 200 more groups"));
  EXPECT_THAT(all, HasSubstr("the tier up to 200 m reaches the radius of 90 m"));
}

TEST(SceneExplain, MeasuresMovingBodies) {
  const TemporaryScene scene(
      "[[object]]\nname = \"floor\"\nplane = [0, 0, 1]\n[[object]]\nname = \"cube\"\n"
      "box = \"40 40 40 mm\"\nposition = \"0 0 20 mm\"\nmass = \"50 g\"\n" +
      std::string(kOperator) + "[[device]]\npeer = 1\noperator = 1\n");
  const auto text = run_reckon({"scene", "explain", scene.path()});
  EXPECT_EQ(text.status, 0) << text.err;
  EXPECT_THAT(text.out, ::testing::ContainsRegex(
                            "with 1 body awake and hands among them, the steps of all hands "
                            "take .* us in the median and .* us at p99; until the last force is "
                            "written .* us at p99; [0-9]+ of 700 periods are late"));
  const auto lines = run_reckon({"scene", "explain", scene.path(), "--json"});
  EXPECT_THAT(lines.out, HasSubstr("{\"kind\":\"bodies\",\"awake\":1,\"median_s\":"));
}

TEST(SceneExplain, PrintsTheTreeOfNodes) {
  const TemporaryScene scene(
      "[[node]]\nname = \"table\"\n"
      "[[node]]\nname = \"cup\"\nparent = \"table\"\nkind = \"switch\"\nshows = \"full\"\n"
      "[[node]]\nname = \"empty\"\nparent = \"cup\"\n"
      "[[node]]\nname = \"full\"\nparent = \"cup\"\n"
      "[[node]]\nname = \"cup2\"\nuse = \"cup\"\n"
      "[[node]]\nname = \"moon\"\nturn_rate = \"90 deg/s\"\nswing = [0, 0, 0.5]\n"
      "swing_rate = \"2 Hz\"\n"
      "[[node]]\nname = \"hill\"\nkind = \"level_of_detail\"\n"
      "[[node]]\nname = \"near\"\nparent = \"hill\"\nfarthest = \"20 m\"\n"
      "[[node]]\nname = \"far\"\nparent = \"hill\"\n"
      "[[object]]\nname = \"shell\"\nsphere = \"1 cm\"\nnode = \"empty\"\n"
      "[[object]]\nname = \"tea\"\nsphere = \"1 cm\"\nnode = \"full\"\n");
  const auto result = run_reckon({"scene", "explain", scene.path()});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out,
              ::testing::ContainsRegex("nodes +11, 5 levels with the scene and its objects"));
  EXPECT_THAT(result.out,
              ::testing::ContainsRegex("hang on them +4 objects, 2 of them from copies"));
  EXPECT_THAT(result.out, ::testing::ContainsRegex("copy +cup2 of cup"));
  EXPECT_THAT(result.out, HasSubstr("cup2 shows cup2/full of cup2/empty, cup2/full"));
  EXPECT_THAT(result.out, HasSubstr("hill: near to 20 m, far at any distance; hands feel near"));
  EXPECT_THAT(result.out, HasSubstr("moon turns by 90 deg/s about [0, 0, 1], swings by [0, 0, 0.5] "
                                    "m at 2 Hz, from 0 deg"));
  EXPECT_THAT(result.out, HasSubstr("shell, cup2/shell: hidden by a switch, or a coarser level"));
  EXPECT_THAT(run_reckon({"scene", "check", scene.path()}).out,
              HasSubstr("good; 2 objects, 0 operators, 11 nodes, hash"));
  EXPECT_THAT(run_reckon({"scene", "check", scene.path(), "--json"}).out,
              HasSubstr("\"nodes\":11,"));
  const TemporaryScene plain("[[object]]\nname = \"tea\"\nsphere = \"1 cm\"\n");
  EXPECT_THAT(run_reckon({"scene", "explain", plain.path()}).out, Not(HasSubstr("SCENE GRAPH")));
}

TEST(SceneExplain, PrintsTheCostOfAQuadTree) {
  const test::ScratchFolder folder;
  std::ofstream sample(folder.file("town.csv"));
  sample << "x_m,y_m\n";
  for (int i = 0; i < 200; ++i) sample << 3000 + 7 * i % 400 << ',' << 600 + 11 * i % 400 << '\n';
  sample.close();
  std::ofstream(folder.file("town.toml"))
      << "[aoim]\nscheme = \"quadtree\"\nradius = \"100 m\"\npool = 16\n[aoim.quadtree]\n"
         "centre = [2000, 2000, 0]\nside = \"4 km\"\ndensity = \"town.csv\"\n"
         "reach = \"100 m\"\n";
  const auto result = run_reckon({"scene", "explain", folder.file("town.toml")});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("quad-tree of 16 cells in a square of 4 km: "));
  EXPECT_THAT(result.out, HasSubstr("for 200 sampled positions, "));
  EXPECT_THAT(result.out, HasSubstr("with equal squares of 1 km"));
}

TEST(SceneExplain, CountsLocales) {
  const TemporaryScene scene(
      "[aoim]\nscheme = \"locales\"\nradius = \"3 m\"\n"
      "[[aoim.locale]]\nname = \"a\"\nsize = [4, 6, 0]\nneighbours = \"b\"\n"
      "[[aoim.locale]]\nname = \"b\"\norigin = [4, 0, 0]\nsize = [4, 8, 0]\n");
  const auto result = run_reckon({"scene", "explain", scene.path()});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("2 locales of 4 m to 8 m, with 1 connections; senses 3 m"));
}

TEST(SceneExplain, ListsExactlyTheEffectsThatTheSceneDeclares) {
  const TemporaryScene scene(kFriction);
  const auto result = run_reckon({"scene", "explain", "--json", scene.path()});
  ASSERT_EQ(result.status, 0) << result.err;
  std::vector<std::string> friction, springs, absent;
  for (const std::string& line : result.lines()) {
    const auto row = nlohmann::json::parse(line);
    const std::string kind = row["kind"];
    const std::string object = row.value("object", "");
    if (kind == "left_out" && row["effect"] == "stick_slip_friction")
      absent = row["objects"].get<std::vector<std::string>>();
    if (kind != "stage") continue;
    if (row["stage"] == "stick_slip_friction") friction.push_back(object);
    if (row["stage"] == "spring_damper") springs.push_back(object);
    EXPECT_NE(row["cost"], "") << line;
  }
  EXPECT_THAT(friction, testing::ElementsAre("floor"));
  EXPECT_THAT(springs, testing::UnorderedElementsAre("floor", "ball"));
  EXPECT_THAT(absent, testing::ElementsAre("ball"));
}

TEST(SceneExplain, ShowsHowToAddOmittedEffects) {
  const TemporaryScene scene(kPlain);
  const auto result = run_reckon({"scene", "explain", scene.path()});
  EXPECT_EQ(result.status, 0);
  EXPECT_THAT(result.out, HasSubstr("friction = { static = 0.5, kinetic = 0.35 }"));

  const TemporaryScene with(std::string(kPlain) + "friction = { static = 0.5, kinetic = 0.35 }\n");
  const std::string out = run_reckon({"scene", "explain", with.path()}).out;
  EXPECT_THAT(out.substr(out.find("LEFT OUT")), Not(HasSubstr("friction = { static")));
}

TEST(SceneExplain, ListsTheEffectsOfRegions) {
  const TemporaryScene scene(std::string(kPlain) +
                             "[[region]]\nname = \"pool\"\nbox = [1, 1, 0.5]\n"
                             "viscosity = { linear = \"4 N s/m\" }\n");
  const std::string out = run_reckon({"scene", "explain", scene.path()}).out;
  const std::size_t absent = out.find("LEFT OUT");
  EXPECT_THAT(out.substr(0, absent), HasSubstr("in a box"));
  EXPECT_THAT(out.substr(0, absent), HasSubstr("linear 4 N s/m"));
  EXPECT_THAT(out.substr(absent), Not(HasSubstr("viscosity = {")));
  EXPECT_THAT(out.substr(absent), HasSubstr("a [[region]]"));
}

TEST(SceneExplain, ReportsThatNothingRunsInAnEmptyWorld) {
  const TemporaryScene scene("");
  const auto result = run_reckon({"scene", "explain", scene.path()});
  EXPECT_EQ(result.status, 0);
  EXPECT_THAT(result.out, HasSubstr("nothing to touch"));
  EXPECT_THAT(result.out, Not(HasSubstr("stick_slip")));
}

TEST(SceneExplain, PrintsTheLimits) {
  const TemporaryScene scene("[network]\nentities = 1234\n");
  const auto text = run_reckon({"scene", "explain", scene.path()});
  EXPECT_THAT(text.out, HasSubstr("LIMITS"));
  std::map<std::string, std::string> limits;
  for (const std::string& line : run_reckon({"scene", "explain", "--json", scene.path()}).lines()) {
    const auto row = nlohmann::json::parse(line);
    if (row["kind"] == "limit") limits[row["what"]] = row["value"];
  }
  EXPECT_THAT(limits["remote entities"], HasSubstr("1234 rows of "));
  EXPECT_THAT(limits["remote entities"], HasSubstr("(table_full)"));
  EXPECT_THAT(limits["rings of datagrams"], HasSubstr("2 MiB each way"));
  EXPECT_THAT(limits["felt by a hand"], HasSubstr("the 32 nearest bodies within 250 mm"));
  EXPECT_EQ(limits["moving objects"],
            "256 at most, 64 of them awake; while 64 are awake, no other one wakes (not_woken)");
  EXPECT_THAT(limits["devices of a peer"], HasSubstr("8 at most"));
  EXPECT_THAT(limits["rows of a picture"], HasSubstr("64"));
  EXPECT_THAT(limits["peers known"], HasSubstr("1024"));
}

/// The fact `what` of each thing that peers own, by "PEER HAS".
std::map<std::string, std::string> facts(const std::string& text, const std::string& what) {
  const TemporaryScene scene(text);
  const auto result = run_reckon({"scene", "explain", "--json", scene.path()});
  EXPECT_EQ(result.status, 0) << result.err;
  std::map<std::string, std::string> found;
  for (const std::string& line : result.lines()) {
    const auto row = nlohmann::json::parse(line);
    if (row["kind"] != "peer" || row["what"] != what) continue;
    found[fmt::format("{} {}", row["peer"].get<int>(), row["has"].get<std::string>())] =
        row["value"];
  }
  return found;
}

// Computed by hand: a hand has at most K = 0.95 b / (T (1 + 2 d)), a wall 3/4 of twice that.
TEST(SceneExplain, PrintsTheStiffnessOfEachDevice) {
  const std::string text = std::string(kOperator) +
                           "[hand]\nk1 = 500\ndamping = 0\n"
                           "[[device]]\nmarking = \"A\"\n"
                           "[[device]]\nmarking = \"B\"\ndamping = 4\nrate = \"2 kHz\"\n"
                           "[[device]]\nmarking = \"C\"\ndelay = \"2 ms\"\n"
                           "[[device]]\nmarking = \"D\"\nmax_stiffness = 450\n";
  auto stiffness = facts(text, "stiffness");
  EXPECT_THAT(stiffness["1 device 1 A"],
              testing::ContainsRegex("^walls up to 1.4.* kN/m, hands up to 950 N/m"));
  EXPECT_THAT(stiffness["1 device 2 B"], StartsWith("walls up to 11.4 kN/m, hands up to 7.6 kN/m"));
  EXPECT_THAT(stiffness["1 device 3 C"], StartsWith("walls up to 285 N/m, hands up to 190 N/m"));
  EXPECT_THAT(stiffness["1 device 1 A"], HasSubstr("hands as asked"));
  EXPECT_THAT(stiffness["1 device 3 C"], Not(HasSubstr("as asked")));
  EXPECT_THAT(stiffness["1 device 4 D"], HasSubstr("hands up to 450 N/m"));
}

// Half of what a device of 1 N s/m holds is used by the damper: 950 N/m becomes 475 N/m.
TEST(SceneExplain, PrintsAHandsStiffnessBesideItsDamper) {
  const std::string text = std::string(kOperator) +
                           "[hand]\nk1 = 700\ndamping = 2\n[[device]]\n"
                           "[[entity]]\nmarking = \"POST\"\ntype = \"5.1\"\npeer = 2\n"
                           "force_model = { kind = \"sphere\", k1 = 700, damping = 0.25 }\n";
  EXPECT_THAT(
      facts(text, "stiffness")["1 device 1 "],
      ::testing::EndsWith(
          "hands up to 475 N/m with a damper of 0.5 N s/m, 950 N/m without it; entities as asked"));
  const TemporaryScene scene(text);
  const std::string out = run_reckon({"scene", "explain", scene.path()}).out;
  EXPECT_THAT(out, HasSubstr("hand has 700 N/m, but is rendered with 475 N/m by its device, 950 "
                             "N/m without its damper; a weaker damper, more"));
}

// 0.95 of 2 b / T is 1900 N/m: 1900 N/s at 1 m/s.
TEST(SceneExplain, PrintsTheForceRateLimitOfEachDevice) {
  const std::string text = std::string(kOperator) +
                           "[[device]]\nmarking = \"A\"\n"
                           "[[device]]\nmarking = \"B\"\nmax_force_rate = 300\n"
                           "[[device]]\nmarking = \"C\"\nmax_force_rate = \"5 kN/s\"\n";
  auto grows = facts(text, "force grows by");
  EXPECT_EQ(grows["1 device 1 A"], "up to 1.9 kN/s");
  EXPECT_EQ(grows["1 device 2 B"], "up to 300 N/s");
  EXPECT_THAT(grows["1 device 3 C"], StartsWith("up to 1.9 kN/s of the requested 5 kN/s"));
}

TEST(SceneExplain, PrintsWhichBodiesAHandHolds) {
  auto holds = facts(std::string(kOperator) +
                         "[hand]\ngrab_stiffness = 100\n"
                         "[[object]]\nname = \"cube\"\nbox = \"40 40 40 mm\"\nmass = 1\n"
                         "surface = { stiffness = 500 }\n"
                         "[[device]]\npeer = 1\n[[device]]\npeer = 2\ngrab_button = 1\n",
                     "holds bodies");
  ASSERT_EQ(holds.size(), 2U);
  EXPECT_THAT(holds.begin()->second, StartsWith("while button 0 is pressed, by "));
  EXPECT_THAT(holds.begin()->second, Not(HasSubstr("copy")));
  EXPECT_THAT(holds.rbegin()->second, StartsWith("while button 1 is pressed, by "));
  EXPECT_THAT(holds.rbegin()->second,
              HasSubstr("only bodies that its peer simulates, as owner or as a copy"));
}

TEST(SceneExplain, PrintsTheContactShapeOfAHand) {
  const TemporaryScene ball("[hand]\ncontact_radius = \"2 mm\"\n"), point("");
  EXPECT_THAT(run_reckon({"scene", "explain", ball.path()}).out,
              HasSubstr("feels objects with a ball of 2 mm"));
  EXPECT_THAT(run_reckon({"scene", "explain", point.path()}).out,
              HasSubstr("feels objects with a point"));
}

// A surface may use 3/4 of the damping: 1425 N/m of 1900 N/m.
TEST(SceneExplain, ReportsSoftenedSurfaces) {
  const auto with = [](const std::string& stiffness) {
    return facts(std::string(kPlain) + "surface = { stiffness = " + stiffness + " }\n",
                 "stiffness")["1 device 1 "];
  };
  EXPECT_THAT(with("1400"), HasSubstr("objects and hands as asked"));
  EXPECT_THAT(with("1800"), Not(HasSubstr("objects")));
  EXPECT_THAT(with("1800"), testing::ContainsRegex("^walls up to 1.43 kN/m, .*; hands as asked"));
}

TEST(SceneExplain, PrintsThePossessionsOfEachPeer) {
  const std::string text = std::string(kOperator) +
                           "[[device]]\npeer = 3\n[[entity]]\npeer = 1\nmarking = \"POST\"\n"
                           "type = \"Platform Land Switzerland Tank\"\nposition = [1, 2, 3]\n"
                           "force_model = { kind = \"sphere\" }\n[[entity]]\ntype = \"1.2\"\n";
  EXPECT_THAT(
      facts(text, "type"),
      testing::ElementsAre(
          testing::Pair("1 entity 1 POST", "1.1.206.1.0.0.0 (Platform Land Switzerland Tank)"),
          testing::Pair("1 entity 2 ", "1.2.0.0.0.0.0 (Platform Air)")));
  auto sends = facts(text, "sends");
  EXPECT_EQ(sends["1 entity 1 POST"], "when off by 500 um or 3 deg or 50 mN; else every 5 s");
  EXPECT_EQ(sends["1 entity 2 "], "when off by 1 m or 3 deg; else every 60 s");
  EXPECT_EQ(facts(text, "motion")["1 entity 1 POST"], "stands at [1, 2, 3] m");
  auto felt = facts(text, "felt");
  EXPECT_EQ(felt["1 entity 1 POST"], "sphere of 20 mm, 475 N/m, 0.5 N s/m; gives up to 50 mW");
  EXPECT_THAT(felt["1 entity 2 "], HasSubstr("nothing"));
  EXPECT_EQ(facts(text, "")["2 nothing"], "it only receives");
  EXPECT_EQ(facts(text, "held by")["3 device 1 "], "operator 1, passive");

  const TemporaryScene scene(text);
  EXPECT_THAT(run_reckon({"scene", "explain", scene.path()}).out, HasSubstr("entity 1 POST"));
}

}  // namespace
}  // namespace reckon::tools
