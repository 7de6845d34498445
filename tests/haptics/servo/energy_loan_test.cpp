// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Two hands that find each other overlapping: after a start, an outage or a late discovery neither
// of them has pushed a surface away, and both ports are empty.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include "reckon/haptics/contact/energy_exchange.hpp"
#include "reckon/tests/haptics/support/hands_in_a_row.hpp"
#include "reckon/tests/support/soak.hpp"

namespace reckon::haptics {
namespace {

constexpr double kRight = 0.9;  // of the force of the springs in a row

struct Cell {
  double press, delay, loss;
};

std::string name(const Cell& c) {
  return std::to_string(1e3 * c.press) + " mm, " + std::to_string(1e3 * c.delay) + " ms, loss " +
         std::to_string(c.loss);
}

HandsInARow overlapping(const Cell& cell, unsigned seed) {
  RowHands hands;
  hands.target = [press = cell.press](std::size_t i, double) { return i == 0 ? press : 0.0; };
  hands.start = cell.press;
  RowLine line;
  line.delay = cell.delay;
  line.loss = cell.loss;
  return {hands, line, seed};
}

// Both hands have most of the force within 3 s of the first update, and neither has more energy
// than the loan.
void expect_right(HandsInARow& row, const Cell& cell, const char* when) {
  const double right = row_truth(2, 300, 500, cell.press)[0];
  while (row.snapshot(0).count == 0 || row.snapshot(1).count == 0) row.step();
  for (int i = 0; i < 2900; ++i) row.step();
  double least[2] = {right, right}, most = 0;
  for (int i = 0; i < 100; ++i) {
    row.step();
    for (const std::size_t hand : {0u, 1u}) {
      least[hand] = std::min(least[hand], row.felt(hand));
      most = std::max(most, row.felt(hand));
    }
  }
  for (const std::size_t hand : {0u, 1u}) {
    EXPECT_GE(least[hand], kRight * right) << name(cell) << " " << when << ", hand " << hand;
    EXPECT_LE(row.most_loan(hand), kGreatestLoan + 1e-12) << name(cell);
  }
  EXPECT_LE(most, 1.1 * right) << name(cell) << " " << when;
  EXPECT_GE(row.least_port(), -kGreatestLoan - 1e-9) << name(cell);
  EXPECT_GE(row.least_unlent(), -1e-9) << name(cell) << ": port >= -owed";
}

constexpr double kDelays[] = {0.0003, 0.005, 0.020, 0.050};  // [s]

TEST(EnergyLoan, OverlappingStartHandsPushEachOther) {
  for (const double press : {0.010, 0.020}) {
    for (const double delay : kDelays) {
      const Cell cell{press, delay, 0};
      HandsInARow row = overlapping(cell, 1);
      expect_right(row, cell, "at start");
    }
  }
}

TEST(EnergyLoan, OutageInContactIsRecoveredTwice) {
  for (const double press : {0.010, 0.020}) {
    for (const double delay : kDelays) {
      const Cell cell{press, delay, 0};
      RowHands hands;
      hands.target = [press](std::size_t i, double t) {
        return i == 0 ? press * smooth(t - 1) : 0.0;
      };
      RowLine line;
      line.delay = delay;
      HandsInARow row(hands, line, 2);
      for (int i = 0; i < 4000; ++i) row.step();
      EXPECT_LE(row.most_loan(0) + row.most_loan(1), 0.001)
          << "begun from outside: what is short at rest alone";
      for (const char* when : {"first outage", "second"}) {
        for (int i = 0; i < 8000; ++i) row.step(false);
        EXPECT_LT(row.felt(0) + row.felt(1), 1e-9) << "the models have expired";
        expect_right(row, cell, when);
      }
    }
  }
}

TEST(EnergyLoan, LateDiscoveryOverALossyLine) {
  for (const double loss : {0.2, 0.5}) {
    for (const double press : {0.010, 0.020}) {
      for (const double delay : kDelays) {
        for (unsigned seed = 1; seed <= test::tries(1U, 4U); ++seed) {
          const Cell cell{press, delay, loss};
          HandsInARow row = overlapping(cell, seed);
          for (int i = 0; i < 1500; ++i) row.step(false);
          expect_right(row, cell, "late");
        }
      }
    }
  }
}

TEST(EnergyLoan, ContactFromOutsideGetsNoLoan) {
  for (const std::size_t count : {2u, 3u}) {
    for (const double delay : kDelays) {
      RowHands hands;
      hands.count = count;
      hands.start = -0.01;
      hands.target = [](std::size_t i, double t) {
        const double stroke = t > 2.5 ? 0.005 * std::sin(10 * (t - 2.5)) : 0.0;
        return i == 0 ? -0.01 + 0.03 * smooth(t - 1) + stroke : 0.0;
      };
      RowLine line;
      line.delay = delay;
      HandsInARow row(hands, line, 3);
      for (int i = 0; i < 6000; ++i) row.step();
      EXPECT_GT(row.felt(1), 0.5);
      for (std::size_t i = 0; i < count; ++i) EXPECT_EQ(row.most_loan(i), 0.0) << delay;
      EXPECT_GE(row.least_port(), -1e-9);
      EXPECT_GE(row.least_sum(), -1e-9);
    }
  }
}

// A peer whose hand appears inside ours and vanishes, again and again, gets at most one loan from
// us, and no faster.
TEST(EnergyLoan, IsOnePerDevice) {
  SimulatedDeviceConfig held;
  held.hand_stiffness = 300;
  SimulatedDevice device(held);
  ServoLoop servo(device, EffectPlan(), {});
  double most = 0, fastest = 0, last = 0, least = 0;
  std::uint32_t version = 0;
  for (int i = 0; i < 60'000; ++i) {
    const auto now = std::chrono::milliseconds(i);
    ContactSet set;
    if (i % 1500 < 1000) {
      RemoteHand& hand = set.hands[set.count++];
      hand.id = {1, 2, static_cast<std::uint16_t>(1 + i / 1500 % 5)};
      const double side = i / 1500 % 2 == 0 ? 1.0 : -1.0;
      hand.state.position.x() = side * (0.012 + 0.003 * std::sin(0.1 * i));
      hand.state_time = now;
      hand.model.kind = pdu::ForceModelKind::sphere;
      hand.model.k1 = 500;
      hand.model.radius = 0.02;
      hand.valid_until = now + std::chrono::milliseconds(200);
      hand.version = ++version;
      hand.need = 1.0;
    }
    servo.contacts().write(set);
    servo.step(now);
    servo.snapshots().update();
    const ServoSnapshot& s = servo.snapshots().read();
    most = std::max(most, s.loan);
    fastest = std::max(fastest, s.loan - last);
    last = s.loan;
    least = std::min(least, s.port_energy + s.loan);
  }
  EXPECT_GT(most, 0.003);
  EXPECT_LE(most, kGreatestLoan + 1e-12);
  EXPECT_LE(fastest, 1e-3 * kHandLoanPower * (1 + 1e-9)) << "over a millisecond";
  EXPECT_GE(least, -1e-9);
}

}  // namespace
}  // namespace reckon::haptics
