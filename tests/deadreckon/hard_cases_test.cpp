// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The hard cases of dead reckoning, by name. Some have a test elsewhere:
//   rates from none to 10 rad/s    DrmQuadrature.*, Drm.ZeroRateBodyModelsMoveAlongTheirAxes
//   turning by about pi            Rotation.LogarithmUndoesExponentialFromZeroToPi
//   gimbal, Euler angles           Euler.KeepsItsDigitsAtAndNearGimbalLock,
//                                  Drm.TurnsThroughGimbalLockWithoutError
//   equal timestamps               MultiStep.UsesTheSentVelocityForCloseUpdates,
//                                  MotionHistory.RefusesOldAndNonFiniteSamples
//   the hour of a timestamp        Timestamp.* (pdu), SenderClock.* (integration)
//   NaN and infinity on the wire   EntityConversion.RefusesNonFiniteNumbers...
//   update rates, loss, duplicates BadLink.* (bad_link_test.cpp)
//   the same in a peer             HardCases.* of tests/integration
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "reckon/deadreckon/extrapolators/adaptive_order.hpp"
#include "reckon/deadreckon/extrapolators/extrapolators.hpp"
#include "reckon/deadreckon/force/force_predictor.hpp"
#include "reckon/deadreckon/motion/convergence.hpp"
#include "reckon/deadreckon/motion/drm.hpp"
#include "reckon/deadreckon/motion/rotation.hpp"
#include "reckon/deadreckon/sending/deadband.hpp"
#include "reckon/deadreckon/sending/update_policy.hpp"
#include "reckon/deadreckon/wire_conversion.hpp"
#include "reckon/tests/deadreckon/support/oracle.hpp"

namespace reckon::deadreckon {
namespace {

using Algorithm = pdu::DeadReckoningAlgorithm;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using test::Random;

constexpr double kPi = std::numbers::pi;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr std::array<double, 3> kBad = {kNan, kInfinity, -kInfinity};
constexpr std::array<double, 10> kTimes = {0,     1e-320, 1,         -1,         3600,
                                           1e300, -1e300, kInfinity, -kInfinity, kNan};

Quaterniond heading(double psi) { return quaternion_from_euler({psi, 0, 0}); }

KinematicState headed(double psi) {
  KinematicState state;
  state.algorithm = Algorithm::rvw;
  state.orientation = heading(psi);
  return state;
}

Pose pose_headed(double psi) { return extrapolate(headed(psi), 0); }

bool converges(const ConvergenceCurveRow& row) { return row.curve != ConvergenceCurve::snap; }

ConvergenceSettings settings(const ConvergenceCurveRow& row) {
  ConvergenceSettings made;
  made.curve = row.curve;
  return made;
}

// --- Rates of zero and of a nanoradian a second.

TEST(HardCases, NanoradianRateAddsItsFirstOrderTerm) {
  Random random(1);
  constexpr double t = 10;
  for (const Algorithm algorithm : {Algorithm::rpb, Algorithm::rvb}) {
    for (int i = 0; i < 100; ++i) {
      KinematicState still = random.state(algorithm, 0);
      still.position.setZero();
      KinematicState slow = still;
      slow.angular_velocity = 1e-9 * random.direction();
      // The integral of (w s) x (V + A s); the next term is 1e-8 of it.
      Vector3d way = 0.5 * t * t * still.velocity;
      if (algorithm == Algorithm::rvb) way += t * t * t / 3 * still.acceleration;
      const Vector3d expected = still.orientation * slow.angular_velocity.cross(way);
      const Vector3d found = extrapolate(slow, t).position - extrapolate(still, t).position;
      ASSERT_LE((found - expected).norm(), 1e-11);
      ASSERT_NEAR(angle_between(extrapolate(slow, t).orientation, still.orientation), 1e-8, 1e-15);
    }
  }
}

// --- Angles across pi.

TEST(HardCases, AngleThresholdAppliesAcrossPi) {
  UpdatePolicy policy(Thresholds{}, 55);
  policy.sent(headed(kPi - 0.01), 0);
  for (const double sign : {1.0, -1.0}) {
    Pose truth = pose_headed(-kPi + 0.04);  // 0.05 rad ahead, below 3 degrees
    truth.orientation.coeffs() *= sign;
    EXPECT_EQ(policy.decide(truth, 1), SendReason::none);
    truth = pose_headed(-kPi + 0.05);
    truth.orientation.coeffs() *= sign;
    EXPECT_EQ(policy.decide(truth, 1), SendReason::orientation);
  }
}

TEST(HardCases, ConvergenceCrossesPiTheShortWay) {
  for (const ConvergenceCurveRow& row : kConvergenceCurves) {
    PoseConvergence convergence(settings(row));
    const Pose predicted = pose_headed(-kPi + 0.2);
    convergence.restart(pose_headed(kPi - 0.2), predicted, 0);
    for (double t = 0; t < 1.1; t += 0.001) {
      const double psi = euler_from_quaternion(convergence.shown(predicted, t).orientation).psi;
      ASSERT_GE(std::abs(psi), kPi - 0.2 - 1e-12) << row.name << " at " << t;
    }
  }
}

TEST(HardCases, TwoHeadingsAcrossPiGiveTheShortTurn) {
  MotionHistory history;
  ASSERT_TRUE(history.add(motion_sample(headed(kPi - 0.1), 0)));
  ASSERT_TRUE(history.add(motion_sample(headed(-kPi + 0.1), 1)));
  const Pose pose = first_order_two_step(history, 1, {});
  EXPECT_NEAR(angle_between(pose.orientation, heading(-kPi + 0.3)), 0, 1e-14);
  EXPECT_NEAR(pose.angular_velocity.z(), 0.2, 1e-14);
}

TEST(HardCases, PsiAcrossPiOnTheWireIsContinuous) {
  const LocalFrame frame(0.8, 0.2, 100);
  KinematicState state = headed(0);
  state.angular_velocity = {0, 0, 1};
  bool passed = false;
  float before = 0;
  for (double t = 0; t < 6.4; t += 0.01) {
    KinematicState now = state, back;
    now.orientation = extrapolate(state, t).orientation;
    pdu::EntityState wire;
    ASSERT_EQ(to_wire(now, frame, wire), ConversionError::none);
    ASSERT_EQ(from_wire(wire, frame, back), ConversionError::none);
    // Half a last digit of three float32 angles.
    ASSERT_LE(angle_between(back.orientation, now.orientation), 4e-7) << t;
    passed = passed || std::abs(wire.orientation.psi - before) > 6;
    before = wire.orientation.psi;
  }
  EXPECT_TRUE(passed) << "psi never passed pi";
}

// --- Gimbal lock.

TEST(HardCases, VerticalAttitudesRoundTripOnTheWire) {
  const LocalFrame frame(0, 0, 0);
  const float up = static_cast<float>(kPi / 2);  // 4e-8 beyond pi/2
  for (const float theta : {up, std::nextafter(up, 0.0F), -up, std::nextafter(-up, 0.0F)}) {
    for (float turn = -3; turn < 3.1F; turn += 0.25F) {
      pdu::EntityState wire;
      wire.location = {6378137, 0, 0};
      wire.dead_reckoning.algorithm = Algorithm::rvw;
      wire.orientation = {turn, theta, 0.5F * turn};
      wire.dead_reckoning.angular_velocity = {0.3F, -0.2F, turn};
      KinematicState state, back;
      ASSERT_EQ(from_wire(wire, frame, state), ConversionError::none);
      const Quaterniond later = extrapolate(state, 1.0).orientation;
      // One second forward and one second back, through the wire while at the lock.
      pdu::EntityState again;
      ASSERT_EQ(to_wire(state, frame, again), ConversionError::none);
      ASSERT_LE(std::abs(again.orientation.theta), up);
      ASSERT_EQ(from_wire(again, frame, back), ConversionError::none);
      ASSERT_LE(angle_between(extrapolate(back, 1.0).orientation, later), 6e-7) << turn;
    }
  }
}

// --- Equal and reversed timestamps.

TEST(HardCases, ReversedTimestampsAreIgnoredAndEqualOnesReplace) {
  Random random(3);
  for (const Extrapolator& row : kExtrapolators) {
    MotionHistory history;
    for (const double time : {1.0, 2.0, 3.0})
      ASSERT_TRUE(history.add(motion_sample(random.state(Algorithm::rvw, 0.3), time)));
    const Pose before = row.predict(history, 0.5, {});
    for (const double time : {2.999, 2.0, 0.0, -1e9})
      ASSERT_FALSE(history.add(motion_sample(random.state(Algorithm::rvw, 0.3), time)));
    EXPECT_EQ(row.predict(history, 0.5, {}).position, before.position) << row.name;
    const MotionSample correction = motion_sample(random.state(Algorithm::rvw, 0.3), 3.0);
    ASSERT_TRUE(history.add(correction));
    EXPECT_EQ(row.predict(history, 0, {}).position, correction.position) << row.name;
  }
}

TEST(HardCases, AdaptiveOrderIgnoresLateOrRepeatedUpdates) {
  Random random(4);
  AdaptiveOrder clean, disturbed;
  for (int i = 0; i < 200; ++i) {
    KinematicState state = random.state(Algorithm::rvw, 0.3);
    state.position = {5.0 * i, 0.1 * i * i, 0};
    const MotionSample sample = motion_sample(state, 0.2 * i);
    ASSERT_TRUE(clean.add(sample));
    ASSERT_TRUE(disturbed.add(sample));
    ASSERT_TRUE(disturbed.add(sample));  // twice
    ASSERT_FALSE(disturbed.add(motion_sample(state, 0.2 * i - 0.1)));
    ASSERT_EQ(clean.chosen().name, disturbed.chosen().name) << i;
    ASSERT_EQ(clean.predict(0.1).position, disturbed.predict(0.1).position) << i;
  }
}

// --- Coordinates of 1e7 m: their last digit is 1.9e-9 m.

TEST(HardCases, MillimetreThresholdsHoldTenThousandKilometresOut) {
  Thresholds thresholds;
  thresholds.position = kFingertipResolution;
  UpdatePolicy policy(thresholds, 1e6);
  KinematicState state = headed(1);
  state.position = {1e7, -1e7, 1e7};
  state.velocity = {123.25, -45.5, 7.75};
  policy.sent(state, 0);
  for (int i = 1; i <= 60'000; ++i) {
    // Exact in double: multiples of 1/1024 s are, thousandths of a second are not.
    const double t = i / 1024.0;
    Pose truth = extrapolate(state, 0);
    truth.position = state.position + t * state.velocity;
    ASSERT_EQ(policy.decide(truth, t), SendReason::none) << t;
    truth.position.x() += 2.4e-3;
    ASSERT_EQ(policy.decide(truth, t), SendReason::none) << t;
    truth.position.x() += 0.2e-3;
    ASSERT_EQ(policy.decide(truth, t), SendReason::position) << t;
  }
}

TEST(HardCases, ConvergenceIsContinuousTenThousandKilometresOut) {
  Random random(5);
  for (const ConvergenceCurveRow& row : kConvergenceCurves) {
    if (!converges(row)) continue;
    PoseConvergence convergence(settings(row));
    Pose predicted = random.pose(), shown = random.pose();
    predicted.position = {1e7, 1e7, -1e7};
    shown.position = predicted.position + Vector3d(1e-3, -2e-3, 5e-4);
    convergence.restart(shown, predicted, 3600);
    const double last_digit = std::nextafter(1e7, 2e7) - 1e7;
    EXPECT_LE((convergence.shown(predicted, 3600).position - shown.position).norm(), 2 * last_digit)
        << row.name;
    const double end = 3600 + convergence.duration();
    const Vector3d left = convergence.shown(predicted, end - 1e-9).position - predicted.position;
    EXPECT_LE(left.norm(), 1e-6 + 2 * last_digit) << row.name;
  }
}

// --- An hour of silence.

TEST(HardCases, HourOfSilenceStaysFiniteInEveryModel) {
  Random random(6);
  for (int model = 0; model <= 10; ++model)
    EXPECT_TRUE(is_finite(extrapolate(random.state(static_cast<Algorithm>(model), 10), 3600)));
  MotionHistory history;
  for (const double time : {0.0, 0.2, 0.4})
    ASSERT_TRUE(history.add(motion_sample(random.state(Algorithm::rvw, 0.3), time)));
  for (const Extrapolator& row : kExtrapolators) {
    const Pose hour = row.predict(history, 3600, {});
    EXPECT_TRUE(is_finite(hour)) << row.name;
    // A differenced rate is not used for longer than ten intervals.
    if (row.updates > 1 && row.needs == SentRates::position) {
      EXPECT_EQ(hour.position, row.predict(history, 2.1, {}).position) << row.name;
      EXPECT_TRUE(hour.velocity.isZero()) << row.name;
    }
  }
}

// --- NaN and infinity.

TEST(HardCases, NonFiniteTimesGiveFiniteAnswers) {
  Random random(7);
  const KinematicState state = random.state(Algorithm::rvb, 2);
  UpdatePolicy policy(Thresholds{}, 5);
  policy.sent(state, 0);
  ForcePredictor force;
  ForceModel model;
  model.kind = pdu::ForceModelKind::sphere;
  model.k1 = model.radius = model.validity = 100;
  force.update(model, state, 0);
  AdaptiveOrder adaptive;
  for (const double time : {0.0, 1.0, 2.0}) ASSERT_TRUE(adaptive.add(motion_sample(state, time)));
  PoseConvergence convergence;
  convergence.restart(random.pose(), random.pose(), 0);
  for (const double t : kTimes) {
    EXPECT_TRUE(std::isfinite(bounded_tau(t))) << t;
    EXPECT_TRUE(is_finite(policy.predicted(t))) << t;
    EXPECT_TRUE(is_finite(adaptive.predict(t))) << t;
    EXPECT_TRUE(is_finite(convergence.shown(extrapolate(state, 1), t))) << t;
    EXPECT_TRUE(is_finite(force.entity(t))) << t;
    EXPECT_TRUE(force.predict({}, t).allFinite()) << t;
    EXPECT_TRUE(force.weight(t) >= 0 && force.weight(t) <= 1) << t;
    EXPECT_TRUE(predict(SignalUpdate{0, {1, 1, 1}, {1, 1, 1}, SignalModel::line}, t).allFinite());
    for (const ConvergenceCurveRow& row : kConvergenceCurves) {
      const ConvergenceWeights w = convergence_weights(row.curve, t, 0.1);
      EXPECT_TRUE(std::isfinite(w.error + w.rate + w.error_rate + w.rate_rate)) << row.name << t;
    }
  }
}

TEST(HardCases, NonFiniteErrorsAreDroppedByEveryCurve) {
  for (const ConvergenceCurveRow& row : kConvergenceCurves) {
    for (const double bad : kBad) {
      for (int which = 0; which < 4; ++which) {
        Pose shown, predicted = pose_headed(1);
        if (which == 0) shown.position.y() = bad;
        if (which == 1) shown.velocity.y() = bad;
        if (which == 2) shown.angular_velocity.y() = bad;
        if (which == 3) shown.orientation.y() = bad;
        PoseConvergence convergence(settings(row));
        convergence.restart(shown, predicted, 0);
        const Pose after = convergence.shown(predicted, 0.01);
        EXPECT_EQ(after.position, predicted.position) << row.name << ' ' << bad << ' ' << which;
        EXPECT_TRUE(is_finite(after)) << row.name << ' ' << bad << ' ' << which;
      }
      PoseConvergence convergence(settings(row));
      convergence.restart(Pose{}, pose_headed(1), bad);  // a non-finite instant
      EXPECT_TRUE(is_finite(convergence.shown(pose_headed(1), 0.01))) << row.name << ' ' << bad;
    }
  }
}

TEST(HardCases, NonFiniteNumbersAreRefusedByEveryInterface) {
  const LocalFrame frame(0.8, 0.2, 100);
  for (const double bad : kBad) {
    for (const auto member : {&KinematicState::position, &KinematicState::velocity,
                              &KinematicState::acceleration, &KinematicState::angular_velocity}) {
      KinematicState state = headed(1);
      (state.*member)[2] = bad;
      pdu::EntityState wire;
      EXPECT_NE(to_wire(state, frame, wire), ConversionError::none);
      if (member == &KinematicState::position || member == &KinematicState::velocity) {
        MotionHistory history;
        AdaptiveOrder adaptive;
        EXPECT_FALSE(history.add(motion_sample(state, 1)));
        EXPECT_FALSE(adaptive.add(motion_sample(state, 1)));
        EXPECT_TRUE(is_finite(adaptive.predict(1)));
      }
    }
    DeadbandSender sender;
    EXPECT_FALSE(sender.sample(bad, {1, 1, 1}).has_value());
    EXPECT_FALSE(sender.sample(1, {1, bad, 1}).has_value());
    EXPECT_TRUE(sender.sample(1, {1, 1, 1}).has_value()) << "still the first good one";
  }
}

TEST(HardCases, NonFiniteThresholdOrErrorSends) {
  for (double Thresholds::*const member :
       {&Thresholds::position, &Thresholds::angle, &Thresholds::force}) {
    Thresholds thresholds;
    thresholds.*member = kNan;
    UpdatePolicy policy(thresholds, 5);
    policy.sent(headed(1), 0);
    EXPECT_NE(policy.decide(pose_headed(1), 1), SendReason::none);
  }
  UpdatePolicy policy(Thresholds{}, 5);
  policy.sent(headed(1), 0);
  EXPECT_EQ(policy.decide(pose_headed(1), 1, kNan), SendReason::force);
  EXPECT_EQ(policy.decide(pose_headed(1), 1), SendReason::none);
}

}  // namespace
}  // namespace reckon::deadreckon
