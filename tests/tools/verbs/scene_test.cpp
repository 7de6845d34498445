// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// `reckon scene`: what it says of good and bad scene files, and that it explains what a scene
// declares.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

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
  const TemporaryScene cap("[aoim]\ngroups = 20\nradius = \"20 m\"\n");
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

TEST(SceneCheck, TellsWhatIsWrongWithATrace) {
  const TemporaryScene trace("t_s,px_m\n0,0\n");
  const TemporaryScene scene(fmt::format("[[operator]]\ntrace = \"{}\"\n", trace.path()));
  const auto result = run_reckon({"scene", "check", scene.path()});
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.out, HasSubstr(trace.path()));
}

TEST(SceneCheck, IsContentWithTheScenesOfTheProject) {
  std::size_t scenes = 0;
  for (const auto& entry : std::filesystem::directory_iterator(RECKON_SOURCE_DIR "/scenes")) {
    if (entry.path().extension() != ".toml") continue;
    const auto result = run_reckon({"scene", "check", entry.path().string()});
    EXPECT_EQ(result.status, 0) << result.out;
    ++scenes;
  }
  EXPECT_GE(scenes, 2U);
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

}  // namespace
}  // namespace reckon::tools
