// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Regions are sources of energy: what a hand at rest feels of them, and that nobody gets more out
// of them than the loan of the port and the power of its oscillations.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <complex>
#include <cstdio>
#include <numbers>
#include <random>

#include "reckon/haptics/contact/static_contact.hpp"
#include "reckon/pdu/seconds.hpp"
#include "reckon/tests/haptics/support/servo_bench.hpp"

namespace reckon::haptics {
namespace {

using bench::Bench;
using Eigen::Vector3d;
using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr double kPeriod = 0.001;   // [s]
constexpr double kRoundOff = 1e-9;  // [J]
constexpr double kGrip = 300.0;     // [N/m]
constexpr double kPower = 0.1;      // [W], of oscillations, by default
constexpr double kAtOnce = 0.02;    // [J], likewise

SceneRegion region(std::optional<Shape> shape = std::nullopt) {
  SceneRegion out;
  out.name = "region";
  out.shape = std::move(shape);
  return out;
}
Scene of(const SceneRegion& one) {
  Scene scene;
  scene.regions.push_back(one);
  return scene;
}
Scene weight(double newtons, std::optional<Shape> shape = std::nullopt) {
  SceneRegion one = region(std::move(shape));
  one.effects.declare<ConstantForce>() = {0, 0, -newtons};
  return of(one);
}
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

// A grip that gives way comes to rest nearer to the magnet than where it began.
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
    ASSERT_LE(s.oscillation_energy, kAtOnce + kPower * pdu::to_seconds(bench.now));
    ASSERT_EQ(s.mesh_force, s.force);
  }
  EXPECT_GE(std::abs(sum), 0.95 * 0.3);
  EXPECT_GE(bench.least, bench::kPassive);
}

// Nothing that it brings in is left for others: no storage, no gift.
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
  const double most = kAtOnce + kPower * 5.0;
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

TEST(RegionSource, WeightStaysRightDownAndUp) {
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

TEST(RegionSource, WeightStaysRightThroughTheEdge) {
  const auto inside = [](const Vector3d& place) { return std::abs(place.x()) <= 0.03; };
  moves(
      weight(2.0, BoxShape{{0.06, 0.2, 0.2}}),
      [](double t) {
        HandTarget hand;
        hand.position.x() = 0.05 * std::sin(2 * std::numbers::pi * 0.5 * t);
        return hand;
      },
      inside);
}

/// What was taken out of a port [J], by its own books.
struct Loot {
  double least = 0.0;   // of the books
  double beyond = 0.0;  // <= 0, of the bound that is stated
  double spent = -1.0;  // by oscillations beyond what they may
  double owed = 0.0;    // most
};

/// A port that moves as told or as takes most, with its own books.
class Thief {
 public:
  Thief(const Scene& scene, double loan, int delay, double resolution = 0.0)
      : plan_(scene),
        port_(1.0, delay, resolution),
        contact_(plan_, kCap / (1.0 + 2.0 * delay)),
        held_(delay) {
    port_.region_loan().limit(loan);
    port_.oscillations().limit(kPower, kAtOnce);
  }
  void begin(const Vector3d& place) {
    place_ = place;
    tool_.reset({place});
    contact_.reset(tool_);
  }
  /// @return the force that was written [N]
  Vector3d hold() {
    PortLoad load;
    tool_.set_velocity(velocity_);
    contact_.load(tool_, kPeriod, load);
    const PortHold held = port_.hold(load, kPeriod);
    if (held.walls < 1.0) contact_.attenuate(held.walls, port_);
    contact_.shown(held.extra);
    return held.force + port_.shake(load, kPeriod);
  }
  void move(const Vector3d& force, const Vector3d& dx) {
    hold_for_a_sample(force, dx);
    port_.settle(unread_, kPeriod);
    tool_.move({place_});
    contact_.settle(tool_, kPeriod, port_);
    unread_.setZero();
    note();
  }
  /// The reading after the motion fails, and the next force is cut.
  void move_unread(const Vector3d& force, const Vector3d& dx) {
    hold_for_a_sample(force, dx);
    port_.miss(kPeriod);
    note();
    static_cast<void>(hold());
    cut();
    port_.attenuate(0.0);
  }
  void cut() { contact_.attenuate(0.0, port_); }

  [[nodiscard]] const Vector3d& place() const { return place_; }
  [[nodiscard]] const Vector3d& at_handle() const { return held_.at_handle(); }
  [[nodiscard]] const Loot& loot() const { return loot_; }

 private:
  void hold_for_a_sample(const Vector3d& force, const Vector3d& dx) {
    held_.write(force);
    books_ += -held_.at_handle().dot(dx) + dx.squaredNorm() / kPeriod;
    place_ += dx;
    unread_ += dx;
    velocity_ = dx / kPeriod;
  }
  void note() {
    port_.wait(kPeriod);
    time_ += kPeriod;
    loot_.least = std::min(loot_.least, books_);
    const double owed = port_.region_loan().owed(), spent = port_.oscillations().spent();
    // A sample that was not read is booked with the next one.
    if (unread_.isZero(0.0)) loot_.beyond = std::min(loot_.beyond, books_ + owed + spent);
    loot_.spent = std::max(loot_.spent, spent - kAtOnce - kPower * time_);
    loot_.owed = std::max(loot_.owed, owed);
  }

  static constexpr double kCap = 0.75 * 0.95 * 2.0 / kPeriod;

  EffectPlan plan_;
  EnergyPort port_;
  StaticContact contact_;
  PointTool tool_;
  HeldForces held_;
  Vector3d place_ = Vector3d::Zero(), velocity_ = Vector3d::Zero();
  Vector3d unread_ = Vector3d::Zero();
  double books_ = 0.0, time_ = 0.0;
  Loot loot_;
};

// In at the top and out at the bottom: the second round is paid by nobody.
TEST(RegionSource, EnteringAgainGrantsNothingNew) {
  Thief thief(weight(2.0, BoxShape{{0.04, 0.04, 0.08}}), 0.12, 0);
  thief.begin({0.03, 0, 0.039});
  const Vector3d corners[] = {
      {0.0, 0, 0.039}, {0.0, 0, -0.039}, {0.03, 0, -0.039}, {0.03, 0, 0.039}};
  double first = 0.0;
  for (int round = 0; round < 40; ++round) {
    for (const Vector3d& corner : corners) {
      while ((corner - thief.place()).norm() > 1e-9) {
        Vector3d way = corner - thief.place();
        if (way.norm() > 1e-4) way *= 1e-4 / way.norm();
        thief.move(thief.hold(), way);
      }
    }
    if (round == 0) first = thief.loot().least;
  }
  EXPECT_LT(first, -0.05) << "the first fall is a gift of the region";
  EXPECT_GE(thief.loot().least, -0.12 - kRoundOff);
  EXPECT_GE(thief.loot().beyond, -kRoundOff);
  EXPECT_LE(thief.loot().owed, 0.12 + kRoundOff);
}

/// What an adversary can choose, each in [0, 1].
struct Genes {
  static constexpr int kCount = 16;
  double value[kCount] = {};
  double operator[](int i) const { return value[i]; }
};

Scene drawn(const Genes& g) {
  Scene scene;
  const int count = 1 + static_cast<int>(2.99 * g[0]);
  for (int i = 0; i < count; ++i) {
    const double size = 0.01 + 0.06 * g[1];
    SceneRegion one = g[2] < 0.4   ? region(BoxShape{{size, size, size}})
                      : g[2] < 0.8 ? region(SphereShape{0.5 * size})
                                   : region(PlaneShape{Vector3d(1, 0, g[3]).normalized()});
    one.pose.position = Vector3d(0.02 * i * g[3], 0, 0.01 * i * g[4]);
    one.pose.orientation =
        Eigen::Quaterniond(Eigen::AngleAxisd(3.0 * g[4] * i, Vector3d(0.3, 1, 0.2).normalized()));
    if (g[5] < 0.6) one.effects.declare<ConstantForce>() = {2.0 * g[6], 0.0, -4.0 * g[7]};
    if (g[6] > 0.5) one.effects.declare<PointSpring>() = {10.0 + 200.0 * g[7], 0.0, 3.0};
    if (g[8] > 0.5) one.effects.declare<Attraction>() = {3.0 * g[8], 0.01 + 0.03 * g[9]};
    if (g[9] > 0.6) one.effects.declare<Oscillation>() = {g[7], 0.0, 4.0 * g[8], 2.0 + 60.0 * g[6]};
    if (g[5] > 0.8) one.effects.declare<DryFriction>() = {g[7], 50.0 + 200.0 * g[6]};
    if (g[1] > 0.7 && g[2] < 0.8) one.effects.declare<BorderSpring>() = {200.0 * g[3]};
    scene.regions.push_back(one);
  }
  return scene;
}

/// Circles over the edge, goes with the force for some of the time, and is cut now and then.
Loot played(const Genes& g, std::uint32_t seed) {
  constexpr double kLoan = 0.05;
  Thief thief(drawn(g), kLoan, static_cast<int>(3.99 * g[15] * g[15]));
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> any(0.0, 1.0);
  const Vector3d middle(0.06 * (g[10] - 0.5), 0, 0.06 * (g[11] - 0.5));
  const double radius = 0.002 + 0.04 * g[12], rate = 0.2 + 20.0 * g[13] * g[13];
  const auto on_circle = [&](double t) -> Vector3d {
    const double angle = 2.0 * std::numbers::pi * rate * t;
    return middle + radius * Vector3d(std::cos(angle), 0, std::sin(angle));
  };
  thief.begin(on_circle(0));
  double falls = 0.0;
  for (int i = 0; i < 3000; ++i) {
    if (any(random) < 0.001) thief.cut();
    const Vector3d force = thief.hold();
    Vector3d way = on_circle(kPeriod * (i + 1)) - thief.place();
    if (falls > 0) way = 0.5 * kPeriod * (g[15] > 0.5 ? thief.at_handle() : force);
    if (falls < -0.3 * (1.0 - g[14])) falls = 0.1 * any(random);
    falls -= kPeriod;
    if (way.norm() > 0.003) way *= 0.003 / way.norm();
    if (any(random) < 0.002 * g[3]) {
      thief.move_unread(force, way);
      thief.move(Vector3d::Zero(), Vector3d::Zero());
    } else {
      thief.move(force, way);
    }
  }
  return thief.loot();
}

// A climb of 250 tries by what is taken, and by what is taken beyond the stated bound.
TEST(RegionSource, AdversaryWithMotionGetsNoMore) {
  std::mt19937 random(20261128);
  std::uniform_real_distribution<double> any(0.0, 1.0);
  std::normal_distribution<double> normal;
  Genes best;
  double score = 1e9, most_taken = 0.0, worst = 0.0;
  for (int i = 0; i < 250; ++i) {
    Genes next = best;
    for (double& value : next.value) {
      if (i < 60) value = any(random);
      if (i >= 60 && any(random) < 0.3) value = std::clamp(value + 0.2 * normal(random), 0.0, 1.0);
    }
    const Loot loot = played(next, static_cast<std::uint32_t>(i));
    const double beyond = std::min(loot.beyond, -std::max(0.0, loot.spent));
    EXPECT_GE(beyond, -kRoundOff) << "try " << i;
    EXPECT_LE(loot.owed, 0.05 + kRoundOff) << "try " << i;
    most_taken = std::max(most_taken, -loot.least);
    worst = std::min(worst, beyond);
    if (loot.least + 1e6 * beyond >= score) continue;
    score = loot.least + 1e6 * beyond;
    best = next;
  }
  std::printf("250 tries took at most %.1f mJ, beyond the bound %.2g J\n", 1e3 * most_taken,
              -worst);
  EXPECT_GT(most_taken, 0.05) << "the adversary is one";
}

// The loan is no more than what the regions can store where the device can be.
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

// A servo whose force is switched off and on, on a device that lags and reads in steps.
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

// A liar presses a resting hand and says to have given whatever it takes.
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
}  // namespace reckon::haptics
