// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A body between peers: its owner changes before a hand touches it, and hands of two peers press,
// carry and lift it.
#include <gtest/gtest.h>

#include "reckon/tests/integration/two_peers_one_body.hpp"
#include "reckon/tests/support/soak.hpp"

namespace reckon::test {
namespace {

using Eigen::Vector3d;

int seeds() { return tries(1, 60); }

haptics::HandTarget target_at(double x, double z = 0.0) {
  haptics::HandTarget target;
  target.position = {x, 0, z};
  return target;
}

/// The second hand pushes the body of the first peer, at 0.15 m/s.
OneBody pushed(double mass) {
  OneBody body;
  body.mass = mass;
  body.drag = 0.2;
  body.seconds = 2.5;
  body.laws = {[](double) { return target_at(1.0); },
               [](double t) { return target_at(-0.16 + 0.15 * std::max(0.0, t - 0.3)); }};
  return body;
}

/// Both hands press it from two sides at one time, and then carry it 40 mm if told to.
OneBody pressed(bool carries) {
  OneBody body;
  body.drag = 2.0;
  body.seconds = carries ? 7.0 : 4.0;
  const auto law = [carries](double side) {
    return [=](double t) {
      const double carried = carries ? 0.04 * eased(t, 4, 5) : 0.0;
      return target_at(side * (0.06 - 0.035 * eased(t, 0.5, 1.5)) + carried);
    };
  };
  body.laws = {law(-1), law(1)};
  return body;
}

/// Two hands lift a cube of 50 g by friction, and shake it at 1 Hz.
OneBody lifted() {
  OneBody body;
  body.mass = 0.05;
  body.stiffness = 400;
  body.side = 0.04;
  body.is_heavy = true;
  body.seconds = 8.0;
  const auto law = [](double side, double later) {
    return [=](double t) {
      const double shaken = 0.015 * std::sin(2 * M_PI * std::max(0.0, t - 4)) * eased(t, 4, 4.5);
      const double apart = 0.07 - 0.062 * eased(t, 0.2 + later, 0.9 + later);
      return target_at(side * apart + shaken, 0.02 + 0.05 * eased(t, 2.5, 3.5));
    };
  };
  body.laws = {law(-1, 0.0), law(1, 0.5)};
  return body;
}

void expect_one_owner(const OneBodyRun& run) {
  for (const OneBodyStep& step : run.steps()) ASSERT_LE(step.owners, 1);
}

TEST(TouchedBodies, AreOwnedBeforeTheTouch) {
  for (const double mass : {0.1, 1.0, 10.0}) {
    const OneBodyRun truth(pushed(mass));
    for (const double delay : {0.0003, 0.02, 0.05, 0.1}) {
      for (const double loss : {0.0, 0.3}) {
        for (int seed = 1; seed <= seeds(); ++seed) {
          const OneBodyRun run(pushed(mass), {delay, loss, static_cast<std::uint64_t>(seed)});
          SCOPED_TRACE(testing::Message() << mass << ' ' << delay << ' ' << loss << ' ' << seed);
          EXPECT_LE(run.error(truth), mass < 1 ? 0.05 : 0.03);
          EXPECT_GT(run.touch_of(1).second, 10u) << "ms before the touch";
          expect_one_owner(run);
        }
      }
    }
  }
}

TEST(TouchedBodies, ArePressedByTwoPeers) {
  const OneBodyRun truth(pressed(false));
  for (const auto& [delay, bar] : {std::pair(0.02, 0.05), {0.05, 0.12}, {0.1, 0.4}}) {
    for (int seed = 1; seed <= seeds(); ++seed) {
      const OneBodyRun run(pressed(false), {delay, 0.0, static_cast<std::uint64_t>(seed)});
      SCOPED_TRACE(testing::Message() << delay << ' ' << seed);
      EXPECT_LE(run.error(truth), bar);
      expect_one_owner(run);
    }
  }
}

TEST(TouchedBodies, AreCarriedByTwoPeers) {
  const OneBodyRun truth(pressed(true));
  for (const double loss : {0.0, 0.3}) {
    for (const auto& [delay, bar] : {std::pair(0.0003, 0.05), {0.02, 0.1}, {0.05, 0.2}}) {
      for (int seed = 1; seed <= seeds(); ++seed) {
        const OneBodyRun run(pressed(true), {delay, loss, static_cast<std::uint64_t>(seed)});
        SCOPED_TRACE(testing::Message() << delay << ' ' << loss << ' ' << seed);
        EXPECT_LE(run.error(truth), bar);
        EXPECT_LE(run.steady_error(truth), 0.02);
        EXPECT_GE(run.least_energy(), -2 * haptics::PressingHands::kLoan);
        expect_one_owner(run);
      }
    }
  }
}

TEST(TouchedBodies, AreLiftedByTwoPeers) {
  const OneBodyRun truth(lifted());
  for (const double loss : {0.0, 0.3}) {
    for (const auto& [delay, steady, peak, turn] :
         {std::tuple(0.0003, 0.02, 1.5, 0.04), {0.02, 0.02, 1.5, 0.04}, {0.05, 0.05, 2.5, 0.08}}) {
      for (int seed = 1; seed <= seeds(); ++seed) {
        const OneBodyRun run(lifted(), {delay, loss, static_cast<std::uint64_t>(seed)});
        SCOPED_TRACE(testing::Message() << delay << ' ' << loss << ' ' << seed);
        EXPECT_LE(run.steady_error(truth), steady);
        EXPECT_LE(run.peak(), peak * truth.peak());
        EXPECT_GT(run.steps().back().place.z(), 0.06) << "not dropped";
        EXPECT_LE(Eigen::Quaterniond::Identity().angularDistance(run.steps().back().turned), turn);
        EXPECT_GE(run.least_energy(), -2 * haptics::PressingHands::kLoan);
        expect_one_owner(run);
      }
    }
  }
}

}  // namespace
}  // namespace reckon::test
