// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The spring of one contact: its friction, its curvature, and its response to bad parameters.
#include "reckon/haptics/passivity/contact_spring.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <array>
#include <cmath>
#include <limits>
#include <random>

#include "reckon/tests/haptics/support/plane_surface.hpp"

namespace reckon::haptics {
namespace {

using Eigen::Vector3d;
using test::plane;
using Kind = pdu::ForceModelKind;

TEST(ContactSpring, IgnoresNonFiniteParameters) {
  ContactSpring spring;
  spring.reset(Vector3d::Zero());
  spring.move(plane(500, 0.01, 950));
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), -1.0}) {
    ContactParameters theta = plane(500, 0.01, 950);
    theta.k1 = bad;
    spring.move(theta);
    EXPECT_EQ(spring.parameters().k1, 500.0);
  }
}

TEST(ContactSpring, FrictionSticksThenSlidesAtTheKineticCoefficient) {
  ContactParameters theta = plane(500, 0.0, 950);
  theta.static_friction = 0.6;
  theta.kinetic_friction = 0.3;
  ContactSpring spring;
  Vector3d x(-0.001, 0, 0);
  spring.reset(x);
  spring.move(theta);  // another kind of surface: it begins with gain 0
  spring.move(theta);
  for (; x.x() < 0.004; x.x() += 1e-5) spring.settle(x, 0.001);
  double most = 0, last = 0;
  for (int i = 0; i < 1000; ++i) {
    x.y() += 1e-5;
    spring.settle(x, 0.001);
    spring.move(theta);
    last = -spring.force().y() / -spring.force().x();
    most = std::max(most, last);
  }
  EXPECT_NEAR(most, 0.6, 0.01);
  EXPECT_NEAR(last, 0.3, 1e-9);
  EXPECT_TRUE(spring.slipping());
}

// S(x + dx) <= S(x) - F.dx + dx.H dx / 2 for any dx, including the motion of the bristle: the one
// inequality used by the proof.
TEST(ContactSpring, CurvatureIsBoundedForAnyMotion) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> u(0, 1);
  const auto any = [&] { return Vector3d(u(random) - .5, u(random) - .5, u(random) - .5); };
  int felt = 0;
  for (int i = 0; i < 200'000; ++i) {
    ContactParameters theta;
    const std::array kinds{Kind::sphere, Kind::plane, Kind::field, Kind::spring_damper_region};
    theta.kind = kinds[static_cast<std::size_t>(4 * u(random))];
    theta.point = 0.02 * any();
    theta.normal = any().normalized();
    theta.reach = 0.04 * u(random);
    theta.patch = 0.03 * u(random);
    theta.k1 = 2000 * u(random);
    theta.k3 = u(random) < 0.5 ? 0 : 1e8 * u(random);
    theta.static_friction = u(random) < 0.3 ? 0 : u(random);
    theta.kinetic_friction = theta.static_friction * u(random);
    theta.gain = u(random);
    theta.slope_limit = 950 * u(random);
    ContactSpring spring;
    spring.reset(0.02 * any());
    spring.move(theta);
    spring.move(theta);
    spring.settle(spring.probe() + 0.002 * any(), 0.001);
    if (!(spring.stored() > 0)) continue;
    ++felt;
    ContactSpring there = spring;
    const Vector3d dx = std::pow(10.0, -4 + 3 * u(random)) * any();
    there.settle(spring.probe() + dx, 0.001);
    const double bound =
        spring.stored() - spring.force().dot(dx) + 0.5 * dx.dot(spring.slope() * dx);
    ASSERT_LE(there.stored(), bound + 1e-15) << i;
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(spring.slope());
    ASSERT_NEAR(solver.eigenvalues().maxCoeff(), spring.greatest_slope(), 1e-9);
  }
  EXPECT_GT(felt, 20'000);
}

}  // namespace
}  // namespace reckon::haptics
