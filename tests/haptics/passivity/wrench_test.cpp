// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A tool of several probes on a device of six axes: the wrench that one port may hold, against the
// worst motion of a hand within a sample, by the kinematics of rigid bodies.
#include "reckon/haptics/passivity/wrench.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>
#include <vector>

#include "reckon/haptics/passivity/energy_port.hpp"
#include "reckon/tests/support/soak.hpp"

namespace reckon::haptics {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kSample = 0.001;

class Random {
 public:
  explicit Random(unsigned seed) : numbers_(seed) {}
  double any(double from, double to) {
    return std::uniform_real_distribution<double>(from, to)(numbers_);
  }
  /// With a logarithmic distribution.
  double log(double from, double to) { return from * std::pow(to / from, any(0, 1)); }
  Vector3d way() {
    std::normal_distribution<double> normal;
    return Vector3d(normal(numbers_), normal(numbers_), normal(numbers_)).normalized();
  }
  Wrench wrench() {
    Wrench wrench;
    wrench << way(), way();
    return wrench;
  }

 private:
  std::mt19937 numbers_;
};

/// A probe of a tool on a spring: a plane, or a point.
struct Probe {
  Vector3d place = Vector3d::Zero();   // from the handle
  Vector3d anchor = Vector3d::Zero();  // where the spring has no force
  Matrix3d stiffness = Matrix3d::Zero();

  [[nodiscard]] Vector3d force() const { return -stiffness * (place - anchor); }
  /// Stored energy after a motion of the tool, by its rotation, not by a first-order approximation.
  [[nodiscard]] double stored(const Wrench& motion) const {
    const Vector3d turn = motion.tail<3>();
    const double angle = turn.norm();
    Vector3d at = place;
    if (angle > 0) at = Eigen::AngleAxisd(angle, turn / angle) * at;
    const Vector3d way = at + motion.head<3>() - anchor;
    return 0.5 * way.dot(stiffness * way);
  }
};

struct Tool {
  std::vector<Probe> probes;
  Wrench damping, rest;

  explicit Tool(Random& random) {
    const int count = static_cast<int>(random.any(1, 4.999));
    for (int i = 0; i < count; ++i) {
      Probe probe;
      probe.place = random.log(1e-3, 0.1) * random.way();
      const Vector3d normal = random.way();
      const double stiffness = random.log(10, 2000);
      probe.stiffness = random.any(0, 1) < 0.7 ? Matrix3d(stiffness * normal * normal.transpose())
                                               : Matrix3d(stiffness * Matrix3d::Identity());
      probe.anchor = probe.place + random.log(1e-5, 5e-3) * random.way();
      probes.push_back(probe);
    }
    damping << Vector3d::Constant(random.log(0.2, 5)), Vector3d::Constant(random.log(2e-4, 2e-2));
    for (int i = 0; i < 6; ++i) damping[i] *= random.log(0.5, 2);
    rest = random.log(1e-3, 5) * random.wrench();
    rest.tail<3>() *= random.log(1e-3, 0.1);
  }
  /// Sum of all springs.
  struct Pressed {
    Wrench force = Wrench::Zero();
    WrenchCurvature curvature = WrenchCurvature::Zero();
  };
  [[nodiscard]] Pressed pressed() const {
    Pressed sum;
    for (const Probe& probe : probes) {
      sum.force += wrench_of(probe.place, probe.force());
      sum.curvature += curvature_of(probe.place, probe.stiffness, probe.force());
    }
    return sum;
  }
  [[nodiscard]] double stored(const Wrench& motion) const {
    double sum = 0;
    for (const Probe& probe : probes) sum += probe.stored(motion);
    return sum;
  }
};

PortLoadOf<6> load_of(const Tool& tool, const DampedAxes& axes) {
  const auto [springs, curvature] = tool.pressed();
  PortLoadOf<6> load;
  load.springs = axes.scaled_force(springs);
  load.stored = tool.stored(Wrench::Zero());
  load.springs_slope = axes.slope(curvature);
  load.extra = axes.scaled_force(tool.rest);
  return load;
}

TEST(Wrench, TorqueIsTheSumOfLeversTimesForces) {
  Random random(1);
  for (int i = 0; i < 1000; ++i) {
    const Vector3d r1 = 0.1 * random.way(), r2 = 0.1 * random.way();
    const Vector3d f1 = 5 * random.way(), f2 = 5 * random.way();
    const Wrench both = wrench_of(r1, f1) + wrench_of(r2, f2);
    // By components, r x f.
    const auto torque = [](const Vector3d& r, const Vector3d& f) -> Vector3d {
      return {r[1] * f[2] - r[2] * f[1], r[2] * f[0] - r[0] * f[2], r[0] * f[1] - r[1] * f[0]};
    };
    EXPECT_LT((both.tail<3>() - torque(r1, f1) - torque(r2, f2)).norm(), 1e-9);
    EXPECT_LT((both.head<3>() - f1 - f2).norm(), 1e-9);
    // A virtual motion does the same work as the forces at the probes.
    const Wrench motion = 1e-3 * random.wrench();
    const Vector3d turn = motion.tail<3>();
    const double work =
        f1.dot(motion.head<3>() + turn.cross(r1)) + f2.dot(motion.head<3>() + turn.cross(r2));
    EXPECT_NEAR(both.dot(motion), work, 1e-12);
  }
}

TEST(Wrench, CurvatureBoundsTheGainOfAPotential) {
  Random random(2);
  for (int i = 0; i < 20'000; ++i) {
    const Tool tool(random);
    const auto [force, curvature] = tool.pressed();
    Wrench motion = random.wrench();
    motion.head<3>() *= random.log(1e-6, 3e-3);
    motion.tail<3>() *= random.log(1e-5, kMostTurn);
    const double gained = tool.stored(motion) - tool.stored(Wrench::Zero());
    const double bound = -force.dot(motion) + 0.5 * motion.dot(curvature * motion);
    EXPECT_LE(gained, bound + 1e-15 + 1e-12 * tool.stored(motion)) << i;
  }
}

TEST(Wrench, DampedAxesKeepWorkAndLoss) {
  Random random(3);
  for (int i = 0; i < 100; ++i) {
    const Tool tool(random);
    const DampedAxes axes(tool.damping);
    const Wrench force = 3 * random.wrench(), motion = 1e-3 * random.wrench();
    EXPECT_NEAR(axes.scaled_force(force).dot(axes.scaled_motion(motion)), force.dot(motion), 1e-15);
    EXPECT_NEAR(axes.scaled_motion(motion).squaredNorm(), motion.cwiseAbs2().dot(tool.damping),
                1e-15);
    EXPECT_LT((axes.force(axes.scaled_force(force)) - force).norm(), 1e-14);
  }
}

// Any energy, any tool: the wrench held by the port leaves enough for the worst motion, and when it
// cuts, no more than that.
TEST(SixAxes, PortCoversTheWorstMotionOfAnyTool) {
  Random random(4);
  double tightest = 0;
  const int tools = test::tries(40'000, 100'000);
  int cut = 0, whole = 0;
  for (int i = 0; i < tools; ++i) {
    const Tool tool(random);
    const DampedAxes axes(tool.damping);
    const auto [springs, curvature] = tool.pressed();
    const PortLoadOf<6> load = load_of(tool, axes);
    EnergyPortOf<6> port(1.0);
    const double energy = random.log(1e-7, 0.03);
    port.borrow(energy);
    const PortHoldOf<6> held = port.hold(load, kSample);
    ASSERT_TRUE(held.force.allFinite());
    (held.extra < 1 || held.springs < 1 ? cut : whole) += 1;

    // The worst motion of the part that is not booked, and some others.
    const Wrench rest = axes.force(held.force) - held.weight * springs;
    WrenchCurvature pays = WrenchCurvature(tool.damping.asDiagonal()) / kSample;
    pays -= 0.5 * held.weight * curvature;
    const Wrench worst = 0.5 * pays.ldlt().solve(rest);
    const double level = std::max(port.level(), 0.0);
    double margin = level;
    for (int way = 0; way < 4; ++way) {
      Wrench motion = worst;
      if (way > 0) motion = random.any(0, 1.5) * worst + 0.2 * worst.norm() * random.wrench();
      motion *= std::min(1.0, kMostTurn / motion.tail<3>().norm());
      const double left = level - axes.force(held.force).dot(motion) +
                          motion.cwiseAbs2().dot(tool.damping) / kSample -
                          held.weight * tool.stored(motion);
      margin = std::min(margin, left);
    }
    ASSERT_GE(margin, -1e-9) << i << ": energy " << energy << " of " << load.stored;
    if (held.extra < 1 || held.springs < 1) tightest = std::max(tightest, 1.0 - margin / level);
  }
  std::printf("[ six axes ] %d cut, %d whole, tightest %.3f of the bound\n", cut, whole, tightest);
  EXPECT_GT(cut, tools / 10);
  EXPECT_GT(whole, tools / 10);
  EXPECT_GE(tightest, 0.9);
}

// Through the ledger: an adversary takes all it can over many samples, on sliding tools.
TEST(SixAxes, MultiProbeToolGivesNoHandEnergy) {
  for (unsigned seed = 1; seed <= 200; ++seed) {
    Random random(seed);
    Tool tool(random);
    const DampedAxes axes(tool.damping);
    EnergyPortOf<6> port(1.0);
    double books = 0, least = 0;
    for (int i = 0; i < 300; ++i) {
      const PortLoadOf<6> load = load_of(tool, axes);
      const PortHoldOf<6> held = port.hold(load, kSample);
      const Wrench force = axes.force(held.force);
      Wrench motion = 0.5 * kSample * force.cwiseQuotient(tool.damping);
      if (i % 3 == 0) {
        motion = random.log(1e-6, 5e-4) * random.wrench();
        motion.tail<3>() *= 20;
      }
      motion.head<3>() *= std::min(1.0, 1e-3 / motion.head<3>().norm());
      motion.tail<3>() *= std::min(1.0, 0.02 / motion.tail<3>().norm());
      books += -force.dot(motion) + motion.cwiseAbs2().dot(tool.damping) / kSample;
      least = std::min(least, books);
      port.settle(axes.scaled_motion(motion), kSample);
      for (Probe& probe : tool.probes) {
        const double angle = motion.tail<3>().norm();
        Vector3d moved = probe.place;
        if (angle > 0) moved = Eigen::AngleAxisd(angle, motion.tail<3>() / angle) * moved;
        // The handle stays the origin; the tool keeps its length.
        probe.anchor -= motion.head<3>();
        probe.place = moved;
      }
      tool.rest = random.log(1e-3, 5) * random.wrench();
    }
    EXPECT_GE(least, -1e-9) << seed;
  }
}

}  // namespace
}  // namespace reckon::haptics
