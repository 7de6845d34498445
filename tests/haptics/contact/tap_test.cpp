// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A tap over a network against the same two hands with a spring between them.
// RECKON_SOAK=1 runs ten seeds of each line.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "reckon/tests/haptics/support/hands_in_a_row.hpp"

namespace reckon::haptics {
namespace {

constexpr double kAway = 0.035, kDepth = 0.012, kHold = 0.15;  // [m], [m], [s]
constexpr double kBegin = 0.5;                                 // [s]

struct Felt {
  double peak = 0, impulse = 0;  // [N], [N s]
  void add(double force) {
    peak = std::max(peak, force);
    impulse += 1e-3 * std::max(0.0, force);
  }
};

/// Where the striker wants to be from its place [m]: in, held, and out, at this speed [m/s].
double way(double t, double speed) {
  const double takes = (kAway + kDepth) / speed;
  const double in = std::clamp((t - kBegin) / takes, 0.0, 1.0);
  const double out = std::clamp((t - kBegin - takes - kHold) / takes, 0.0, 1.0);
  return -kAway + (kAway + kDepth) * (in - out);
}

RowHands hands_of(double stiffness, double speed) {
  RowHands hands;
  hands.stiffness = stiffness;
  hands.start = -kAway;
  hands.target = [speed](std::size_t i, double t) { return i == 0 ? way(t, speed) : 0.0; };
  return hands;
}

Felt truth(double stiffness, double speed) {
  const RowHands hands = hands_of(stiffness, speed);
  const double place = 2 * hands.radius + 1e-6;
  const auto device = [&](std::size_t i) {
    SimulatedDeviceConfig config;
    config.mass = hands.mass;
    config.damping = hands.damping;
    config.hand_stiffness = hands.grip;
    config.hand_damping = hands.grip_damping;
    config.start.x() = i == 0 ? -kAway : place;
    return SimulatedDevice(config, [&hands, i, place](double t) {
      HandTarget target;
      target.position.x() = (i == 0 ? 0.0 : place) + hands.target(i, t);
      return target;
    });
  };
  SimulatedDevice striker = device(0), struck = device(1);
  Felt felt;
  for (int k = 1; k <= 1500; ++k) {
    const auto now = pdu::from_seconds(1e-3 * k);
    static_cast<void>(striker.read(now));
    static_cast<void>(struck.read(now));
    const double apart = struck.position().x() - striker.position().x();
    const double force = std::max(0.0, stiffness * (2 * hands.radius - apart));
    striker.write({-force, 0, 0}, now);
    struck.write({force, 0, 0}, now);
    felt.add(force);
  }
  return felt;
}

Felt tap(double stiffness, double speed, double delay, double loss, unsigned seed) {
  RowLine line;
  line.delay = delay;
  line.loss = loss;
  HandsInARow row(hands_of(stiffness, speed), line, seed);
  Felt felt;
  for (int k = 0; k < 1500; ++k) {
    row.step();
    felt.add(row.snapshot(1).force.x());
  }
  EXPECT_GE(row.least_sum(), -1e-9);
  EXPECT_GE(row.least_port(), -1e-9);
  return felt;
}

unsigned seeds() { return std::getenv("RECKON_SOAK") != nullptr ? 10 : 2; }

TEST(Tap, GivesTheStruckHandNoMoreThanItsTrueImpulseAndAFifth) {
  for (const double stiffness : {500.0, 900.0})
    for (const double speed : {0.2, 0.6, 1.0})
      for (const double delay : {0.005, 0.01, 0.02, 0.03, 0.05})
        for (const double loss : {0.05, 0.3})
          for (unsigned seed = 1; seed <= seeds(); ++seed) {
            const double limit = 1.2 * truth(stiffness, speed).impulse;
            EXPECT_LE(tap(stiffness, speed, delay, loss, seed).impulse, limit)
                << stiffness << " N/m, " << speed << " m/s, " << 1e3 * delay << " ms, loss " << loss
                << ", seed " << seed;
          }
}

TEST(Tap, IsRightOnALan) {
  const Felt right = truth(500, 0.2), felt = tap(500, 0.2, 0.0003, 0, 1);
  EXPECT_NEAR(felt.peak / right.peak, 1.05, 0.07);
  EXPECT_NEAR(felt.impulse / right.impulse, 1.0, 0.05);
}

}  // namespace
}  // namespace reckon::haptics
