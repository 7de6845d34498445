// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The gate's promise: port work + device damping + received - given >= 0 whatever arrives.
#include "reckon/haptics/passivity/force_gate.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>
#include <random>

#include "reckon/tests/support/allocation_guard.hpp"
#include "reckon/tests/support/reference_data.hpp"

namespace reckon::haptics {
namespace {

using Eigen::Vector3d;
using Kind = pdu::ForceModelKind;

constexpr double kT = 1e-3;
constexpr double kPassive = -1e-9;  // [J], rounding of sums of some joules

double cap_of(double b) { return 0.95 * 2 * b / kT; }

// What a device of damping b would book: exact work of the held force, least damping loss.
struct Port {
  double work = 0, damping = 0, received = 0, given = 0, least = 0;
  void move(const Vector3d& force, const Vector3d& dx, double b) {
    work -= force.dot(dx);
    damping += b * dx.squaredNorm() / kT;
  }
  // What was absorbed must cover what is stored and what may still be spent, not only be >= 0.
  void check(const ForceGate& gate) {
    const double absorbed = work + damping + received - given;
    least = std::min(least, absorbed);
    surplus = std::min(surplus, absorbed - gate.stored() - gate.ledger());
    purse = std::min(purse, gate.ledger());
  }
  double surplus = 0, purse = 0;
};

ContactParameters plane(double k, double height, double slope_limit) {
  ContactParameters theta;
  theta.kind = Kind::plane;
  theta.normal = -Vector3d::UnitX();
  theta.point = Vector3d(height, 0, 0);
  theta.k1 = k;
  theta.gain = 1;
  theta.slope_limit = slope_limit;
  return theta;
}

TEST(BoundedSpring, EnergyIsTheIntegralOfForceInEveryRange) {
  struct Case {
    double k1, k3, slope, limit;
  };
  for (const Case& c :
       {Case{500, 0, 1900, 1e9}, Case{500, 1e8, 1900, 1e9}, Case{500, 1e8, 1900, 1.5},
        Case{3000, 1e8, 1900, 5}, Case{0, 1e9, 900, 3}, Case{500, 1e8, 1900, 8}}) {
    double energy = 0, worst = 0, steepest = 0;
    const double h = 1e-6;
    for (double d = 0; d < 0.01; d += h) {
      const double f0 = bounded_spring(c.k1, c.k3, c.slope, c.limit, d).force;
      const SpringLoad load = bounded_spring(c.k1, c.k3, c.slope, c.limit, d + h);
      energy += 0.5 * h * (f0 + load.force);
      worst = std::max(worst, std::abs(energy - load.energy));
      steepest = std::max(steepest, (load.force - f0) / h);
      EXPECT_GE(load.force, f0 - 1e-12);
      EXPECT_LE(load.force, c.limit);
    }
    EXPECT_LE(steepest, c.slope * (1 + 1e-6));
    EXPECT_LE(worst, 1e-9) << c.k1 << ' ' << c.k3;
  }
}

TEST(BoundedSpring, EqualsTheRecordAsReceivedBelowItsLimits) {
  for (double d = -0.001; d < 0.003; d += 1e-4) {
    const SpringLoad load = bounded_spring(500, 2e7, 1900, 10, d);
    EXPECT_DOUBLE_EQ(load.force, deadreckon::normal_force(500, 2e7, d));
    EXPECT_DOUBLE_EQ(load.energy, deadreckon::stored_energy(500, 2e7, d));
  }
}

TEST(ContactPotential, GeometryAgreesWithThePredictorsForEveryKind) {
  std::mt19937 rng(7);
  std::uniform_real_distribution<double> u(-1, 1);
  const auto v = [&] { return Vector3d(u(rng), u(rng), u(rng)); };
  for (const Kind kind : {Kind::plane, Kind::sphere, Kind::field, Kind::spring_damper_region}) {
    for (int i = 0; i < 200; ++i) {
      deadreckon::ForceModel model;
      model.kind = kind;
      model.radius = 0.5 + 0.4 * u(rng);
      model.point = v();
      model.normal = v().normalized();
      deadreckon::Pose pose;
      pose.position = v();
      pose.orientation = Eigen::Quaterniond(1, u(rng), u(rng), u(rng)).normalized();
      const Vector3d probe = v();
      const auto expected = deadreckon::contact(model, pose, probe, 0.1);
      const auto got = geometry(parameters(model, pose, 0.1), probe);
      EXPECT_NEAR(got.depth, expected.depth, 1e-14);
      EXPECT_LE((got.normal - expected.normal).norm(), 1e-14);
    }
  }
}

// S(x + dx) <= S(x) - f.dx + slope/2 |dx|^2: the inequality that the proof rests on.
TEST(ContactPotential, CurvatureFromAboveIsBoundedForEveryKind) {
  std::mt19937 rng(11);
  std::uniform_real_distribution<double> u(-1, 1);
  const auto v = [&] { return Vector3d(u(rng), u(rng), u(rng)); };
  for (const Kind kind : {Kind::plane, Kind::sphere, Kind::field, Kind::spring_damper_region}) {
    for (int i = 0; i < 2000; ++i) {
      ContactParameters theta;
      theta.kind = kind;
      theta.normal = v().normalized();
      theta.reach = 0.02;
      theta.patch = 0.02;
      theta.k1 = 500 * (1 + u(rng));
      theta.k3 = 1e7 * (1 + u(rng));
      theta.gain = 1;
      theta.slope_limit = 900;
      theta.force_limit = 4;
      const Vector3d x = 0.03 * v(), dx = 0.01 * v();
      const auto here = geometry(theta, x), there = geometry(theta, x + dx);
      const SpringLoad a = normal_load(theta, here.depth), b = normal_load(theta, there.depth);
      const double bound = a.energy - a.force * here.normal.dot(dx) + 450 * dx.squaredNorm();
      EXPECT_LE(b.energy, bound + 1e-15);
    }
  }
}

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

TEST(ForceGate, StaysPassiveOnEveryUpdateAttackThatDefeatsRawUpdates) {
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

    Port port;
    double peak = 0;
    ForceGate gate;
    gate.reset({a.position(0), 0, 0});
    for (int i = 0; i < a.steps; ++i) {
      const ContactParameters goal = theta(i, cap_of(a.b));
      ContactParameters next = goal;
      if (i > 0) next = between(gate.parameters(), goal, kT / 0.1);
      gate.move(next);
      const Vector3d force = gate.render(0, a.b, kT);
      peak = std::max(peak, force.norm());
      const Vector3d x(a.position(i + 1), 0, 0);
      port.move(force, x - Vector3d(a.position(i), 0, 0), a.b);
      gate.settle(x, a.b, kT);
      port.check(gate);
    }
    EXPECT_GE(port.least, kPassive) << id;
    EXPECT_GE(port.surplus, kPassive) << id;
    EXPECT_LE(peak, 1.05 * raw_peak) << id;
  }
}

TEST(ForceGate, DoesNotTouchABenignSceneBelowTheCap) {
  ForceGate gate;
  gate.reset(Vector3d::Zero());
  double worst = 0;
  for (int i = 0; i < 5000; ++i) {
    const Vector3d x(0.004 * std::sin(0.01 * i), 0.002 * std::cos(0.007 * i), 0);
    gate.settle(x, 1.0, kT);
    gate.move(plane(800, 0.001, 1900));
    const double raw = 800 * std::max(0.0, x.x() - 0.001);
    worst = std::max(worst, (gate.render(0, 1.0, kT) - Vector3d(-raw, 0, 0)).norm());
  }
  std::printf("gate error on a linear wall: %.2g N\n", worst);
  EXPECT_LE(worst, 1e-12);
}

TEST(ForceGate, NeverPullsAndNeverDampsBeyondItsLedger) {
  ForceGate gate;
  gate.reset(Vector3d(0.002, 0, 0));
  gate.move(plane(500, 0.0, 1000));
  EXPECT_EQ(gate.stored(), 0.0);  // an empty ledger pays for nothing
  EXPECT_EQ(gate.render(100.0, 1.0, kT).norm(), 0.0);
  for (int i = 1; i < 200; ++i) gate.settle(Vector3d(0.002 + 1e-4 * (i % 2), 0, 0), 1.0, kT);
  gate.move(plane(500, 0.0, 1000));
  EXPECT_LE(gate.render(-100.0, 1.0, kT).dot(Vector3d::UnitX()), 0.0);
}

TEST(ForceGate, LeavesParametersAloneThatAreNotNumbers) {
  ForceGate gate;
  gate.reset(Vector3d::Zero());
  gate.move(plane(500, 0.01, 1900));
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), -1.0}) {
    ContactParameters theta = plane(500, 0.01, 1900);
    theta.k1 = bad;
    EXPECT_EQ(gate.move(theta), 0.0);
    EXPECT_EQ(gate.shortfall(theta), 0.0);
    EXPECT_EQ(gate.parameters().k1, 500.0);
  }
}

TEST(ForceGate, FrictionSticksThenSlidesAtTheKineticCoefficient) {
  ContactParameters theta = plane(500, 0.0, 1900);
  theta.static_friction = 0.6;
  theta.kinetic_friction = 0.3;
  ForceGate gate;
  gate.reset(Vector3d(-0.001, 0, 0));
  gate.move(theta);
  Vector3d x(-0.001, 0, 0);
  for (; x.x() < 0.004; x.x() += 1e-5) gate.settle(x, 1.0, kT);
  double most = 0, last = 0;
  for (int i = 0; i < 1000; ++i) {
    x.y() += 1e-5;
    gate.settle(x, 1.0, kT);
    gate.move(theta);
    const Vector3d f = gate.render(0, 1.0, kT);
    last = -f.y() / -f.x();
    most = std::max(most, last);
  }
  EXPECT_NEAR(most, 0.6, 0.01);
  EXPECT_NEAR(last, 0.3, 1e-9);
  EXPECT_TRUE(gate.slipping());
}

// A random walk of a hand against a random history of surfaces of every kind.
class GateFuzz {
 public:
  explicit GateFuzz(unsigned seed) : rng_(seed), b_(0.2 + 2 * unit()) { gate_.reset(x_); }

  void run(int steps) {
    velocity_ = 0.3 * direction();
    for (int i = 0; i < steps; ++i) step();
  }

  Port port;
  double peak = 0;
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

  void update() {
    if (unit() < 0.02) older_ = goal_;
    if (unit() < 0.02) goal_ = surface();
    if (unit() < 0.005) goal_.point += direction();  // jumps 1 m
    if (unit() < 0.005) std::swap(goal_, older_);    // comes out of order
    goal_.point += 2e-4 * direction();
    ContactParameters next = goal_;
    const bool same = goal_.kind == gate_.parameters().kind;
    if (same && unit() < 0.9) next = between(gate_.parameters(), goal_, 0.05);
    if (unit() < 0.02) next = poisoned(next);
    gate_.move(next);
    if (unit() < 0.01) port.received += gate_.credit(0.03 * unit());
    if (unit() < 0.01) port.given += gate_.give(0.03 * unit());
  }

  void step() {
    update();
    Vector3d force = gate_.render(40 * (unit() - 0.5), b_, kT);
    if (unit() < 0.01) {
      const double keep = unit();
      gate_.attenuate(keep);
      force *= keep;
    }
    finite = finite && force.allFinite();
    peak = std::max(peak, force.norm());
    velocity_ += 0.02 * direction() - 0.5 * x_ * kT * 400;
    if (unit() < 0.01) velocity_ = 0.4 * unit() * direction();
    const Vector3d dx = velocity_ * kT;
    port.move(force, dx, b_);
    x_ += dx;
    gate_.settle(x_, b_, kT);
    port.check(gate_);
  }

  std::mt19937 rng_;
  double b_;
  ForceGate gate_;
  ContactParameters goal_, older_;
  Vector3d x_ = Vector3d::Zero(), velocity_ = Vector3d::Zero();
};

TEST(ForceGate, StaysPassiveInThreeDimensionsUnderRandomHostileUpdates) {
  double least = 0, surplus = 0, peak = 0;
  for (unsigned seed = 1; seed <= 200; ++seed) {
    GateFuzz fuzz(seed);
    fuzz.run(5000);
    ASSERT_TRUE(fuzz.finite) << "seed " << seed;
    ASSERT_GE(fuzz.port.least, kPassive) << "seed " << seed;
    ASSERT_GE(fuzz.port.surplus, kPassive) << "seed " << seed;
    ASSERT_GE(fuzz.port.purse, 0.0) << "seed " << seed;
    surplus = std::min(surplus, fuzz.port.surplus);
    least = std::min(least, fuzz.port.least);
    peak = std::max(peak, fuzz.peak);
  }
  std::printf("200 seeds x 5000 steps: least energy %.2g J, least surplus %.2g J, peak %.1f N\n",
              least, surplus, peak);
}

TEST(ForceGate, AllocatesNothing) {
  GateFuzz fuzz(3);
  const test::AllocationGuard guard;
  fuzz.run(1000);
  EXPECT_EQ(guard.count(), 0u);
}

}  // namespace
}  // namespace reckon::haptics
