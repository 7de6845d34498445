// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// `reckon tune`: the behaviour on which users and scripts rely.
#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "reckon/peer/scene/scene_file.hpp"
#include "reckon/tests/bench/support/bench_console.hpp"
#include "reckon/tests/support/scratch_folder.hpp"

namespace reckon::bench {
namespace {

using nlohmann::json;
using test::ProgramResult;
using test::run_bench;
using ::testing::HasSubstr;
using ::testing::Not;

class Tune : public testing::Test {
 protected:
  void SetUp() override {
    std::ofstream file(path_);
    file << "t_s,id,x_m,y_m,vx_mps,vy_mps\n";
    // A sample a second: with any threshold, the displacement within a second stays invisible,
    // which makes the knee.
    for (int t = 0; t < 600; ++t) {
      const double slow = t / 5.0, quick = t / 3.0;
      file << t << ",a," << 30 * std::cos(slow) + 6 * std::sin(quick) << ',' << 20 * std::sin(slow)
           << ',' << -6 * std::sin(slow) + 2 * std::cos(quick) << ',' << 4 * std::cos(slow) << '\n';
    }
  }
  [[nodiscard]] ProgramResult run(std::vector<std::string> words) const {
    words.insert(words.begin(), {"tune", path_});
    return run_bench(words);
  }
  [[nodiscard]] std::string error_of(const std::vector<std::string>& words) const {
    const ProgramResult result = run(words);
    EXPECT_EQ(result.status, 2) << result.out;
    EXPECT_TRUE(result.out.empty());
    return result.err;
  }
  test::ScratchFolder folder_;
  std::string path_ = folder_.file("tracks.csv");
};

std::vector<json> objects_of(const ProgramResult& result) {
  std::vector<json> objects;
  for (const std::string& line : result.lines()) objects.push_back(json::parse(line));
  return objects;
}

TEST_F(Tune, ShowsCurveKneeAndSceneLines) {
  const ProgramResult result = run({});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("1 entity, 600 samples in 599 s"));
  EXPECT_THAT(result.out, HasSubstr("knee  "));
  EXPECT_THAT(result.out, HasSubstr("the knee of the curve"));
  EXPECT_THAT(result.out, HasSubstr("the packets of every sample"));
  EXPECT_THAT(result.out, HasSubstr("[dead_reckoning]\nalgorithm = \""));
  EXPECT_TRUE(result.err.empty()) << result.err;
}

TEST_F(Tune, JsonHasSettingsAndARecommendation) {
  const std::vector<json> objects = objects_of(run({"--json", "--models", "auto,rvw"}));
  ASSERT_GT(objects.size(), 4U);
  std::size_t settings = 0, knees = 0, fronts = 0;
  for (const json& object : objects) {
    if (object["kind"] != "setting") continue;
    ++settings;
    knees += object["knee"].get<bool>() ? 1 : 0;
    fronts += object["front"].get<bool>() ? 1 : 0;
    EXPECT_LE(object["rms_m"].get<double>(), object["max_m"].get<double>());
    EXPECT_NEAR(object["octets_per_s"].get<double>(), 172 * object["packets_per_s"].get<double>(),
                1e-6);
  }
  EXPECT_EQ(settings % 2, 0U);
  EXPECT_EQ(knees, 1U);
  EXPECT_GE(fronts, 3U);
  EXPECT_EQ(objects.back()["kind"], "recommendation");
  EXPECT_THAT(objects.back()["toml"].get<std::string>(), HasSubstr("[dead_reckoning]"));
}

TEST_F(Tune, PicksTheCheapestSettingWithinAnError) {
  const std::vector<json> objects = objects_of(run({"--json", "--error", "2 m"}));
  const json& advice = objects.back();
  EXPECT_LE(advice["p99_m"].get<double>(), 2);
  for (const json& object : objects) {
    if (object["kind"] != "setting" || object["p99_m"].get<double>() > 2) continue;
    EXPECT_GE(object["packets_per_s"].get<double>(), advice["packets_per_s"].get<double>());
  }
}

TEST_F(Tune, PicksTheMostAccurateSettingWithinABudget) {
  const json packets = objects_of(run({"--json", "--budget", "0.5"})).back();
  EXPECT_LE(packets["packets_per_s"].get<double>(), 0.5);
  const json octets = objects_of(run({"--json", "--budget", "86 B/s"})).back();
  EXPECT_EQ(octets["threshold_m"], packets["threshold_m"]);
  EXPECT_EQ(octets["model"], packets["model"]);
}

TEST_F(Tune, GivesLinesForASceneFile) {
  const json advice =
      objects_of(run({"--json", "--models", "fpw,rvw", "--heartbeat", "10min", "--error", "2m"}))
          .back();
  const peer::SceneFile scene = peer::parse_scene_file(advice["toml"].get<std::string>(), "made");
  EXPECT_EQ(scene.dead_reckoning.thresholds.position, advice["threshold_m"].get<double>());
  EXPECT_EQ(scene.dead_reckoning.heartbeat, std::chrono::seconds(60));
}

TEST_F(Tune, StatusReportsThatNothingReachesTheGoal) {
  const ProgramResult error = run({"--error", "1um"});
  EXPECT_EQ(error.status, 1);
  EXPECT_THAT(error.out, HasSubstr("No setting keeps the p99 error"));
  EXPECT_THAT(error.out, Not(HasSubstr("[dead_reckoning]")));
  EXPECT_EQ(run({"--budget", "0.0001"}).status, 1);
}

TEST_F(Tune, CsvRowsHaveEqualNumbersOfCells) {
  const ProgramResult result = run({"--csv", "--thresholds", "10cm,1m", "--models", "rvw"});
  const std::vector<std::string> lines = result.lines();
  ASSERT_GE(lines.size(), 5U);
  for (const std::string& line : lines)
    EXPECT_EQ(std::count(line.begin(), line.end(), ','), 12) << line;
  EXPECT_THAT(lines[1], HasSubstr("setting,rvw,0.1,"));
}

TEST_F(Tune, DrawsTheCurveWithItsKnee) {
  const std::string picture = folder_.file("curve.svg");
  EXPECT_EQ(run({"--plot", picture}).status, 0);
  std::ostringstream text;
  text << std::ifstream(picture).rdbuf();
  EXPECT_THAT(text.str(), HasSubstr("<svg xmlns="));
  EXPECT_THAT(text.str(), HasSubstr("knee: "));
  EXPECT_THAT(text.str(), HasSubstr("DRM 4, 1 m"));
  EXPECT_THAT(text.str(), Not(HasSubstr("nan")));
  EXPECT_THAT(error_of({"--plot", "/nowhere/curve.svg"}), HasSubstr("cannot be written"));
}

TEST_F(Tune, WithoutAKneeGivesThePriceOfHalving) {
  const ProgramResult result = run({"--models", "rvw", "--thresholds", "2m,5m"});
  EXPECT_EQ(result.status, 0);
  EXPECT_THAT(result.out, HasSubstr("The curve has no knee"));
}

TEST_F(Tune, IncludesTheEffectsOfALossyNetwork) {
  const json good = objects_of(run({"--json", "--models", "rvw", "--thresholds", "0.1m"})).front();
  const json bad = objects_of(run({"--json", "--models", "rvw", "--thresholds", "0.1m", "--delay",
                                   "3s", "--loss", "30%"}))
                       .front();
  EXPECT_GT(bad["p99_m"].get<double>(), good["p99_m"].get<double>());
}

TEST_F(Tune, NamesTheMistake) {
  EXPECT_THAT(error_of({"--error", "0.5 m", "--budget", "3"}), HasSubstr("one of them"));
  EXPECT_THAT(error_of({"--error", "5s"}), HasSubstr("--error 5s"));
  EXPECT_THAT(error_of({"--budget", "much"}), HasSubstr("10kB/s"));
  EXPECT_THAT(error_of({"--models", "rwv"}), HasSubstr("did you mean 'rvw'"));
  EXPECT_THAT(error_of({"--thresholds", "0m"}), HasSubstr("out of range"));
  EXPECT_THAT(error_of({"--loss", "200%"}), HasSubstr("out of range"));
  EXPECT_THAT(error_of({"--heartbeat", "1ms"}), HasSubstr("100ms or more"));
  EXPECT_THAT(error_of({"--json", "--csv"}), HasSubstr("two formats"));
  EXPECT_THAT(error_of({"--columns", "x"}), HasSubstr("add --force"));
  EXPECT_THAT(error_of({"--force", "--error", "1m"}), HasSubstr("is for motion"));
  EXPECT_THAT(run_bench({"tune"}).err, HasSubstr("name a FILE"));
  const ProgramResult missing = run_bench({"tune", "/nowhere/a.csv"});
  EXPECT_EQ(missing.status, 2);
  EXPECT_THAT(missing.err, HasSubstr("/nowhere/a.csv"));
}

TEST_F(Tune, ShowsTheSavingOfADeadband) {
  std::ofstream(path_) << "t_s,f_N\n0,1\n0.001,1\n0.002,1\n0.003,2\n";
  const ProgramResult text = run({"--force"});
  EXPECT_EQ(text.status, 0) << text.err;
  EXPECT_THAT(text.out, HasSubstr("auto, 10 % Weber"));
  for (const json& object : objects_of(run({"--force", "--json"}))) {
    EXPECT_EQ(object["outside"], 0);
    EXPECT_EQ(object["unit"], "N");
    EXPECT_NEAR(object["share"].get<double>(), 0.5, 1e-9);
  }
  EXPECT_EQ(run({"--force", "--csv"}).lines().size(), 10U);
}

}  // namespace
}  // namespace reckon::bench
