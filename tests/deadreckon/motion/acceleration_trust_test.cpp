// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/deadreckon/motion/acceleration_trust.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

#include "reckon/deadreckon/motion/motion_history.hpp"
#include "reckon/deadreckon/motion/rotation.hpp"
#include "reckon/deadreckon/sending/model_choice.hpp"
#include "reckon/deadreckon/sending/update_policy.hpp"
#include "reckon/tests/deadreckon/support/oracle.hpp"

namespace reckon::deadreckon {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;
using Model = pdu::DeadReckoningAlgorithm;
using test::Random;

constexpr double kWithoutEnd = std::numeric_limits<double>::infinity();
constexpr double kUndefined = std::numeric_limits<double>::quiet_NaN();
constexpr double kFallRate = 9.81;

KinematicState moving(Model model, const Vector3d& velocity, const Vector3d& acceleration) {
  KinematicState state;
  state.algorithm = model;
  state.velocity = velocity;
  state.acceleration = acceleration;
  return state;
}

KinematicState random_state(Random& random, Model model) {
  KinematicState state = moving(model, random.vector(20), random.vector(30));
  state.position = random.vector(100);
  state.orientation = random.rotation();
  state.angular_velocity = random.vector(2);
  return state;
}

// Displacement per acceleration after tau, with trust T: the integral of tau, then 2T - tau, then
// 0.
double reach(double tau, double trust) {
  if (tau <= trust) return tau * tau / 2;
  const double back = std::max(0.0, 2 * trust - tau);
  return trust * trust - back * back / 2;
}

TEST(AccelerationTrust, LastsFourTimesVelocityOverAcceleration) {
  EXPECT_DOUBLE_EQ(acceleration_trust(moving(Model::rvw, {3, 4, 0}, {0, 0, 2})), 10.0);
  EXPECT_DOUBLE_EQ(acceleration_trust(moving(Model::rvb, {0, 0, 0}, {0, 0, 2})), 0.0);
  EXPECT_EQ(acceleration_trust(moving(Model::fvw, {3, 4, 0}, {0, 0, 0})), kWithoutEnd);
  EXPECT_EQ(acceleration_trust(moving(Model::rpw, {3, 4, 0}, {0, 0, 2})), kWithoutEnd);
  EXPECT_EQ(acceleration_trust(KinematicState{}), kWithoutEnd);
}

TEST(AccelerationTrust, PoseWithinItIsTheStandardPose) {
  Random random(1);
  for (int i = 0; i < 20000; ++i) {
    const auto model = static_cast<Model>(i % 10);
    const KinematicState state = random_state(random, model);
    const double trust = std::min(acceleration_trust(state), 100.0);
    const double tau = random.real(-5, 1) * trust;
    if (is_beyond_trust(state, tau)) continue;  // by rounding at the very end
    const Pose standard = extrapolate(state, tau), trusted = extrapolate_trusted(state, tau);
    ASSERT_EQ(standard.position, trusted.position) << i;
    ASSERT_EQ(standard.orientation.coeffs(), trusted.orientation.coeffs()) << i;
    ASSERT_EQ(standard.velocity, trusted.velocity) << i;
  }
}

TEST(AccelerationTrust, InReferenceAxesFollowsTheClosedForm) {
  Random random(2);
  for (int i = 0; i < 5000; ++i) {
    const KinematicState state = random_state(random, i % 2 == 0 ? Model::rvw : Model::fvw);
    const double trust = acceleration_trust(state), tau = random.real(0, 4) * trust;
    const Pose pose = extrapolate_trusted(state, tau);
    const Vector3d expected =
        state.position + tau * state.velocity + reach(tau, trust) * state.acceleration;
    // Rounding of some hundred metres.
    ASSERT_LT((pose.position - expected).norm(), 1e-9 * (1 + expected.norm())) << i;
    const double change = std::max(0.0, std::min(tau, 2 * trust - tau));
    const Vector3d velocity = state.velocity + change * state.acceleration;
    ASSERT_LT((pose.velocity - velocity).norm(), 1e-9 * (1 + velocity.norm())) << i;
    ASSERT_LT(angle_between(pose.orientation, extrapolate(state, tau).orientation), 1e-7) << i;
  }
}

TEST(AccelerationTrust, PositionAndVelocityAreContinuousAtItsEnd) {
  Random random(3);
  for (int i = 0; i < 3000; ++i) {
    const auto model = static_cast<Model>(i % 10);
    const KinematicState state = random_state(random, model);
    const double trust = acceleration_trust(state);
    if (!std::isfinite(trust)) continue;
    for (const double at : {trust, 2 * trust}) {
      const double h = 1e-9 * at;
      const Pose before = extrapolate_trusted(state, at - h);
      const Pose after = extrapolate_trusted(state, at + h);
      const double speed = (1 + kTrustedChange) * state.velocity.norm();
      const double change = state.acceleration.norm() + state.angular_velocity.norm() * speed;
      ASSERT_LE((after.position - before.position).norm(), 2 * h * speed + 1e-9) << i;
      ASSERT_LE((after.velocity - before.velocity).norm(), 2 * h * change + 1e-9) << i;
    }
  }
}

// Velocity in body axes by numerical integration of the same law.
TEST(AccelerationTrust, InBodyAxesEqualsTheIntegratedVelocity) {
  Random random(4);
  for (int i = 0; i < 30; ++i) {
    const KinematicState state = random_state(random, Model::rvb);
    const double trust = acceleration_trust(state), end = random.real(1, 3) * trust;
    constexpr int kSteps = 20000;
    const double dt = end / kSteps;
    Vector3d position = state.position;
    for (int k = 0; k < kSteps; ++k) {
      const double t = (k + 0.5) * dt;
      const double change = std::max(0.0, std::min(t, 2 * trust - t));
      position += dt * (state.orientation * exponential(t * state.angular_velocity) *
                        (state.velocity + change * state.acceleration));
    }
    // The error of the midpoint rule is the second derivative times dt^2.
    EXPECT_LT((extrapolate_trusted(state, end).position - position).norm(), 1e-4) << i;
  }
}

TEST(AccelerationTrust, BounceSampleMovesABallABoundedDistance) {
  const KinematicState bounce = moving(Model::rvw, {0, 0, 5}, {0, 0, 600});
  const auto stray = [&](const Pose& pose, double t) {
    return (pose.position - t * bounce.velocity).norm();
  };
  EXPECT_NEAR(stray(extrapolate(bounce, 1), 1), 300, 1e-9);
  // kTrustedChange^2 |V|^2 / |A|
  EXPECT_NEAR(stray(extrapolate_trusted(bounce, 1), 1), 16 * 25.0 / 600, 1e-9);
  EXPECT_NEAR(stray(extrapolate_trusted(bounce, 60), 60), 16 * 25.0 / 600, 1e-9);
}

TEST(AccelerationTrust, ThrownBallIsTrustedUntilItFallsBack) {
  const KinematicState thrown = moving(Model::rvw, {2, 0, 6}, {0, 0, -kFallRate});
  const double flight = 2 * 6 / kFallRate;
  EXPECT_FALSE(is_beyond_trust(thrown, 1.9 * flight));
}

TEST(AccelerationTrust, SteadyBodyAxisTurnIsTrustedForEver) {
  // 100 m at 20 m/s: the rate of the body components is 0.
  KinematicState turn = moving(Model::rvb, {20, 0, 0}, {0, 0, 0});
  turn.angular_velocity = {0, 0, 0.2};
  const double tau = 600;
  const Pose pose = extrapolate_trusted(turn, tau);
  const Vector3d on_circle(100 * std::sin(0.2 * tau), 100 * (1 - std::cos(0.2 * tau)), 0);
  EXPECT_LT((pose.position - on_circle).norm(), 1e-9);
}

TEST(AccelerationTrust, IsFiniteForEveryFloatAndTime) {
  constexpr double kHuge = std::numeric_limits<float>::max();
  constexpr double kTiny = std::numeric_limits<float>::denorm_min();
  for (const Model model : {Model::rvw, Model::fvw, Model::rvb, Model::fvb}) {
    for (const double v : {0.0, kTiny, 1.0, kHuge}) {
      for (const double a : {0.0, kTiny, 1.0, kHuge}) {
        KinematicState state = moving(model, {v, 0, 0}, {0, a, a});
        state.angular_velocity = {0, 0.1, 0};
        for (const double tau : {0.0, 1e-9, 1.0, 3600.0, 1e300, -1.0, kWithoutEnd, kUndefined}) {
          EXPECT_TRUE(is_finite(extrapolate_trusted(state, tau)))
              << static_cast<int>(model) << " " << v << " " << a << " " << tau;
        }
        EXPECT_FALSE(is_beyond_trust(state, kUndefined));
        EXPECT_FALSE(is_beyond_trust(state, 0));
        EXPECT_FALSE(is_beyond_trust(state, -1));
      }
    }
  }
  const KinematicState bad = moving(Model::rvw, {kUndefined, 0, 0}, {1, 0, 0});
  EXPECT_FALSE(is_beyond_trust(bad, 1e6));
  EXPECT_FALSE(is_finite(extrapolate_trusted(bad, 1)));
}

MotionSample falling(double t) {
  return {t,
          {0, 0, -kFallRate * t * t / 2},
          Quaterniond::Identity(),
          {0, 0, -kFallRate * t},
          {0, 0, -kFallRate},
          {0, 0, 0}};
}

struct FallSeen {
  int updates = 0;
  double reckon = 0, standard = 0;  // largest errors [m]
};

// An owner without heartbeats, with thresholds of 0.1 m. Errors are sampled before each update.
FallSeen fall(double seconds, double first, double step = 1e-3, bool looks_ahead = false) {
  Thresholds thresholds;
  thresholds.position = 0.1;
  UpdatePolicy policy(thresholds, 1000);
  if (looks_ahead) policy.look_again_after(step);
  FallSeen seen;
  KinematicState sent;
  double since = 0;
  for (double t = first; t < first + seconds; t += step) {
    const MotionSample truth = falling(t);
    if (seen.updates > 0) {
      const auto error = [&](const Pose& pose) { return (pose.position - truth.position).norm(); };
      seen.reckon = std::max(seen.reckon, error(extrapolate_trusted(sent, t - since)));
      seen.standard = std::max(seen.standard, error(extrapolate(sent, t - since)));
    }
    const Pose pose{truth.position, truth.orientation, truth.velocity, truth.angular_velocity};
    const SendReason reason = policy.decide(pose, t);
    if (reason == SendReason::none) continue;
    sent = kinematic_state(truth, Model::rvw);
    since = t;
    policy.sent(sent, t, reason);
    ++seen.updates;
  }
  return seen;
}

TEST(AccelerationTrust, BothViewersKeepTheThresholdInFreeFall) {
  const FallSeen seen = fall(20, 0);
  EXPECT_LT(seen.reckon, 0.11);
  EXPECT_LT(seen.standard, 0.11);
  // At rest, after 0.14 s (0.1 m), and then at about five times the time of the last update.
  EXPECT_LE(seen.updates, 5);
}

TEST(AccelerationTrust, FallIsTrustedForFourTimesItsAge) { EXPECT_EQ(fall(3.9, 1.0).updates, 1); }

TEST(AccelerationTrust, SlowlyPolledOwnerSendsBeforeItEnds) {
  const FallSeen late = fall(20, 1, 1), ahead = fall(20, 1, 1, true);
  EXPECT_GT(late.reckon, 9) << "trusted for 4 s, seen after 5";
  EXPECT_LT(ahead.reckon, 1e-9);
  EXPECT_LT(ahead.standard, 1e-9);
  EXPECT_EQ(ahead.updates, late.updates);
}

TEST(AccelerationTrust, SteadyTurnCostsNoExtraUpdate) {
  const auto on_circle = [](double t) {
    const Vector3d out(std::cos(0.2 * t), std::sin(0.2 * t), 0);
    const Vector3d along(-out.y(), out.x(), 0);
    return MotionSample{
        t,
        100 * out,
        Quaterniond(Eigen::AngleAxisd(0.2 * t + std::numbers::pi / 2, Vector3d::UnitZ())),
        20 * along,
        -4 * out,
        {0, 0, 0.2}};
  };
  for (const Model model : {Model::rvw, Model::rvb}) {
    UpdatePolicy policy({}, 1000);
    KinematicState sent;
    int by_policy = 0, by_standard = 0;
    double since = 0;
    for (double t = 0; t < 300; t += 1.0 / 60) {
      const MotionSample truth = on_circle(t);
      const Pose pose{truth.position, truth.orientation, truth.velocity, truth.angular_velocity};
      const SendReason reason = policy.decide(pose, t);
      if (reason != SendReason::none) {
        policy.sent(kinematic_state(truth, model), t, reason);
        ++by_policy;
      }
      const Pose seen = extrapolate(sent, t - since);
      const bool off = (seen.position - truth.position).norm() > Thresholds{}.position ||
                       angle_between(seen.orientation, truth.orientation) > Thresholds{}.angle;
      if (by_standard > 0 && !off) continue;
      sent = kinematic_state(truth, model);
      since = t;
      ++by_standard;
    }
    EXPECT_EQ(by_policy, by_standard) << static_cast<int>(model);
  }
}

}  // namespace
}  // namespace reckon::deadreckon
