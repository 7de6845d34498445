// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The port's promise: work + device damping + received - given >= 0 whatever the contacts show.
#include "reckon/haptics/passivity/energy_port.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <array>
#include <cmath>
#include <fstream>
#include <initializer_list>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>
#include <random>

#include "reckon/haptics/passivity/contact_spring.hpp"
#include "reckon/tests/haptics/support/plane_surface.hpp"
#include "reckon/tests/support/allocation_guard.hpp"
#include "reckon/tests/support/reference_data.hpp"

namespace reckon::haptics {
namespace {

using Eigen::Vector3d;
using test::plane;
using Kind = pdu::ForceModelKind;

constexpr double kT = 1e-3;
constexpr double kPassive = -1e-9;  // [J], rounding of sums of some joules

double cap_of(double b) { return 0.95 * b / kT; }

// What a port of damping b has booked in truth: exact work of the held force, least damping loss.
struct Meter {
  double absorbed = 0, least = 0, surplus = 0;
  void move(const Vector3d& force, const Vector3d& dx, double b) {
    absorbed += b * dx.squaredNorm() / kT - force.dot(dx);
  }
  // What was absorbed must cover what may still be spent, not only be >= 0.
  void check(const EnergyPort& port) {
    least = std::min(least, absorbed);
    surplus = std::min(surplus, absorbed - port.level());
  }
};

// One contact and the port that pays for it.
struct Touch {
  explicit Touch(double b, const Vector3d& at) : port(b), damping(b), x(at) { spring.reset(at); }
  Vector3d hold(double damper = 0) {
    PortLoad load;
    load.springs = spring.force();
    load.stored = spring.stored();
    load.springs_slope = spring.greatest_slope();
    const Vector3d& n = spring.geometry().normal;
    if (spring.stored() > 0) load.extra = std::max(damper, -spring.normal_force()) * n;
    return force = port.hold(load, kT).force;
  }
  void go(const Vector3d& to) {
    const Vector3d dx = to - x;
    meter.move(force, dx, damping);
    port.settle(dx, kT);
    spring.settle(to, 0.001);
    x = to;
    meter.check(port);
  }
  EnergyPort port;
  ContactSpring spring;
  Meter meter;
  double damping;
  Vector3d x, force = Vector3d::Zero();
};

struct Attack {
  double b, f, amplitude, mean, phase, switch_hz, switch_phase, k1, k2, x1, x2;
  int steps;
  double position(int i) const {
    return mean + amplitude * std::sin(2 * std::numbers::pi * f * i * kT + phase);
  }
  bool first(int i) const {
    const double turns = i * kT * switch_hz + switch_phase;
    return turns - std::floor(turns) < 0.5;
  }
};

Attack read(const nlohmann::json& v) {
  return {v["b"],       v["f_hz"],      v["x_amp"],        v["x_mean"],
          v["x_phase"], v["switch_hz"], v["switch_phase"], v["K1"],
          v["K2"],      v["x01"],       v["x02"],          v["steps"]};
}

TEST(EnergyPort, StaysPassiveOnEveryUpdateAttackThatDefeatsRawUpdates) {
  RECKON_NEED_DATA("oracles/update_attacks.json");
  std::ifstream file(test::reference_data() / "oracles/update_attacks.json");
  const nlohmann::json oracle = nlohmann::json::parse(file);
  for (const auto& v : oracle["vectors"]) {
    const Attack a = read(v);
    const std::string id = v["id"];
    ASSERT_EQ(v["T"].get<double>(), kT);
    const auto theta = [&](int i, double slope) {
      return plane(a.first(i) ? a.k1 : a.k2, a.first(i) ? a.x1 : a.x2, slope);
    };

    double work = 0, damping = 0, least_work = 0, least = 0, raw_peak = 0;
    for (int i = 0; i < a.steps; ++i) {
      const ContactParameters raw = theta(i, 1e9);
      const double force = normal_load(raw, geometry(raw, {a.position(i), 0, 0}).depth).force;
      const double dx = a.position(i + 1) - a.position(i);
      work += force * dx;
      damping += a.b * dx * dx / kT;
      least_work = std::min(least_work, work);
      least = std::min(least, work + damping);
      raw_peak = std::max(raw_peak, force);
    }
    EXPECT_NEAR(work, v["raw"]["port_energy_end"].get<double>(), 1e-9) << id;
    EXPECT_NEAR(least_work, v["raw"]["port_energy_min"].get<double>(), 1e-9) << id;
    EXPECT_NEAR(least, v["raw"]["min_with_device_damping"].get<double>(), 1e-9) << id;
    EXPECT_NEAR(raw_peak, v["raw"]["force_peak"].get<double>(), 1e-9) << id;

    Touch touch(a.b, {a.position(0), 0, 0});
    double peak = 0;
    for (int i = 0; i < a.steps; ++i) {
      touch.spring.move(theta(i, cap_of(a.b)));  // at once: no surface waits for energy
      peak = std::max(peak, touch.hold().norm());
      touch.go({a.position(i + 1), 0, 0});
    }
    EXPECT_GE(touch.meter.least, kPassive) << id;
    EXPECT_GE(touch.meter.surplus, kPassive) << id;
    EXPECT_LE(peak, 1.05 * raw_peak) << id;
  }
}

TEST(EnergyPort, DoesNotTouchABenignSceneBelowTheCap) {
  Touch touch(1.0, Vector3d::Zero());
  double worst = 0;
  for (int i = 0; i < 5000; ++i) {
    touch.go(Vector3d(0.004 * std::sin(0.01 * i), 0.002 * std::cos(0.007 * i), 0));
    touch.spring.move(plane(800, 0.001, cap_of(1.0)));
    const double raw = 800 * std::max(0.0, touch.x.x() - 0.001);
    worst = std::max(worst, (touch.hold() - Vector3d(-raw, 0, 0)).norm());
  }
  std::printf("error on a linear wall: %.2g N\n", worst);
  EXPECT_LE(worst, 1e-12);
}

// A quarter of S is enough for the whole force of K = b/(2 T): the rest is held, not booked.
TEST(EnergyPort, ShowsTheWholeForceOfASurfaceThatCameWithAQuarterOfItsEnergy) {
  Touch touch(1.0, Vector3d::Zero());
  const double stored = 0.5 * 500 * 0.004 * 0.004;
  touch.port.credit(0.2501 * stored);
  for (int i = 0; i < 2; ++i) touch.spring.move(plane(500, -0.004, cap_of(1.0)));
  EXPECT_NEAR(touch.hold().norm(), 2.0, 1e-9);
  Touch poorer(1.0, Vector3d::Zero());
  poorer.port.credit(0.0625 * stored);
  for (int i = 0; i < 2; ++i) poorer.spring.move(plane(500, -0.004, cap_of(1.0)));
  EXPECT_NEAR(poorer.hold().norm(), 1.0, 0.01) << "half the force for a quarter of the energy";
}

TEST(EnergyPort, ForcesThatCancelCostNothing) {
  EnergyPort port(1.0);
  PortLoad load;
  load.springs = Vector3d(1e-14, 0, 0);  // 5 N from the left, 5 N from the right
  load.stored = 0.05;
  load.springs_slope = 1000;
  EXPECT_EQ(port.hold(load, kT).springs, 0.0) << "nothing is there at all";
  port.credit(1e-6);
  const PortHold held = port.hold(load, kT);
  EXPECT_EQ(held.springs, 1.0);
}

TEST(EnergyPort, NeverDampsBeyondItsEnergy) {
  Touch touch(1.0, Vector3d(0.002, 0, 0));
  touch.spring.move(plane(500, 0.0, cap_of(1.0)));
  EXPECT_EQ(touch.hold(100.0).norm(), 0.0) << "an empty ledger pays for nothing";
  for (int i = 1; i < 200; ++i) touch.go(Vector3d(0.002 + 1e-4 * (i % 2), 0, 0));
  EXPECT_LE(touch.hold(-100.0).dot(Vector3d::UnitX()), 1e-12) << "and the sum never pulls";
  EXPECT_GE(touch.meter.surplus, kPassive);
}

// A random walk of a hand against a random history of surfaces of every kind.
class PortFuzz {
 public:
  explicit PortFuzz(unsigned seed)
      : rng_(seed), b_(0.2 + 2 * unit()), count_(1 + seed % 4), port_(b_) {
    for (ContactSpring& spring : springs_) spring.reset(x_);
  }

  void run(int steps) {
    velocity_ = 0.3 * direction();
    for (int i = 0; i < steps; ++i) step();
  }

  Meter meter;
  double peak = 0, purse = 0;
  bool finite = true;

 private:
  double unit() { return std::uniform_real_distribution<double>(0, 1)(rng_); }
  Vector3d direction() { return Vector3d(unit() - 0.5, unit() - 0.5, unit() - 0.5).normalized(); }

  ContactParameters surface() {
    static constexpr Kind kinds[] = {
        Kind::sphere, Kind::sphere, Kind::plane, Kind::field, Kind::spring_damper_region,
        Kind::none};
    ContactParameters theta;
    theta.kind = unit() < 0.9 ? goal_.kind : kinds[static_cast<int>(6 * unit())];
    theta.point = x_ + 0.02 * direction();
    theta.normal = direction();
    theta.reach = 0.04 * unit();
    theta.patch = 0.03 * unit();
    theta.k1 = 3000 * unit();
    theta.k3 = unit() < 0.5 ? 0 : 1e8 * unit();
    theta.static_friction = unit();
    theta.kinetic_friction = theta.static_friction * unit();
    theta.gain = unit() < 0.8 ? 1 : unit();
    theta.slope_limit = cap_of(b_) * unit();
    theta.force_limit = unit() < 0.8 ? 10 : 3 * unit();
    return theta;
  }

  ContactParameters poisoned(ContactParameters theta) {
    const double bad[] = {std::nan(""), std::numeric_limits<double>::infinity(), -300.0, 1e300};
    const double value = bad[static_cast<int>(4 * unit())];
    double* const fields[] = {&theta.k1,        &theta.k3,         &theta.reach,
                              &theta.point.y(), &theta.normal.z(), &theta.static_friction};
    *fields[static_cast<int>(6 * unit())] = value;
    return theta;
  }

  void update(ContactSpring& spring) {
    if (unit() < 0.02) older_ = goal_;
    if (unit() < 0.02) goal_ = surface();
    if (unit() < 0.005) goal_.point += direction();  // jumps 1 m
    if (unit() < 0.005) std::swap(goal_, older_);    // comes out of order
    goal_.point += 2e-4 * direction();
    spring.move(unit() < 0.02 ? poisoned(goal_) : goal_);
  }

  PortLoad load() {
    PortLoad load;
    Eigen::Matrix3d slopes = Eigen::Matrix3d::Zero();
    for (std::size_t i = 0; i < count_; ++i) {
      load.springs += springs_[i].force();
      load.stored += springs_[i].stored();
      slopes += springs_[i].slope();
    }
    load.springs_slope = slopes.eigenvalues().real().maxCoeff();
    load.extra = unit() < 0.5 ? Vector3d(0, 0, 0) : Vector3d(4 * unit() * direction());
    return load;
  }

  void step() {
    for (std::size_t i = 0; i < count_; ++i) update(springs_[i]);
    if (unit() < 0.01) meter.absorbed += port_.credit(0.03 * unit());
    if (unit() < 0.01) meter.absorbed -= port_.give(0.03 * unit());
    Vector3d force = port_.hold(load(), kT).force;
    if (unit() < 0.01) {
      const double keep = unit();
      port_.attenuate(keep);
      force *= keep;
    }
    finite = finite && force.allFinite();
    peak = std::max(peak, force.norm());
    velocity_ += 0.02 * direction() - 0.5 * x_ * kT * 400;
    if (unit() < 0.01) velocity_ = 0.4 * unit() * direction();
    Vector3d dx = velocity_ * kT;
    // Now and then the motion that takes the most out of a force held still.
    if (unit() < 0.2) dx = force / (2 * b_ / kT);
    meter.move(force, dx, b_);
    x_ += dx;
    port_.settle(dx, kT);
    for (std::size_t i = 0; i < count_; ++i) springs_[i].settle(x_, 0.001);
    meter.check(port_);
    purse = std::min(purse, port_.level());
  }

  std::mt19937 rng_;
  double b_;
  std::size_t count_;
  EnergyPort port_;
  std::array<ContactSpring, 4> springs_;
  ContactParameters goal_, older_;
  Vector3d x_ = Vector3d::Zero(), velocity_ = Vector3d::Zero();
};

TEST(EnergyPort, StaysPassiveInThreeDimensionsUnderRandomHostileUpdates) {
  double least = 0, surplus = 0, peak = 0;
  for (unsigned seed = 1; seed <= 200; ++seed) {
    PortFuzz fuzz(seed);
    fuzz.run(5000);
    ASSERT_TRUE(fuzz.finite) << "seed " << seed;
    ASSERT_GE(fuzz.meter.least, kPassive) << "seed " << seed;
    ASSERT_GE(fuzz.meter.surplus, kPassive) << "seed " << seed;
    ASSERT_GE(fuzz.purse, -1e-12) << "seed " << seed;
    surplus = std::min(surplus, fuzz.meter.surplus);
    least = std::min(least, fuzz.meter.least);
    peak = std::max(peak, fuzz.peak);
  }
  std::printf("200 seeds x 5000 steps: least energy %.2g J, least surplus %.2g J, peak %.1f N\n",
              least, surplus, peak);
}

TEST(EnergyPort, WhatIsOwedStaysOwedUntilItIsPaid) {
  EnergyPort port(1.0);
  port.borrow(0.004);
  EXPECT_EQ(port.level(), 0.004);
  port.pay_back(0.001);
  EXPECT_NEAR(port.owed(), 0.003, 1e-15);
  port.clear();
  EXPECT_EQ(port.level(), 0.0);
  EXPECT_NEAR(port.owed(), 0.003, 1e-15) << "what is forgotten is not forgiven";
  port.credit(0.01);
  port.pay_back(0.01);
  EXPECT_EQ(port.owed(), 0.0);
  EXPECT_NEAR(port.level(), 0.007, 1e-15);
}

// A hand of 1 N s/m that comes 2 mm in a millisecond: 4 mJ. What is left of it is unknown.
TEST(EnergyPort, WhatIsDiscardedWasNotAbsorbed) {
  EnergyPort port(1.0);
  static_cast<void>(port.hold({}, kT));
  port.settle(Vector3d(0.002, 0, 0), kT);
  EXPECT_NEAR(port.absorbed(), 0.004, 1e-12);
  port.clear();
  EXPECT_NEAR(port.absorbed(), 0.0, 1e-12);
}

// A surface that was fed for long and goes away: 50 mJ were in its spring.
EnergyPort fed_by_others() {
  EnergyPort port(2.0);
  port.limit_received_power(0.2);
  PortLoad pressed;
  pressed.stored = 0.05;
  for (int i = 0; i < 1000; ++i) {
    port.settle(Vector3d::Zero(), kT);
    port.wait(kT);
    port.credit(1.0, 1.0);
    port.hold(pressed, kT);
  }
  EXPECT_NEAR(port.level(), 0.05 + EnergyPort::kReceivedAtOnce, 1e-12);
  port.hold({}, kT);
  return port;
}

TEST(EnergyPort, WhatOthersGaveIsKeptNoMoreThanTheyMayGiveAtOnce) {
  EnergyPort port = fed_by_others();
  EXPECT_NEAR(port.level(), EnergyPort::kReceivedAtOnce, 1e-12);
  EXPECT_EQ(port.receivable(), 0.0);

  // It goes into the hand, and as much may come again.
  PortLoad push;
  push.springs = Vector3d(1.0, 0.0, 0.0);
  for (int i = 0; i < 50; ++i) {
    port.hold(push, kT);
    port.settle(Vector3d(1e-4, 0.0, 0.0), kT);
    port.wait(kT);
    EXPECT_LE(port.level() + port.receivable(), EnergyPort::kReceivedAtOnce + 1e-12) << i;
  }
  EXPECT_NEAR(port.receivable(), 0.004, 1e-9) << "5 mJ of work, of which the damping took 1";
}

TEST(EnergyPort, WhatTheHandTakesBackFromOthersIsNoWorkOfItsOwn) {
  EnergyPort port = fed_by_others();
  const auto swing = [&](double force, double dx, int steps) {
    PortLoad load;
    load.stored = 0.05;
    load.springs = Vector3d(force, 0.0, 0.0);
    for (int i = 0; i < steps; ++i) {
      port.hold(load, kT);
      port.settle(Vector3d(dx, 0.0, 0.0), kT);
    }
  };
  swing(1.0, 1e-4, 50);
  swing(1.0, -1e-4, 50);
  port.hold({}, kT);
  EXPECT_NEAR(port.level(), EnergyPort::kReceivedAtOnce + 0.002, 1e-9)
      << "pushed away, and back; the damping took 2 mJ of the hand's";

  swing(1.0, -2e-4, 100);
  port.hold({}, kT);
  EXPECT_GT(port.level(), 2 * EnergyPort::kReceivedAtOnce) << "pushed of its own";
}

// A handle of 1 N s/m that goes 1 mm in 2 ms loses half a millijoule, in however many samples that
// is told.
TEST(EnergyPort, DampingTakesWhatTheDevicesOwnTimeSays) {
  const auto absorbed = [](double resolution, std::initializer_list<std::array<double, 2>> ways) {
    EnergyPort port(1.0, 0, resolution);
    for (const auto& [way, took] : ways) port.settle(Vector3d(way, 0, 0), kT, took);
    return port.absorbed();
  };
  EXPECT_NEAR(absorbed(0, {{1e-3, 2e-3}}), 0.5e-3, 1e-15);
  EXPECT_NEAR(absorbed(0, {{0, 0}, {1e-3, 2e-3}}), 0.5e-3, 1e-15);
  EXPECT_NEAR(absorbed(0, {{0.5e-3, 1e-3}, {0, 0}, {0.5e-3, 1e-3}}), 0.5e-3, 1e-15);
  EXPECT_LE(absorbed(1e-6, {{0, 0}, {1e-3, 2e-3}}), 0.5e-3);
  EXPECT_GT(absorbed(1e-6, {{0, 0}, {1e-3, 2e-3}}), 0.49e-3);
}

TEST(EnergyPort, AllocatesNothing) {
  PortFuzz fuzz(3);
  const test::AllocationGuard guard;
  fuzz.run(1000);
  EXPECT_EQ(guard.count(), 0u);
}

TEST(EnergyPort, AForceIsPaidForWithTheLeastDampingOfThosePosesThatItWasChosenIn) {
  constexpr int kDelay = 2;
  EnergyPort port(2.0, kDelay);
  port.pose(0.5, 0.0);
  EXPECT_EQ(port.damping(), 0.5) << "at once where it is less";
  for (int i = 0; i < kDelay + 1; ++i) {
    port.pose(2.0, 0.0);
    EXPECT_EQ(port.damping(), 0.5) << "a force of then may be under way, " << i;
  }
  port.pose(2.0, 0.0);
  EXPECT_EQ(port.damping(), 2.0);
}

TEST(EnergyPort, WhatDampingTakesOfAWayIsThatOfItsWorsePose) {
  EnergyPort port(2.0);
  const Vector3d dx(1e-3, 0, 0);
  const auto loss = [&](double damping) {
    const double before = port.absorbed();
    port.pose(damping, 0.0);
    port.settle(dx, kT);
    return port.absorbed() - before;
  };
  EXPECT_NEAR(loss(2.0), 2e-3, 1e-15);
  EXPECT_NEAR(loss(0.5), 0.5e-3, 1e-15) << "there";
  EXPECT_NEAR(loss(2.0), 0.5e-3, 1e-15) << "and from there";
  EXPECT_NEAR(loss(2.0), 2e-3, 1e-15);
}

TEST(EnergyPort, WhatDampingTakesOfAWayWithoutReadingsIsThatOfItsWorseEnd) {
  EnergyPort port(2.0);
  port.pose(0.5, 0.0);
  port.settle(Vector3d::Zero(), kT);
  port.miss(kT);
  port.pose(2.0, 0.0);
  port.settle(Vector3d(1e-3, 0, 0), kT);
  EXPECT_NEAR(port.absorbed(), 0.5 * 1e-6 / (2 * kT), 1e-15);
}

TEST(EnergyPort, AnErrorOfTheEncodersIsThatOfThePoseInWhichTheForceChanged) {
  EnergyPort port(1.0, 0, 1e-4);
  PortLoad load;
  load.extra = Vector3d(1, 0, 0);
  static_cast<void>(port.credit(1.0));
  static_cast<void>(port.hold(load, kT));
  port.pose(1.0, 3e-4);
  port.settle(Vector3d::Zero(), kT);
  // Half the diagonal of a step, as the force came and as it may go.
  EXPECT_NEAR(port.encoder_allowance(), 2 * 0.5 * std::sqrt(3) * 3e-4, 1e-12);
}

TEST(EnergyPort, OfAForceThatWasHeldInPartTheHandPutInThatPartAndGotAllOfIt) {
  for (const double way : {-1e-3, 1e-3}) {
    EnergyPort port(1.0);
    PortLoad load;
    load.walls = Vector3d(2, 0, 0);
    ASSERT_EQ(port.hold(load, kT).force.x(), 2.0);
    const double no_time = 0.0;  // in which damping takes something
    port.settle(Vector3d(way, 0, 0), kT, no_time, 0.25);
    EXPECT_NEAR(port.absorbed(), way < 0 ? 0.25 * 2e-3 : -2e-3, 1e-15);
  }
}

}  // namespace
}  // namespace reckon::haptics
