// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// `reckon scene`: its output for good and bad scene files, meshes, and softened stiffness.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "reckon/tests/support/mesh_text.hpp"
#include "reckon/tests/support/places.hpp"
#include "reckon/tests/tools/support/captured_console.hpp"
#include "reckon/tests/tools/support/temporary_scene.hpp"

namespace reckon::tools::scene_test {
namespace {

using test::kFriction;
using test::kPlain;
using test::run_reckon;
using test::TemporaryScene;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

TEST(SceneCheck, IsContentWithAGoodFile) {
  const TemporaryScene scene(kFriction);
  const auto result = run_reckon({"scene", "check", scene.path()});
  EXPECT_EQ(result.status, 0) << result.out << result.err;
  EXPECT_THAT(result.out, StartsWith(scene.path() + ": good; 2 objects, 0 operators, hash "));
}

TEST(SceneCheck, NotesARadiusThatReachesAllGroups) {
  const TemporaryScene all("[aoim]\npool = 16\nradius = \"20 m\"\n");
  const auto everything = run_reckon({"scene", "check", all.path()});
  EXPECT_EQ(everything.status, 0);
  EXPECT_THAT(everything.out, HasSubstr("note: the radius of 20 m needs all 16 groups in use"));
  const TemporaryScene cap("[aoim]\ngroups = 20\nradius = \"20 m\"\n[hand]\nk1 = 400\n");
  const auto capped = run_reckon({"scene", "check", "--json", cap.path()});
  EXPECT_EQ(capped.status, 0);
  const auto json = nlohmann::json::parse(capped.out);
  ASSERT_EQ(json["notes"].size(), 1u);
  EXPECT_THAT(json["notes"][0].get<std::string>(),
              HasSubstr("may need 256 groups, but [aoim] groups is 20"));
}

TEST(SceneCheck, RefusesAPoolThatNoDemoWouldTake) {
  for (const char* pool : {"2", "3"}) {
    const TemporaryScene scene(fmt::format("[aoim]\npool = {}\n", pool));
    const auto result = run_reckon({"scene", "check", scene.path()});
    EXPECT_EQ(result.status, 1);
    EXPECT_THAT(result.out, HasSubstr("take 4 to 1000, or 1 for a world that is not divided"));
  }
}

TEST(SceneCheck, NamesPlaceAndRemedyOfEachProblem) {
  const TemporaryScene scene("[[object]]\nname = \"a\"\nsphere = 1\nsurface = { stifness = 8 }\n");
  const auto result = run_reckon({"scene", "check", scene.path()});
  EXPECT_EQ(result.status, 1);
  EXPECT_EQ(result.out,
            scene.path() + ":4:13: unknown key 'stifness' (did you mean 'stiffness'?)\n");
}

TEST(SceneCheck, PointsAtABodyWithoutADevice) {
  const TemporaryScene scene(
      "[[object]]\nname = \"wall\"\nplane = [0.0, 0.0, 1.0]\n"
      "[[object]]\nname = \"cube\"\nbox = \"40 40 40 mm\"\nposition = [0.0, 0.0, 0.1]\n"
      "mass = \"60 g\"\n");
  const auto result = run_reckon({"scene", "check", scene.path()});
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.out,
              StartsWith(scene.path() + ":8:8: a scene with bodies (mass) needs a hand"));
}

TEST(SceneCheck, ChecksEveryFileAndReturnsTheWorst) {
  const TemporaryScene good(kPlain);
  const TemporaryScene bad("[scene]\nnane = 3\n");
  const auto result = run_reckon({"scene", "check", bad.path(), good.path()});
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.out, HasSubstr("did you mean 'name'?"));
  EXPECT_THAT(result.out, HasSubstr(good.path() + ": good"));
}

TEST(SceneCheck, ReportsABadMesh) {
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

// A cube of 100 m, meant as 100 mm in millimetres; one face is missing, one reversed, one
// duplicate.
std::string bad_cube() {
  test::MeshData cube = test::cube();
  for (auto& v : cube.vertices) v *= 100.0;
  cube.triangles.pop_back();
  std::swap(cube.triangles[2][0], cube.triangles[2][1]);
  cube.triangles.push_back(cube.triangles[5]);
  return test::obj_text(cube);
}

TEST(SceneCheck, PrintsOnlyTheSizeOfAGoodMesh) {
  const test::TemporaryMesh mesh(".obj", test::obj_text(test::cube()));
  const TemporaryScene scene(scene_of(mesh));
  const auto result = run_reckon({"scene", "check", scene.path()});
  EXPECT_EQ(result.status, 0) << result.out;
  EXPECT_THAT(result.out, HasSubstr("mesh of \"stone\": 1 x 1 x 1 m, 12 triangles, closed\n"));
  EXPECT_THAT(result.out, Not(HasSubstr("note: mesh")));
}

TEST(SceneCheck, CountsPatchesAndReportsMissingOnes) {
  const test::TemporaryMesh mesh(
      ".obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nusemtl felt\nf 1 3 4\n");
  const TemporaryScene scene(scene_of(mesh) +
                             "patch = [{ name = \"felt\", surface = { stiffness = 200 } },\n"
                             "         { name = \"steel\", surface = { stiffness = 900 } }]\n");
  const auto result = run_reckon({"scene", "check", scene.path()});
  EXPECT_EQ(result.status, 0) << result.out;
  EXPECT_THAT(result.out, HasSubstr("; patches: 1 felt (1)\n"));
  EXPECT_THAT(result.out, HasSubstr("note: mesh of \"stone\": patch \"steel\" is not a material or "
                                    "group of any face; the file has felt"));
  EXPECT_THAT(result.out,
              HasSubstr("1 of 2 triangles is in no patch and has the surface of the object"));
  const auto json = run_reckon({"scene", "check", "--json", scene.path()});
  const auto patches = nlohmann::json::parse(json.out)["meshes"][0]["patches"];
  ASSERT_EQ(patches.size(), 1u);
  EXPECT_EQ(patches[0]["patch"], 1);
  EXPECT_EQ(patches[0]["name"], "felt");
  EXPECT_EQ(patches[0]["triangles"], 1);
  EXPECT_THAT(run_reckon({"scene", "explain", scene.path()}).out,
              HasSubstr("\"felt\", number 1, stiffness 200 N/m"));
}

TEST(SceneCheck, ReportsRepairsOfAMesh) {
  const test::TemporaryMesh mesh(".obj", bad_cube());
  const TemporaryScene scene(scene_of(mesh));
  const auto result = run_reckon({"scene", "check", scene.path()});
  EXPECT_EQ(result.status, 0) << result.out;
  EXPECT_THAT(result.out, HasSubstr("100 x 100 x 100 m, 11 triangles, open, both sides felt"));
  EXPECT_THAT(result.out, HasSubstr("note: mesh of \"stone\": is 173.2 m large"));
  EXPECT_THAT(result.out, HasSubstr("scale_to = \"173.2 mm\""));
  EXPECT_THAT(result.out,
              HasSubstr("1 triangle was dropped, because another has the same corners"));
  EXPECT_THAT(result.out, HasSubstr("1 triangle had the opposite orientation of the neighbours and "
                                    "was turned (first: line 11)"));
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

TEST(SceneExplain, ReportsRepairsOfAMesh) {
  const test::TemporaryMesh mesh(".obj", bad_cube());
  const TemporaryScene scene(scene_of(mesh));
  const auto text = run_reckon({"scene", "explain", scene.path()});
  EXPECT_THAT(text.out, HasSubstr("open mesh, both sides felt, size 173.2 m"));
  EXPECT_THAT(text.out, testing::ContainsRegex("\nMESH +FILE +FOUND\nstone +[^ ]+ +100 x 100 x"));
  EXPECT_THAT(text.out, HasSubstr("1 triangle had the opposite orientation of the neighbours"));
  int meshes = 0;
  for (const std::string& line : run_reckon({"scene", "explain", "--json", scene.path()}).lines()) {
    const auto row = nlohmann::json::parse(line);
    if (row["kind"] != "mesh") continue;
    ++meshes;
    EXPECT_EQ(row["boundary_edges"], 3);
  }
  EXPECT_EQ(meshes, 1);
}

TEST(SceneCheck, ReportsAMeshFarAway) {
  const test::TemporaryMesh mesh(".obj",
                                 test::obj_text(test::cube(), {4321012.25, 678901.5, 432.0}));
  const TemporaryScene scene(scene_of(mesh));
  const auto result = run_reckon({"scene", "check", scene.path()});
  EXPECT_THAT(result.out, HasSubstr("is 4374 km from the scene's origin"));
  const TemporaryScene centred(scene_of(mesh) + "centre = true\n");
  EXPECT_THAT(run_reckon({"scene", "check", centred.path()}).out, Not(HasSubstr("note: mesh")));
}

TEST(SceneCheck, NamesFileAndLineOfAMeshFault) {
  const test::TemporaryMesh mesh(".obj", "v 0 0 0\nv 1 0 0\nv 0 nan 0\nf 1 2 3\n");
  const TemporaryScene scene(scene_of(mesh));
  const auto result = run_reckon({"scene", "check", scene.path()});
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.out, HasSubstr(mesh.path().string() +
                                    ":3: vertex 2, counted from 0, is not finite; repair it"));
  EXPECT_THAT(result.out, HasSubstr("object \"stone\""));
}

TEST(SceneCheck, ReportsABadTrace) {
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

// The table's top is at 10 mm; a cube of 40 mm rests on it at 30 mm.
std::string bodies_on_a_table(const std::string& cube2_at, const std::string& more = "") {
  const auto cube = [](const std::string& name, const std::string& at) {
    return fmt::format(
        "[[object]]\nname = \"{}\"\nbox = \"40 40 40 mm\"\nposition = \"{}\"\nmass = \"50 g\"\n"
        "surface = {{stiffness = \"400 N/m\"}}\n",
        name, at);
  };
  return "[[object]]\nname = \"table\"\nbox = \"1 1 0.02 m\"\n" + cube("cube1", "0 0 30 mm") +
         cube("cube2", cube2_at) + more +
         "[[operator]]\npassive = true\nposition = \"0 0 300 mm\"\n[[device]]\npeer = 1\n";
}

TEST(SceneCheck, NamesOverlappingBodiesAndTheirSeparation) {
  const TemporaryScene scene(bodies_on_a_table("3 0 66.9 mm"));
  const auto result = run_reckon({"scene", "check", scene.path()});
  EXPECT_EQ(result.status, 1);
  EXPECT_EQ(result.out, scene.path() +
                            ": object 'cube2' starts 3.1 mm deep in 'cube1', and contact will push "
                            "them apart: move 'cube2' by 3.1 mm along +z\n");
  const auto json = run_reckon({"scene", "check", "--json", scene.path()});
  EXPECT_EQ(json.status, 1);
  EXPECT_THAT(nlohmann::json::parse(json.out)["problem"].get<std::string>(),
              StartsWith("object 'cube2' starts 3.1 mm deep"));
}

TEST(SceneCheck, AcceptsBodiesThatRestOnOneAnother) {
  for (const char* place : {"0 0 70 mm", "0 0 69.991 mm", "40 0 30 mm", "0 0 90 mm"}) {
    const TemporaryScene scene(bodies_on_a_table(place));
    const auto result = run_reckon({"scene", "check", scene.path()});
    EXPECT_EQ(result.status, 0) << place << ": " << result.out;
  }
  const TemporaryScene deeper(bodies_on_a_table("0 0 69.989 mm"));
  EXPECT_EQ(run_reckon({"scene", "check", deeper.path()}).status, 1);
}

TEST(SceneCheck, ReportsBodiesInPlanesAndMeshes) {
  const TemporaryScene floor(bodies_on_a_table(
      "200 0 30 mm",
      "[[object]]\nname = \"ground\"\nplane = \"0 0 1\"\nposition = \"0 0 15 mm\"\n"));
  const auto below = run_reckon({"scene", "check", floor.path()});
  EXPECT_EQ(below.status, 1);
  EXPECT_THAT(below.out, HasSubstr("'cube1' starts 5 mm deep in 'ground'"));
  EXPECT_THAT(below.out, HasSubstr("move 'cube2' by 5 mm along +z"));
  EXPECT_THAT(below.out, Not(HasSubstr("table")));

  // A stone of 1 m from (0, 0, 10 m) on, a ball 0.2 m below its top.
  const test::TemporaryMesh stone(".obj", test::obj_text(test::cube()));
  const TemporaryScene within(bodies_on_a_table(
      "200 0 30 mm",
      fmt::format("[[object]]\nname = \"stone\"\nmesh = \"{}\"\nposition = \"0 0 10 m\"\n"
                  "[[object]]\nname = \"lost\"\nsphere = \"100 mm\"\n"
                  "position = \"0.5 0.4 10.8 m\"\nmass = \"1 kg\"\n",
                  stone.path().string())));
  const auto lost = run_reckon({"scene", "check", within.path()});
  EXPECT_EQ(lost.status, 1) << lost.out;
  EXPECT_THAT(lost.out, HasSubstr("'lost' starts 300 mm deep in 'stone'"));
  EXPECT_THAT(lost.out, HasSubstr("move 'lost' by 300 mm along +z"));
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

TEST(SceneNew, PrintsAValidSceneWithValidExamples) {
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

TEST(SceneVerb, PrintsItsUsage) {
  EXPECT_EQ(run_reckon({"scene"}).status, 2);
  EXPECT_EQ(run_reckon({"scene", "check"}).status, 2);
  EXPECT_EQ(run_reckon({"scene", "chekc", "x.toml"}).status, 2);
  const auto missing = run_reckon({"scene", "explain", "/no/such/file.toml"});
  EXPECT_EQ(missing.status, 2);
  EXPECT_THAT(missing.err, HasSubstr("/no/such/file.toml: there is no such file"));
}

}  // namespace
}  // namespace reckon::tools::scene_test
