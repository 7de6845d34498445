// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// `reckon scene`: what it says of good and bad scene files, and that it explains what a scene
// declares.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "reckon/tests/support/mesh_text.hpp"
#include "reckon/tests/support/places.hpp"
#include "reckon/tests/support/scratch_folder.hpp"
#include "reckon/tests/tools/support/captured_console.hpp"

namespace reckon::tools {
namespace {

using test::run_reckon;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

constexpr const char* kPlain = "[[object]]\nname = \"floor\"\nplane = [0, 0, 1]\n";
constexpr const char* kFriction =
    "[[object]]\nname = \"floor\"\nplane = [0, 0, 1]\nfriction = { static = 0.6, kinetic = 0.4 }\n"
    "[[object]]\nname = \"ball\"\nsphere = \"40 mm\"\n";

/// A scene file that is gone at the end of its scope.
class TemporaryScene {
 public:
  explicit TemporaryScene(const std::string& text)
      : path_(std::filesystem::temp_directory_path() /
              fmt::format("reckon_verb_scene_{}_{}.toml", getpid(), ++count_)) {
    std::ofstream(path_) << text;
  }
  ~TemporaryScene() { std::filesystem::remove(path_); }
  TemporaryScene(const TemporaryScene&) = delete;
  TemporaryScene& operator=(const TemporaryScene&) = delete;

  [[nodiscard]] std::string path() const { return path_.string(); }

 private:
  inline static int count_ = 0;
  std::filesystem::path path_;
};

TEST(SceneCheck, IsContentWithAGoodFile) {
  const TemporaryScene scene(kFriction);
  const auto result = run_reckon({"scene", "check", scene.path()});
  EXPECT_EQ(result.status, 0) << result.out << result.err;
  EXPECT_THAT(result.out, StartsWith(scene.path() + ": good; 2 objects, 0 operators, hash "));
}

TEST(SceneCheck, NotesThatTheRadiusHearsEverythingOrReachesTheCap) {
  const TemporaryScene all("[aoim]\npool = 16\nradius = \"20 m\"\n");
  const auto everything = run_reckon({"scene", "check", all.path()});
  EXPECT_EQ(everything.status, 0);
  EXPECT_THAT(everything.out, HasSubstr("note: the radius of 20 m reaches all 16 groups in use"));
  const TemporaryScene cap("[aoim]\ngroups = 20\nradius = \"20 m\"\n[hand]\nk1 = 400\n");
  const auto capped = run_reckon({"scene", "check", "--json", cap.path()});
  EXPECT_EQ(capped.status, 0);
  const auto json = nlohmann::json::parse(capped.out);
  ASSERT_EQ(json["notes"].size(), 1u);
  EXPECT_THAT(json["notes"][0].get<std::string>(),
              HasSubstr("may need 256 groups and [aoim] groups allows 20"));
}

TEST(SceneCheck, RefusesAPoolThatNoDemoWouldTake) {
  for (const char* pool : {"2", "3"}) {
    const TemporaryScene scene(fmt::format("[aoim]\npool = {}\n", pool));
    const auto result = run_reckon({"scene", "check", scene.path()});
    EXPECT_EQ(result.status, 1);
    EXPECT_THAT(result.out, HasSubstr("take 4 to 1000, or 1 for a world that is not divided"));
  }
}

TEST(SceneExplain, SaysHowManyGroupsTheRadiusNeeds) {
  const TemporaryScene scene("[aoim]\nscheme = \"square\"\nradius = \"3 m\"\ngroups = 20\n");
  const auto result = run_reckon({"scene", "explain", scene.path()});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("square, 1 m; senses 3 m"));
  EXPECT_THAT(result.out, ::testing::ContainsRegex("the radius needs up to 4[5-9] of them"));
  EXPECT_THAT(result.out, HasSubstr("[aoim] groups allows 20"));
}

TEST(SceneExplain, SaysWhatAQuadTreeCosts) {
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
  EXPECT_THAT(result.out, HasSubstr("of the sample's 200 places, "));
  EXPECT_THAT(result.out, HasSubstr("with equal squares of 1 km"));
}

TEST(SceneExplain, SaysHowManyLocalesThereAre) {
  const TemporaryScene scene(
      "[aoim]\nscheme = \"locales\"\nradius = \"3 m\"\n"
      "[[aoim.locale]]\nname = \"a\"\nsize = [4, 6, 0]\nneighbours = \"b\"\n"
      "[[aoim.locale]]\nname = \"b\"\norigin = [4, 0, 0]\nsize = [4, 8, 0]\n");
  const auto result = run_reckon({"scene", "explain", scene.path()});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("2 locales of 4 m to 8 m, ways between them: 1; senses 3 m"));
}

TEST(SceneCheck, TellsPlaceAndRemedyOfEachProblem) {
  const TemporaryScene scene("[[object]]\nname = \"a\"\nsphere = 1\nsurface = { stifness = 8 }\n");
  const auto result = run_reckon({"scene", "check", scene.path()});
  EXPECT_EQ(result.status, 1);
  EXPECT_EQ(result.out,
            scene.path() + ":4:13: unknown key 'stifness' (did you mean 'stiffness'?)\n");
}

TEST(SceneCheck, LooksAtEveryFileAndTellsTheWorst) {
  const TemporaryScene good(kPlain);
  const TemporaryScene bad("[scene]\nnane = 3\n");
  const auto result = run_reckon({"scene", "check", bad.path(), good.path()});
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.out, HasSubstr("did you mean 'name'?"));
  EXPECT_THAT(result.out, HasSubstr(good.path() + ": good"));
}

TEST(SceneCheck, TellsWhatIsWrongWithAMesh) {
  const TemporaryScene mesh("this is no mesh\n");
  const TemporaryScene scene(fmt::format("[[object]]\nname = \"a\"\nmesh = \"{}\"\n", mesh.path()));
  const auto result = run_reckon({"scene", "check", scene.path()});
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.out, StartsWith(scene.path() + ": "));
}

/// A scene of one object, the mesh `stone`.
std::string scene_of(const test::TemporaryMesh& mesh) {
  return fmt::format("[[object]]\nname = \"stone\"\nmesh = \"{}\"\n", mesh.path().string());
}

// A cube of 100 m, that is of 100 mm drawn in millimetres; one face is missing, one turned, one
// twice.
std::string bad_cube() {
  test::MeshData cube = test::cube();
  for (auto& v : cube.vertices) v *= 100.0;
  cube.triangles.pop_back();
  std::swap(cube.triangles[2][0], cube.triangles[2][1]);
  cube.triangles.push_back(cube.triangles[5]);
  return test::obj_text(cube);
}

TEST(SceneCheck, TellsTheSizeOfAMeshAndNothingElseWhereItIsGood) {
  const test::TemporaryMesh mesh(".obj", test::obj_text(test::cube()));
  const TemporaryScene scene(scene_of(mesh));
  const auto result = run_reckon({"scene", "check", scene.path()});
  EXPECT_EQ(result.status, 0) << result.out;
  EXPECT_THAT(result.out, HasSubstr("mesh of \"stone\": 1 x 1 x 1 m, 12 triangles, closed\n"));
  EXPECT_THAT(result.out, Not(HasSubstr("note: mesh")));
}

TEST(SceneCheck, CountsThePatchesOfAMeshAndTellsWhatIsNotFound) {
  const test::TemporaryMesh mesh(
      ".obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nusemtl felt\nf 1 3 4\n");
  const TemporaryScene scene(scene_of(mesh) +
                             "patch = [{ name = \"felt\", surface = { stiffness = 200 } },\n"
                             "         { name = \"steel\", surface = { stiffness = 900 } }]\n");
  const auto result = run_reckon({"scene", "check", scene.path()});
  EXPECT_EQ(result.status, 0) << result.out;
  EXPECT_THAT(result.out, HasSubstr("; patches: 1 felt (1)\n"));
  EXPECT_THAT(result.out, HasSubstr("note: mesh of \"stone\": patch \"steel\" is no material or "
                                    "group of any face; the file has felt"));
  EXPECT_THAT(result.out, HasSubstr("1 of 2 triangles is in no patch and feels as the object"));
  const auto json = run_reckon({"scene", "check", "--json", scene.path()});
  const auto patches = nlohmann::json::parse(json.out)["meshes"][0]["patches"];
  ASSERT_EQ(patches.size(), 1u);
  EXPECT_EQ(patches[0]["patch"], 1);
  EXPECT_EQ(patches[0]["name"], "felt");
  EXPECT_EQ(patches[0]["triangles"], 1);
  EXPECT_THAT(run_reckon({"scene", "explain", scene.path()}).out,
              HasSubstr("\"felt\", number 1, stiffness 200 N/m"));
}

TEST(SceneCheck, TellsWhatWasMendedInAMesh) {
  const test::TemporaryMesh mesh(".obj", bad_cube());
  const TemporaryScene scene(scene_of(mesh));
  const auto result = run_reckon({"scene", "check", scene.path()});
  EXPECT_EQ(result.status, 0) << result.out;
  EXPECT_THAT(result.out, HasSubstr("100 x 100 x 100 m, 11 triangles, open, both sides felt"));
  EXPECT_THAT(result.out, HasSubstr("note: mesh of \"stone\": is 173.2 m large"));
  EXPECT_THAT(result.out, HasSubstr("scale_to = \"173.2 mm\""));
  EXPECT_THAT(result.out, HasSubstr("1 triangle was dropped that had the corners of another"));
  EXPECT_THAT(result.out, HasSubstr("1 triangle ran against the neighbours and was turned (first: "
                                    "line 11)"));
  EXPECT_THAT(result.out, HasSubstr("is open: 3 edges of one triangle only, round 1 hole"));

  const auto json = run_reckon({"scene", "check", "--json", scene.path()});
  const auto row = nlohmann::json::parse(json.out);
  ASSERT_EQ(row["meshes"].size(), 1u);
  const auto& facts = row["meshes"][0];
  EXPECT_EQ(facts["object"], "stone");
  EXPECT_EQ(facts["file"], mesh.path().string());
  EXPECT_EQ(facts["extent_m"], nlohmann::json({100, 100, 100}));
  EXPECT_EQ(facts["triangles"], 11);
  EXPECT_EQ(facts["closed"], false);
  EXPECT_TRUE(facts["volume_m3"].is_null());
  EXPECT_EQ(facts["duplicates_dropped"], 1);
  EXPECT_EQ(facts["triangles_turned"], 1);
  EXPECT_EQ(facts["holes"], 1);
  EXPECT_EQ(row["notes"].size(), facts["notes"].size() + row["softened"].size());
}

TEST(SceneExplain, TellsWhatWasMendedInAMesh) {
  const test::TemporaryMesh mesh(".obj", bad_cube());
  const TemporaryScene scene(scene_of(mesh));
  const auto text = run_reckon({"scene", "explain", scene.path()});
  EXPECT_THAT(text.out, HasSubstr("open mesh, both sides felt, size 173.2 m"));
  EXPECT_THAT(text.out, testing::ContainsRegex("\nMESH +FILE +FOUND\nstone +[^ ]+ +100 x 100 x"));
  EXPECT_THAT(text.out, HasSubstr("1 triangle ran against the neighbours"));
  int meshes = 0;
  for (const std::string& line : run_reckon({"scene", "explain", "--json", scene.path()}).lines()) {
    const auto row = nlohmann::json::parse(line);
    if (row["kind"] != "mesh") continue;
    ++meshes;
    EXPECT_EQ(row["boundary_edges"], 3);
  }
  EXPECT_EQ(meshes, 1);
}

TEST(SceneCheck, TellsThatAMeshIsDrawnFarAway) {
  const test::TemporaryMesh mesh(".obj",
                                 test::obj_text(test::cube(), {4321012.25, 678901.5, 432.0}));
  const TemporaryScene scene(scene_of(mesh));
  const auto result = run_reckon({"scene", "check", scene.path()});
  EXPECT_THAT(result.out, HasSubstr("lies 4374 km from the scene's origin"));
  const TemporaryScene centred(scene_of(mesh) + "centre = true\n");
  EXPECT_THAT(run_reckon({"scene", "check", centred.path()}).out, Not(HasSubstr("note: mesh")));
}

TEST(SceneCheck, NamesFileAndLineOfAFaultInAMesh) {
  const test::TemporaryMesh mesh(".obj", "v 0 0 0\nv 1 0 0\nv 0 nan 0\nf 1 2 3\n");
  const TemporaryScene scene(scene_of(mesh));
  const auto result = run_reckon({"scene", "check", scene.path()});
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.out, HasSubstr(mesh.path().string() + ":3: vertex 2, counted from 0, is not "
                                                           "finite; mend it"));
  EXPECT_THAT(result.out, HasSubstr("object \"stone\""));
}

TEST(SceneCheck, TellsWhatIsWrongWithATrace) {
  const TemporaryScene trace("t_s,px_m\n0,0\n");
  const TemporaryScene scene(fmt::format("[[operator]]\ntrace = \"{}\"\n", trace.path()));
  const auto result = run_reckon({"scene", "check", scene.path()});
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.out, HasSubstr(trace.path()));
}

TEST(SceneCheck, IsContentWithTheScenesOfTheProject) {
  std::size_t scenes = 0;
  for (const auto& entry :
       std::filesystem::directory_iterator(reckon::test::source_dir() + "/scenes")) {
    if (entry.path().extension() != ".toml") continue;
    const auto result = run_reckon({"scene", "check", entry.path().string()});
    EXPECT_EQ(result.status, 0) << result.out;
    ++scenes;
  }
  EXPECT_GE(scenes, 5U);
}

TEST(SceneCheck, GivesOneJsonObjectALine) {
  const TemporaryScene good(kPlain);
  const TemporaryScene bad("[scene]\nnane = 3\n");
  const auto result = run_reckon({"scene", "check", "--json", good.path(), bad.path()});
  ASSERT_EQ(result.lines().size(), 2U);
  const auto first = nlohmann::json::parse(result.lines()[0]);
  EXPECT_EQ(first["status"], "ok");
  EXPECT_EQ(first["objects"], 1);
  const auto second = nlohmann::json::parse(result.lines()[1]);
  EXPECT_EQ(second["status"], "error");
  EXPECT_EQ(second["line"], 2);
  EXPECT_EQ(second["column"], 1);
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
    if (kind == "left_out") absent.push_back(row["effect"].get<std::string>() + " " + object);
    if (kind != "stage") continue;
    if (row["stage"] == "stick_slip_friction") friction.push_back(object);
    if (row["stage"] == "spring_damper") springs.push_back(object);
    EXPECT_NE(row["cost"], "") << line;
  }
  EXPECT_THAT(friction, testing::ElementsAre("floor"));
  EXPECT_THAT(springs, testing::UnorderedElementsAre("floor", "ball"));
  EXPECT_THAT(absent, testing::ElementsAre("stick_slip_friction ball"));
}

TEST(SceneExplain, SaysHowToHaveWhatIsLeftOut) {
  const TemporaryScene scene(kPlain);
  const auto result = run_reckon({"scene", "explain", scene.path()});
  EXPECT_EQ(result.status, 0);
  EXPECT_THAT(result.out, HasSubstr("friction = { static = 0.5, kinetic = 0.35 }"));

  const TemporaryScene with(std::string(kPlain) + "friction = { static = 0.5, kinetic = 0.35 }\n");
  EXPECT_THAT(run_reckon({"scene", "explain", with.path()}).out, HasSubstr("nothing is left out"));
}

TEST(SceneExplain, OfAnEmptyWorldSaysThatNothingRuns) {
  const TemporaryScene scene("");
  const auto result = run_reckon({"scene", "explain", scene.path()});
  EXPECT_EQ(result.status, 0);
  EXPECT_THAT(result.out, HasSubstr("nothing to touch"));
  EXPECT_THAT(result.out, Not(HasSubstr("stick_slip")));
}

TEST(SceneExplain, SaysHowLargeThingsAreMade) {
  const TemporaryScene scene("");
  const auto text = run_reckon({"scene", "explain", scene.path()});
  EXPECT_THAT(text.out, HasSubstr("LIMITS"));
  std::map<std::string, std::string> limits;
  for (const std::string& line : run_reckon({"scene", "explain", "--json", scene.path()}).lines()) {
    const auto row = nlohmann::json::parse(line);
    if (row["kind"] == "limit") limits[row["what"]] = row["value"];
  }
  EXPECT_THAT(limits["remote entities"], HasSubstr("100000 rows of "));
  EXPECT_THAT(limits["remote entities"], HasSubstr("(table_full)"));
  EXPECT_THAT(limits["rings of datagrams"], HasSubstr("2 MiB each way"));
  EXPECT_THAT(limits["felt by a hand"], HasSubstr("within 250 mm of it, the 32 nearest"));
  EXPECT_THAT(limits["devices of a peer"], HasSubstr("8 at most"));
  EXPECT_THAT(limits["rows of a picture"], HasSubstr("64"));
  EXPECT_THAT(limits["peers known"], HasSubstr("1024"));
}

/// What `explain` says of each thing that peers have: value of `what`, by "PEER HAS".
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

constexpr const char* kOperator = "[[operator]]\npassive = true\n";

// By hand: a hand has at most K = 0.95 b / (T (1 + 2 d)), a wall 3/4 of twice that.
TEST(SceneExplain, TellsTheStiffnessThatEachDeviceCanShow) {
  const std::string text = std::string(kOperator) +
                           "[hand]\nk1 = 500\n"
                           "[[device]]\nmarking = \"A\"\n"
                           "[[device]]\nmarking = \"B\"\ndamping = 4\nrate = \"2 kHz\"\n"
                           "[[device]]\nmarking = \"C\"\ndelay = \"2 ms\"\n"
                           "[[device]]\nmarking = \"D\"\nmax_stiffness = 450\n";
  auto stiffness = facts(text, "stiffness");
  EXPECT_THAT(stiffness["1 device 1 A"],
              testing::ContainsRegex("^walls up to 1.4.* kN/m, hands up to 950 N/m"));
  EXPECT_THAT(stiffness["1 device 2 B"], StartsWith("walls up to 11.4 kN/m, hands up to 7.6 kN/m"));
  EXPECT_THAT(stiffness["1 device 3 C"], StartsWith("walls up to 285 N/m, hands up to 190 N/m"));
  EXPECT_THAT(stiffness["1 device 1 A"], HasSubstr("hands 500 N/m as asked"));
  EXPECT_THAT(stiffness["1 device 3 C"], HasSubstr("190 N/m of 500 N/m asked: softened"));
  EXPECT_THAT(stiffness["1 device 4 D"], HasSubstr("450 N/m of 500 N/m asked: softened"));
}

// 0.95 of 2 b / T is 1900 N/m: 1900 N/s at 1 m/s.
TEST(SceneExplain, TellsHowFastTheForceOfEachDeviceMayGrow) {
  const std::string text = std::string(kOperator) +
                           "[[device]]\nmarking = \"A\"\n"
                           "[[device]]\nmarking = \"B\"\nmax_force_rate = 300\n"
                           "[[device]]\nmarking = \"C\"\nmax_force_rate = \"5 kN/s\"\n";
  auto grows = facts(text, "force grows by");
  EXPECT_EQ(grows["1 device 1 A"], "up to 1.9 kN/s");
  EXPECT_EQ(grows["1 device 2 B"], "up to 300 N/s");
  EXPECT_THAT(grows["1 device 3 C"], StartsWith("up to 1.9 kN/s of 5 kN/s asked"));
}

TEST(SceneExplain, TellsWhatAHandFeelsObjectsWith) {
  const TemporaryScene ball("[hand]\ncontact_radius = \"2 mm\"\n"), point("");
  EXPECT_THAT(run_reckon({"scene", "explain", ball.path()}).out,
              HasSubstr("feels objects with a ball of 2 mm"));
  EXPECT_THAT(run_reckon({"scene", "explain", point.path()}).out,
              HasSubstr("feels objects with a point"));
}

TEST(SceneExplain, TellsThatABaselineIsForStudiesAndDemoRefusesIt) {
  const TemporaryScene baseline("[coupling]\nmode = \"effort_flow\"\n"), ours("");
  EXPECT_EQ(run_reckon({"scene", "check", baseline.path()}).status, 0);
  EXPECT_THAT(run_reckon({"scene", "explain", baseline.path()}).out,
              HasSubstr("effort_flow, a baseline: `bench stability` runs it"));
  EXPECT_THAT(run_reckon({"scene", "explain", ours.path()}).out, Not(HasSubstr("baseline")));
  for (const char* verb : {"demo", "peer"}) {
    const auto refused = run_reckon({verb, baseline.path(), "--iface", "lo"});
    EXPECT_EQ(refused.status, 2) << verb;
    EXPECT_THAT(refused.err, HasSubstr("\"effort_flow\" is a baseline for studies")) << verb;
  }
}

// A surface may lean on 3/4 of the damping: 1425 N/m of 1900 N/m.
TEST(SceneExplain, TellsWhetherSurfacesAreSoftened) {
  const auto with = [](const std::string& stiffness) {
    return facts(std::string(kPlain) + "surface = { stiffness = " + stiffness + " }\n",
                 "stiffness")["1 device 1 "];
  };
  EXPECT_THAT(with("1400"), HasSubstr("objects 1.4 kN/m as asked"));
  EXPECT_THAT(with("1800"), testing::ContainsRegex("objects 1.42.* of 1.8 kN/m asked: softened"));
}

TEST(SceneExplain, TellsWhatEachPeerHas) {
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
  EXPECT_EQ(felt["1 entity 1 POST"], "sphere of 20 mm, 800 N/m, 2 N s/m; gives up to 50 mW");
  EXPECT_THAT(felt["1 entity 2 "], HasSubstr("nothing"));
  EXPECT_EQ(facts(text, "")["2 nothing"], "it only listens");
  EXPECT_EQ(facts(text, "held by")["3 device 1 "], "operator 1, passive");

  const TemporaryScene scene(text);
  EXPECT_THAT(run_reckon({"scene", "explain", scene.path()}).out, HasSubstr("entity 1 POST"));
}

TEST(SceneNew, PrintsASceneThatIsGoodAsItIsAndWithAllItsExamples) {
  const auto result = run_reckon({"scene", "new"});
  EXPECT_EQ(result.status, 0);
  std::string examples;
  for (const std::string& line : result.lines()) {
    examples += (line.starts_with("# ") ? line.substr(2) : line) + "\n";
    EXPECT_LE(line.size(), 100u);
  }
  const TemporaryScene as_it_is(result.out), with_all(examples);
  EXPECT_THAT(run_reckon({"scene", "check", as_it_is.path()}).out,
              HasSubstr(": good; 1 object, 1 operator, hash"));
  EXPECT_THAT(run_reckon({"scene", "check", with_all.path()}).out,
              HasSubstr(": good; 2 objects, 1 operator, 1 device, 2 entities, hash"));
  EXPECT_EQ(run_reckon({"scene", "new", "x.toml"}).status, 2);
}

TEST(SceneKeysVerb, PrintsTheTablesOfTheDocumentation) {
  const auto result = run_reckon({"scene", "keys"});
  EXPECT_EQ(result.status, 0);
  EXPECT_THAT(result.out, StartsWith("### The file\n"));
  for (const std::string& line : run_reckon({"scene", "keys", "--json"}).lines()) {
    EXPECT_TRUE(nlohmann::json::accept(line)) << line;
  }
}

TEST(SceneVerb, SaysWhatItWants) {
  EXPECT_EQ(run_reckon({"scene"}).status, 2);
  EXPECT_EQ(run_reckon({"scene", "check"}).status, 2);
  EXPECT_EQ(run_reckon({"scene", "chekc", "x.toml"}).status, 2);
  const auto missing = run_reckon({"scene", "explain", "/no/such/file.toml"});
  EXPECT_EQ(missing.status, 2);
  EXPECT_THAT(missing.err, HasSubstr("/no/such/file.toml: there is no such file"));
}

constexpr const char* kStiff =
    "[[object]]\nname = \"wall\"\nplane = [0, 0, 1]\nsurface = { stiffness = 20000 }\n"
    "[hand]\nk1 = 1500\ndamping = 0\n";

// 1 N s/m at 1 kHz: 0.95 x 2 b/T is 1900 N/m, 3/4 of it for walls and half for hands.
TEST(SceneCheck, TellsWhatTheDeviceOfASceneWithoutAnyShowsSofter) {
  const TemporaryScene scene(kStiff);
  const auto text = run_reckon({"scene", "check", scene.path()});
  EXPECT_EQ(text.status, 0);
  EXPECT_THAT(
      text.out,
      HasSubstr("note: object wall asks for 20000 N/m and is felt with 1425 N/m by its device"));
  EXPECT_THAT(text.out, HasSubstr("note: hand asks for 1500 N/m and is felt with 950 N/m"));
  const auto json =
      nlohmann::json::parse(run_reckon({"scene", "check", "--json", scene.path()}).out);
  ASSERT_EQ(json["softened"].size(), 2u);
  EXPECT_EQ(json["softened"][0]["what"], "object wall");
  EXPECT_EQ(json["softened"][0]["shown"], 1425);
  EXPECT_EQ(json["softened"][0]["asked"], 20000);
  EXPECT_EQ(json["softened"][1]["shown"], 950);
}

TEST(SceneCheck, TellsItOfTheDevicesThatAreTooWeakAlone) {
  const TemporaryScene scene(
      std::string(kStiff) +
      "[[operator]]\npassive = true\n[[device]]\nmarking = \"STRONG\"\ndamping = 20\n"
      "[[device]]\npeer = 2\nmarking = \"WEAK\"\ndamping = 2\n");
  const auto text = run_reckon({"scene", "check", scene.path()});
  EXPECT_THAT(text.out,
              HasSubstr("20000 N/m and is felt with 2850 N/m by device 1 WEAK of peer 2"));
  EXPECT_THAT(text.out, Not(HasSubstr("STRONG")));
  EXPECT_THAT(text.out, Not(HasSubstr("hand asks for"))) << "2 N s/m show 1900 N/m";
}

TEST(SceneCheck, TellsUpToWhichSlopeAHandHardens) {
  const TemporaryScene scene("[hand]\nk1 = 500\nk3 = 15000000\ndamping = 0\n");
  const auto text = run_reckon({"scene", "check", scene.path()});
  EXPECT_THAT(text.out, HasSubstr("k3 of [hand] is felt up to a slope of 950 N/m, 3.16 mm deep"));
  const auto json =
      nlohmann::json::parse(run_reckon({"scene", "check", "--json", scene.path()}).out);
  ASSERT_EQ(json["softened"].size(), 1u);
  EXPECT_TRUE(json["softened"][0]["asked"].is_null());
  EXPECT_NEAR(json["softened"][0]["from_m"].get<double>(), 0.00316228, 1e-7);
}

TEST(SceneCheck, SaysNothingOfSofteningWhereAllIsShownAsAsked) {
  const TemporaryScene scene(std::string(kPlain) + "[hand]\nk1 = 475\n");
  EXPECT_THAT(run_reckon({"scene", "check", scene.path()}).out, Not(HasSubstr("felt with")));
  // Half of what the device could show of a spring goes into the damper of 2 N s/m.
  const TemporaryScene stiffer(std::string(kPlain) + "[hand]\nk1 = 476\n");
  EXPECT_THAT(run_reckon({"scene", "check", stiffer.path()}).out,
              HasSubstr("hand asks for 476 N/m and is felt with 475 N/m"));
}

TEST(SceneExplain, SaysWithWhichStiffnessAWallIsFeltBesideWhatItAsks) {
  const TemporaryScene scene(std::string(kStiff) +
                             "[[object]]\nname = \"soft\"\nsphere = 1\n"
                             "surface = { stiffness = 300 }\n");
  const auto text = run_reckon({"scene", "explain", scene.path()});
  EXPECT_THAT(text.out, HasSubstr("stiffness 20000 N/m, damping 0 N s/m: felt with 1425 N/m"));
  EXPECT_THAT(text.out, Not(HasSubstr("300 N/m, damping 0 N s/m:")));
  EXPECT_THAT(text.out, HasSubstr("hand asks for 1500 N/m and is felt with 950 N/m"));
  const auto json = run_reckon({"scene", "explain", "--json", scene.path()});
  std::size_t rows = 0;
  for (const std::string& line : json.lines())
    rows += nlohmann::json::parse(line)["kind"] == "softened" ? 1 : 0;
  EXPECT_EQ(rows, 2u);
}

}  // namespace
}  // namespace reckon::tools
