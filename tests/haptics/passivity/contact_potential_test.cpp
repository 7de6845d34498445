// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/passivity/contact_potential.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace reckon::haptics {
namespace {

using Eigen::Vector3d;
using Kind = pdu::ForceModelKind;

TEST(BoundedSpring, EnergyIsTheIntegralOfForce) {
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
      EXPECT_NEAR(got.slope, expected.slope, 1e-14);
    }
  }
}

// S(x + dx) <= S(x) - f.dx + slope/2 |dx|^2: the inequality used by the proof.
TEST(ContactPotential, CurvatureFromAboveIsBoundedForEveryKind) {
  std::mt19937 rng(11);
  std::uniform_real_distribution<double> u(-1, 1);
  const auto v = [&] { return Vector3d(u(rng), u(rng), u(rng)); };
  for (const Kind kind : {Kind::plane, Kind::sphere, Kind::field, Kind::spring_damper_region}) {
    for (int i = 0; i < 20000; ++i) {
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
      const double bound =
          a.energy - here.slope * a.force * here.normal.dot(dx) + 450 * dx.squaredNorm();
      EXPECT_LE(b.energy, bound + 1e-15);
    }
  }
}

}  // namespace
}  // namespace reckon::haptics
