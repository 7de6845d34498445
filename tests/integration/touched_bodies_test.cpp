// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A body between peers: its owner changes before a hand touches it, and hands of two peers press,
// carry, lift and throw it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "reckon/tests/integration/judged_runs.hpp"

namespace reckon::test {
namespace {

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

/// Both hands press it from two sides at one time. With `carries`, they then move it by 40 mm.
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

TEST(TouchedBodies, AreOwnedBeforeTheTouch) {
  for (const double mass : {0.1, 1.0, 10.0}) {
    const OneBodyRun truth(pushed(mass));
    Share share;
    for (const double delay : {0.0003, 0.02, 0.05, 0.1}) {
      for (const double loss : {0.0, 0.3}) {
        for (int seed = 1; seed <= seeds(); ++seed) {
          const OneBodyRun run(pushed(mass), {delay, loss, static_cast<std::uint64_t>(seed)});
          SCOPED_TRACE(testing::Message() << mass << ' ' << delay << ' ' << loss << ' ' << seed);
          const bool is_before = run.touch_of(1).second > 10;  // [ms]
          share.note(is_before && run.error(truth) <= (mass < 1 ? 0.05 : 0.03), delay, loss, seed);
          expect_one_owner(run);
        }
      }
    }
  }
}

TEST(TouchedBodies, AreRequestedAtTheTouchByOption) {
  for (const double delay : {0.0003, 0.02, 0.05}) {
    const OneBodyRun run(pushed(1.0), {delay, 0.0, 1, true});
    SCOPED_TRACE(testing::Message() << delay);
    EXPECT_EQ(run.touch_of(1).second, 0u) << "ms before the touch";
    EXPECT_EQ(run.steps().back().owner, 1);
    expect_one_owner(run);
  }
}

TEST(TouchedBodies, ArePressedByTwoPeers) {
  const OneBodyRun truth(pressed(false));
  Share share;
  for (const auto& [delay, bar] : {std::pair(0.02, 0.05), {0.05, 0.12}, {0.1, 0.4}}) {
    for (int seed = 1; seed <= seeds(); ++seed) {
      const OneBodyRun run(pressed(false), {delay, 0.0, static_cast<std::uint64_t>(seed)});
      SCOPED_TRACE(testing::Message() << delay << ' ' << seed);
      share.note(run.error(truth) <= bar, delay, 0.0, seed);
      expect_one_owner(run);
    }
  }
}

TEST(TouchedBodies, AreCarriedByTwoPeers) {
  const OneBodyRun truth(pressed(true));
  Share share;
  for (const double loss : {0.0, 0.3}) {
    for (const auto& [delay, bar] :
         {std::pair(0.0003, 0.05), {0.02, 0.1}, {0.05, 0.2}, {0.1, 0.35}}) {
      for (int seed = 1; seed <= seeds(); ++seed) {
        const OneBodyRun run(pressed(true), {delay, loss, static_cast<std::uint64_t>(seed)});
        SCOPED_TRACE(testing::Message() << delay << ' ' << loss << ' ' << seed);
        share.note(run.error(truth) <= bar && run.steady_error(truth) <= 0.02, delay, loss, seed);
        EXPECT_GE(run.least_energy(), -2 * haptics::PressingHands::kLoan);
        expect_one_owner(run);
      }
    }
  }
}

TEST(TouchedBodies, AreLiftedByTwoPeers) {
  const OneBodyRun truth(lifted());
  Share share;
  for (const double loss : {0.0, 0.3}) {
    for (const auto& [delay, steady, peak, turn] :
         {std::tuple(0.0003, 0.02, 1.5, 0.04), {0.02, 0.02, 1.5, 0.04}, {0.05, 0.05, 2.5, 0.08}}) {
      for (int seed = 1; seed <= seeds(); ++seed) {
        const OneBodyRun run(lifted(), {delay, loss, static_cast<std::uint64_t>(seed)});
        SCOPED_TRACE(testing::Message() << delay << ' ' << loss << ' ' << seed);
        const bool is_right =
            run.steady_error(truth) <= steady && run.peak() <= peak * truth.peak();
        share.note(is_right, delay, loss, seed);
        EXPECT_GT(run.steps().back().place.z(), 0.06) << "not dropped";
        EXPECT_LE(Eigen::Quaterniond::Identity().angularDistance(run.steps().back().turned), turn);
        EXPECT_GE(run.least_energy(), -2 * haptics::PressingHands::kLoan);
        expect_one_owner(run);
      }
    }
  }
}

TEST(TouchedBodies, AreHeldUpForAMinute) {
  if (!soaks()) GTEST_SKIP() << "long: with RECKON_SOAK=1";
  OneBody body = lifted();
  body.seconds = 62.0;
  for (const double delay : {0.0003, 0.02, 0.05}) {
    for (const double loss : {0.0, 0.3}) {
      for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        const OneBodyRun run(body, {delay, loss, seed});
        SCOPED_TRACE(testing::Message() << delay << ' ' << loss << ' ' << seed);
        EXPECT_GT(run.steps().back().place.z(), 0.06) << "not dropped";
        EXPECT_LE(Eigen::Quaterniond::Identity().angularDistance(run.steps().back().turned), 0.2);
      }
    }
  }
}

TEST(TouchedBodies, NeedFewOctets) {
  const auto sent = [](double seconds) {
    OneBody body = pressed(false);
    body.seconds = seconds;
    OneBodyRun run(body, {0.02, 0.0, 1});
    return run.peer(1).link().statistics().sent_bytes;
  };
  EXPECT_LT(sent(6) - sent(4), 2 * 8000u) << "of 2 s, while both hands press";
}

// The hands arrive within 100 ms of each other, or the second when the first has rested at the body
// for a second.
TEST(TouchedBodies, ArePressedWhoeverComesFirst) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> any(-0.1, 0.1);
  Share share;
  for (const auto& [delay, bar] : {std::pair(0.02, 0.05), {0.05, 0.12}, {0.1, 0.4}}) {
    for (int seed = 1; seed <= seeds(); ++seed) {
      for (const double gap : {any(random), 1.0}) {
        OneBody body = pressed(false);
        body.seconds = 5.0;
        body.laws[1] = [law = body.laws[1], gap](double t) { return law(t - gap); };
        const OneBodyRun truth(body);
        const OneBodyRun run(body, {delay, 0.0, static_cast<std::uint64_t>(seed)});
        const double steady = delay < 0.1 ? 0.02 : 0.1;
        share.note(run.error(truth) <= bar && run.steady_error(truth) <= steady, delay, 0.0, seed);
        EXPECT_GE(run.least_energy(), -2 * haptics::PressingHands::kLoan);
        expect_one_owner(run);
      }
    }
  }
}

// The first hand throws the body to the second, which catches it and pushes it back.
TEST(TouchedBodies, AreCaughtByAnotherPeer) {
  OneBody body;
  body.drag = 2.0;
  body.seconds = 6.0;
  body.laws = {[](double t) { return target_at(-0.16 + 0.15 * std::clamp(t - 0.3, 0.0, 0.8)); },
               [](double t) { return target_at(0.16 - 0.05 * std::max(0.0, t - 1.5)); }};
  const OneBodyRun truth(body);
  Share share;
  for (const double delay : {0.0003, 0.02, 0.05, 0.1}) {
    for (int seed = 1; seed <= seeds(); ++seed) {
      const OneBodyRun run(body, {delay, 0.0, static_cast<std::uint64_t>(seed)});
      const double bar = delay < 0.1 ? 0.05 : 0.1;
      share.note(run.error(truth) <= bar && run.steady_error(truth) <= bar, delay, 0.0, seed);
      EXPECT_GE(run.least_energy(), -2 * haptics::PressingHands::kLoan);
      expect_one_owner(run);
    }
  }
}

}  // namespace
}  // namespace reckon::test
