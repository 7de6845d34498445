// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/deadreckon/force/force_predictor.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "reckon/deadreckon/motion/drm.hpp"
#include "reckon/tests/deadreckon/support/oracle.hpp"

namespace reckon::deadreckon {
namespace {

using Eigen::Vector3d;
using test::Random;

ForceModel ball() {
  ForceModel m;
  m.kind = pdu::ForceModelKind::sphere;
  m.k1 = 500;
  m.k3 = 1e6;
  m.damping = 2;
  m.radius = 0.02;
  m.validity = 12;
  return m;
}

KinematicState drifting() {
  KinematicState s;
  s.algorithm = pdu::DeadReckoningAlgorithm::rvb;
  s.velocity = {0.01, 0, 0};
  s.angular_velocity = {0, 0, 1};
  return s;
}

ProbeState touching() { return {{0.015, 0.01, 0}, {-0.02, 0, 0}, 0.005}; }

TEST(ForcePredictor, EvaluatesTheModelOnTheExtrapolatedEntity) {
  ForcePredictor predictor;
  predictor.update(ball(), drifting(), 0);
  for (double age = 0; age < 0.5; age += 0.05) {
    const Vector3d expected = evaluate(ball(), extrapolate(drifting(), age), touching());
    EXPECT_EQ(predictor.predict(touching(), age), expected);
  }
  EXPECT_GT(predictor.predict(touching(), 0).norm(), 1);
}

TEST(ForcePredictor, HasNoForceWithoutAModel) {
  ForcePredictor predictor;
  EXPECT_EQ(predictor.predict(touching(), 0), Vector3d::Zero());
  EXPECT_TRUE(predictor.expired(0));
  predictor.update(ball(), drifting(), 0);
  EXPECT_FALSE(predictor.expired(0));
  predictor.clear();
  EXPECT_EQ(predictor.predict(touching(), 0), Vector3d::Zero());
}

TEST(ForcePredictor, FadesContinuouslyAfterItsValidity) {
  ForcePredictor predictor;
  predictor.update(ball(), KinematicState{}, 1);
  const double full = predictor.predict(touching(), 1).norm();
  EXPECT_EQ(predictor.predict(touching(), 13.0).norm(), full);
  EXPECT_NEAR(predictor.predict(touching(), 13.05).norm(), 0.5 * full, 1e-9);
  EXPECT_EQ(predictor.predict(touching(), 13.1 + 1e-9), Vector3d::Zero());
  EXPECT_TRUE(predictor.expired(13.1 + 1e-9));

  double before = full;
  for (double t = 12.99; t < 13.12; t += 1e-4) {
    const double now = predictor.predict(touching(), t).norm();
    ASSERT_LE(now, before + 1e-12);
    ASSERT_LE(before - now, 1.51 * full * 1e-4 / kForceDecay) << t;
    before = now;
  }
}

TEST(ForcePredictor, AnEntityUpdateDoesNotProlongTheModel) {
  ForcePredictor predictor;
  predictor.update(ball(), KinematicState{}, 0);
  predictor.update_entity(KinematicState{}, 11);
  EXPECT_EQ(predictor.weight(12), 1);
  EXPECT_EQ(predictor.weight(12.2), 0);
}

TEST(ForcePredictor, HasNoErrorForCorrectlyPredictedForce) {
  ForcePredictor predictor;
  predictor.update(ball(), drifting(), 0);
  const std::array<ProbeState, 2> probes = {touching(), ProbeState{{0, 0.02, 0}, {0, 0, 0}, 0.005}};
  for (double now = 0; now < 1; now += 0.1) {
    const Pose truth = extrapolate(drifting(), now);
    EXPECT_EQ(predictor.error(ball(), truth, probes, now), 0);
    EXPECT_FALSE(predictor.should_send(ball(), truth, probes, now, 0));
  }
}

TEST(ForcePredictor, SendsWhenTheForceErrorExceedsTheThreshold) {
  ForcePredictor predictor;
  ForceModel sent = ball();
  sent.k3 = 0;
  sent.damping = 0;
  predictor.update(sent, KinematicState{}, 0);
  const ProbeState probe = {{0.015, 0, 0}, Vector3d::Zero(), 0.005};  // 10 mm deep: 5 N
  ForceModel truth = sent;
  truth.k1 = 505;  // 5.05 N
  EXPECT_NEAR(predictor.error(truth, {}, {&probe, 1}, 0), 0.05, 1e-12);
  EXPECT_FALSE(predictor.should_send(truth, {}, {&probe, 1}, 0, 0.051));
  EXPECT_TRUE(predictor.should_send(truth, {}, {&probe, 1}, 0, 0.049));
}

TEST(ForcePredictor, CountsAForceErrorFromThePoseAlone) {
  ForcePredictor predictor;
  ForceModel m = ball();
  m.k3 = 0;
  m.damping = 0;
  predictor.update(m, KinematicState{}, 0);
  const ProbeState probe = {{0.015, 0, 0}, Vector3d::Zero(), 0.005};
  Pose moved;
  moved.position = {0.001, 0, 0};  // 1 mm is 0.5 N here, far below any position threshold
  EXPECT_NEAR(predictor.error(m, moved, {&probe, 1}, 0), 0.5, 1e-12);
}

TEST(ForcePredictor, TakesTheWorstProbeAndNeedsNone) {
  ForcePredictor predictor;
  const std::array<ProbeState, 3> probes = {ProbeState{{1, 0, 0}, {}, 0}, touching(),
                                            ProbeState{{2, 0, 0}, {}, 0}};
  const double expected = evaluate(ball(), Pose{}, touching()).norm();
  EXPECT_EQ(predictor.error(ball(), {}, probes, 0), expected);  // never sent: peers compute no
                                                                // force
  EXPECT_EQ(predictor.error(ball(), {}, {}, 0), 0);
}

TEST(ForcePredictor, TreatsNonFiniteNumbersAsNoForce) {
  ForcePredictor predictor;
  predictor.update(ball(), KinematicState{}, 0);
  const double felt = predictor.predict(touching(), 0).norm();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  ForceModel broken = ball();
  broken.k1 = nan;
  const ProbeState probe = touching();
  EXPECT_EQ(predictor.error(broken, {}, {&probe, 1}, 0), felt);
  for (const auto member : {&ProbeState::position, &ProbeState::velocity}) {
    ProbeState lost = touching();
    (lost.*member).x() = nan;
    EXPECT_EQ(predictor.predict(lost, 0), Vector3d::Zero());
  }
}

}  // namespace
}  // namespace reckon::deadreckon
