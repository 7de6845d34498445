// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// After a failed reading, a released switch, a pulled cable, a trip or a start inside an object, a
// hand that leans at its place gets its force back, by bounded loans.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "reckon/haptics/contact/energy_exchange.hpp"
#include "reckon/tests/haptics/support/hands_in_a_row.hpp"
#include "reckon/tests/haptics/support/servo_bench.hpp"

namespace reckon::haptics::hiccup_test {
namespace {

using bench::Bench;
using bench::floor;
using bench::presses;
using Eigen::Vector3d;
using namespace std::chrono_literals;

constexpr double kRight = 0.9;      // of the force before
constexpr double kRoundOff = 1e-9;  // [J]

// A grip of 300 N/m with a goal 15 mm deep in a floor.
struct Wall {
  double stiffness, grip = 300, goal = 0.015;
  [[nodiscard]] double right() const { return grip * stiffness / (grip + stiffness) * goal; }
};

SimulatedDeviceConfig held(const Wall& wall, double z) {
  SimulatedDeviceConfig device = bench::at(z);
  device.hand_stiffness = wall.grip;
  return device;
}

using Hiccup = std::function<void(Bench&)>;

struct Row {
  const char* name;
  Wall wall;
  Hiccup hiccup;
};

void unplug_for(Bench& bench, std::chrono::milliseconds time) {
  bench.device.plug(false);
  bench.run(time);
  bench.device.plug(true);
}
void let_go_for(Bench& bench, std::chrono::milliseconds time) {
  bench.device.enable(false);
  bench.run(time);
  bench.device.enable(true);
}

std::vector<Row> hiccups_at_a_wall() {
  const auto one = [](Bench& b) { unplug_for(b, 1ms); };
  return {
      {"one failed reading", {1400}, one},
      {"one failed reading", {800}, one},
      {"one failed reading", {500}, one},
      {"three failed readings", {1400}, [](Bench& b) { unplug_for(b, 3ms); }},
      {"every tenth reading fails for a second",
       {1400},
       [&](Bench& b) {
         for (int i = 0; i < 100; ++i) {
           unplug_for(b, 1ms);
           b.run(9ms);
         }
       }},
      {"switch let go for 50 ms", {1400}, [](Bench& b) { let_go_for(b, 50ms); }},
      {"switch let go for 1 s", {1400}, [](Bench& b) { let_go_for(b, 1s); }},
      {"switch let go for 1 s", {500}, [](Bench& b) { let_go_for(b, 1s); }},
      {"cable out for 0.3 s", {1400}, [](Bench& b) { unplug_for(b, 300ms); }},
      {"cable out for 5 s", {800}, [](Bench& b) { unplug_for(b, 5s); }},
      {"a late step of 9.8 ms", {1400}, [](Bench& b) { b.now += 8800us; }},
      {"a late step of 40 ms", {1400}, [](Bench& b) { b.now += 39ms; }},
      {"cable out for 0.3 s at 7.4 N", {1400, 300, 0.030}, [](Bench& b) { unplug_for(b, 300ms); }},
  };
}

HandTarget wants(double height) {
  HandTarget target;
  target.position.z() = height;
  return target;
}

TEST(Hiccup, WallRecoversWithinThreeSeconds) {
  for (const Row& row : hiccups_at_a_wall()) {
    Bench bench(floor(row.wall.stiffness), held(row.wall, 0.03), presses(row.wall.goal));
    const double before = bench.run(3s).force.norm();
    ASSERT_NEAR(before, row.wall.right(), 0.01 * row.wall.right()) << row.name;
    row.hiccup(bench);
    const double after = bench.run(3s).force.norm();
    const ServoSnapshot& s = bench.servo.snapshots().read();
    std::printf("wall %4.0f N/m, %s: %.2f N before, %.2f N after, lent %.1f mJ\n",
                row.wall.stiffness, row.name, before, after, 1e3 * s.loan_most);
    EXPECT_GE(after, kRight * before) << row.name << ", " << row.wall.stiffness << " N/m";
    EXPECT_LE(after, 1.05 * before) << row.name;
    EXPECT_LE(s.loan_most, kGreatestLoan + kRoundOff);
    EXPECT_GE(bench.least, -kRoundOff) << row.name;
  }
}

TEST(Hiccup, OneFailedReadingCostsAtMostAQuarter) {
  Bench bench(floor(1400), held({1400}, 0.03), presses(0.015));
  const double before = bench.run(3s).force.norm();
  unplug_for(bench, 1ms);
  bench.run(20ms);
  double least = before;
  for (int i = 0; i < 200; ++i) least = std::min(least, bench.run(1ms).force.norm());
  EXPECT_GE(least, 0.7 * before);
  EXPECT_EQ(bench.servo.snapshots().read().trips, 0u);
}

TEST(Hiccup, WallFadesInForAHandInside) {
  for (const double stiffness : {500.0, 1400.0}) {
    const Wall wall{stiffness};
    Bench bench(floor(stiffness), held(wall, -wall.goal),
                [&](double) { return wants(-wall.goal); });
    double fastest = 0, last = 0;
    for (int i = 0; i < 3000; ++i) {
      const double force = bench.run(1ms).force.norm();
      fastest = std::max(fastest, force - last);
      last = force;
    }
    const ServoSnapshot& s = bench.servo.snapshots().read();
    std::printf("begins inside %4.0f N/m: %.2f of %.2f N, at most %.3f N/ms, lent %.1f mJ\n",
                stiffness, last, wall.right(), fastest, 1e3 * s.loan_most);
    EXPECT_GE(last, kRight * wall.right()) << stiffness;
    EXPECT_LE(fastest, wall.right() / 200) << "no quicker than 0.2 s";
    EXPECT_GT(s.tally.walls.seconds, 0.1) << "told";
    EXPECT_GE(bench.least, -kRoundOff);
  }
}

// 200 mm deep: no loan lifts a hand out of there, and this is reported all the time.
TEST(Hiccup, ContactBeyondTheLoanIsReported) {
  const Wall wall{1400, 300, 0.2};
  Bench bench(floor(1400), held(wall, -0.2), [](double) { return wants(-0.2); });
  bench.run(10s);
  const ServoSnapshot& s = bench.servo.snapshots().read();
  EXPECT_LE(s.loan_most, kGreatestLoan + kRoundOff);
  EXPECT_GT(s.tally.walls.seconds, 9.0);
  EXPECT_GE(bench.least, -kRoundOff);
}

// Deeper than the loan reaches: the surface moves to the handle, and any deeper press from there
// feels the whole wall.
TEST(Hiccup, WallBeyondTheLoanMovesToTheHandle) {
  for (const Wall& wall : {Wall{900, 150, 0.06}, Wall{600, 300, 0.06}, Wall{1400, 200, 0.08}}) {
    double deeper = 0;
    Bench bench(floor(wall.stiffness), held(wall, -wall.goal),
                [&](double t) { return wants(-wall.goal - deeper * smooth(t - 8)); });
    deeper = 0.005 * (1 + wall.stiffness / wall.grip);
    const double before = bench.run(8s).force.z(), from = bench.device.position().z();
    const double after = bench.run(4s).force.z(), pressed = from - bench.device.position().z();
    const ServoSnapshot& s = bench.servo.snapshots().read();
    std::printf("%4.0f N/m, grip %3.0f: %.2f of %.2f N, %.1f mm hidden, then %.2f N for %.2f mm\n",
                wall.stiffness, wall.grip, before, wall.right(), 1e3 * s.tally.hidden,
                after - before, 1e3 * pressed);
    EXPECT_NEAR(pressed, 0.005, 0.0005);
    EXPECT_NEAR(after - before, wall.stiffness * pressed, 0.05 * wall.stiffness * pressed);
    EXPECT_NEAR(s.tally.hidden, -from - before / wall.stiffness, 1e-4);
    EXPECT_LE(s.loan_most, kGreatestLoan + kRoundOff);
    EXPECT_GE(bench.least, -kRoundOff);
  }
}

// Hidden depth is rendered again as the hand comes out.
TEST(Hiccup, HiddenDepthReturnsOnTheWayOut) {
  Bench bench(floor(900), held({900, 150}, -0.06), [](double t) {
    const double out = 0.07 * smooth((t - 6) / 2), in = 0.02 * smooth(t - 9);
    return wants(-0.06 + out - in);
  });
  bench.run(6s);
  ASSERT_GT(bench.servo.snapshots().read().tally.hidden, 0.01);
  bench.run(2500ms);
  EXPECT_GT(bench.device.position().z(), 0.005);
  const double force = bench.run(3s).force.z();
  EXPECT_NEAR(force, Wall({900, 150, 0.01}).right(), 0.01) << "the whole wall from outside";
  EXPECT_GE(bench.least, -kRoundOff);
}

struct Pair {
  const char* name;
  double press;
  std::function<void(HandsInARow&)> hiccup;
};

// Steps of a millisecond.
void step(HandsInARow& row, int count) {
  for (int i = 0; i < count; ++i) row.step();
}

std::vector<Pair> hiccups_of_a_pair() {
  const auto switched = [](std::initializer_list<std::size_t> hands, int ms) {
    return [hands = std::vector<std::size_t>(hands), ms](HandsInARow& row) {
      for (const std::size_t hand : hands) row.device(hand).enable(false);
      step(row, ms);
      for (const std::size_t hand : hands) row.device(hand).enable(true);
    };
  };
  const auto pulled = [](std::vector<std::size_t> hands, int ms) {
    return [hands, ms](HandsInARow& row) {
      for (const std::size_t hand : hands) row.device(hand).plug(false);
      step(row, ms);
      for (const std::size_t hand : hands) row.device(hand).plug(true);
    };
  };
  return {{"one failed reading at one", 0.030, pulled({1}, 1)},
          {"one failed reading at both", 0.020, pulled({0, 1}, 1)},
          {"both let the switch go for 50 ms", 0.012, switched({0, 1}, 50)},
          {"one lets the switch go for 1 s", 0.020, switched({0}, 1000)},
          {"both cables out for 0.3 s", 0.020, pulled({0, 1}, 300)},
          {"one cable out for 2 s", 0.030, pulled({1}, 2000)}};
}

TEST(Hiccup, TwoHandsPushEachOtherAsBefore) {
  for (const double delay : {0.0003, 0.02}) {
    for (const Pair& pair : hiccups_of_a_pair()) {
      RowHands hands;
      hands.target = [&](std::size_t i, double t) { return i == 0 ? pair.press * smooth(t) : 0.0; };
      RowLine line;
      line.delay = delay;
      HandsInARow row(hands, line, 1);
      step(row, 4000);
      const double right = row_truth(2, 300, 500, pair.press)[0];
      ASSERT_NEAR(row.felt(0), right, 0.1 * right) << pair.name;
      pair.hiccup(row);
      step(row, 3000);
      std::printf("%2.0f ms, %2.0f mm, %s: %.2f and %.2f of %.2f N, lent %.1f and %.1f mJ\n",
                  1e3 * delay, 1e3 * pair.press, pair.name, row.felt(0), row.felt(1), right,
                  1e3 * row.most_loan(0), 1e3 * row.most_loan(1));
      for (const std::size_t hand : {0u, 1u}) {
        EXPECT_GE(row.felt(hand), kRight * right) << pair.name << ", hand " << hand;
        EXPECT_LE(row.felt(hand), 1.1 * right) << pair.name << ", hand " << hand;
      }
      EXPECT_GE(row.least_unlent(), -kRoundOff) << pair.name;
    }
  }
}

// For any number of flaps of switch and cable the total is at most one loan.
TEST(Hiccup, AThousandFlapsGetOneLoan) {
  for (const bool cable : {false, true}) {
    Bench bench(floor(1400), held({1400}, 0.03), presses(0.015));
    bench.run(2s);
    std::mt19937 random(cable ? 2 : 1);
    for (int i = 0; i < 1000; ++i) {
      const auto off = std::chrono::milliseconds(1 + random() % 120);
      cable ? unplug_for(bench, off) : let_go_for(bench, off);
      bench.run(std::chrono::milliseconds(1 + random() % 200));
    }
    const ServoSnapshot& s = bench.servo.snapshots().read();
    EXPECT_LE(s.loan_most, kGreatestLoan + kRoundOff);
    EXPECT_GE(bench.least, -kRoundOff);
    std::printf("%s: lent at most %.1f mJ, least %.1f mJ\n", cable ? "cable" : "switch",
                1e3 * s.loan_most, 1e3 * bench.least);
  }
}

}  // namespace
}  // namespace reckon::haptics::hiccup_test
