// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The exchange with a board that runs the example's program, over a line that delays, loses and
// changes octets. All time is the board's.
#include "reckon/haptics/serial/serial_session.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <numbers>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "reckon/tests/haptics/support/wired_board.hpp"
#include "reckon/tests/support/soak.hpp"

namespace reckon::haptics::serial_session_test {
namespace {

using Eigen::Vector3d;
using std::chrono::microseconds;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using std::chrono::seconds;
using test::board_limits;
using test::pressing;
using test::SerialBoardOptions;
using test::wall_of;
using Wired = test::PressingBoard;

TEST(SerialSession, WallIsFeltThroughTheExamplesProgram) {
  Wired wired;
  wired.run(seconds(3));
  EXPECT_EQ(wired.session->stage(), SerialStage::running);
  // A wall spring K against the hand's of 200 N/m, 20 mm behind it.
  const double wall = wired.servo.static_stiffness_limit();
  const double force = 200 * wall / (200 + wall) * 0.02;
  EXPECT_NEAR(wired.board.force().z(), force, 0.03);
  EXPECT_NEAR(wired.last.force.z(), force, 0.03);
  EXPECT_LT((wired.last.device - wired.board.position()).norm(), 3e-5);
  EXPECT_EQ(wired.session->lost() + wired.session->damaged(), 0U);
}

TEST(SerialSession, PositionsAndForcesHaveTheAxesSigns) {
  for (int axes = 1; axes <= 3; ++axes) {
    SerialBoardOptions options;
    options.axes = axes;
    Wired wired(options, [](double) { return Vector3d(0.01, 0.02, 0.03); });
    wired.servo_runs = false;
    for (int i = 0; i < 1'000; ++i) {
      static_cast<void>(wired.device.read(wired.board.now()));
      wired.device.write({1, 2, -3}, wired.board.now());
      wired.run(milliseconds(1));
    }
    const Vector3d force =
        Vector3d(1, 2, -3).cwiseProduct(Vector3d(1, axes > 1 ? 1 : 0, axes > 2 ? 1 : 0));
    EXPECT_LT((wired.board.force() - force).norm(), 1e-9) << axes;
    const DeviceSample sample = wired.device.read(wired.board.now());
    ASSERT_TRUE(sample.ok);
    EXPECT_LT((sample.position - wired.board.position()).norm(), 2e-5);
    EXPECT_EQ(sample.position.z() == 0.0, axes < 3) << "an axis that it lacks";
  }
}

// The board's true forces on each displacement between two consecutive readings: exactly the writes
// that the readings name, in their order. The handle moves steadily along x, so its count
// identifies the tick.
class Witness {
 public:
  explicit Witness(unsigned seed)
      : random_(seed), often_(seed % 2 == 0), board_(options(seed), hand) {
    board_.servo_runs = false;
  }

  void run(int steps) {
    for (int i = 0; i < steps; ++i) {
      disturb(i);
      board_.run(milliseconds(1));
      if (silent_-- <= 0) write();
      UsbReading reading;
      while (board_.exchange.readings.pop(reading)) see(reading);
    }
  }
  [[nodiscard]] int ways() const { return ways_; }
  [[nodiscard]] int runs() const { return runs_; }
  [[nodiscard]] int with_gaps() const { return with_gaps_; }

 private:
  static SerialBoardOptions options(unsigned seed) {
    SerialBoardOptions options;
    options.seed = seed;
    options.is_led = true;
    options.period = seed % 3 == 0 ? 500 : seed % 3 == 1 ? 1'700 : 1'000;
    options.jitter = static_cast<int>(40 * seed);
    return options;
  }
  static Vector3d hand(double t) { return {0.5 * t, 0.05 * std::sin(t), 0}; }
  [[nodiscard]] bool happens(unsigned of_thousand) { return random_() % 1'000 < of_thousand; }

  // Frame errors all the time, and outages of whole directions or of the servo now and then.
  void disturb(int step) {
    board_.in.latency = board_.out.latency = microseconds(random_() % 1'500);
    board_.faults = {often_ ? 450U : 30U, 30, 30, 30, false, 30};
    board_.in_is_cut = step % 500 > 485;
    board_.out_is_cut = step % 700 > 680;
    if (happens(often_ ? 60 : 3)) silent_ = static_cast<int>(random_() % 11);
    board_.board.lose_place(step % 1'100 > 1'090);
  }

  void write() {
    UsbForce& force = board_.exchange.force.write_slot();
    const auto newtons = [&] { return 1e-3 * (static_cast<int>(random_() % 8'001) - 4'000); };
    force.force = {newtons(), newtons(), newtons()};
    force.number = static_cast<std::int64_t>(written_.size()) + 1;
    force.at = board_.board.now();
    written_.push_back(force.force);
    board_.exchange.force.publish();
  }

  void see(const UsbReading& reading) {
    const auto count = static_cast<std::int32_t>(std::lround(reading.position.x() / 20e-6));
    std::size_t tick = last_tick_;
    while (tick < board_.board.ticks().size() && board_.board.ticks()[tick].counts[0] != count)
      ++tick;
    ASSERT_LT(tick, board_.board.ticks().size()) << "a place where it never was";
    const auto& ticks = board_.board.ticks();
    EXPECT_EQ(std::lround(reading.position.y() / -20e-6), ticks[tick].counts[1]);
    if (last_ && last_->run == reading.run) {
      check_way(*last_, reading, last_tick_, tick);
      EXPECT_EQ(*reading.at - *last_->at,
                microseconds(ticks[tick].stamp - ticks[last_tick_].stamp));
      ++ways_;
    } else {
      ++runs_;
    }
    EXPECT_LT((ticks[tick].force - written(reading.after)).norm(), 1e-9);
    last_ = reading;
    last_tick_ = tick;
  }

  void check_way(const UsbReading& from, const UsbReading& to, std::size_t first, std::size_t end) {
    with_gaps_ += from.after < to.before ? 1 : 0;
    std::int64_t number = from.after;
    for (std::size_t i = first; i < end; ++i) {
      const Vector3d& held = board_.board.ticks()[i].force;
      while (number <= to.before && (written(number) - held).norm() > 1e-9) ++number;
      ASSERT_LE(number, to.before) << "the board held a force that is not told";
    }
    EXPECT_EQ(number, to.before) << "it did not hold one that is told";
  }

  [[nodiscard]] Vector3d written(std::int64_t number) const {
    return number == 0 ? Vector3d(Vector3d::Zero())
                       : written_[static_cast<std::size_t>(number) - 1];
  }

  std::mt19937 random_;
  const bool often_;  // half of the reports are lost, and the servo is often silent
  Wired board_;
  std::vector<Vector3d> written_;
  std::optional<UsbReading> last_;
  std::size_t last_tick_ = 0;
  int silent_ = 0, ways_ = 0, runs_ = 0, with_gaps_ = 0;
};

TEST(SerialSession, ReadingsNameExactlyTheHeldForces) {
  int ways = 0, runs = 0, with_gaps = 0, tried = 0;
  for (unsigned seed = 1; seed <= 60; seed += test::tries(5U, 1U), ++tried) {
    SCOPED_TRACE(seed);
    Witness witness(seed);
    witness.run(6'000);
    ways += witness.ways();
    runs += witness.runs();
    with_gaps += witness.with_gaps();
    if (::testing::Test::HasFailure()) return;
  }
  EXPECT_GT(ways, 2'500 * tried);
  EXPECT_GT(runs, 25 * tried);
  EXPECT_GT(with_gaps, 100 * tried);
}

// Readings of one run continue over a few lost reports, but not over a release in between, even if
// the next report has a force again.
TEST(SerialSession, UnseenReleaseEndsTheRun) {
  for (const bool lets_go : {false, true}) {
    Wired wired;
    wired.servo_runs = false;
    const auto run = [&](int steps) {
      std::uint32_t of_last = 0;
      for (int i = 0; i < steps; ++i) {
        wired.device.write({0, 0, 1}, wired.board.now());
        wired.run(milliseconds(1));
        UsbReading reading;
        while (wired.exchange.readings.pop(reading)) of_last = reading.run;
      }
      return of_last;
    };
    const std::uint32_t before = run(500);
    ASSERT_GT(before, 0U);
    wired.in_is_cut = true;
    wired.board.lose_place(lets_go);
    run(1);
    wired.board.lose_place(false);
    run(2);
    wired.in_is_cut = false;
    EXPECT_EQ(run(50) != before, lets_go);
    EXPECT_GT(wired.session->lost(), 1U);
  }
}

// For the seeds that a gate omits: no divisor of 60, which determines the parameters of a seed.
constexpr unsigned kSteps = 7;

// The board's own ledger, over phases, latencies, report rates, hands and walls; includes walls
// along axes that a board of one or two lacks.
TEST(SerialSession, NeverGivesUnpaidEnergy) {
  double least = 0, meter = -1, most_allowance = 0;
  std::uint64_t failed = 0;
  unsigned runs = 0;
  for (unsigned seed = 1; seed <= 40; seed += test::tries(kSteps, 1U), ++runs) {
    SerialBoardOptions options;
    options.seed = seed;
    options.axes = seed % 4 == 0 ? 1 : seed % 4 == 1 ? 2 : 3;
    options.mass = seed % 3 == 0 ? 0.5 : 0.1;
    options.hand_stiffness = 10 * seed;
    options.hand_damping = seed % 2 == 0 ? 0 : 2;  // the device itself must stop the handle
    options.period = seed % 5 == 0 ? 500 : seed % 5 == 1 ? 2'000 : 1'000;
    options.jitter = static_cast<int>(10 * seed);
    const Vector3d normals[] = {{1, 0, 0.7}, {0.3, 1, 1}, {0, 0, 1}, {-0.5, 0.5, 1}};
    const double wave = 2 * std::numbers::pi * (0.5 + 0.15 * seed);
    Wired wired(
        options,
        [=](double t) {
          const double turn = wave * std::min(t, 6.0);  // then it rests
          return Vector3d(0.02 * std::sin(turn) - 0.01, 0.01 * std::cos(turn),
                          0.015 * std::sin(turn) - 0.01);
        },
        board_limits(milliseconds(4 + seed % 4)),
        wall_of(normals[seed % 4], seed % 2 == 0 ? 20'000 : 60));
    wired.in.latency = microseconds(50 * (seed * 7 % 30));
    wired.out.latency = microseconds(50 * (seed * 3 % 25));
    wired.run(seconds(8));
    EXPECT_EQ(wired.session->stage(), SerialStage::running) << "seed " << seed;
    EXPECT_GE(wired.least_books, -1e-9) << "seed " << seed;
    EXPECT_LE(wired.last.port_energy, wired.board.books() + wired.last.encoder_allowance)
        << "seed " << seed;
    least = std::min(least, wired.least_own);
    meter = std::max(meter, wired.last.port_energy - wired.board.books());
    most_allowance = std::max(most_allowance, wired.last.encoder_allowance);
    failed += wired.last.tally.failed;
  }
  std::printf(
      "least %.3g J without any allowance, the meter above the books by %.3g J at most, "
      "allowance to %.3g J, %llu readings failed of %u,000\n",
      least, meter, most_allowance, static_cast<unsigned long long>(failed), 8 * runs);
}

// In phases with frames of the board lost, changed, duplicated and swapped, and frames to it
// changed.
TEST(SerialSession, DamagedFramesMakeNoEnergy) {
  std::uint64_t lost = 0, damaged = 0, failed = 0;
  double least = 0, felt = 0;
  unsigned runs = 0;
  for (unsigned seed = 1; seed <= 40; seed += test::tries(kSteps, 1U), ++runs) {
    SerialBoardOptions options;
    options.seed = seed;
    options.axes = 1 + static_cast<int>(seed % 3);
    options.hand_stiffness = 20 * seed;
    options.hand_damping = seed % 2 == 0 ? 0 : 2;
    Wired wired(
        options,
        [=](double t) { return Vector3d(0.015 * std::sin((3 + 0.3 * seed) * t) - 0.005, 0, 0); },
        board_limits(), wall_of({1, 0.2, 0.1}));
    const unsigned rate = seed % 4 == 0 ? 200 : 20;
    if (seed % 5 != 0) wired.faults.lost = rate;
    if (seed % 5 != 1) wired.faults.changed = rate;
    if (seed % 5 != 2) wired.faults.doubled = rate;
    if (seed % 5 != 3) wired.faults.swapped = rate;
    if (seed % 5 != 4) wired.faults.changed_out = rate;
    for (int i = 0; i < 6'000; ++i) {
      wired.run(milliseconds(1));
      felt = std::max(felt, wired.board.force().norm());
    }
    EXPECT_EQ(wired.session->stage(), SerialStage::running) << "seed " << seed;
    EXPECT_GE(wired.least_books, -1e-9) << "seed " << seed;
    EXPECT_LE(wired.last.port_energy, wired.board.books() + wired.last.encoder_allowance)
        << "seed " << seed;
    least = std::min(least, wired.least_own);
    lost += wired.session->lost();
    damaged += wired.session->damaged();
    failed += wired.last.tally.failed;
  }
  EXPECT_GT(lost, 25U * runs);
  EXPECT_GT(damaged, 25U * runs);
  EXPECT_GT(felt, 0.2) << "[N]";
  std::printf("least %.3g J, %llu reports lost, %llu damaged, %llu readings failed of %u,000\n",
              least, static_cast<unsigned long long>(lost),
              static_cast<unsigned long long>(damaged), static_cast<unsigned long long>(failed),
              6 * runs);
}

TEST(SerialSession, OccasionalLostReportKeepsTheForce) {
  Wired wired;
  wired.press();
  const auto trips = wired.last.trips;
  for (int i = 0; i < 5; ++i) {
    wired.faults.next_lost = true;
    wired.run(milliseconds(600));
  }
  EXPECT_EQ(wired.session->lost(), 5U);
  EXPECT_EQ(wired.last.trips, trips);
  EXPECT_GT(wired.last.force.z(), 0.5);
}

TEST(SerialSession, ChainSlowerThanDeclaredFailsReadings) {
  Wired wired(
      {}, [](double t) { return Vector3d(0, 0, 0.015 * std::sin(9 * t) - 0.005); },
      board_limits(milliseconds(2)));
  wired.in.latency = wired.out.latency = milliseconds(2);
  wired.run(seconds(4));
  EXPECT_GT(wired.last.tally.failed, 100U);
  EXPECT_GE(wired.least_books, -1e-9);
}

// The measured delay suffices: no reading fails any more.
TEST(SerialSession, MeasuredChainDelaySuffices) {
  for (int latency = 0; latency <= 2'000; latency += 250) {
    SerialBoardOptions options;
    options.seed = static_cast<unsigned>(latency + 1);
    Wired measured(options);
    measured.in.latency = measured.out.latency = microseconds(latency);
    measured.run(seconds(2));
    const nanoseconds chain = measured.session->chain();
    ASSERT_GT(chain, microseconds(2 * latency));
    Wired told(options, pressing, board_limits(chain + microseconds(500)));
    told.in.latency = told.out.latency = microseconds(latency);
    told.run(seconds(1));
    const auto failed = told.last.tally.failed;
    told.run(seconds(3));
    EXPECT_EQ(told.last.tally.failed, failed) << "latency " << latency << " us";
    EXPECT_LT(chain, microseconds(2 * latency) + milliseconds(4));
  }
}

}  // namespace
}  // namespace reckon::haptics::serial_session_test
