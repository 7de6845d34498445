// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/reduction/linearisation.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace reckon::bench {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

// Masses in a row on hardening springs; the input presses the last one, the first one meets a wall
// at 0. State: positions, then speeds.
struct HardeningChain {
  template <typename Scalar>
  ModelAnswer<Scalar> operator()(const VectorOf<Scalar>& state,
                                 const VectorOf<Scalar>& input) const {
    const Index n = state.size() / 2;
    ModelAnswer<Scalar> answer{VectorOf<Scalar>(2 * n), VectorOf<Scalar>(2)};
    VectorOf<Scalar> force = VectorOf<Scalar>::Constant(n, Scalar(0.0));
    for (Index i = 0; i + 1 < n; ++i) {
      const Scalar stretch = state[i + 1] - state[i], rate = state[n + i + 1] - state[n + i];
      const Scalar pull = 80.0 * stretch + 4e4 * stretch * stretch * stretch + 0.4 * rate;
      force[i] += pull;
      force[i + 1] -= pull;
    }
    const Scalar depth = one_sided<Scalar>(-state[0], -state[n]);
    const Scalar wall = 300.0 * depth + 20.0 * sqrt(depth * depth + 1e-6) * depth;
    force[0] += wall;
    force[n - 1] += input[0];
    for (Index i = 0; i < n; ++i) {
      answer.rate[i] = state[n + i];
      answer.rate[n + i] = force[i] / 0.05;
    }
    answer.output << wall, Scalar(7.0);
    return answer;
  }
};

VectorXd joined(const ModelAnswer<double>& answer) {
  VectorXd all(answer.rate.size() + answer.output.size());
  all << answer.rate, answer.output;
  return all;
}

Eigen::MatrixXd central_differences(const VectorXd& state, const VectorXd& input) {
  const double step = 1e-6;
  const HardeningChain model;
  const Index n = state.size();
  Eigen::MatrixXd slopes(n + 2, n + input.size());
  for (Index i = 0; i < slopes.cols(); ++i) {
    VectorXd up = state, down = state, more = input, less = input;
    (i < n ? up[i] : more[i - n]) += step;
    (i < n ? down[i] : less[i - n]) -= step;
    slopes.col(i) = (joined(model.operator()<double>(up, more)) -
                     joined(model.operator()<double>(down, less))) /
                    (2.0 * step);
  }
  return slopes;
}

TEST(Linearisation, EqualsCentralDifferences) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int round = 0; round < 200; ++round) {
    VectorXd state(8), input(1);
    for (double& x : state) x = 0.02 * unit(random);
    // The wall's corner has no derivative; central differences would span both sides.
    state[0] += state[0] > 0 ? 1e-3 : -1e-3;
    input[0] = unit(random);
    const Linearisation at = linearise(HardeningChain{}, state, input);
    Eigen::MatrixXd slopes(10, 9);
    slopes << at.system.A, at.system.B, at.system.C, at.system.D;
    const Eigen::MatrixXd expected = central_differences(state, input);
    EXPECT_LE((slopes - expected).cwiseAbs().maxCoeff(), 1e-6 * expected.cwiseAbs().maxCoeff());
    const ModelAnswer<double> there = HardeningChain{}.operator()<double>(state, input);
    EXPECT_LE((at.rate - there.rate).norm(), 1e-12 * there.rate.norm());
    EXPECT_EQ(at.output[1], 7.0);
  }
}

// Slope of the wall's force over the position of the first mass.
double wall_slope(double position, double speed) {
  VectorXd state = VectorXd::Zero(4);
  state[0] = position;
  state[2] = speed;
  return linearise(HardeningChain{}, state, VectorXd::Zero(1)).system.C(0, 0);
}

TEST(Linearisation, TakesTheActualSideOfAContact) {
  const double inside = -300.0 - 20.0 * 1e-3;
  EXPECT_NEAR(wall_slope(-1e-4, 0.0), inside, 1.0);
  EXPECT_EQ(wall_slope(1e-4, -1.0), 0.0);
  // On the surface the direction of motion decides.
  EXPECT_NEAR(wall_slope(0.0, -0.1), inside, 1e-9);
  EXPECT_NEAR(wall_slope(1e-12, -0.1), inside, 1e-6);
  EXPECT_EQ(wall_slope(0.0, 0.1), 0.0);
  EXPECT_EQ(wall_slope(-1e-12, 0.1), 0.0);
  EXPECT_EQ(wall_slope(0.0, 0.0), 0.0);
}

struct Corner {
  template <typename Scalar>
  ModelAnswer<Scalar> operator()(const VectorOf<Scalar>& state, const VectorOf<Scalar>&) const {
    ModelAnswer<Scalar> answer{VectorOf<Scalar>(1), VectorOf<Scalar>(0)};
    answer.rate[0] = sqrt(state[0]);
    return answer;
  }
};

TEST(Linearisation, RefusesAPointWithoutDerivative) {
  EXPECT_THROW((void)linearise(Corner{}, VectorXd::Zero(1), VectorXd(0)), std::invalid_argument);
  EXPECT_NO_THROW((void)linearise(Corner{}, VectorXd::Ones(1), VectorXd(0)));
  EXPECT_THROW((void)linearise(Corner{}, VectorXd::Ones(2), VectorXd(0)), std::invalid_argument);
}

}  // namespace
}  // namespace reckon::bench
