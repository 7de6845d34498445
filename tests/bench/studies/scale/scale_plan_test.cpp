// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Flags of bench scale, and the resulting exercises.
#include <gmock/gmock.h>

#include <chrono>
#include <cmath>
#include <fstream>

#include "reckon/bench/studies/scale/options.hpp"
#include "reckon/tests/support/scratch_folder.hpp"
#include "reckon/tools/command_line/console.hpp"

namespace reckon::bench {
namespace {

using ::testing::HasSubstr;

std::string refusal(const ScaleWords& words) {
  try {
    static_cast<void>(read_scale_plan(words));
  } catch (const tools::UsageError& error) {
    return error.what();
  }
  return "taken";
}

TEST(ScalePlan, CrossesPeersWithEntities) {
  ScaleWords words;
  words.peers = "2,4";
  words.entities = "100,200";
  words.threshold = "50cm";
  words.delay = std::chrono::milliseconds(80);
  words.jitter = "25%";
  const ScalePlan plan = read_scale_plan(words);
  ASSERT_EQ(plan.settings.size(), 4U);
  EXPECT_EQ(plan.settings[1].peers, 2U);
  EXPECT_EQ(plan.settings[1].crowd.entities, 200U);
  EXPECT_EQ(plan.settings[3].peers, 4U);
  EXPECT_DOUBLE_EQ(plan.settings[0].thresholds.position, 0.5);
  EXPECT_EQ(plan.settings[0].network.jitter, std::chrono::milliseconds(20));
}

TEST(ScalePlan, DrawnExercisesReplaceAllOthers) {
  ScaleWords words;
  words.drawn = 3;
  const ScalePlan plan = read_scale_plan(words);
  EXPECT_EQ(plan.drawn.size(), 3U);
  EXPECT_TRUE(plan.settings.empty());
  EXPECT_EQ(plan.meeting, Meeting::lo);
  words.cell = "50 m";
  EXPECT_THAT(refusal(words), HasSubstr("--drawn draws the exercises"));
  words = {};
  words.drawn = 0;
  EXPECT_THAT(refusal(words), HasSubstr("--drawn: write 1"));
  words = {};
  words.pick = "0 m";
  EXPECT_THAT(refusal(words), HasSubstr("--pick"));
}

TEST(ScalePlan, RefusesByNameWhatCannotBe) {
  ScaleWords words;
  words.peers = "8.5";
  EXPECT_THAT(refusal(words), HasSubstr("--peers: 8.5"));
  words = {};
  words.entities = "10";
  EXPECT_THAT(refusal(words), HasSubstr("--entities"));
  words = {};
  words.jitter = "10%";
  EXPECT_THAT(refusal(words), HasSubstr("--delay"));
  words = {};
  words.rate = 0;
  EXPECT_THAT(refusal(words), HasSubstr("--rate"));
  words = {};
  words.loss = "120%";
  EXPECT_THAT(refusal(words), HasSubstr("--loss"));
}

TEST(ScalePlan, FitsWhatIsTooLargeToRun) {
  ScaleWords words;
  words.peers = "64,1000";
  EXPECT_THAT(refusal(words), HasSubstr("--peers: 1000 need a fit to 3 or more exercises"));
  words.peers = "64,1000,128,256";
  const ScalePlan plan = read_scale_plan(words);
  ASSERT_EQ(plan.settings.size(), 3U);
  ASSERT_EQ(plan.fitted.size(), 1U);
  EXPECT_EQ(plan.fitted[0].crowd.entities, 100'000U);
  words.entities = "6400";
  EXPECT_THAT(refusal(words), HasSubstr("with as many entities each"));
}

// Two tracks last as long as the study, one is shorter. Copies of the two are side by side.
TEST(ScalePlan, TakesTracksThatLast) {
  const test::ScratchFolder folder;
  const std::string file = folder.file("tracks.csv");
  std::ofstream out(file);
  out << "t_s,id,x_m,y_m\n";
  for (int t = 0; t <= 12; ++t) {
    out << t << ",1," << 10 * t << ",0\n" << t << ",2,0," << 5 * t << '\n';
    if (t > 4 && t < 8) out << t << ",3,50,50\n";
  }
  out.close();
  ScaleWords words;
  words.file = file;
  words.peers = "2";
  words.entities = "6";
  words.length = std::chrono::seconds(5);
  const ScalePlan plan = read_scale_plan(words);
  EXPECT_EQ(plan.tracks.size(), 2U);
  Crowd crowd(plan.settings[0].crowd);
  EXPECT_EQ(crowd.size(), 6U);
  crowd.advance(3);
  int of_first = 0;
  for (std::size_t i = 0; i < crowd.size(); ++i) {
    const Eigen::Vector3d velocity = crowd.motion(i).velocity;
    of_first += (velocity - Eigen::Vector3d(10, 0, 0)).norm() < 1e-6;
    EXPECT_TRUE(std::abs(velocity.norm() - 10) < 1e-6 || std::abs(velocity.norm() - 5) < 1e-6);
  }
  EXPECT_EQ(of_first, 3);
  words.movement = "walkers";
  EXPECT_THAT(refusal(words), HasSubstr("--movement"));
  words.movement = "";
  words.length = std::chrono::seconds(60);
  EXPECT_THAT(refusal(words), HasSubstr("--for"));
}

}  // namespace
}  // namespace reckon::bench
