// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/deadreckon/motion/articulation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "reckon/deadreckon/motion/rotation.hpp"
#include "reckon/tests/deadreckon/support/parts.hpp"
#include "reckon/tests/support/allocation_guard.hpp"

namespace reckon::deadreckon::test {
namespace {

TEST(Articulation, ContinuesAtItsRateUntilTheTimeOut) {
  Random random(3);
  for (int i = 0; i < 10'000; ++i) {
    const PartParameter p =
        parameter(kTurret, PartMetric::azimuth, random.real(-kPi, kPi), random.real(-20, 20));
    const double tau = random.real(-12, 12);
    const PartMotion at = predict(p, tau);
    const double angle = p.value + p.rate * tau;  // sine and cosine ignore wrapping
    ASSERT_NEAR(std::cos(at.value), std::cos(angle), 1e-12);
    ASSERT_NEAR(std::sin(at.value), std::sin(angle), 1e-12);
    ASSERT_EQ(at.rate, p.rate);
    ASSERT_EQ(predict(p, 3600).value, predict(p, kLongestPartMotion).value);
    ASSERT_EQ(predict(p, 3600).rate, 0);
    ASSERT_EQ(predict(p, kNan).value, p.value);
  }
  EXPECT_EQ(predict(parameter(96, PartMetric::extension, 100, 2), 3).value, 106);
  EXPECT_EQ(predict(parameter(96, PartMetric::extension, 100, 2), 30, 20).value, 140);
}

TEST(Articulation, ComparesAnglesTheShorterWay) {
  Random random(4);
  const auto about_z = [](double a) {
    return Eigen::Quaterniond(Eigen::AngleAxisd(a, Eigen::Vector3d::UnitZ()));
  };
  for (int i = 0; i < 10'000; ++i) {
    const double a = random.real(-10, 10), b = random.real(-10, 10);
    const double off = difference(PartMetric::rotation, a, b);
    ASSERT_NEAR(std::abs(off), angle_between(about_z(a), about_z(b)), 1e-12);
    ASSERT_NEAR(std::cos(b + off), std::cos(a), 1e-12);
  }
  EXPECT_NEAR(difference(PartMetric::azimuth, -kPi + 0.01, kPi - 0.01), 0.02, 1e-15);
  EXPECT_EQ(difference(PartMetric::azimuth, kPi, 0), kPi);
  EXPECT_EQ(difference(PartMetric::z, 7, -7), 14);
}

TEST(Articulation, SendsErrorsAboveTheThresholdOfTheUnit) {
  const PartThresholds limits;
  const auto sends = [&](PartMetric metric, double off) {
    return should_send(one(parameter(5, metric, 1 + off)), one(parameter(5, metric, 1)), 0);
  };
  for (const PartMetric metric : kMetrics) {
    const double limit = is_angle(metric)                 ? limits.angle
                         : metric == PartMetric::position ? limits.share
                                                          : limits.length;
    for (const double sign : {1.0, -1.0}) {
      EXPECT_FALSE(sends(metric, sign * 0.999 * limit)) << static_cast<int>(metric);
      EXPECT_TRUE(sends(metric, sign * 1.001 * limit)) << static_cast<int>(metric);
    }
  }
  // Across pi: 2 degrees are not sent, 4 are.
  const PartState near_pi = one(parameter(5, PartMetric::azimuth, kPi - 0.0175));
  EXPECT_FALSE(should_send(one(parameter(5, PartMetric::azimuth, -kPi + 0.0175)), near_pi, 0));
  EXPECT_TRUE(should_send(one(parameter(5, PartMetric::azimuth, -kPi + 0.0525)), near_pi, 0));
}

TEST(Articulation, SendsWhenAPartAppearsDisappearsOrMoves) {
  const PartState sent = one(parameter(kGun, PartMetric::elevation, 0.2));
  EXPECT_FALSE(should_send(sent, sent, 5));
  EXPECT_TRUE(should_send(PartState(), sent, 0));
  EXPECT_TRUE(should_send(sent, PartState(), 0));
  EXPECT_TRUE(should_send(one(parameter(kTurret, PartMetric::elevation, 0.2)), sent, 0));
  PartParameter moved = sent.parameters()[0];
  moved.attached_to = 2;
  EXPECT_TRUE(should_send(one(moved), sent, 0));
  PartThresholds broken;
  broken.angle = kNan;
  EXPECT_TRUE(should_send(sent, sent, 0, broken)) << "rather one packet too many";
}

// The state of peers is the decoded state.
PartState as_received(const PartState& state) {
  std::array<std::byte, 64 * 16> octets;
  PartState back;
  from_wire(std::span(octets).first(to_wire(state, octets)), back);
  return back;
}

TEST(Articulation, SteadilyTurningTurretNeedsTwoPackets) {
  constexpr double kRate = 0.4;  // [rad/s], from t = 1 s on
  constexpr double kTimeout = 132;
  PartState sent = as_received(one(parameter(kTurret, PartMetric::azimuth, 1)));
  double sent_at = 0, worst = 0;
  int packets = 1;
  for (double now = 0; now < 120; now += 0.01) {
    const double turned = std::max(0.0, now - 1);
    const PartState truth =
        one(parameter(kTurret, PartMetric::azimuth, 1 + kRate * turned, turned > 0 ? kRate : 0.0));
    if (should_send(truth, sent, now - sent_at, {}, kTimeout)) {
      sent = as_received(truth);
      sent_at = now;
      ++packets;
    }
    const PartParameter &is = truth.parameters()[0], &told = sent.parameters()[0];
    const double seen = predict(told, now - sent_at, kTimeout).value;
    worst = std::max(worst, std::abs(difference(is.metric, is.value, seen)));
  }
  EXPECT_EQ(packets, 2);
  EXPECT_LE(worst, PartThresholds().angle);
}

TEST(Articulation, ChangeCounterWrapsToOne) {
  PartState state;
  for (int i = 0; i < 600; ++i) {
    ASSERT_TRUE(state.set(parameter(kTurret, PartMetric::azimuth, 1e-3 * i)));
    const int change = state.parameters()[0].change;
    ASSERT_EQ(change, i == 0 ? 0 : 1 + (i - 1) % 255);
    // the same value again
    ASSERT_TRUE(state.set(parameter(kTurret, PartMetric::azimuth, 1e-3 * i)));
    ASSERT_EQ(state.parameters()[0].change, change);
  }
  for (const double bad : {kNan, std::numeric_limits<double>::infinity()}) {
    EXPECT_FALSE(state.set(parameter(kTurret, PartMetric::azimuth, bad)));
    EXPECT_FALSE(state.set(parameter(kTurret, PartMetric::azimuth, 0, bad)));
  }
}

TEST(Articulation, IsShownWithoutAStepAtAnyUpdate) {
  Random random(5);
  for (const PartMetric metric : kMetrics) {
    PartConvergence convergence;
    double now = 0;
    convergence.update(one(parameter(kTurret, metric, 3.1, 1)), 0, 0);
    for (int i = 0; i < 2000; ++i) {
      now += random.real(0.001, 0.2);  // often before the last error has decayed
      const PartMotion before = convergence.shown(0, now);
      const double told = random.real(-kPi, kPi), rate = random.real(-3, 3);
      convergence.update(one(parameter(kTurret, metric, told, rate)), now - 0.05, now);
      const PartMotion after = convergence.shown(0, now);
      ASSERT_LE(std::abs(difference(metric, after.value, before.value)), 1e-12);
      ASSERT_NEAR(after.rate, before.rate, 1e-12);
      // The rate is the slope of the displayed value.
      constexpr double h = 1e-6;
      const double t = now + random.real(0.01, 0.09);
      const double slope =
          difference(metric, convergence.shown(0, t + h).value, convergence.shown(0, t - h).value) /
          (2 * h);
      ASSERT_NEAR(convergence.shown(0, t).rate, slope, 1e-5);
    }
    const double end = now + 1.01 * ConvergenceSettings().longest;
    EXPECT_EQ(convergence.shown(0, end).value,
              predict(convergence.state().parameters()[0], end - (now - 0.05)).value);
  }
}

TEST(Articulation, ConvergesTheShorterWayAcrossPi) {
  PartConvergence convergence;
  convergence.update(one(parameter(kTurret, PartMetric::azimuth, kPi - 0.2)), 0, 0);
  convergence.update(one(parameter(kTurret, PartMetric::azimuth, -kPi + 0.2)), 1, 1);
  for (double t = 1; t < 2.1; t += 0.001)
    ASSERT_GE(std::abs(convergence.shown(0, t).value), kPi - 0.2 - 1e-12) << t;
}

TEST(Articulation, ShowsAppearedRemovedOrMovedPartsAtOnce) {
  PartConvergence convergence;
  convergence.update(one(parameter(kTurret, PartMetric::azimuth, 1)), 0, 0);
  PartState next = one(parameter(kLandingGear, PartMetric::position, 0.5));
  ASSERT_TRUE(next.set(parameter(kTurret, PartMetric::azimuth, 1.5)));
  convergence.update(next, 1, 1);
  EXPECT_EQ(convergence.shown(0, 1).value, 0.5) << "new";
  EXPECT_EQ(convergence.shown(1, 1).value, 1) << "known, though in another place of the list";
  PartParameter moved = parameter(kTurret, PartMetric::azimuth, 2);
  moved.attached_to = 1;
  convergence.update(one(moved), 2, 2);
  ASSERT_EQ(convergence.state().parameters().size(), 1u) << "the gear is gone";
  EXPECT_EQ(convergence.shown(0, 2).value, 2) << "attached elsewhere";
  convergence.update(one(parameter(kGun, PartMetric::extension, 0)), 3, 3);
  convergence.update(one(parameter(kGun, PartMetric::extension, 100)), 4, 4);
  EXPECT_EQ(convergence.shown(0, 4).value, 100) << "farther than the teleport distance";
}

TEST(Articulation, AllocatesNothing) {
  Random random(6);
  const PartState state = random_state(random);
  std::array<std::byte, 64 * 16> octets;
  PartState back;
  PartConvergence convergence;
  double sink = 0;
  const reckon::test::AllocationGuard guard;
  for (int i = 0; i < 100; ++i) {
    sink +=
        static_cast<double>(from_wire(std::span(octets).first(to_wire(state, octets)), back).taken);
    sink += should_send(state, back, 0.1) ? 1 : 0;
    convergence.update(back, 0.1 * i, 0.1 * i);
    if (!back.parameters().empty()) sink += convergence.shown(0, 0.1 * i + 0.05).value;
  }
  EXPECT_EQ(guard.count(), 0u);
  EXPECT_TRUE(std::isfinite(sink));
}

}  // namespace
}  // namespace reckon::deadreckon::test
