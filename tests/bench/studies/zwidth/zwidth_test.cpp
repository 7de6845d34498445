// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The range of impedances of a device: theory and measurement against closed forms and eigenvalues.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <unsupported/Eigen/MatrixFunctions>

#include "reckon/bench/studies/zwidth/measured_border.hpp"
#include "reckon/bench/studies/zwidth/study.hpp"

namespace reckon::bench {
namespace {

/// Spectral radius of handle and wall, written out: position, speed, previous position, forces in
/// transit.
double closed_loop_radius(const ZWidthDevice& device, double K, double B) {
  const double T = device.period;
  Eigen::Matrix3d continuous = Eigen::Matrix3d::Zero();  // x' = v, m v' = f - b v, f held
  continuous(0, 1) = 1;
  continuous(1, 1) = -device.damping / device.mass;
  continuous(1, 2) = 1 / device.mass;
  const Eigen::Matrix3d step = (T * continuous).exp();
  const int d = device.delay_samples;
  Eigen::MatrixXd loop = Eigen::MatrixXd::Zero(3 + d, 3 + d);
  Eigen::RowVectorXd wall = Eigen::RowVectorXd::Zero(3 + d), felt = wall;
  wall(0) = -K - B / T;
  wall(2) = B / T;
  if (d == 0)
    felt = wall;
  else
    felt(3 + d - 1) = 1;
  for (const int row : {0, 1}) {
    loop(row, 0) += step(row, 0);
    loop(row, 1) += step(row, 1);
    loop.row(row) += step(row, 2) * felt;
  }
  loop(2, 0) = 1;
  if (d > 0) loop.row(3) = wall;
  for (int i = 1; i < d; ++i) loop(3 + i, 2 + i) = 1;
  return loop.eigenvalues().cwiseAbs().maxCoeff();
}

double stiffness_where_radius_is_one(const ZWidthDevice& device, double B) {
  double high = 1e-3 * device.damping / device.period;
  while (closed_loop_radius(device, high, B) <= 1) high *= 1.02;
  double low = high / 1.02;
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (low + high);
    (closed_loop_radius(device, middle, B) > 1 ? high : low) = middle;
  }
  return high;
}

TEST(ZWidth, BordersMatchThreeEightWithoutDelay) {
  for (const ZWidthDevice& device :
       {ZWidthDevice{}, ZWidthDevice{0.05, 0.3, 2.5e-4, 0}, ZWidthDevice{2, 8, 1e-2, 0}}) {
    for (const double share : {-0.7, -0.2, 0.0, 0.1, 0.5, 0.9}) {
      const double B = share * device.damping;
      const double border = 2 * (device.damping - std::abs(B)) / device.period;
      EXPECT_NEAR(passive_stiffness(device, B), border, 1e-9 * border) << share;
      EXPECT_NEAR(undelayed_stiffness(device, B), border, 1e-12 * border) << share;
      EXPECT_NEAR(energy_border(device, B), border, 0.01 * border) << share;
    }
  }
}

TEST(ZWidth, DelayedSpringIsPassiveToItsLimit) {
  for (const int d : {1, 2, 5, 20, 100}) {
    const ZWidthDevice device{0.1, 1, 1e-3, d};
    const double border = 1 / (1e-3 * (d + 0.5));
    EXPECT_NEAR(passive_stiffness(device, 0), border, 1e-9 * border) << d;
    EXPECT_NEAR(energy_border(device, 0), border, 0.01 * border) << d;
  }
}

TEST(ZWidth, SomeDampingInADelayedWallAllowsStiffness) {
  const ZWidthDevice device{0.1, 1, 1e-3, 5};
  for (const double B : {0.2, 0.5, 0.8})
    EXPECT_NEAR(energy_border(device, B), passive_stiffness(device, B),
                0.01 * passive_stiffness(device, B))
        << B;
  EXPECT_GT(passive_stiffness(device, 0.5), 1.3 * passive_stiffness(device, 0));
}

TEST(ZWidth, DamperLikeTheDevicesLeavesNoStiffness) {
  for (const double B : {1.0, 1.5, -1.0}) {
    EXPECT_EQ(passive_stiffness({}, B), 0.0);
    EXPECT_LT(energy_border({}, B), 1.0) << B;
  }
}

TEST(ZWidth, SpringAloneOscillatesJustAboveThePassiveLimit) {
  for (const int d : {0, 1, 5, 20}) {
    const ZWidthDevice device{0.1, 1, 1e-3, d};
    const double passive = passive_stiffness(device, 0), unstable = stability_border(device, 0);
    EXPECT_GT(unstable, passive) << "what is passive is stable";
    EXPECT_LT(unstable, 1.05 * passive) << d;
  }
}

TEST(ZWidth, OscillationBeginsAtAnEigenvalueOnTheCircle) {
  for (const int d : {0, 1, 5, 20}) {
    for (const double B : {0.0, 0.3, 0.8}) {
      const ZWidthDevice device{0.1, 1, 1e-3, d};
      const double exact = stiffness_where_radius_is_one(device, B);
      EXPECT_NEAR(stability_border(device, B), exact, 2e-3 * exact) << d << " samples, B " << B;
    }
  }
}

TEST(ZWidth, TooStrongADamperLeavesNoStableWall) {
  EXPECT_EQ(stability_border({0.01, 1, 1e-2, 10}, 3), 0.0);
}

TEST(ZWidth, ServoStaysBelowThePassiveBorder) {
  for (const int d : {0, 3, 20})
    for (const double B : {0.0, 0.1, 0.3}) {
      const ZWidthDevice device{0.1, 1, 1e-3, d};
      EXPECT_LT(servo_stiffness(device, B), passive_stiffness(device, B));
      EXPECT_GT(servo_stiffness(device, B), 0.3 * 2 * (1 - B) / (1e-3 * (1 + 2 * d)));
    }
}

TEST(ZWidth, RowsAreInTheOrderOfDampings) {
  const std::vector<double> dampings{0.5, 0, 0.9};
  const auto rows = run_zwidth({}, dampings);
  ASSERT_EQ(rows.size(), 3U);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_EQ(rows[i].damping, dampings[i]);
    EXPECT_LT(std::abs(rows[i].off()), 0.01);
  }
}

TEST(ZWidth, StopsWithoutRowsOnRequest) {
  const std::vector<double> dampings{0, 0.5};
  EXPECT_TRUE(run_zwidth({}, dampings, [](std::size_t, std::size_t) { return false; }).empty());
}

}  // namespace
}  // namespace reckon::bench
