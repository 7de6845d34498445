// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/exchange/force_stop.hpp"

#include <gtest/gtest.h>

#include <csignal>
#include <thread>
#include <vector>

namespace reckon::haptics {
namespace {

TEST(ForceStop, GivesItsStateAndCause) {
  ForceStop stop;
  EXPECT_FALSE(stop.is_pressed());
  EXPECT_EQ(stop.state().cause, StopCause::none);
  stop.release(StopCause::program);
  EXPECT_EQ(stop.changes(), 0U) << "it was released";
  stop.press(StopCause::key);
  stop.press(StopCause::button);
  EXPECT_TRUE(stop.is_pressed());
  EXPECT_EQ(stop.state().presses, 1U) << "the second found it pressed";
  EXPECT_EQ(stop.state().cause, StopCause::key);
  stop.release(StopCause::program);
  EXPECT_FALSE(stop.state().pressed);
  EXPECT_EQ(stop.state().presses, 1U);
  EXPECT_EQ(stop.state().cause, StopCause::program);
  stop.toggle(StopCause::signal);
  EXPECT_TRUE(stop.is_pressed());
  EXPECT_EQ(stop.state().presses, 2U);
  stop.toggle(StopCause::signal);
  EXPECT_FALSE(stop.is_pressed());
}

TEST(ForceStop, LosesNoChangeOfManyThreads) {
  ForceStop stop;
  constexpr int kEach = 10'001;
  std::vector<std::thread> threads;
  for (int i = 0; i < 3; ++i)
    threads.emplace_back([&] {
      for (int k = 0; k < kEach; ++k) stop.toggle(StopCause::program);
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(stop.changes(), 3U * kEach);
  EXPECT_TRUE(stop.is_pressed()) << "an odd number";
}

TEST(ForceStop, IsPressedByASignalHandler) {
  static ForceStop stop;
  const auto before = std::signal(SIGUSR2, [](int) { stop.toggle(StopCause::signal); });
  ASSERT_EQ(std::raise(SIGUSR2), 0);
  std::signal(SIGUSR2, before);
  EXPECT_TRUE(stop.is_pressed());
  EXPECT_EQ(stop.state().cause, StopCause::signal);
}

}  // namespace
}  // namespace reckon::haptics
