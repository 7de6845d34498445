// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A board that is pulled out at random instants, all time the board's. The test does the work of
// the loop, because a kernel tty has its own clock.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <span>

#include "reckon/haptics/serial/serial_frames.hpp"
#include "reckon/haptics/serial/serial_packets.hpp"
#include "reckon/haptics/serial/serial_session.hpp"
#include "reckon/tests/haptics/support/plugged_device.hpp"
#include "reckon/tests/haptics/support/wired_board.hpp"

namespace reckon::haptics::serial_unplug_test {
namespace {

using Eigen::Vector3d;
using std::chrono::microseconds;
using std::chrono::milliseconds;

class Pulled : public test::WiredBoard {
 public:
  explicit Pulled(const test::SerialBoardOptions& options)
      : WiredBoard(
            options, [](double t) { return Vector3d(0, 0, 0.015 * std::sin(20 * t) - 0.01); },
            test::board_limits(), test::stiff_floor()) {}

  // The next session asks on a line without a board.
  void pull() {
    in = out = test::LineWay();
    in_is_cut = out_is_cut = true;
    session->end_run();
    const std::uint32_t run = session->run();
    session.emplace(exchange, test::board_limits(), run, question_ += 4'096, board.now());
  }
  void plug(bool has_lost_power) {
    if (has_lost_power) board.forget();
    in_is_cut = out_is_cut = false;
  }

 private:
  std::uint16_t question_ = 100;
};

TEST(SerialUnplug, AtRandomInstantsLeavesNoForce) {
  std::uint64_t pressed = 0;
  for (unsigned seed = 1; seed <= 10; ++seed) {
    test::SerialBoardOptions options;
    options.seed = seed;
    std::mt19937 random(seed);
    Pulled wired(options);
    for (int round = 0; round < 100; ++round) {
      SCOPED_TRACE(testing::Message() << "seed " << seed << ", round " << round);
      // Also while it is asked and greets, and while the force ramps up.
      wired.run(microseconds(50) * (random() % (round % 3 == 0 ? 400 : 6'000)));
      if (!wired.board.force().isZero(0)) ++pressed;
      wired.pull();
      wired.run(milliseconds(10));
      EXPECT_TRUE(wired.last.force.isZero(0));
      EXPECT_FALSE(wired.last.enabled);
      wired.run(milliseconds(2));  // a tick, and octets in transit
      EXPECT_TRUE(wired.board.force().isZero(0)) << "its own watchdog";
      wired.run(microseconds(50) * (random() % 2'000));
      EXPECT_TRUE(wired.board.force().isZero(0)) << "nothing is told to what is not there";
      wired.plug(random() % 4 == 0);
    }
    wired.run(milliseconds(500));
    EXPECT_EQ(wired.session->stage(), SerialStage::running);
    EXPECT_TRUE(wired.last.enabled);
    EXPECT_GE(wired.least_books, -1e-9);
  }
  EXPECT_GT(pressed, 100U) << "pulled out under a force";
}

// The hand's energy until the board released is unknown.
TEST(SerialUnplug, MeterStaysBelowTheBoardsLedger) {
  test::SerialBoardOptions options;
  options.damping = 2.0;
  options.hand_stiffness = 600;
  test::WiredBoard wired(
      options,
      [](double t) {
        const double share = std::clamp(2.0 * std::min(t - 1.0, 4.0 - t), 0.0, 1.0);
        return Vector3d(0, 0, 0.01 - share * (0.01 - 0.015 * std::sin(20 * t)));
      },
      test::board_limits(), test::stiff_floor());
  while (wired.board.now() < milliseconds(4000)) {
    wired.run(milliseconds(83));
    wired.servo_runs = false;
    wired.run(milliseconds(7));
    wired.servo_runs = true;
  }
  wired.run(milliseconds(500));
  EXPECT_GT(wired.last.tally.force_drops, 20U) << "the board never let go";
  EXPECT_GT(wired.board.books(), 0.001) << "nothing was touched";
  EXPECT_LE(wired.last.port_energy - test::transferred(wired.last),
            wired.board.books() + wired.last.encoder_allowance + 1e-9);
  EXPECT_GE(wired.least_books, -1e-9);
}

// The last zero of the frame is missing, and the first zero of the question would complete it.
TEST(SerialUnplug, IncompleteForceIsNeverHeld) {
  test::SerialBoard board({}, [](double) { return Vector3d(0, 0, 0.01); });
  const auto tell = [&](std::span<const std::uint8_t> octets) {
    for (const std::uint8_t octet : octets) {
      board.take(octet);
      EXPECT_FALSE(board.will_hold());
    }
  };
  const SerialFrame force = frame_of({7, {1'000, 0, 0}}, 3);
  tell(force.span().first(force.length - 1));
  UsbExchange exchange;
  SerialSession session(exchange, test::board_limits(), 1, 100, milliseconds(300));
  const auto question = session.next(milliseconds(300));
  ASSERT_TRUE(question);
  tell(question->span());
  EXPECT_EQ(board.commands(), 1U) << "it was asked";
}

}  // namespace
}  // namespace reckon::haptics::serial_unplug_test
