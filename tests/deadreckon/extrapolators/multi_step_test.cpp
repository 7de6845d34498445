// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/deadreckon/extrapolators/multi_step.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <ostream>
#include <stdexcept>
#include <string>
#include <string_view>

#include "reckon/deadreckon/extrapolators/extrapolators.hpp"
#include "reckon/deadreckon/motion/drm.hpp"
#include "reckon/tests/deadreckon/support/known_motions.hpp"
#include "reckon/tests/deadreckon/support/oracle.hpp"
#include "reckon/tests/support/declarations.hpp"

namespace reckon::deadreckon {

static void PrintTo(const Extrapolator& row, std::ostream* out) { *out << row.name; }

}  // namespace reckon::deadreckon

namespace reckon::deadreckon::test::multi_step_test {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

const Extrapolator& extrapolator(std::string_view name) {
  for (const Extrapolator& row : kExtrapolators)
    if (row.name == name) return row;
  throw std::runtime_error("no extrapolator of this name");
}

MotionHistory circle_history(double gap) {
  MotionHistory history;
  for (const double t : {-2 * gap, -gap, 0.0}) EXPECT_TRUE(history.add(on_circle(t)));
  return history;
}

double circle_error(std::string_view name, double gap, double tau) {
  const Pose pose = extrapolator(name).predict(circle_history(gap), tau, {});
  return (pose.position - on_circle(tau).position).norm();
}

TEST(MultiStep, MeetsEveryOracleVectorAtItsTolerance) {
  RECKON_NEED_DATA("oracles/one_two_step.json");
  const auto vectors = oracle("one_two_step.json").at("vectors");
  EXPECT_EQ(vectors.size(), 26U);
  double worst = 0;
  for (const auto& v : vectors) {
    SCOPED_TRACE(v.at("id").get<std::string>());
    MotionHistory history;
    history.add({number(v["t2"]), vector(v["x2"]), Quaterniond::Identity(), vector(v["v2"]),
                 Vector3d::Zero(), Vector3d::Zero()});
    history.add({number(v["t1"]), vector(v["x1"]), Quaterniond::Identity(), vector(v["v1"]),
                 vector(v["a1"]), Vector3d::Zero()});
    const std::string formula = v["formula"];
    const std::string name = formula == "1st_one"   ? "one_step_1"
                             : formula == "1st_two" ? "two_step_1"
                             : formula == "2nd_one" ? "one_step_2"
                                                    : "two_step_2";
    const double tau = number(v["t"]) - number(v["t1"]);
    // The vectors test the formula: no cap, and any interval.
    const Pose pose = extrapolator(name).predict(history, tau, {1e-12, kInfinity});
    const Vector3d expected = vector(v.contains("expected_x") ? v["expected_x"] : v["fallback_x"]);
    const double off = (pose.position - expected).lpNorm<Eigen::Infinity>();
    EXPECT_LE(off, number(v["tol_m"]));
    worst = std::max(worst, off / number(v["tol_m"]));
  }
  RecordProperty("worst_share_of_tolerance", std::to_string(worst));
}

TEST(MultiStep, ErrsOnTheThesisCircleAsTheFormulas) {
  // Printed digits: closed forms of a circle of 10 m at 1 rad/s.
  EXPECT_NEAR(circle_error("hold", 0.1, 0.1), 0.9996, 5e-5);
  EXPECT_NEAR(circle_error("one_step_1", 0.1, 0.1), 0.04999, 5e-6);
  EXPECT_NEAR(circle_error("one_step_2", 0.1, 0.1), 0.001666, 5e-7);
  EXPECT_NEAR(circle_error("two_step_1", 0.1, 0.1), 0.09992, 5e-6);
  EXPECT_NEAR(circle_error("two_step_2", 0.1, 0.1), 0.004164, 5e-7);
  EXPECT_NEAR(circle_error("hold", 1, 1), 9.589, 5e-4);
  EXPECT_NEAR(circle_error("one_step_1", 1, 1), 4.863, 5e-4);
  EXPECT_NEAR(circle_error("one_step_2", 1, 1), 1.636, 5e-4);
  EXPECT_NEAR(circle_error("two_step_1", 1, 1), 9.194, 5e-4);
  EXPECT_NEAR(circle_error("two_step_2", 1, 1), 3.903, 5e-4);
}

TEST(Extrapolators, HaveARowForEveryDeclaredPrediction) {
  std::size_t predictions = 0;
  for (const std::string& header : reckon::test::headers_in("deadreckon/extrapolators")) {
    for (const std::string& name : reckon::test::all_of(
             reckon::test::source_text(header),
             R"(Pose (\w+)\(const MotionHistory& \w+, double \w+,\s+const StepLimits& \w+\))")) {
      EXPECT_TRUE(reckon::test::is_row("deadreckon/extrapolators/extrapolators.hpp",
                                       "kExtrapolators", name))
          << header << " declares " << name << ": it needs a row in kExtrapolators";
      ++predictions;
    }
  }
  EXPECT_EQ(predictions, kExtrapolators.size());
}

class EveryExtrapolator : public testing::TestWithParam<Extrapolator> {};

TEST_P(EveryExtrapolator, IsExactUpToItsOrder) {
  Random random(11);
  for (int i = 0; i < 1000; ++i) {
    Polynomial motion{random.vector(1000), random.vector(100), random.vector(5), random.vector(1)};
    if (GetParam().order < 3) motion.j.setZero();
    if (GetParam().order < 2) motion.a.setZero();
    if (GetParam().order < 1) motion.v.setZero();
    MotionHistory history;
    const double gap = random.real(0.05, 2);
    for (const double t : {-2 * gap, -gap, 0.0}) history.add(motion.at(t));
    const double tau = random.real(0, 5 * gap);
    const Pose pose = GetParam().predict(history, tau, {});
    // 1000 m at 2.2e-16, differenced over one interval and extrapolated over five: below 1e-9.
    EXPECT_NEAR((pose.position - motion.at(tau).position).norm(), 0, 1e-9);
    EXPECT_NEAR((pose.velocity - motion.at(tau).velocity).norm(), 0, 1e-9);
  }
}

TEST_P(EveryExtrapolator, GivesTheRateOfItsPositionAsVelocity) {
  const MotionHistory history = circle_history(0.1);
  for (const double tau : {0.05, 0.4, 0.9}) {
    constexpr double kStep = 1e-5;
    const Vector3d rate = (GetParam().predict(history, tau + kStep, {}).position -
                           GetParam().predict(history, tau - kStep, {}).position) /
                          (2 * kStep);
    EXPECT_NEAR((GetParam().predict(history, tau, {}).velocity - rate).norm(), 0, 1e-8);
  }
}

TEST_P(EveryExtrapolator, StaysFiniteForAnyGapsAndTimes) {
  for (const double gap : {0.0, 1e-300, 1e-9, 1e-3, 1.0, 1e9}) {
    MotionHistory history;
    history.add(
        {-2 * gap, {1e7, -1e7, 1e7}, Quaterniond::Identity(), {1e3, 0, 0}, {0, 1, 0}, {0, 0, 1}});
    history.add(
        {-gap, {-1e7, 1e7, 1e7}, Quaterniond(0, 1, 0, 0), {0, 1e3, 0}, {0, 1, 0}, {0, 1e4, 0}});
    history.add({0, {1e7, 1e7, 1e7}, Quaterniond(0, 0, 1, 0), {0, 0, 1e3}, {0, 1, 0}, {0, 0, 9}});
    for (const double tau : {0.0, -1.0, 1e-9, 1.0, 3600.0, 1e300, kInfinity, -kInfinity, kNan})
      EXPECT_TRUE(is_finite(GetParam().predict(history, tau, {}))) << gap << ' ' << tau;
  }
}

TEST_P(EveryExtrapolator, HoldsStillAfterThreeEqualPositions) {
  MotionHistory history;
  for (const double t : {0.0, 0.1, 0.2})
    history.add({t, {4e6, 5e6, 6e6}, Quaterniond::Identity(), {0, 0, 0}, {0, 0, 0}, {0, 0, 0}});
  const Pose pose = GetParam().predict(history, 1e5, {});
  EXPECT_EQ(pose.position, Vector3d(4e6, 5e6, 6e6));
}

TEST_P(EveryExtrapolator, NeedsNoHistoryToAnswer) {
  EXPECT_TRUE(is_finite(GetParam().predict(MotionHistory{}, 1, {})));
}

TEST_P(EveryExtrapolator, IsInTheTableOfTheDocument) {
  EXPECT_NE(reckon::test::source_text("docs/dead_reckoning.md")
                .find("| `" + std::string(GetParam().name) + "` |"),
            std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(Extrapolators, EveryExtrapolator, testing::ValuesIn(kExtrapolators),
                         [](const auto& row) { return std::string(row.param.name); });

TEST(MultiStep, UsesTheSentVelocityForCloseUpdates) {
  MotionHistory history;
  history.add({1.0, {0, 0, 0}, Quaterniond::Identity(), {1, 0, 0}, {0, 0, 0}, {0, 0, 0}});
  history.add({1.0005, {5, 0, 0}, Quaterniond::Identity(), {1, 0, 0}, {0, 0, 0}, {0, 0, 0}});
  // 5 m in half a millisecond must not become 10 km/s.
  EXPECT_NEAR(first_order_two_step(history, 1, {}).position.x(), 6, 1e-12);
  EXPECT_NEAR(second_order_two_step(history, 1, {}).position.x(), 6, 1e-12);
}

TEST(MultiStep, HoldsADifferencedVelocityForTenGapsOnly) {
  MotionHistory history;
  history.add({0.0, {0, 0, 0}, Quaterniond::Identity(), {0, 0, 0}, {0, 0, 0}, {0, 0, 0}});
  history.add({0.1, {1, 0, 0}, Quaterniond::Identity(), {0, 0, 0}, {0, 0, 0}, {0, 0, 0}});
  EXPECT_NEAR(first_order_two_step(history, 1, {}).position.x(), 11, 1e-12);
  EXPECT_NEAR(first_order_two_step(history, 60, {}).position.x(), 11, 1e-12);
  EXPECT_EQ(first_order_two_step(history, 60, {}).velocity, Vector3d::Zero());
}

TEST(MultiStep, ContinuesTheLastTurnTheShorterWay) {
  MotionHistory history;
  const Vector3d axis = Vector3d(1, 2, -3).normalized();
  const auto turned = [&](double angle) { return Quaterniond(Eigen::AngleAxisd(angle, axis)); };
  Quaterniond other_sign = turned(0.5);
  other_sign.coeffs() *= -1;
  history.add({0.0, {0, 0, 0}, turned(0.2), {0, 0, 0}, {0, 0, 0}, {0, 0, 0}});
  history.add({0.1, {0, 0, 0}, other_sign, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}});
  const Pose pose = first_order_two_step(history, 0.2, {});
  EXPECT_LT(difference(pose.orientation, turned(1.1)), 1e-14);
  EXPECT_NEAR((pose.angular_velocity - 3 * axis).norm(), 0, 1e-12);
}

TEST(PositionHistory, UsesTheSecondOrderBetweenTheCutoffsOnly) {
  const auto error = [](double acceleration) {
    const Polynomial motion{{0, 0, 0}, {10, 0, 0}, {0, acceleration, 0}};
    MotionHistory history;
    for (const double t : {-0.2, -0.1, 0.0}) history.add(motion.at(t));
    return (position_history(history, 0.5, {}).position - motion.at(0.5).position).norm();
  };
  EXPECT_LT(error(0.2), 1e-12);
  EXPECT_LT(error(19), 1e-12);
  // First order: a tau (gap + tau) / 2 is missing.
  EXPECT_NEAR(error(0.05), 0.05 * 0.15, 1e-12);
  EXPECT_NEAR(error(25), 25 * 0.15, 1e-11);
}

TEST(MotionHistory, RefusesOldAndNonFiniteSamples) {
  MotionHistory history;
  EXPECT_TRUE(history.add(on_circle(1)));
  EXPECT_TRUE(history.add(on_circle(2)));
  EXPECT_FALSE(history.add(on_circle(1.5)));
  MotionSample broken = on_circle(3);
  broken.velocity.y() = kNan;
  EXPECT_FALSE(history.add(broken));
  broken = on_circle(3);
  broken.time = kInfinity;
  EXPECT_FALSE(history.add(broken));
  MotionSample corrected = on_circle(2);
  corrected.position.x() = 77;
  EXPECT_TRUE(history.add(corrected));
  ASSERT_EQ(history.size(), 2U);
  EXPECT_EQ(history[0].position.x(), 77);
  EXPECT_EQ(history[1].time, 1);
}

TEST(MotionHistory, SamplesBodyAxesAsTheModelMoves) {
  // Velocity and acceleration are checked by differences of the model's own motion.
  Random random(5);
  for (int model = 0; model <= 9; ++model) {
    const KinematicState state = random.state(static_cast<pdu::DeadReckoningAlgorithm>(model), 0.7);
    const MotionSample sample = motion_sample(state, 3);
    constexpr double kStep = 1e-3;
    const Pose before = extrapolate(state, -kStep), at = extrapolate(state, 0),
               after = extrapolate(state, kStep);
    const Vector3d velocity = (after.position - before.position) / (2 * kStep);
    const Vector3d acceleration =
        (after.position - 2 * at.position + before.position) / (kStep * kStep);
    EXPECT_NEAR((sample.velocity - velocity).norm(), 0, 1e-4) << model;
    EXPECT_NEAR((sample.acceleration - acceleration).norm(), 0, 1e-3) << model;
    EXPECT_EQ(sample.angular_velocity, at.angular_velocity) << model;
  }
}

}  // namespace
}  // namespace reckon::deadreckon::test::multi_step_test
