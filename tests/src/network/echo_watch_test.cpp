// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/network/echo_watch.hpp"

#include <gtest/gtest.h>

namespace reckon::peer {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using std::chrono::seconds;
using Turn = EchoWatch::Turn;

const GroupAddress kBase = GroupPool::ipv4_default().base();
const GroupAddress kCell = GroupPool::ipv4_default().address(7);

class EchoWatchTest : public testing::Test {
 protected:
  EchoWatchTest() { watch_.joined(kBase); }

  /// Sends to the group once a second; returns the last turn, `none` if there was none.
  Turn run(int times, bool answered, const GroupAddress& group = kBase) {
    Turn turn = Turn::none;
    for (int i = 0; i < times; ++i) {
      watch_.send(group);
      if (answered) watch_.receive(group);
      for (int k = 0; k < 4; ++k, now_ += milliseconds(250)) {
        if (const Turn next = watch_.look(now_); next != Turn::none) turn = next;
      }
    }
    return turn;
  }
  EchoWatch watch_;
  nanoseconds now_ = seconds(10);
};

TEST_F(EchoWatchTest, IsContentWhileEachDatagramComesBack) {
  EXPECT_EQ(run(100, true), Turn::none);
}

TEST_F(EchoWatchTest, ReportsSilenceOnceAndItsEndOnce) {
  EXPECT_EQ(run(2, false), Turn::none);
  EXPECT_EQ(run(2, false), Turn::silent);
  EXPECT_EQ(run(100, false), Turn::none);
  EXPECT_EQ(run(1, true), Turn::heard);
  EXPECT_EQ(run(100, true), Turn::none);
}

TEST_F(EchoWatchTest, StaysSilentAcrossARestartUntilAnEcho) {
  ASSERT_EQ(run(4, false), Turn::silent);
  watch_.restart();
  EXPECT_EQ(run(10, false), Turn::none);
  EXPECT_EQ(run(1, true), Turn::heard);
}

TEST_F(EchoWatchTest, TakesAnUnreadBurstForNoSilence) {
  for (int i = 0; i < 1000; ++i) watch_.send(kBase);
  EXPECT_EQ(watch_.look(now_), Turn::none);
  EXPECT_EQ(watch_.look(now_ + milliseconds(100)), Turn::none);
}

// Nothing was sent while the process was stopped: elapsed time alone is no silence.
TEST_F(EchoWatchTest, TakesAStoppedProcessForNoSilence) {
  watch_.send(kBase);
  EXPECT_EQ(watch_.look(now_), Turn::none);
  now_ += seconds(60);
  watch_.send(kBase);
  EXPECT_EQ(watch_.look(now_), Turn::none);
}

TEST_F(EchoWatchTest, WatchesOnlyTheFirstGroupWhileJoined) {
  watch_.joined(kCell);
  EXPECT_EQ(run(20, false, kCell), Turn::none);
  watch_.left(kBase);
  EXPECT_EQ(run(20, false), Turn::none);
}

}  // namespace
}  // namespace reckon::peer
