// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The effect of keys on a replay, by characters and a clock set by hand.
#include "reckon/tools/captures/replay_keys.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <string_view>

#include "reckon/peer/clocks/clock.hpp"

namespace reckon::tools::replay_keys_test {
namespace {

using namespace std::chrono_literals;
using std::chrono::nanoseconds;
using Demand = ReplayKeys::Demand;

constexpr std::string_view kRight = "\x1b[C";
constexpr std::string_view kLeft = "\x1b[D";

/// A replay that began at 100 s with a datagram recorded at 1000 s; the next one, of 1060 s, is
/// pending.
class Player : public ::testing::Test {
 protected:
  Player() {
    schedule.next(1000s);
    schedule.sent(clock.now());
    schedule.next(1060s);
  }
  Demand press(std::string_view keys) {
    Demand demand = Demand::nothing;
    for (const char key : keys) demand = decoder.press(key, schedule, clock.now());
    return demand;
  }
  nanoseconds position() { return schedule.position(clock.now()); }

  peer::ManualClock clock{100s};
  ReplaySchedule schedule{1.0, 100s};
  ReplayKeys decoder;
};

TEST_F(Player, RestsWhileItIsPaused) {
  clock.advance(20s);
  EXPECT_EQ(press(" "), Demand::nothing);
  EXPECT_TRUE(schedule.is_paused());
  clock.advance(1000s);
  EXPECT_EQ(position(), 20s);
  EXPECT_EQ(schedule.paused(clock.now()), 1000s);
  EXPECT_EQ(press(" "), Demand::nothing);
  EXPECT_FALSE(schedule.is_paused());
  EXPECT_EQ(schedule.due(), 1160s);  // 40 s are left
  schedule.sent(1160s);
  EXPECT_EQ(schedule.played(), 60s);
  EXPECT_EQ(schedule.active(), 60s);
  EXPECT_EQ(schedule.kept(), 1);
}

TEST_F(Player, GoesFasterAndSlowerFromWhereItIs) {
  clock.advance(20s);
  press("+");
  EXPECT_EQ(schedule.rate(), 2);
  EXPECT_EQ(schedule.due(), 140s);  // 40 s at 2x
  clock.advance(10s);
  EXPECT_EQ(position(), 40s);
  press("--");
  EXPECT_EQ(schedule.rate(), 0.5);
  EXPECT_EQ(schedule.due(), 170s);  // 20 s at 0.5x
  schedule.sent(170s);
  EXPECT_DOUBLE_EQ(schedule.asked(), 60.0 / 70);
  EXPECT_DOUBLE_EQ(schedule.kept(), 60.0 / 70);
  press("=");
  EXPECT_EQ(schedule.rate(), 1);
}

TEST_F(Player, KeepsTheRateWithinItsBounds) {
  for (int i = 0; i < 100; ++i) press("+");
  EXPECT_EQ(schedule.rate(), ReplayKeys::kFastest);
  for (int i = 0; i < 100; ++i) press("-");
  EXPECT_EQ(schedule.rate(), ReplayKeys::kSlowest);
}

TEST_F(Player, ChangesItsRateWhilePaused) {
  clock.advance(20s);
  press(" ");
  clock.advance(5s);
  press("++");
  EXPECT_EQ(position(), 20s);
  clock.advance(5s);
  press(" ");
  EXPECT_EQ(schedule.due(), 140s);  // 40 s at 4x from 130 s on
  schedule.sent(140s);
  EXPECT_DOUBLE_EQ(schedule.asked(), 60.0 / 30);
}

TEST_F(Player, LeapsForwardWithoutReadingAgain) {
  clock.advance(20s);
  EXPECT_EQ(press(kRight), Demand::nothing);
  EXPECT_EQ(position(), 30s);
  EXPECT_FALSE(schedule.is_skipped());
  EXPECT_EQ(schedule.due(), 150s);
  EXPECT_EQ(press(kRight), Demand::nothing);
  EXPECT_EQ(press(kRight), Demand::nothing);
  EXPECT_EQ(press("\x1bOC"), Demand::nothing);  // the arrow in another terminal mode
  EXPECT_EQ(position(), 60s);
  EXPECT_FALSE(schedule.is_skipped());
  clock.advance(1s);
  press("\x1b[1;5C");  // with Ctrl held
  EXPECT_TRUE(schedule.is_skipped());
}

TEST_F(Player, ReadsAgainAfterJumpingBackOverSentDatagrams) {
  schedule.sent(160s);
  schedule.next(1090s);
  clock.advance(75s);
  EXPECT_EQ(press(kLeft), Demand::nothing);  // to 65 s: nothing was sent since then
  EXPECT_EQ(position(), 65s);
  EXPECT_EQ(press(kLeft), Demand::read_again);
  EXPECT_EQ(position(), 55s);
  schedule.next(1000s);
  EXPECT_TRUE(schedule.is_skipped());
  schedule.next(1060s);
  EXPECT_FALSE(schedule.is_skipped());
  EXPECT_EQ(schedule.due(), 180s);  // 5 s later
  schedule.sent(180s);
  EXPECT_EQ(schedule.played(), 75s + 5s);  // skipped time does not count
  EXPECT_EQ(schedule.active(), 80s);
}

TEST_F(Player, LeapsBackToTheBeginningAtMost) {
  clock.advance(5s);
  EXPECT_EQ(press(kLeft), Demand::nothing);  // the sent datagram is at the beginning
  EXPECT_EQ(position(), 0s);
  EXPECT_EQ(schedule.due(), 165s);
}

TEST_F(Player, LeapsWhilePaused) {
  clock.advance(20s);
  press(" ");
  EXPECT_EQ(press(kRight), Demand::nothing);
  EXPECT_EQ(press(kRight), Demand::nothing);
  EXPECT_EQ(press(kLeft), Demand::read_again);  // the skipped datagrams were read
  EXPECT_EQ(position(), 30s);
  clock.advance(7s);
  press(" ");
  EXPECT_EQ(position(), 30s);
}

TEST_F(Player, LeapsBehindTheEndIntoTheNextLap) {
  clock.advance(58s);
  press(kRight);
  EXPECT_TRUE(schedule.is_skipped());  // 60 s is before 68 s
  schedule.next_lap(clock.now());
  schedule.next(1000s);
  EXPECT_FALSE(schedule.is_skipped());
  EXPECT_EQ(schedule.due(), clock.now());
}

TEST_F(Player, EndsByKeyAndHeedsNoOther) {
  EXPECT_EQ(press("q"), Demand::end);
  for (int key = -128; key < 128; ++key) {
    const std::string_view known = " +-=q\x1b";
    if (known.find(static_cast<char>(key)) != std::string_view::npos) continue;
    EXPECT_EQ(decoder.press(static_cast<char>(key), schedule, clock.now()), Demand::nothing) << key;
  }
  EXPECT_EQ(press("\x1bq"), Demand::end);  // Esc alone does nothing
  EXPECT_EQ(schedule.rate(), 1);
  EXPECT_FALSE(schedule.is_paused());
  EXPECT_EQ(schedule.due(), 160s);
}

TEST(ReplayKeys, DoNotChangeMaximumSpeed) {
  ReplaySchedule schedule(0, 5s);
  schedule.next(1000s);
  schedule.sent(5s);
  ReplayKeys keys;
  (void)keys.press('+', schedule, 6s);
  (void)keys.press('-', schedule, 6s);
  EXPECT_EQ(schedule.rate(), 0);
  EXPECT_FALSE(schedule.is_changed());
}

TEST(ReplayKeys, JumpFromTheSentPositionWhenLate) {
  ReplaySchedule schedule(64, 0s);
  schedule.next(0s);
  schedule.sent(0s);
  schedule.next(30s);
  // By the clock it would be at 640 s; it waits to send the datagram due at 30 s.
  EXPECT_EQ(schedule.position(10s), 30s);
}

}  // namespace
}  // namespace reckon::tools::replay_keys_test
