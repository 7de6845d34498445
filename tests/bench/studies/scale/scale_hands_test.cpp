// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Hands in the study of scale.
#include <gmock/gmock.h>

#include <sstream>
#include <string>
#include <vector>

#include "reckon/bench/studies/scale/options.hpp"
#include "reckon/bench/studies/scale/run.hpp"
#include "reckon/tools/command_line/console.hpp"

namespace reckon::bench {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

HandsRow hands_at(std::string_view scene, double threshold, double touching, double whole,
                  double p99) {
  HandsRow row{scene, threshold, touching, whole, 300 * whole, {}};
  row.error.p99 = p99;
  return row;
}

// For each scene, the smallest threshold that meets the bar, even if a larger threshold sends more
// again.
TEST(ScaleHands, SayAtWhichErrorTheyAreFewEnough) {
  const std::vector rows{hands_at("press-20", 0.005, 41, 60, 0.03),
                         hands_at("press-20", 0.015, 40, 30, 0.05),
                         hands_at("press-20", 0.05, 44, 20, 0.11),
                         hands_at("tap", 0.005, 0, 33, 0.6), hands_at("tap", 0.015, 0, 21, 0.7)};
  const std::string text = hands_text(rows);
  const std::string bars = text.substr(text.find("the least of these"));
  std::istringstream in(bars);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  ASSERT_EQ(lines.size(), 4U);
  EXPECT_THAT(lines[2], testing::ContainsRegex("press-20 +15 mN +50 mN +50 mN +110 mN"));
  EXPECT_THAT(lines[3], testing::ContainsRegex("tap +- +- +none of these +-"));
}

TEST(ScaleHands, AllOfFourTouchAndEndBetweenRuns) {
  int asked = 0;
  const auto rows = run_many_hands(4, {}, 1, [&](double) { return ++asked < 230; });
  ASSERT_EQ(rows.size(), 1U) << "the second was stopped in its first second";
  EXPECT_EQ(rows[0].peers, 4U);
  EXPECT_EQ(rows[0].touching, 4U);
  EXPECT_GT(rows[0].packets_per_s, 4);
  EXPECT_GT(raw_stream_of(4).packets_per_s, 25 * rows[0].packets_per_s);
  EXPECT_THAT(many_hands_text(rows), HasSubstr("4 peers with a hand each, 4 of them touching"));
  EXPECT_THAT(many_hands_text(rows), Not(HasSubstr("the others move")));
}

TEST(ScaleHands, ManyHandsAreAsManyAsPeers) {
  ScaleWords words;
  EXPECT_EQ(read_scale_plan(words).hands, 64U);
  words.peers = "4,8";
  EXPECT_EQ(read_scale_plan(words).hands, 8U);
  words.peers = "200";
  EXPECT_EQ(read_scale_plan(words).hands, kManyHands);
  words.peers = "1";
  words.many_hands = true;
  EXPECT_THROW(static_cast<void>(read_scale_plan(words)), tools::UsageError);
}

}  // namespace
}  // namespace reckon::bench
