// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/deadreckon/force/force_model.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "reckon/deadreckon/motion/rotation.hpp"
#include "reckon/tests/deadreckon/support/oracle.hpp"

namespace reckon::deadreckon {
namespace {

using Eigen::Vector3d;
using Kind = pdu::ForceModelKind;
using test::Random;

constexpr std::array<Kind, 4> kTouchable = {Kind::plane, Kind::sphere, Kind::field,
                                            Kind::spring_damper_region};

ForceModel model_of(Kind kind) {
  ForceModel m;
  m.kind = kind;
  m.k1 = 400;
  m.k3 = 3e6;
  m.radius = 0.03;
  m.point = {0.01, -0.02, 0.005};
  m.normal = Vector3d(1, 2, -2) / 3.0;
  return m;
}

TEST(ForceModel, FollowsItsClosedForm) {
  EXPECT_EQ(normal_force(500, 0, 0.002), 1.0);
  EXPECT_DOUBLE_EQ(normal_force(500, 1e6, 0.01), 5.0 + 1.0);
  EXPECT_DOUBLE_EQ(stored_energy(500, 1e6, 0.01), 0.025 + 0.0025);
  EXPECT_DOUBLE_EQ(tangent_stiffness(500, 1e6, 0.01), 500 + 300);
  for (const double outside : {0.0, -0.0, -1.0, -1e9}) {
    EXPECT_EQ(normal_force(500, 1e6, outside), 0);
    EXPECT_EQ(stored_energy(500, 1e6, outside), 0);
    EXPECT_EQ(tangent_stiffness(500, 1e6, outside), 0);
  }
}

TEST(ForceModel, StoresTheIntegralOfItsForce) {
  Random random(1);
  for (int i = 0; i < 100; ++i) {
    const double k1 = random.real(0, 3000), k3 = random.real(0, 1e9), depth = random.real(0, 0.02);
    constexpr int kCells = 64;  // Simpson's rule is exact for a cubic
    double integral = 0;
    for (int c = 0; c < kCells; ++c) {
      const double a = depth * c / kCells, b = depth * (c + 1) / kCells;
      integral += (b - a) / 6 *
                  (normal_force(k1, k3, a) + 4 * normal_force(k1, k3, (a + b) / 2) +
                   normal_force(k1, k3, b));
    }
    EXPECT_NEAR(stored_energy(k1, k3, depth), integral, 1e-13 * (1 + integral));
  }
}

TEST(ForceModel, PlanePushesAlongItsNormalByDepth) {
  ForceModel m = model_of(Kind::plane);
  m.k3 = 0;
  Pose entity;
  entity.position = {1, 2, 3};
  entity.orientation = exponential({0.3, -0.2, 0.9});
  const Vector3d n = entity.orientation * m.normal;
  const Vector3d on_surface = entity.position + entity.orientation * m.point;
  const Contact c = contact(m, entity, on_surface - 0.004 * n, 0.001);
  EXPECT_NEAR(c.depth, 0.005, 1e-15);
  EXPECT_LE((c.normal - n).norm(), 1e-15);
  const Vector3d f = evaluate(m, entity, on_surface - 0.004 * n, Vector3d::Zero(), 0.001);
  EXPECT_LE((f - 2.0 * n).norm(), 1e-12);
  EXPECT_EQ(evaluate(m, entity, on_surface + 0.0011 * n, Vector3d::Zero(), 0.001),
            Vector3d::Zero());
}

TEST(ForceModel, SpheresOverlapByRadiiLessDistance) {
  const ForceModel m = model_of(Kind::sphere);
  Pose entity;
  entity.orientation = exponential({0, 0, 1.0});
  const Vector3d centre = entity.orientation * m.point;
  Random random(2);
  for (int i = 0; i < 200; ++i) {
    const Vector3d way = random.direction();
    const double distance = random.real(0.001, 0.06);
    const Contact c = contact(m, entity, centre + distance * way, 0.01);
    EXPECT_NEAR(c.depth, 0.04 - distance, 1e-15);
    EXPECT_LE((c.normal - way).norm(), 1e-13);
    EXPECT_LE((c.point - centre).norm(), 1e-15);
  }
}

TEST(ForceModel, FieldActsOnTheProbesCentreOnly) {
  const ForceModel m = model_of(Kind::field);
  const Vector3d probe = m.point + Vector3d(0.02, 0, 0);
  EXPECT_EQ(contact(m, {}, probe, 0.0).depth, contact(m, {}, probe, 0.05).depth);
  EXPECT_NEAR(contact(m, {}, probe, 0.05).depth, 0.01, 1e-15);
}

TEST(ForceModel, RegionIsAPegWithAFlatEnd) {
  ForceModel m = model_of(Kind::spring_damper_region);
  m.point.setZero();
  m.normal = Vector3d::UnitZ();
  EXPECT_NEAR(contact(m, {}, {0.01, 0, -0.002}, 0).depth, 0.002, 1e-15);
  EXPECT_EQ(contact(m, {}, {0.01, 0, -0.002}, 0).normal, Vector3d::UnitZ());
  // Beside the patch there is no contact; just inside, its side pushes out.
  EXPECT_LT(contact(m, {}, {0.031, 0, -0.002}, 0).depth, 0);
  EXPECT_NEAR(contact(m, {}, {0.029, 0, -0.01}, 0).depth, 0.001, 1e-15);
  EXPECT_EQ(contact(m, {}, {0.029, 0, -0.01}, 0).normal, Vector3d::UnitX());
}

TEST(ForceModel, PushesAlongItsNormalFromASpheresCentre) {
  const ForceModel m = model_of(Kind::sphere);
  const Contact c = contact(m, {}, m.point, 0);
  EXPECT_EQ(c.normal, m.normal);
  EXPECT_EQ(c.depth, 0.03);
}

TEST(ForceModel, GivesNoForceForUnsupportedKinds) {
  for (const Kind kind : {Kind::none, Kind::modal, static_cast<Kind>(200)}) {
    ForceModel m = model_of(kind);
    EXPECT_EQ(evaluate(m, {}, m.point, Vector3d::Zero(), 1.0), Vector3d::Zero());
  }
}

TEST(ForceModel, NeverPullsAProbeThatLeavesFast) {
  Random random(3);
  for (const Kind kind : kTouchable) {
    ForceModel m = model_of(kind);
    m.damping = 50;
    for (int i = 0; i < 5000; ++i) {
      const Pose entity = random.pose();
      const Vector3d probe = entity.position + entity.orientation * m.point + random.vector(0.04);
      const Contact c = contact(m, entity, probe, 0.005);
      const Vector3d f = evaluate(m, entity, probe, random.vector(10), 0.005);
      ASSERT_GE(f.dot(c.normal), 0);
      ASSERT_LE(f.cross(c.normal).norm(), 1e-12 * (1 + f.norm()));
      if (c.depth <= 0) {
        ASSERT_EQ(f, Vector3d::Zero());
      }
    }
  }
}

TEST(ForceModel, DampsAgainstTheMovingAndTurningSurface) {
  ForceModel m = model_of(Kind::plane);
  m.k3 = 0;
  m.damping = 10;
  m.point.setZero();
  m.normal = Vector3d::UnitX();
  Pose entity;
  entity.velocity = {0.5, 0, 0};
  entity.angular_velocity = {0, 0, 2};
  const Vector3d probe = {-0.01, 0.1, 0};
  // The surface at the probe moves with v + w x r = (0.5 - 0.2, ..) along the normal.
  const Vector3d with_surface = {0.3, -0.02, 0};
  EXPECT_NEAR(evaluate(m, entity, probe, with_surface, 0).x(), 4.0, 1e-12);
  EXPECT_NEAR(evaluate(m, entity, probe, with_surface - Vector3d(0.1, 0, 0), 0).x(), 5.0, 1e-12);
  EXPECT_NEAR(evaluate(m, entity, probe, with_surface + Vector3d(0.1, 0, 0), 0).x(), 3.0, 1e-12);
}

// [J], for strokes of about 0.1 J. The peg's force turns by a right angle where its side becomes
// nearer than its face, so a cell across that line has an error of (force x step).
double quadrature_error(Kind kind) { return kind == Kind::spring_damper_region ? 1e-3 : 2e-6; }

// Work of the spring along a closed path. For a force with a potential it is zero to the accuracy
// of the quadrature, wherever the path enters and leaves.
double work_around(const ForceModel& m, const Vector3d& centre, const Vector3d& a,
                   const Vector3d& b) {
  constexpr int kSteps = 20000;
  const auto at = [&](int i) {
    const double phase = 2 * std::numbers::pi * i / kSteps;
    return Vector3d(centre + std::cos(phase) * a + std::sin(phase) * b);
  };
  double work = 0;
  for (int i = 0; i < kSteps; ++i) {
    const Vector3d from = at(i), to = at(i + 1);
    work += evaluate(m, {}, 0.5 * (from + to), Vector3d::Zero(), 0.004).dot(to - from);
  }
  return work;
}

TEST(ForceModel, GainsNoEnergyOnAnyClosedPath) {
  Random random(4);
  for (const Kind kind : kTouchable) {
    const ForceModel m = model_of(kind);
    double worst = 0;
    for (int i = 0; i < 30; ++i) {
      const Vector3d centre = m.point + random.vector(0.03);
      worst = std::max(worst,
                       std::abs(work_around(m, centre, random.vector(0.03), random.vector(0.03))));
    }
    EXPECT_LE(worst, quadrature_error(kind)) << static_cast<int>(kind);
  }
}

TEST(ForceModel, WorkOfASlowProbeEqualsStoredEnergy) {
  Random random(5);
  for (const Kind kind : kTouchable) {
    const ForceModel m = model_of(kind);
    for (int i = 0; i < 20; ++i) {
      const Vector3d from = m.point + random.vector(0.03), to = m.point + random.vector(0.03);
      constexpr int kSteps = 20000;
      const Vector3d step = (to - from) / kSteps;
      double work = 0;
      for (int s = 0; s < kSteps; ++s) {
        work += evaluate(m, {}, from + (s + 0.5) * step, Vector3d::Zero(), 0.004).dot(step);
      }
      const auto stored = [&](const Vector3d& p) {
        return stored_energy(m.k1, m.k3, contact(m, {}, p, 0.004).depth);
      };
      EXPECT_NEAR(work, stored(from) - stored(to), quadrature_error(kind))
          << static_cast<int>(kind);
    }
  }
}

}  // namespace
}  // namespace reckon::deadreckon
