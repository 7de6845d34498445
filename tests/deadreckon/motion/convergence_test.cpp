// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/deadreckon/motion/convergence.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "reckon/deadreckon/motion/drm.hpp"
#include "reckon/deadreckon/motion/rotation.hpp"
#include "reckon/tests/deadreckon/support/oracle.hpp"

namespace reckon::deadreckon {
namespace {

using Eigen::Vector3d;
using test::Random;
using Curve = ConvergenceCurve;

using NamedCurve = ConvergenceCurveRow;

// With a fixed duration, without teleports.
ConvergenceSettings settings(Curve curve, double duration) {
  ConvergenceSettings s;
  s.curve = curve;
  s.duration = s.shortest = duration;
  s.teleport_distance = 1e9;
  s.longest = 0;
  return s;
}

// The oracle's new prediction: position, velocity, acceleration from t = 0.
Pose predicted_at(const nlohmann::json& v, double t) {
  Pose pose;
  const Vector3d p = test::vector(v.at("p_new")), rate = test::vector(v.at("v_new")),
                 a = test::vector(v.at("a_new"));
  pose.position = p + t * rate + (0.5 * t * t) * a;
  pose.velocity = rate + t * a;
  return pose;
}

void check_vector(const nlohmann::json& v, const NamedCurve& named) {
  Pose displayed;
  displayed.position = test::vector(v.at("p_disp"));
  displayed.velocity = test::vector(v.at("v_disp"));
  PoseConvergence convergence(settings(named.curve, test::number(v.at("Tc"))));
  convergence.restart(displayed, predicted_at(v, 0), 0);

  const double t = test::number(v.at("t"));
  const Pose shown = convergence.shown(predicted_at(v, t), t);
  // The oracles call projective velocity blending pvb and contain no velocity for it.
  const std::string name = named.curve == Curve::projective ? "pvb" : std::string(named.name);
  const Vector3d p = test::vector(v.at("expected_p").at(name));
  EXPECT_LE((shown.position - p).lpNorm<Eigen::Infinity>(), test::number(v.at("tol_m")))
      << v.at("id") << named.name;
  if (!v.at("expected_v").contains(name)) return;
  const Vector3d rate = test::vector(v.at("expected_v").at(name));
  EXPECT_LE((shown.velocity - rate).lpNorm<Eigen::Infinity>(), test::number(v.at("tol_v")))
      << v.at("id") << named.name;
}

TEST(Convergence, MeetsEveryOracleVectorForEachCurve) {
  RECKON_NEED_DATA("oracles/convergence.json");
  int checked = 0;
  const auto file = test::oracle("convergence.json");
  for (const auto& v : file.at("position")) {
    for (const NamedCurve& named : kConvergenceCurves)
      if (named.curve != Curve::snap && named.curve != Curve::quadratic) check_vector(v, named);
    ++checked;
  }
  EXPECT_EQ(checked, 24);
}

double step_between(const Pose& a, const Pose& b) {
  return std::max({(a.position - b.position).norm(), (a.velocity - b.velocity).norm(),
                   angle_between(a.orientation, b.orientation),
                   (a.angular_velocity - b.angular_velocity).norm()});
}

TEST(Convergence, PoseAndVelocityAreContinuousAtAnyUpdate) {
  Random random(1);
  for (const NamedCurve& named : kConvergenceCurves) {
    if (named.continuity < 1) continue;
    PoseConvergence convergence(settings(named.curve, 0.3));
    KinematicState old = random.state(pdu::DeadReckoningAlgorithm::rvb, 3);
    double since = 0, now = 0;
    // Updates come before, at and after the end of the former convergence.
    for (int i = 0; i < 500; ++i) {
      now += random.real(0.01, 0.5);
      const Pose shown = convergence.shown(extrapolate(old, now - since), now);
      old = random.state(pdu::DeadReckoningAlgorithm::rvb, 3);
      old.position = shown.position + random.vector(3);
      since = now;
      convergence.restart(shown, extrapolate(old, 0), now);
      ASSERT_LE(step_between(shown, convergence.shown(extrapolate(old, 0), now)), 1e-9) << i;
    }
  }
}

TEST(Convergence, ArrivesAtThePredictionWithoutAStep) {
  Random random(2);
  PoseConvergence convergence(settings(Curve::cubic, 0.5));
  const Pose predicted = random.pose();
  convergence.restart(random.pose(), predicted, 1.0);
  EXPECT_TRUE(convergence.converging(1.4));
  EXPECT_LE(step_between(convergence.shown(predicted, 1.5 - 1e-12), predicted), 1e-9);
  EXPECT_EQ(convergence.shown(predicted, 1.5).position, predicted.position);
  EXPECT_FALSE(convergence.converging(1.5));
}

TEST(Convergence, ShowsTheRatesOfTheDisplayedPose) {
  Random random(3);
  for (const NamedCurve& named : kConvergenceCurves) {
    PoseConvergence convergence(settings(named.curve, 0.5));
    const KinematicState s = random.state(pdu::DeadReckoningAlgorithm::rvb, 2);
    Pose shown = extrapolate(s, 0);
    shown.position += random.vector(1);
    shown.orientation = random.rotation();
    shown.angular_velocity = random.vector(3);
    convergence.restart(shown, extrapolate(s, 0), 0);

    constexpr double h = 1e-5;
    const auto at = [&](double t) { return convergence.shown(extrapolate(s, t), t); };
    for (double t = 0.01; t < 0.49; t += 0.02) {
      const Pose before = at(t - h), now = at(t), after = at(t + h);
      const Vector3d velocity = (after.position - before.position) / (2 * h);
      const Vector3d spin = logarithm(before.orientation.conjugate() * after.orientation) / (2 * h);
      EXPECT_LE((now.velocity - velocity).norm(), 1e-5) << named.name;
      EXPECT_LE((now.angular_velocity - spin).norm(), 1e-5) << named.name;
    }
  }
}

TEST(Convergence, OvershootsWithinTheBoundOfItsCurve) {
  for (const NamedCurve& named : kConvergenceCurves) {
    if (named.curve == Curve::snap) continue;
    Random random(4);
    double closest = 0;
    for (int i = 0; i < 300; ++i) {
      const double duration = random.real(0.05, 2);
      PoseConvergence convergence(settings(named.curve, duration));
      Pose shown = random.pose();
      if (i % 3 == 0) shown.position.setZero();
      if (i % 3 == 1) shown.velocity.setZero();
      const double error = shown.position.norm(), rate = shown.velocity.norm();
      const double bound = named.error_bound * error + named.rate_bound * rate * duration;
      const double speed = named.speed_error * error / duration + named.speed_rate * rate;
      convergence.restart(shown, Pose{}, 0);
      for (double t = 0; t < duration; t += duration / 200) {
        const Pose at = convergence.shown(Pose{}, t);
        closest = std::max(closest, at.position.norm() / (bound + 1e-300));
        ASSERT_LE(at.position.norm(), bound * (1 + 1e-9) + 1e-12) << named.name;
        ASSERT_LE(at.velocity.norm(), speed * (1 + 1e-9) + 1e-12) << named.name;
      }
    }
    EXPECT_GE(closest, 0.99) << named.name << ": a bound that nothing reaches says nothing";
  }
}

TEST(Convergence, ListsTheCurvesInEnumerationOrder) {
  for (std::size_t i = 0; i < kConvergenceCurves.size(); ++i)
    EXPECT_EQ(static_cast<std::size_t>(kConvergenceCurves[i].curve), i);
}

// Second differences of the displayed pose, just before and just after an update in mid-correction.
TEST(Convergence, QuinticAccelerationIsContinuousOnTheSameMotion) {
  constexpr double h = 1e-4;
  PoseConvergence convergence(settings(Curve::quintic, 0.4));
  Pose shown;
  shown.position = {1, 0, 0};
  shown.velocity = {0, 2, 0};
  shown.orientation = exponential({0.1, 0, 0});
  convergence.restart(shown, Pose{}, 0);
  PoseConvergence next = convergence;
  next.restart(convergence.shown(Pose{}, 0.13), Pose{}, 0.13);
  const auto bend = [&](const PoseConvergence& c, double t) {
    const Vector3d place = c.shown(Pose{}, t - h).position - 2 * c.shown(Pose{}, t).position +
                           c.shown(Pose{}, t + h).position;
    const Vector3d turn =
        c.shown(Pose{}, t + h).angular_velocity - c.shown(Pose{}, t - h).angular_velocity;
    return std::pair<Vector3d, Vector3d>(place / (h * h), turn / (2 * h));
  };
  const auto before = bend(convergence, 0.13 - h), after = bend(next, 0.13 + h);
  ASSERT_GT(before.first.norm(), 5);
  // The third derivative stays below 1000 m/s^3: over 2 h that is 0.2.
  EXPECT_LE((before.first - after.first).norm(), 0.2);
  EXPECT_LE((before.second - after.second).norm(), 0.02);
}

TEST(Convergence, ErrorsDecayAtAnyUpdateRate) {
  for (const NamedCurve& named : kConvergenceCurves) {
    for (const double rate : {0.2, 1.0, 7.0, 60.0, 1000.0}) {
      PoseConvergence convergence(settings(named.curve, 0.1));
      Pose shown, target;
      shown.position = {1, 0, 0};
      shown.velocity = {0, 3, 0};
      shown.orientation = exponential({0, 0.5, 0});
      target.velocity = {20, 0, 0};
      convergence.restart(shown, target, 0);
      double largest = 0;
      const double end = std::max(2.0, 2 / rate);
      for (double now = 1 / rate; now < end; now += 1 / rate) {
        const Pose at = convergence.shown(target, now);
        largest = std::max(largest, (at.position - target.position).norm());
        convergence.restart(at, target, now);
      }
      const Pose last = convergence.shown(target, end);
      EXPECT_LE((last.position - target.position).norm(), 1e-3) << named.name << ' ' << rate;
      EXPECT_LE(angle_between(last.orientation, target.orientation), 1e-3) << named.name;
      EXPECT_LE(largest, 1.2 + 0.1 * 20) << named.name << ' ' << rate;
    }
  }
}

TEST(Convergence, StretchesTheDurationForLargeErrors) {
  PoseConvergence convergence;
  Pose shown, predicted;
  double now = 0;
  for (const double error : {0.001, 0.1, 0.5, 1.0, 3.0, 9.0}) {
    shown.position = {error, 0, 0};
    convergence.restart(shown, predicted, now += 10);
    const ConvergenceSettings& s = convergence.settings();
    EXPECT_DOUBLE_EQ(convergence.duration(),
                     std::clamp(1.5 * error / s.gentle_speed, s.duration, s.longest));
  }
  predicted.velocity = shown.velocity = {100, 0, 0};  // the error is a tenth of the speed
  convergence.restart(shown, predicted, now += 10);
  EXPECT_DOUBLE_EQ(convergence.duration(), 1.0);
  shown.position = {3, 0, 0};
  convergence.restart(shown, predicted, now += 10);
  EXPECT_DOUBLE_EQ(convergence.duration(), 0.45);
  shown.position.setZero();
  shown.orientation = exponential({0, 0, 1});
  convergence.restart(shown, predicted, now += 10);
  EXPECT_DOUBLE_EQ(convergence.duration(), 0.75);
}

TEST(Convergence, KeepsPaceWithFrequentUpdates) {
  PoseConvergence convergence;
  Pose shown, predicted;
  shown.position = {1e-3, 0, 0};
  convergence.restart(shown, predicted, 0);
  EXPECT_DOUBLE_EQ(convergence.duration(), 0.1);  // no earlier update to compare with
  convergence.restart(shown, predicted, 0.04);
  EXPECT_DOUBLE_EQ(convergence.duration(), 0.06);
  convergence.restart(shown, predicted, 0.041);
  EXPECT_DOUBLE_EQ(convergence.duration(), 0.02);
  shown.position = {3, 0, 0};  // large, but grown in 0.2 s
  convergence.restart(shown, predicted, 0.241);
  EXPECT_DOUBLE_EQ(convergence.duration(), 0.3);
}

// Held at its last position, the displayed copy of an entity at 20 m/s lags by at most its way in
// the time of the correction, 1.5 updates.
TEST(Convergence, KeepsUpWithAPredictionWithoutVelocity) {
  PoseConvergence convergence;
  Pose held;
  double worst = 0;
  for (double now = 0; now < 20; now += 0.05) {
    const Pose shown = convergence.shown(held, now);
    worst = std::max(worst, 20 * now - shown.position.x());
    held.position.x() = 20 * now;
    convergence.restart(shown, held, now);
  }
  EXPECT_LE(worst, 20 * 0.05 * 2.5);
}

TEST(Convergence, SnapsPastTheAngleOfATeleport) {
  ConvergenceSettings s;
  s.teleport_angle = 1;
  PoseConvergence convergence(s);
  Pose shown;
  shown.orientation = exponential({0, 0, 0.99});
  convergence.restart(shown, Pose{}, 0);
  EXPECT_TRUE(convergence.converging(0.01));
  shown.orientation = exponential({0, 0, 1.01});
  convergence.restart(shown, Pose{}, 0);
  EXPECT_FALSE(convergence.converging(0.01));
}

TEST(Convergence, QuadraticStartsWithoutAStepInVelocity) {
  Random random(6);
  PoseConvergence convergence(settings(Curve::quadratic, 0.5));
  const Pose shown = random.pose(), predicted = random.pose();
  convergence.restart(shown, predicted, 0);
  EXPECT_LE(step_between(shown, convergence.shown(predicted, 0)), 1e-9);
  EXPECT_LE((convergence.shown(predicted, 0.5 - 1e-12).position - predicted.position).norm(), 1e-9);
}

TEST(Convergence, TurnsTheShorterWay) {
  PoseConvergence convergence(settings(Curve::cubic, 1.0));
  Pose shown;
  shown.orientation = exponential({0, 0, 3.0});
  shown.orientation.coeffs() *= -1;  // the same orientation
  convergence.restart(shown, Pose{}, 0);
  for (double t = 0; t < 1; t += 0.01) {
    ASSERT_LE(angle_between(convergence.shown(Pose{}, t).orientation, Pose{}.orientation),
              3.0 + 1e-12);
  }
}

TEST(Convergence, SnapsAtATeleport) {
  PoseConvergence convergence({Curve::cubic, 0.1, 10.0});
  Pose shown, predicted;
  predicted.position = {9.9, 0, 0};
  convergence.restart(shown, predicted, 0);
  EXPECT_TRUE(convergence.converging(0.05));
  predicted.position = {10.1, 0, 0};
  convergence.restart(shown, predicted, 1);
  EXPECT_FALSE(convergence.converging(1.05));
  EXPECT_EQ(convergence.shown(predicted, 1).position, predicted.position);
}

TEST(Convergence, SnapsOnNumbersThatAreNotFinite) {
  for (const auto member : {&Pose::position, &Pose::velocity, &Pose::angular_velocity}) {
    PoseConvergence convergence;
    Pose shown;
    (shown.*member)[0] = std::numeric_limits<double>::quiet_NaN();
    convergence.restart(shown, Pose{}, 0);
    EXPECT_TRUE(is_finite(convergence.shown(Pose{}, 0.01)));
  }
  PoseConvergence convergence;
  convergence.restart(Pose{}, Pose{}, 0);
  EXPECT_TRUE(is_finite(convergence.shown(Pose{}, std::numeric_limits<double>::quiet_NaN())));
}

TEST(Convergence, ZeroDurationShowsThePredictionAtOnce) {
  for (const ConvergenceSettings& s :
       {ConvergenceSettings{Curve::snap, 0.1, 10}, ConvergenceSettings{Curve::cubic, 0.0, 10}}) {
    PoseConvergence convergence(s);
    Pose predicted;
    predicted.position = {1, 0, 0};
    convergence.restart(Pose{}, predicted, 0);
    EXPECT_EQ(convergence.shown(predicted, 0).position, predicted.position);
  }
}

TEST(Convergence, KeepsATenthOfASecondByDefault) {
  EXPECT_GE(PoseConvergence().settings().duration, 0.1);
}

}  // namespace
}  // namespace reckon::deadreckon
