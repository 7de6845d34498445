// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Serial boards are measured through their line: damping and delay are found by the board's own
// clock. All time is the board's.
#include <gtest/gtest.h>

#include <chrono>
#include <cstdio>

#include "reckon/haptics/measurement/measuring_servo.hpp"
#include "reckon/tests/haptics/support/wired_board.hpp"
#include "reckon/tests/support/soak.hpp"

namespace reckon::haptics::measured_board_test {
namespace {

using Eigen::Vector3d;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using std::chrono::seconds;
using test::SerialBoardOptions;

DeviceLimits limits(int delay = 6) {
  UsbSettings settings;
  settings.damping = serial_facts().assumed_damping;
  settings.max_force = 5;
  settings.chain = milliseconds(delay);
  return usb_limits(serial_facts(), settings);
}

class Measured : public test::WiredBoard {
 public:
  explicit Measured(const SerialBoardOptions& options, int delay = 6)
      : WiredBoard(options, [](double) { return Vector3d(0.01, 0.02, 0.03); }, limits(delay), {}),
        measuring(device, stop, milliseconds(1), &device) {
    other_servo = [this](nanoseconds now) { measuring.step(now); };
  }

  void begin(DeviceMeasurement::Axes axes = {true, true, true}) {
    for (int i = 0; i < 500 && measuring.stage() != MeasuringStage::ready; ++i)
      run(milliseconds(10));
    ASSERT_EQ(measuring.stage(), MeasuringStage::ready);
    board.let_go();
    run(milliseconds(500));
    ASSERT_TRUE(measuring.begin(axes));
  }
  void finish() {
    for (int i = 0; i < 10'000 && measuring.stage() == MeasuringStage::pushing; ++i) {
      run(milliseconds(20));
      measuring.judge();
    }
  }
  void push() {
    for (int i = 0; i < 200 && board.force().isZero(0); ++i) run(milliseconds(10));
    ASSERT_FALSE(board.force().isZero(0));
  }

  ForceStop stop;
  MeasuringServo measuring;
};

// RECKON_SOAK=1 measures each seed at each period, and both lags below.
TEST(MeasuredBoard, FindsDampingAndDelayWithinTenPerCent) {
  for (unsigned seed = 1; seed <= 2; ++seed) {
    for (const int period : {1'000, 2'000}) {
      if (!test::soaks() && (seed == 1) != (period == 1'000)) continue;
      SerialBoardOptions options;
      options.seed = seed;
      options.damping = seed % 2 == 0 ? 0.5 : 2.0;
      options.period = period;
      Measured wired(options, period == 1'000 ? 6 : 10);
      wired.begin();
      wired.finish();
      const DeviceMeasurement& run = *wired.measuring.run();
      ASSERT_EQ(run.problem(), MeasurementProblem::none) << seed << ", " << period;
      const double stated = period == 1'000 ? 6 : 10;
      std::printf("seed %u, %d us: b %.3f of %.3f, delay %.2f of %.0f ms, %d is enough\n", seed,
                  period, run.result()->damping, options.damping, 1e3 * run.result()->delay, stated,
                  wired.device.needed_delay());
      EXPECT_NEAR(run.result()->damping, options.damping, 0.1 * options.damping);
      EXPECT_NEAR(1e3 * run.result()->delay, stated, 0.1 * stated);
      EXPECT_NEAR(run.result()->resolution, 20e-6, 0.2e-6);
    }
  }
}

// The motors pull later than the board reports: only a push shows it.
TEST(MeasuredBoard, FindsTheLagOfMotorsBehindReports) {
  for (const int lag : {2, 5}) {
    if (!test::soaks() && lag != 5) continue;
    SerialBoardOptions options;
    options.lag = lag;
    Measured wired(options);
    wired.begin();
    wired.finish();
    const DeviceMeasurement& run = *wired.measuring.run();
    ASSERT_EQ(run.problem(), MeasurementProblem::none) << lag;
    EXPECT_NEAR(1e3 * run.result()->delay, 6.0 + lag, 0.1 * (6.0 + lag));
    EXPECT_NEAR(run.result()->damping, options.damping, 0.1 * options.damping);
  }
}

TEST(MeasuredBoard, MeasuresTheAxesOfASmallBoard) {
  SerialBoardOptions options;
  options.axes = 1;
  Measured wired(options);
  wired.begin({true, false, false});
  wired.finish();
  ASSERT_EQ(wired.measuring.run()->problem(), MeasurementProblem::none);
  EXPECT_NEAR(wired.measuring.run()->result()->damping, 2.0, 0.2);
}

TEST(MeasuredBoard, HungBoardEndsTheRun) {
  Measured wired({});
  wired.begin();
  wired.push();
  wired.in_is_cut = wired.out_is_cut = true;
  wired.run(milliseconds(20));
  EXPECT_EQ(wired.measuring.stage(), MeasuringStage::ended);
  EXPECT_EQ(wired.measuring.run()->problem(), MeasurementProblem::readings);
  EXPECT_TRUE(wired.board.force().isZero(0)) << "its own watchdog";
}

}  // namespace
}  // namespace reckon::haptics::measured_board_test
