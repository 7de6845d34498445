// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The port's guarantee: work + device damping + received - given >= 0 for any contacts.
#include "reckon/haptics/passivity/energy_port.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <array>
#include <cmath>
#include <fstream>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <numbers>

#include "reckon/haptics/passivity/contact_spring.hpp"
#include "reckon/tests/haptics/support/plane_surface.hpp"
#include "reckon/tests/haptics/support/port_meter.hpp"
#include "reckon/tests/support/allocation_guard.hpp"
#include "reckon/tests/support/reference_data.hpp"

namespace reckon::haptics {
namespace {

using Eigen::Vector3d;
using meters::cap_of;
using meters::kPassive;
using meters::kT;
using meters::Meter;
using test::plane;

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

TEST(EnergyPort, StaysPassiveUnderEveryUpdateAttack) {
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

TEST(EnergyPort, LeavesABenignSceneUnchanged) {
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

// A quarter of S is sufficient for the whole force of K = b/(2 T): the rest is held, not booked.
TEST(EnergyPort, QuarterOfTheEnergyGivesTheWholeForce) {
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

TEST(EnergyPort, CancellingForcesCostNothing) {
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

TEST(EnergyPort, DebtRemainsUntilItIsPaid) {
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

// A hand of 1 N s/m that moves 2 mm in a millisecond: 4 mJ. The remainder is unknown.
TEST(EnergyPort, DiscardedEnergyIsNotAbsorbed) {
  EnergyPort port(1.0);
  static_cast<void>(port.hold({}, kT));
  port.settle(Vector3d(0.002, 0, 0), kT);
  EXPECT_NEAR(port.absorbed(), 0.004, 1e-12);
  port.clear();
  EXPECT_NEAR(port.absorbed(), 0.0, 1e-12);
}

// A surface that received energy for a long time and disappears: 50 mJ were in its spring.
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

TEST(EnergyPort, KeepsReceivedEnergyWithinTheBurstLimit) {
  EnergyPort port = fed_by_others();
  EXPECT_NEAR(port.level(), EnergyPort::kReceivedAtOnce, 1e-12);
  EXPECT_EQ(port.receivable(), 0.0);

  // It goes into the hand, and the same amount may be received again.
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

TEST(EnergyPort, ReturnedEnergyIsNoWorkOfTheHand) {
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

// A handle of 1 N s/m that moves 1 mm in 2 ms loses half a millijoule, for any number of samples.
TEST(EnergyPort, DampingUsesTheDevicesOwnTime) {
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

TEST(EnergyPort, ForceIsPaidWithTheLeastRecentDamping) {
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

TEST(EnergyPort, DampingOfAMotionUsesItsWorsePose) {
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

TEST(EnergyPort, DampingWithoutReadingsUsesTheWorseEnd) {
  EnergyPort port(2.0);
  port.pose(0.5, 0.0);
  port.settle(Vector3d::Zero(), kT);
  port.miss(kT);
  port.pose(2.0, 0.0);
  port.settle(Vector3d(1e-3, 0, 0), kT);
  EXPECT_NEAR(port.absorbed(), 0.5 * 1e-6 / (2 * kT), 1e-15);
}

TEST(EnergyPort, EncoderErrorUsesTheForcesPose) {
  EnergyPort port(1.0, 0, 1e-4);
  PortLoad load;
  load.extra = Vector3d(1, 0, 0);
  static_cast<void>(port.credit(1.0));
  static_cast<void>(port.hold(load, kT));
  port.pose(1.0, 3e-4);
  port.settle(Vector3d::Zero(), kT);
  // Half the diagonal of a step, at the start of the force and at its possible end.
  EXPECT_NEAR(port.encoder_allowance(), 2 * 0.5 * std::sqrt(3) * 3e-4, 1e-12);
}

TEST(EnergyPort, PartlyHeldForceIsBookedInPart) {
  for (const double way : {-1e-3, 1e-3}) {
    EnergyPort port(1.0);
    PortLoad load;
    load.walls = Vector3d(2, 0, 0);
    ASSERT_EQ(port.hold(load, kT).force.x(), 2.0);
    const double no_time = 0.0;  // with no time for dissipation
    port.settle(Vector3d(way, 0, 0), kT, no_time, 0.25);
    EXPECT_NEAR(port.absorbed(), way < 0 ? 0.25 * 2e-3 : -2e-3, 1e-15);
  }
}

}  // namespace
}  // namespace reckon::haptics
