// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/exercise/twin_line.hpp"

#include <gtest/gtest.h>

namespace reckon::tools {
namespace {

using namespace std::chrono_literals;
using haptics::HandMotion;

TEST(TwinTeller, SendsOnPredictionErrorAndAfterSilence) {
  TwinTeller teller(0.001);
  ASSERT_TRUE(teller.tell({1s, {0, 0, 0}, {0.1, 0, 0}}));
  EXPECT_FALSE(teller.tell({1010ms, {0.0019, 0, 0}, {0.1, 0, 0}}));
  const auto update = teller.tell({1020ms, {0.0031, 0, 0}, {0.2, 0, 0}});
  ASSERT_TRUE(update);
  EXPECT_EQ(update->time, 1020ms);
  EXPECT_EQ(update->state.position.x(), 0.0031);
  EXPECT_EQ(update->state.velocity.x(), 0.2);
  EXPECT_FALSE(teller.tell({1079ms, {0.0149, 0, 0}, {0.2, 0, 0}}));
  EXPECT_TRUE(teller.tell({1080ms, {0.0151, 0, 0}, {0.2, 0, 0}}));
}

TEST(TwinLine, HasTheNewestThatHasArrived) {
  TwinLine line;
  EXPECT_FALSE(line.receive(1s));
  line.send({1s, {}}, 1200ms);
  line.send({1010ms, {}}, 1100ms);  // overtakes
  EXPECT_FALSE(line.receive(1099ms));
  EXPECT_FALSE(line.last());
  EXPECT_TRUE(line.receive(1100ms));
  EXPECT_EQ(line.last()->time, 1010ms);
  EXPECT_FALSE(line.receive(1200ms));
  EXPECT_EQ(line.last()->time, 1010ms);
}

TEST(TwinLine, LosesTheOldestOfMoreThanItHolds) {
  TwinLine line;
  for (std::size_t i = 0; i <= TwinLine::kMost; ++i) line.send({1s + i * 1ms, {}}, 10s + i * 1ms);
  EXPECT_FALSE(line.receive(10s));
  EXPECT_TRUE(line.receive(10s + 1ms));
  EXPECT_EQ(line.last()->time, 1s + 1ms);
}

}  // namespace
}  // namespace reckon::tools
