// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// `reckon demo`: its DIS exercise, and its reports about parts that it leaves out.
#include <gmock/gmock.h>

#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "reckon/tests/support/places.hpp"
#include "reckon/tests/support/scratch_folder.hpp"
#include "reckon/tests/tools/support/captured_console.hpp"
#include "reckon/tools/command_line/console.hpp"

namespace reckon::tools::demo_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class DemoExercise : public testing::Test {
 protected:
  /// The messages of a demo besides its report.
  std::string said(const std::string& scene, std::vector<std::string> more) {
    const std::string path = folder_.file("scene.toml");
    std::ofstream(path) << scene << "[[operator]]\npassive = true\n";
    std::vector<std::string> words{"demo", path, "--for", "50ms", "--json"};
    words.insert(words.end(), more.begin(), more.end());
    const auto result = test::run_reckon(words);
    no_loopback_ = result.status == exit_status(ExitCode::environment);
    EXPECT_TRUE(no_loopback_ || result.status == 0) << result.err;
    return result.err;
  }

  reckon::test::ScratchFolder folder_;
  bool no_loopback_ = false;
};

TEST_F(DemoExercise, IsTheScenesOrDrawnEachTime) {
  const std::string named = said("[network]\nexercise = 77\n", {});
  if (no_loopback_) GTEST_SKIP() << "no multicast on loopback: " << named;
  EXPECT_THAT(named, HasSubstr("DIS exercise 77\n"));
  std::set<std::string> drawn;
  for (int i = 0; i < 6; ++i) {
    const std::string text = said("", {});
    EXPECT_THAT(text, HasSubstr("chosen at random"));
    drawn.insert(text.substr(0, text.find(',')));
  }
  EXPECT_GT(drawn.size(), 1u);
}

TEST_F(DemoExercise, IsConstantInSimulatedTime) {
  EXPECT_THAT(said("", {"--simulated-time"}), Not(HasSubstr("DIS exercise")));
}

TEST_F(DemoExercise, ComparesEntitiesOfPeersWithoutHands) {
  const std::string scene = test::source_dir() + "/scenes/exercise.toml";
  const auto result = test::run_reckon({"demo", scene, "--for", "2s", "--json"});
  if (result.status == exit_status(ExitCode::environment)) GTEST_SKIP() << result.err;
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_TRUE(nlohmann::json::parse(result.out)["pose_error_m"]["p50"].is_number()) << result.out;
}

// Forty posts of the second peer within reach of the first one's hand: eight more than a servo
// takes.
TEST(DemoWalls, AreReportedInNoticesSummaryAndJson) {
  const reckon::test::ScratchFolder folder;
  const std::string path = folder.file("posts.toml");
  std::ofstream scene(path);
  scene << "[[operator]]\npassive = true\n[[device]]\npeer = 1\n";
  for (int i = 0; i < 40; ++i) {
    scene << "[[entity]]\npeer = 2\nmarking = \"POST" << i << "\"\ntype = \"5.1\"\nposition = ["
          << 0.1 << ", " << 0.002 * i << ", 0]\n"
          << "force_model = { kind = \"sphere\", radius = \"1 mm\", k1 = \"100 N/m\" }\n";
  }
  scene.close();
  const auto text = test::run_reckon({"demo", path, "--simulated-time", "--for", "2s"});
  EXPECT_EQ(text.status, 0) << text.err;
  EXPECT_THAT(text.err, HasSubstr("more than the 32 bodies of a servo are near a hand"));
  EXPECT_THAT(text.out, HasSubstr("bodies near a hand were not felt"));
  const auto json = test::run_reckon({"demo", path, "--simulated-time", "--for", "2s", "--json"});
  // The number is greater for a moment, while nearer posts appear and farther ones are still in the
  // servo.
  EXPECT_GE(nlohmann::json::parse(json.out)["hands_unfelt"].get<int>(), 8);
}

nlohmann::json simulated(const std::string& scene, const std::string& length) {
  std::vector<std::string> words{"demo"};
  if (!scene.empty()) words.push_back(scene);
  for (const char* word : {"--simulated-time", "--json", "--for"}) words.emplace_back(word);
  words.push_back(length);
  const auto result = test::run_reckon(words);
  EXPECT_EQ(result.status, 0) << result.err;
  return nlohmann::json::parse(result.out);
}

TEST(Demo, HasTwoHandsThatTouchWithinThreeSeconds) {
  const auto json = simulated("", "3s");
  EXPECT_GT(json["hand_contact_s"].get<double>(), 0.5);
  EXPECT_GT(json["force_error_n"]["max"].get<double>(), 0.0);
  ASSERT_EQ(json["hands"].size(), 2u);
  for (const auto& hand : json["hands"]) EXPECT_GT(hand["touching_hands_s"].get<double>(), 0.2);
}

// The first hand presses 5 mm into the second; both request 1500 N/m, their devices can hold 950.
std::string two_that_press(const reckon::test::ScratchFolder& folder) {
  const std::string path = folder.file("press.toml");
  std::ofstream(path) << "[hand]\nradius = \"10 mm\"\nk1 = 1500\ndamping = 0\n"
                         "static_friction = 0\nkinetic_friction = 0\n"
                         "[dead_reckoning]\nforce = \"0.015 N\"\n"
                         "[[operator]]\nsweep = { from = \"-30 0 0 mm\", to = \"-5 0 0 mm\", "
                         "period = \"8 s\" }\n"
                         "[[operator]]\npassive = true\nposition = \"10 0 0 mm\"\n";
  return path;
}

TEST(Demo, SeparatesForceErrorsFromDeviceLimits) {
  const reckon::test::ScratchFolder folder;
  const std::string path = two_that_press(folder);
  const auto json = simulated(path, "8s");
  const double asked = json["force_error_n"]["p50"],
               possible = json["force_error_possible_n"]["p50"];
  EXPECT_GT(asked, 0.3) << "950 of 1500 N/m under a force of about 1 N";
  EXPECT_LT(possible, 0.1);
  EXPECT_EQ(json["hands"][0]["hand_n_m"], 950);
  EXPECT_EQ(json["hands"][0]["hand_asked_n_m"], 1500);
  const auto text = test::run_reckon({"demo", path, "--simulated-time", "--for", "8s"});
  EXPECT_THAT(text.out, HasSubstr("force asked"));
  EXPECT_THAT(text.out, HasSubstr("force possible"));
  EXPECT_THAT(text.out, HasSubstr("softer than asked          hands 950 of 1500 N/m\n"));
}

TEST(Demo, NamesHandsWithoutContact) {
  const reckon::test::ScratchFolder folder;
  const std::string path = folder.file("apart.toml");
  std::ofstream(path) << "[[operator]]\npassive = true\n[[operator]]\npassive = true\n"
                         "position = \"1 0 0 m\"\n";
  const auto text = test::run_reckon({"demo", path, "--simulated-time", "--for", "1s"});
  EXPECT_THAT(text.out, HasSubstr("none: no hand touched another"));
  EXPECT_THAT(text.out, HasSubstr("touched nobody"));
}

TEST(Demo, ReportsContactWithEntitiesWithoutComparison) {
  const std::string scene = reckon::test::source_dir() + "/scenes/one_user_push.toml";
  const auto json = simulated(scene, "8s");
  EXPECT_GT(json["entity_contact_s"].get<double>(), 1.0);
  EXPECT_EQ(json["hand_contact_s"], 0.0);
  EXPECT_TRUE(json["force_error_n"]["p50"].is_null()) << "no hand touched another";
  const auto text = test::run_reckon({"demo", scene, "--simulated-time", "--for", "8s"});
  EXPECT_THAT(text.out, ::testing::ContainsRegex("the object 0.0 s, entities [3-6].[0-9] s"));
  EXPECT_THAT(text.out,
              HasSubstr("none: no hand touched another; forces of entities are not compared"));
}

TEST(Demo, OfOnePeerReportsNoTraffic) {
  const std::string scene = reckon::test::source_dir() + "/scenes/one_user_push.toml";
  const auto text =
      test::run_reckon({"demo", scene, "--peers", "1", "--simulated-time", "--for", "1s"});
  EXPECT_EQ(text.status, 0) << text.err;
  EXPECT_THAT(text.out, HasSubstr("one peer: no receiver"));
  EXPECT_THAT(text.out, Not(HasSubstr("x fewer")));
  EXPECT_THAT(text.out, HasSubstr("pose              none: no peer showed an entity of another"));
}

TEST(Demo, TracesEveryDeviceOfAPeer) {
  const reckon::test::ScratchFolder folder;
  const std::string path = folder.file("two.toml"), trace = folder.file("trace.csv");
  std::ofstream(path) << "[[operator]]\npassive = true\n[[device]]\npeer = 1\n"
                         "[[device]]\npeer = 1\nrate = \"2 kHz\"\n[[device]]\npeer = 2\n";
  const auto result =
      test::run_reckon({"demo", path, "--simulated-time", "--for", "100ms", "--trace", trace});
  ASSERT_EQ(result.status, 0) << result.err;
  std::ifstream file(trace);
  std::string line;
  std::getline(file, line);
  EXPECT_TRUE(line.ends_with(",patch,device,pace")) << line;
  std::map<std::string, int> rows;  // by "peer device"
  while (std::getline(file, line)) {
    const std::size_t peer = line.find(',') + 1;
    line.resize(line.rfind(','));
    ++rows[line.substr(peer, line.find(',', peer) - peer) + " " + line.substr(line.rfind(',') + 1)];
  }
  EXPECT_EQ(rows, (std::map<std::string, int>{{"1 1", 100}, {"1 2", 200}, {"2 1", 100}}));
}

}  // namespace
}  // namespace reckon::tools::demo_test
