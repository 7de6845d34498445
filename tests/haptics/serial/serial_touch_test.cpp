// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A serial board with everything that can be touched: walls, remote hands, effects, bodies, each at
// five latencies of its line. Energy by the board's own ledger. RECKON_SOAK=1 draws 200 of each.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <string>

#include "reckon/tests/haptics/support/wired_board.hpp"
#include "reckon/tests/support/soak.hpp"

namespace reckon::haptics::serial_touch_test {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using test::DrawnTouch;
using test::TouchKind;

int seeds() { return test::tries(2, 200); }

constexpr int kLatencies = 5;

TEST(SerialTouch, NeverGivesUnpaidEnergyForAnyTouch) {
  double least = 0, allowance = 0;
  for (const TouchKind kind : test::kTouchKinds) {
    double most_force = 0;
    for (int run = 0; run < seeds() * kLatencies; ++run) {
      const int latency = run % kLatencies;
      const auto seed = static_cast<unsigned>(1 + run);
      DrawnTouch touch(kind, seed);
      test::SerialBoardOptions options;
      options.seed = seed;
      options.axes = 3;
      options.mass = run % 3 == 0 ? 0.5 : 0.1;
      options.hand_stiffness = 50.0 * (1 + run * 7 % 12);
      options.hand_damping = run % 2 == 0 ? 0.5 : 3.0;
      UsbSettings settings;
      settings.damping = options.damping = 6.0;  // so that walls are felt
      settings.chain = milliseconds(5 + 2 * latency);
      settings.max_force = 5.0;
      settings.resolution = 20e-6;
      test::WiredBoard wired(
          options, [&](double t) { return touch.hand(t - 1.0); },
          usb_limits(serial_facts(), settings), touch.scene());
      wired.in.latency = wired.out.latency = microseconds(100 + 800 * latency);
      wired.before_step = [&](nanoseconds now) {
        touch.play_others(wired.servo, now - milliseconds(1000));
        most_force = std::max(most_force, wired.last.force.norm());
      };
      wired.run(milliseconds(5500));
      const std::string which = "kind " + std::to_string(static_cast<int>(kind)) + ", seed " +
                                std::to_string(seed) + ", latency " + std::to_string(latency);
      ASSERT_EQ(wired.session->stage(), SerialStage::running) << which;
      ASSERT_GE(wired.least_books, -1e-9) << which;
      if (kind != TouchKind::bodies) {
        ASSERT_LE(wired.last.port_energy - test::transferred(wired.last),
                  wired.board.books() + wired.last.encoder_allowance + 1e-9)
            << which;
      }
      least = std::min(least, wired.least_own);
      allowance = std::max(allowance, wired.last.encoder_allowance);
    }
    EXPECT_GT(most_force, 0.3) << "nothing is felt of kind " << static_cast<int>(kind);
  }
  std::printf("least %.3g J without the encoders' allowance of up to %.3g J\n", least, allowance);
}

}  // namespace
}  // namespace reckon::haptics::serial_touch_test
