// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/reduction/pressed_body.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "reckon/tests/bench/support/linear_systems.hpp"
#include "reckon/tests/bench/support/membranes.hpp"

namespace reckon::bench {
namespace {

constexpr double kStiffness = 900.0;

// In positions and speeds, by LU, without the body's modes.
void expect_right(const SecondOrderSystem& body, bool by_modes, double tolerance) {
  PressedBody pressed(BodyReduction(body), kStiffness);
  EXPECT_EQ(pressed.is_by_modes(), by_modes);
  const StateSpace full = test::pressed(body, kStiffness);
  double worst = 0.0;
  for (double w = 0.1; w < 1e5; w *= 1.07) {
    const Eigen::MatrixXcd right = evaluate(full, {0.0, w});
    worst = std::max(worst, (pressed.force(w) - right).norm() / right.norm());
  }
  EXPECT_LE(worst, tolerance);
}

TEST(PressedBody, ModesGiveTheAnswerOfTheWholeBody) {
  expect_right(test::make_membrane({.side = 6}), true, 1e-9);
  expect_right(test::make_membrane({.side = 5, .touched = {3, 17, 24}}), true, 1e-9);
  expect_right(test::make_chain(9, 0.01, 2000.0, 0.0, 2.0, 1e-3), true, 1e-9);   // free
  expect_right(test::make_chain(9, 0.01, 2000.0, 300.0, 0.0, 0.0), true, 1e-6);  // no damper
}

TEST(PressedBody, UsesFactorsWhereDampersCoupleModes) {
  SecondOrderSystem body = test::make_membrane({.side = 6});
  body.D.coeffRef(0, 0) += 0.01;
  expect_right(body, false, 1e-9);
  body = test::make_chain(4, 0.01, 2000.0, 300.0, 0.0, 0.0);  // dense: few coordinates
  body.D.coeffRef(1, 1) += 0.3;
  expect_right(body, false, 1e-6);
}

// A tiny mass moves the fastest mode so far away that rounding destroys the slow ones.
TEST(PressedBody, ToleratesMassesOfVeryDifferentSizes) {
  SecondOrderSystem body = test::make_chain(8, 0.01, 2000.0, 300.0, 2.0, 0.0);
  body.M.coeffRef(3, 3) *= 1e-13;
  body.D = 2.0 * body.M;
  PressedBody pressed(BodyReduction(body), kStiffness);
  BodyCompliance compliance(body);
  for (double w = 0.1; w < 1e4; w *= 1.3) {
    const auto right = through_contact(compliance.at(w), kStiffness)(0, 0);
    EXPECT_LE(std::abs(pressed.force(w)(0, 0) - right), 1e-8 * std::abs(right)) << w;
  }
}

}  // namespace
}  // namespace reckon::bench
