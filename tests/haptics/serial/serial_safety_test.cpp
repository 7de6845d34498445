// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Cases in which a serial board has no force: silence on either side, no position, a refused board.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <random>
#include <vector>

#include "reckon/haptics/serial/serial_session.hpp"
#include "reckon/tests/haptics/support/wired_board.hpp"

namespace reckon::haptics::serial_safety_test {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using std::chrono::seconds;
using test::SerialBoardOptions;
using ::testing::HasSubstr;
using Wired = test::PressingBoard;

TEST(SerialSession, SilentBoardHasZeroForceWithin10Ms) {
  Wired wired;
  wired.press();
  wired.in_is_cut = true;
  wired.run(milliseconds(10));
  EXPECT_TRUE(wired.board.force().isZero(0)) << "it takes frames still";
  EXPECT_TRUE(wired.last.force.isZero(0));
  wired.in_is_cut = false;
  wired.run(seconds(2));
  EXPECT_GT(wired.board.force().z(), 0.5);
  EXPECT_GE(wired.least_books, -1e-9);
}

TEST(SerialSession, BoardWithoutInputReleasesAndTheServoKnows) {
  Wired wired;
  wired.press();
  const auto let_go = wired.last.tally.force_drops;
  wired.out_is_cut = true;
  wired.run(milliseconds(11));
  EXPECT_TRUE(wired.board.force().isZero(0)) << "by its own watchdog";
  wired.out_is_cut = false;
  wired.run(seconds(2));
  EXPECT_GT(wired.last.tally.force_drops, let_go);
  EXPECT_GT(wired.board.force().z(), 0.5);
  EXPECT_EQ(wired.session->stage(), SerialStage::running);
}

TEST(SerialSession, SilentServoLeavesNoForceAfter10Ms) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    SerialBoardOptions options;
    options.seed = seed;
    options.period = seed % 2 == 0 ? 1'000 : 2'000;
    Wired wired(options);
    wired.press();
    wired.servo_runs = false;
    wired.run(milliseconds(10));
    EXPECT_TRUE(wired.board.force().isZero(0)) << "seed " << seed;
    wired.run(seconds(1));
    EXPECT_TRUE(wired.board.force().isZero(0));
    // It comes back: the energy of the contacts is written off, and they fade in.
    const auto trips = wired.last.trips;
    wired.servo_runs = true;
    wired.run(milliseconds(20));
    EXPECT_LT(wired.board.force().norm(), 0.1);
    EXPECT_GT(wired.last.trips, trips);
    wired.run(seconds(2));
    EXPECT_GT(wired.board.force().z(), 0.5);
  }
}

TEST(SerialSession, HungBoardIsLostAndForceRequestsStop) {
  Wired wired;
  wired.press();
  wired.board.hang(true);
  wired.run(milliseconds(10));
  EXPECT_TRUE(wired.last.force.isZero(0));
  EXPECT_FALSE(wired.session->is_lost(wired.board.now()));
  wired.run(milliseconds(200));
  EXPECT_TRUE(wired.session->is_lost(wired.board.now()));
}

TEST(SerialSession, ResetBoardIsLostUntilAskedAgain) {
  Wired wired;
  wired.press();
  wired.board.forget();
  wired.run(milliseconds(210));
  EXPECT_TRUE(wired.session->is_lost(wired.board.now()));
  EXPECT_TRUE(wired.board.force().isZero(0));
  const std::uint32_t run = wired.session->run() + 1;
  wired.session.emplace(wired.exchange, test::board_limits(), run, static_cast<std::uint16_t>(7),
                        wired.board.now());
  wired.run(seconds(2));
  EXPECT_GT(wired.board.force().z(), 0.5);
  EXPECT_GE(wired.least_books, -1e-9);
}

TEST(SerialSession, WithoutPositionsThereIsNoForce) {
  Wired wired;
  wired.board.lose_place(true);
  wired.run(seconds(2));
  EXPECT_EQ(wired.session->stage(), SerialStage::homing);
  EXPECT_TRUE(wired.board.force().isZero(0));
  EXPECT_TRUE(wired.last.force.isZero(0));
  wired.board.lose_place(false);
  wired.run(seconds(2));
  EXPECT_GT(wired.board.force().z(), 0.5);
  wired.board.lose_place(true);
  wired.run(milliseconds(10));
  EXPECT_TRUE(wired.board.force().isZero(0));
  EXPECT_TRUE(wired.last.force.isZero(0));
}

TEST(SerialSession, BoardWithAWrongClockIsRefused) {
  Wired wired;
  wired.board.run_clock_at(0.5);  // its damping would count twice
  wired.run(seconds(5));
  EXPECT_EQ(wired.session->stage(), SerialStage::refused);
  EXPECT_THAT(wired.session->refusal(), HasSubstr("microseconds"));
  EXPECT_TRUE(wired.board.force().isZero(0));
  EXPECT_TRUE(wired.last.force.isZero(0));
}

TEST(SerialSession, BoardWithLessForceThanConfiguredIsRefused) {
  SerialBoardOptions options;
  options.most_force = 4'900;
  Wired wired(options);
  wired.run(seconds(1));
  EXPECT_EQ(wired.session->stage(), SerialStage::refused);
  EXPECT_THAT(wired.session->refusal(), HasSubstr("max_force = \"4.9 N\""));
  EXPECT_TRUE(wired.board.force().isZero(0));
}

// A greeting by hand, of this version, in answer to this question.
SerialFrame greeting(std::uint8_t version, std::uint16_t question) {
  const std::array<std::uint8_t, 16> octets{0x81,
                                            version,
                                            static_cast<std::uint8_t>(question),
                                            static_cast<std::uint8_t>(question >> 8),
                                            1,
                                            10,
                                            0xE8,
                                            3,
                                            0,
                                            0x20,
                                            0x4E,
                                            0,
                                            0,
                                            0x88,
                                            0x13,
                                            'x'};
  return serial_frame(octets);
}

TEST(SerialSession, BoardOfAnotherVersionIsRefused) {
  UsbExchange exchange;
  SerialSession session(exchange, test::board_limits(), 1, 100, nanoseconds(0));
  ASSERT_TRUE(session.next(nanoseconds(0)));
  session.take(greeting(2, 100).span(), milliseconds(1));
  EXPECT_EQ(session.stage(), SerialStage::refused);
  EXPECT_THAT(session.refusal(), HasSubstr("version 2 of the protocol instead of 1"));
  EXPECT_FALSE(session.next(seconds(1))) << "it is left alone";
}

TEST(SerialSession, AcceptsOnlyAnswersToItsOwnQuestions) {
  UsbExchange exchange;
  SerialSession session(exchange, test::board_limits(), 1, 65'535, nanoseconds(0));
  ASSERT_TRUE(session.next(nanoseconds(0)));
  EXPECT_FALSE(session.next(milliseconds(99)));
  ASSERT_TRUE(session.next(milliseconds(100))) << "asked again, number 0";
  for (const int other : {65'534, 1, 100}) {
    session.take(greeting(1, static_cast<std::uint16_t>(other)).span(), milliseconds(101));
    EXPECT_EQ(session.stage(), SerialStage::asked) << other;
  }
  session.take(greeting(1, 65'535).span(), milliseconds(102));
  EXPECT_EQ(session.stage(), SerialStage::greeted);
}

TEST(SerialSession, DetectsMissingAnswersAndNoise) {
  UsbExchange exchange;
  SerialSession session(exchange, test::board_limits(), 1, 1, nanoseconds(0));
  EXPECT_FALSE(session.is_unanswered(seconds(4)));
  EXPECT_TRUE(session.is_unanswered(milliseconds(4'001)));
  EXPECT_FALSE(session.hears_noise());
  std::vector<std::uint8_t> noise(1'000);
  std::mt19937 random(1);
  for (auto& octet : noise) octet = static_cast<std::uint8_t>(random());
  session.take(noise, seconds(1));
  EXPECT_TRUE(session.hears_noise());
  EXPECT_EQ(session.stage(), SerialStage::asked);
}

}  // namespace
}  // namespace reckon::haptics::serial_safety_test
