// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Regions are sources of energy: their forces on a hand at rest or in motion, within a loan and a
// power.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <complex>
#include <cstdio>
#include <numbers>

#include "reckon/pdu/seconds.hpp"
#include "reckon/tests/haptics/support/region_scenes.hpp"
#include "reckon/tests/haptics/support/servo_bench.hpp"

namespace reckon::haptics::region_source_test {
namespace {

using bench::Bench;
using bench::of;
using bench::region;
using bench::weight;
using Eigen::Vector3d;
using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr double kPeriod = 0.001;   // [s]
constexpr double kRoundOff = 1e-9;  // [J]
constexpr double kGrip = 300.0;     // [N/m]

Scene shaking(double newtons, double frequency) {
  SceneRegion one = region();
  one.effects.declare<Oscillation>() = {0, 0, newtons, frequency};
  return of(one);
}

SimulatedDeviceConfig held_at(const Vector3d& place) {
  SimulatedDeviceConfig config;
  config.hand_stiffness = kGrip;
  config.start = place;
  return config;
}
HandScript rests_at(const Vector3d& place) {
  return [=](double) {
    HandTarget hand;
    hand.position = place;
    return hand;
  };
}

// [N], after 1 s and the least and most of the second after it.
void rest(const Scene& scene, const Vector3d& start, double right, double most_lent) {
  Bench bench(scene, held_at(start), rests_at(start));
  bench.run(seconds(1));
  for (int i = 0; i < 1000; ++i) {
    const ServoSnapshot& s = bench.run(milliseconds(1));
    ASSERT_NEAR(s.force.norm(), right, 0.02 * right) << i;
  }
  const ServoSnapshot& s = bench.servo.snapshots().read();
  EXPECT_EQ(s.tally.effects.seconds > 0.2, false);
  EXPECT_GT(s.region_loan, 0.0);
  EXPECT_LE(s.region_loan_most, most_lent + kRoundOff);
  EXPECT_GE(bench.least, bench::kPassive);
  EXPECT_GE(s.port_energy_min, bench::kPassive);
}

TEST(RegionSource, RestingHandFeelsAWeight) { rest(weight(2.0), {0, 0, 0}, 2.0, 0.12); }

TEST(RegionSource, RestingHandFeelsASpring) {
  SceneRegion one = region();
  one.effects.declare<PointSpring>() = {100.0};
  rest(of(one), {0.008, 0, 0}, 0.008 * 100.0 * kGrip / (100.0 + kGrip), 0.5 * 100 * 0.008 * 0.008);
}

// A yielding grip comes to rest nearer to the magnet than at its start.
TEST(RegionSource, RestingHandFeelsAMagnet) {
  SceneRegion one = region();
  one.effects.declare<Attraction>() = {1.0, 0.02};
  const double right = std::sin(0.4 * std::numbers::pi);
  rest(of(one), {0.008 + right / kGrip, 0, 0}, right, 0.04 / std::numbers::pi);
}

TEST(RegionSource, RestingHandFeelsABorder) {
  SceneRegion one = region(SphereShape{0.02});
  one.effects.declare<BorderSpring>() = {150.0};
  rest(of(one), {0.03, 0, 0}, 0.01 * 150.0 * kGrip / (150.0 + kGrip), 0.5 * 150 * 1e-4);
}

TEST(RegionSource, RestingHandFeelsAVibration) {
  Bench bench(shaking(0.3, 60.0), held_at({0, 0, 0}), rests_at({0, 0, 0}));
  bench.run(seconds(1));
  std::complex<double> sum = 0.0;
  for (int i = 0; i < 1000; ++i) {
    const ServoSnapshot& s = bench.run(milliseconds(1));
    sum += 0.002 * s.force.z() * std::polar(1.0, -2.0 * std::numbers::pi * 60.0 * kPeriod * i);
    ASSERT_LE(s.oscillation_energy,
              bench::kOscillationEnergy + bench::kOscillationPower * pdu::to_seconds(bench.now));
    ASSERT_EQ(s.mesh_force, s.force);
  }
  EXPECT_GE(std::abs(sum), 0.95 * 0.3);
  EXPECT_GE(bench.least, bench::kPassive);
}

// None of its energy remains for others: no storage, no gift.
TEST(RegionSource, OscillationFillsNoLedger) {
  for (const double frequency : {3.0, 5.0, 20.0, 60.0}) {
    Bench bench(shaking(2.0, frequency), held_at({0, 0, 0}), rests_at({0, 0, 0}));
    double kept = 0.0;
    for (int i = 0; i < 4000; ++i) kept = std::max(kept, bench.run(milliseconds(1)).mesh_ledger);
    EXPECT_LE(kept, 1e-3) << frequency << " Hz";
    EXPECT_GE(bench.least, bench::kPassive) << frequency << " Hz";
  }
}

TEST(RegionSource, StrongOscillationIsBoundedAndReported) {
  Bench bench(shaking(8.0, 8.0), held_at({0, 0, 0}), rests_at({0, 0, 0}));
  const ServoSnapshot& s = bench.run(seconds(5));
  const double most = bench::kOscillationEnergy + bench::kOscillationPower * 5.0;
  EXPECT_LE(s.oscillation_energy, most + kRoundOff);
  EXPECT_GE(s.oscillation_energy, 0.8 * most) << "the power that it may have is used";
  EXPECT_LE(-(bench.device.port_work() + bench.device.damping_loss()), most + kRoundOff);
  EXPECT_GT(s.tally.effects.seconds, 1.0);
  EXPECT_LT(s.tally.effects.share, 0.9);
}

TEST(RegionSource, WithoutALoanTheHandMustPay) {
  ServoConfig config;
  config.region_loan = config.oscillation_power = config.oscillation_energy = 0.0;
  SceneRegion one = region();
  one.effects.declare<ConstantForce>() = {0, 0, -2.0};
  one.effects.declare<Oscillation>() = {0, 0, 0.3, 60.0};
  Bench bench(of(one), held_at({0, 0, 0}), rests_at({0, 0, 0}), config);
  const ServoSnapshot& s = bench.run(seconds(2));
  EXPECT_LT(s.force.norm(), 0.01);
  EXPECT_EQ(s.source_energy(), 0.0);
  EXPECT_GT(s.tally.effects.seconds, 1.0);
  EXPECT_GE(bench.least, bench::kPassive);
}

// 50 mm down and up again at 1 Hz for a minute, and sideways through the edge of a box.
void moves(const Scene& scene, HandScript script, bool (*inside)(const Vector3d&)) {
  SimulatedDeviceConfig device = held_at(script(0.0).position);
  Bench bench(scene, device, std::move(script));
  bench.run(milliseconds(500));
  double least = 1e9, most = 0.0;
  int in = 0;
  for (int i = 0; i < 60'000; ++i) {
    const ServoSnapshot& s = bench.run(milliseconds(1));
    in = inside(s.device) ? in + 1 : 0;
    if (in < 120) continue;  // it fades in
    least = std::min(least, -s.force.z());
    most = std::max(most, -s.force.z());
  }
  std::printf("weight of 2 N in motion: %.3f to %.3f N\n", least, most);
  EXPECT_GE(least, 1.9);
  EXPECT_LE(most, 2.1);
  EXPECT_GE(bench.least, bench::kPassive);
}

TEST(RegionSource, WeightStaysCorrectDownAndUp) {
  const auto everywhere = [](const Vector3d&) { return true; };
  moves(
      weight(2.0),
      [](double t) {
        HandTarget hand;
        hand.position.z() = 0.025 * std::cos(2 * std::numbers::pi * t);
        return hand;
      },
      everywhere);
}

TEST(RegionSource, WeightStaysCorrectThroughTheEdge) {
  const auto inside = [](const Vector3d& place) { return std::abs(place.x()) <= 0.03; };
  moves(
      weight(2.0, BoxShape{{0.06, 0.2, 0.2}}),
      [](double t) {
        HandTarget hand;
        hand.position.x() = 0.05 * std::sin(2 * std::numbers::pi * t);
        return hand;
      },
      inside);
}

// The loan is at most the energy that the regions can store within the device's reach.
TEST(RegionSource, LoanIsAtMostThePotentialWithinReach) {
  SceneRegion one = region(BoxShape{{0.02, 0.02, 0.02}});
  one.effects.declare<PointSpring>() = {100.0};
  const double most = 0.5 * 100.0 * 3e-4;
  Bench bench(of(one), held_at({0.03, 0, 0.03}), [](double t) {
    // In at a corner, out at the middle of a face.
    HandTarget hand;
    const double turn = std::fmod(t, 1.0);
    hand.position =
        turn < 0.5 ? Vector3d(1, 1, 1) * (0.03 - 0.06 * turn) : Vector3d(0.06 * (turn - 0.5), 0, 0);
    return hand;
  });
  const ServoSnapshot& s = bench.run(seconds(20));
  std::printf("lent at most %.1f of %.1f mJ\n", 1e3 * s.region_loan_most, 1e3 * most);
  EXPECT_GT(s.region_loan_most, 0.9 * most);
  EXPECT_LE(s.region_loan_most, most + kRoundOff);
  EXPECT_GE(bench.least, bench::kPassive);
}

// A weight of 6 N would store 120 mJ at rest, but a plate of 4 mm has 24 mJ from end to end.
TEST(RegionSource, ThinWeightLendsLess) {
  SimulatedDeviceConfig firm = held_at({0, 0, 0});
  firm.hand_stiffness = 2e4;
  firm.hand_damping = 50.0;
  Bench bench(weight(6.0, BoxShape{{0.08, 0.08, 0.004}}), firm, rests_at({0, 0, 0}));
  const ServoSnapshot& s = bench.run(seconds(3));
  EXPECT_GT(s.region_loan_most, 0.01);
  EXPECT_LE(s.region_loan_most, 0.024 + kRoundOff);
}

// A servo with its force switched off and on, on a device with delay and encoder steps.
TEST(RegionSource, CutsAndDelaysTakeNoMore) {
  for (int delay = 0; delay < 4; ++delay) {
    for (const double resolution : {0.0, 2e-5}) {
      Scene scene = weight(3.0, BoxShape{{0.04, 0.04, 0.06}});
      scene.regions[0].effects.declare<Oscillation>() = {0, 0, 1.0, 30.0};
      SimulatedDeviceConfig device = held_at({0.02, 0, 0.02});
      device.delay_samples = delay;
      device.resolution = resolution;
      Bench bench(scene, device, [](double t) {
        HandTarget hand;
        const double angle = 2.0 * std::numbers::pi * 0.9 * t;
        hand.position = Vector3d(0.025 * std::cos(angle), 0, 0.03 * std::sin(angle));
        return hand;
      });
      for (int i = 0; i < 40; ++i) {
        bench.device.enable(i % 3 != 2);
        bench.run(milliseconds(211));
        const ServoSnapshot& s = bench.servo.snapshots().read();
        ASSERT_GE(bench.least, bench::kPassive - s.encoder_allowance)
            << delay << ", " << resolution;
        ASSERT_GE(s.port_energy_min, bench::kPassive - s.encoder_allowance) << delay;
        ASSERT_LE(s.region_loan_most, 0.12 + kRoundOff);
      }
    }
  }
}

TEST(RegionSource, ToolOfSixAxesFeelsWeightAndVibration) {
  SceneRegion one = region();
  one.effects.declare<ConstantForce>() = {0, 0, -2.0};
  one.effects.declare<Oscillation>() = {0.3, 0, 0, 60.0};
  SimulatedDeviceConfig device = held_at({0, 0, 0});
  device.turn = SimulatedTurnConfig{};
  Bench bench(of(one), device, rests_at({0, 0, 0}));
  bench.run(seconds(1));
  double peak = 0.0;
  for (int i = 0; i < 500; ++i) {
    const ServoSnapshot& s = bench.run(milliseconds(1));
    ASSERT_NEAR(s.force.z(), -2.0, 0.04);
    peak = std::max(peak, s.force.x());
  }
  EXPECT_NEAR(peak, 0.3, 0.015);
  EXPECT_GE(bench.least, bench::kPassive);
}

// A liar presses a resting hand and claims to have given whatever the hand takes.
double into_hand(const Scene& scene) {
  SimulatedDevice device(held_at({0, 0, 0}), rests_at({0, 0, 0}));
  ServoConfig config;
  config.probe_radius = 0.02;
  ServoLoop servo(device, EffectPlan(scene), config);
  double taken = 0.0, source = 0.0;
  for (int i = 0; i < 6000; ++i) {
    const double t = kPeriod * i;
    if (i % 5 == 0) {
      RemoteHand hand = bench::sphere({0, 0, 0}, 900.0, static_cast<std::uint32_t>(i + 1));
      hand.state.position.x() =
          -0.045 + 0.02 * std::min(1.0, t) + 0.004 * std::sin(2.0 * std::numbers::pi * 8.0 * t);
      hand.state_time = milliseconds(i);
      hand.given_to_us = 0.2 * i;
      servo.contacts().write(bench::only(hand));
    }
    servo.step(milliseconds(i));
    servo.snapshots().update();
    source = servo.snapshots().read().source_energy();
    if (i == 1999) taken = device.port_work() + device.damping_loss() + source;
  }
  return taken - (device.port_work() + device.damping_loss() + source);
}

TEST(RegionSource, VibrationGivesALiarNothing) {
  const double without = into_hand({});
  const double with = into_hand(shaking(0.3, 60.0));
  std::printf("liar: %.3f mJ in 4 s, with a vibration %.3f mJ\n", 1e3 * without, 1e3 * with);
  EXPECT_GT(without, 0.01);
  EXPECT_NEAR(with, without, 0.02 * without);
}

}  // namespace
}  // namespace reckon::haptics::region_source_test
