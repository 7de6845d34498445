// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Hands of two peers hold one body by springs.
#include <gtest/gtest.h>

#include <cmath>

#include "reckon/tests/integration/judged_runs.hpp"

namespace reckon::test {
namespace {

/// The first hand holds a body of 0.5 kg by a spring and lifts it; the second presses its side.
OneBody held() {
  OneBody body;
  body.mass = 0.5;
  body.is_heavy = true;
  body.grab = 200;
  body.seconds = 10.0;
  const auto law = [](double side, double later) {
    return [=](double t) {
      const double apart = 0.09 - 0.06 * eased(t, 0.2 + later, 0.9 + later);
      haptics::HandTarget target = target_at(side * apart, 0.04 + 0.12 * eased(t, 3, 5));
      target.buttons = side < 0 && t > 2.5 ? 1 : 0;
      return target;
    };
  };
  body.laws = {law(-1, 0.0), law(1, 0.3)};
  return body;
}

/// Each hand holds an end of a bar of 1 kg by a spring of 150 N/m. They lift it from 3.2 to 5.2 s.
/// @param apart [s], when the first hand releases it
OneBody held_bar(double apart) {
  OneBody body;
  body.is_heavy = true;
  body.side = 0.04;
  body.length = 0.2;
  body.grab = 150;
  body.hand = 1000;
  body.seconds = 11.0;
  const auto law = [apart](double side, double later) {
    return [=](double t) {
      const double out = 0.13 - 0.035 * eased(t, 0.2 + later, 0.9 + later) +
                         0.008 * eased(t, 2.6, 2.9) +
                         (side < 0 ? 0.1 * eased(t, apart, apart + 1) : 0.0);
      haptics::HandTarget target = target_at(side * out, 0.02 + 0.14 * eased(t, 3.2, 5.2));
      target.buttons = t > 2.2 && (side > 0 || t < apart) ? 1 : 0;
      return target;
    };
  };
  body.laws = {law(-1, 0.0), law(1, 0.3)};
  return body;
}

// The first hand holds the body; the second one presses a copy that hangs at the first.
TEST(TouchedBodies, ArePressedWhileAnotherHolds) {
  const OneBodyRun truth(held());
  Share share;
  for (const double delay : {0.0003, 0.02, 0.05}) {
    for (int seed = 1; seed <= seeds(); ++seed) {
      const OneBodyRun run(held(), {delay, 0.0, static_cast<std::uint64_t>(seed)});
      SCOPED_TRACE(testing::Message() << delay << ' ' << seed);
      share.note(run.steady_error(truth) <= 0.06, delay, 0.0, seed);
      EXPECT_GT(run.steps().back().place.z(), 0.06);
      EXPECT_GE(run.least_energy(), -2 * haptics::PressingHands::kLoan);
    }
  }
}

// Hands of two peers hold one bar (thesis 2.4.2). Its sag is its weight over the sum of both
// stiffnesses. With losses or a long delay a hand may lack energy and hold it more softly, but with
// the same force.
TEST(TouchedBodies, AreHeldByTwoPeers) {
  const OneBody bar = held_bar(20);
  const OneBodyRun truth(bar);
  Share share;
  const double sag = 1.0 * 9.81 / (2 * bar.grab);
  const double top = 0.16 - 9.81 / 2 / bar.hand;  // [m], of both handles
  for (const double delay : {0.0003, 0.02, 0.05, 0.1}) {
    for (const double loss : {0.0, 0.3}) {
      for (int seed = 1; seed <= seeds(); ++seed) {
        const OneBodyRun run(bar, {delay, loss, static_cast<std::uint64_t>(seed)});
        SCOPED_TRACE(testing::Message() << delay << ' ' << loss << ' ' << seed);
        const double off = std::abs(top - run.steps().back().place.z() - sag);
        const bool hangs_right = off <= 0.01 * sag && run.steady_error(truth) <= 0.01 &&
                                 run.error(truth) <= 0.05 && run.swing(10.0) <= 0.01 * sag;
        const bool is_hard = loss > 0 || delay > 0.05;
        share.note(is_hard ? run.steady_error(truth) <= 0.04 : hangs_right, delay, loss, seed);
        EXPECT_GE(run.least_energy(), -2 * haptics::PressingHands::kLoan);
        expect_one_owner(run);
      }
    }
  }
}

// The first hand releases the bar, which then hangs at the second.
TEST(TouchedBodies, AreGivenToTheHandThatHolds) {
  const OneBody bar = held_bar(7);
  const OneBodyRun truth(bar);
  for (const double delay : {0.0003, 0.02, 0.05}) {
    for (int seed = 1; seed <= seeds(); ++seed) {
      const OneBodyRun run(bar, {delay, 0.0, static_cast<std::uint64_t>(seed)});
      SCOPED_TRACE(testing::Message() << delay << ' ' << seed);
      EXPECT_EQ(run.steps().back().owner, 1);
      EXPECT_LT(run.step_at_change(), 0.2) << "N, within a millisecond";
      const Eigen::Vector3d off = run.steps().back().force[1] - truth.steps().back().force[1];
      EXPECT_LE(off.norm(), 0.05 * truth.steps().back().force[1].norm());
      EXPECT_LE(run.peak(), 1.5 * truth.peak());
      EXPECT_GE(run.least_energy(), -2 * haptics::PressingHands::kLoan);
      expect_one_owner(run);
    }
  }
}

}  // namespace
}  // namespace reckon::test
