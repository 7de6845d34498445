// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/deadreckon/sending/model_choice.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include "reckon/deadreckon/motion/drm.hpp"
#include "reckon/deadreckon/motion/rotation.hpp"
#include "reckon/tests/deadreckon/support/oracle.hpp"

namespace reckon::deadreckon {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;
using Model = pdu::DeadReckoningAlgorithm;
using test::Random;
using Motion = std::function<MotionSample(double)>;

Quaterniond heading(double angle) {
  return Quaterniond(Eigen::AngleAxisd(angle, Vector3d::UnitZ()));
}

MotionSample straight(double t) {
  return {t, {10 * t, 0, 0}, heading(0), {10, 0, 0}, {0, 0, 0}, {0, 0, 0}};
}

MotionSample speeding_up(double t) {
  return {t, {t * t, 0, 0}, heading(0), {2 * t, 0, 0}, {2, 0, 0}, {0, 0, 0}};
}

MotionSample turning_on_the_spot(double t) {
  return {t, {5, 5, 5}, heading(0.5 * t), {0, 0, 0}, {0, 0, 0}, {0, 0, 0.5}};
}

// 100 m at 20 m/s, nose along the path.
MotionSample circle(double t) {
  const double w = 0.2, angle = w * t;
  const Vector3d out(std::cos(angle), std::sin(angle), 0);
  const Vector3d along(-out.y(), out.x(), 0);
  return {t,
          100 * out,
          heading(angle + std::numbers::pi / 2),
          100 * w * along,
          -100 * w * w * out,
          {0, 0, w}};
}

// The same, accelerating along the circle.
MotionSample faster_circle(double t) {
  const double angle = 0.2 * t + 0.01 * t * t, w = 0.2 + 0.02 * t;
  const Vector3d out(std::cos(angle), std::sin(angle), 0);
  const Vector3d along(-out.y(), out.x(), 0);
  return {t,
          100 * out,
          heading(angle + std::numbers::pi / 2),
          100 * w * along,
          -100 * w * w * out + 2 * along,
          {0, 0, w}};
}

Model chosen_for(const Motion& motion, double seconds = 60) {
  ModelChoice choice;
  for (double t = 0; t < seconds; t += 1.0 / 60) choice.note(motion(t), {});
  return choice.chosen();
}

TEST(ModelChoice, TakesTheSimplestModelThatFitsTheMotion) {
  EXPECT_EQ(chosen_for(straight), Model::fpw);
  EXPECT_EQ(chosen_for(speeding_up), Model::rvw);
  EXPECT_EQ(chosen_for(turning_on_the_spot), Model::rpw);
  EXPECT_EQ(chosen_for(circle), Model::rpb);
  EXPECT_EQ(chosen_for(faster_circle, 20), Model::rvb);
}

TEST(ModelChoice, TrustsNoAccelerationThatIsNoise) {
  Random random(3);
  EXPECT_EQ(chosen_for([&](double t) {
              MotionSample sample = straight(t);
              sample.acceleration = random.vector(5);
              return sample;
            }),
            Model::fpw);
}

TEST(ModelChoice, FollowsAChangeOfTheMotion) {
  ModelChoice choice;
  for (double t = 0; t < 120; t += 1.0 / 60) {
    choice.note(t < 60 ? circle(t) : speeding_up(t), {});
    if (t < 50) continue;
    if (t < 60) {
      EXPECT_EQ(choice.chosen(), Model::rpb);
    }
  }
  EXPECT_TRUE(drm_terms(choice.chosen()).acceleration);  // RVB without a turn is RVW
}

// Number of updates of an owner with one model, or with the choice.
int updates(const Motion& motion, const std::function<Model(const MotionSample&)>& model,
            double seconds = 180) {
  KinematicState sent;
  double since = 0;
  int count = 0;
  for (double t = 0; t < seconds; t += 0.1) {
    const MotionSample truth = motion(t);
    const Model now = model(truth);
    const Pose seen = extrapolate(sent, t - since);
    const bool off = (seen.position - truth.position).norm() > Thresholds{}.position ||
                     angle_between(seen.orientation, truth.orientation) > Thresholds{}.angle;
    if (count > 0 && !off) continue;
    sent = kinematic_state(truth, now);
    since = t;
    ++count;
  }
  return count;
}

// No model is best for all three parts: the choice needs fewer updates than any model alone.
TEST(ModelChoice, BeatsEverySingleModelOnChangingMotion) {
  const Motion mixed = [random = Random(5)](double t) mutable {
    if (t < 60) return circle(t);
    if (t < 120) return faster_circle(t - 60);
    MotionSample sample = straight(t);
    sample.acceleration = random.vector(20);
    sample.angular_velocity = random.vector(0.5);
    return sample;
  };
  ModelChoice choice;
  const int by_choice = updates(mixed, [&](const MotionSample& truth) {
    choice.note(truth, {});
    return choice.chosen();
  });
  for (const Model model : kChosenModels) {
    const int alone = updates(mixed, [&](const MotionSample&) { return model; });
    EXPECT_LT(by_choice, alone) << static_cast<int>(model);
  }
}

TEST(ModelChoice, BeginsWithTheSimplestSufficientModel) {
  const auto first = [](const MotionSample& sample) {
    ModelChoice choice;
    choice.note(sample, {});
    return choice.chosen();
  };
  EXPECT_EQ(ModelChoice().chosen(), Model::fpw);
  EXPECT_EQ(first(straight(1)), Model::fpw);
  EXPECT_EQ(first(speeding_up(1)), Model::rvw);
  EXPECT_EQ(first(turning_on_the_spot(1)), Model::rpw);
  EXPECT_EQ(first(circle(1)), Model::rpb);
  EXPECT_EQ(first(faster_circle(1)), Model::rvb);
  MotionSample huge = straight(1);
  huge.position.x() = huge.velocity.x() = std::numeric_limits<double>::max();
  EXPECT_EQ(first(huge), Model::rvb);  // nothing can be distinguished there
}

// The first update after a turn begins shall contain it, so a vehicle that is not turning yet is
// prepared for RPB. Until it turns, RPB equals FPW and is named so.
TEST(ModelChoice, ReportsTheFirstTurnAfterAStraightPath) {
  const auto bend = [](double t) { return t < 20 ? straight(t) : circle(t); };
  const auto named = [&](const Thresholds& thresholds, double until) {
    ModelChoice choice;
    for (double t = 0; t < until; t += 0.1) choice.note(bend(t), thresholds);
    return choice.chosen();
  };
  EXPECT_EQ(named({}, 20), Model::fpw);
  EXPECT_EQ(named({}, 20.2), Model::rpb);
  Thresholds any_angle;
  any_angle.angle = 4;
  EXPECT_EQ(named(any_angle, 20), Model::fpw);
  EXPECT_EQ(named(any_angle, 20.2), Model::fpw);
}

// Rests for 10 s, accelerates for 3 s, drives for 4 s, brakes for 3 s, and so on.
MotionSample stop_and_go(double time) {
  const double lap = std::floor(time / 20), t = time - 20 * lap;
  const double up = std::clamp(t - 10, 0.0, 3.0), down = std::clamp(t - 17, 0.0, 3.0);
  const double level = std::clamp(t - 13, 0.0, 4.0);
  const double a = t < 10 ? 0 : t < 13 ? 2 : t < 17 ? 0 : -2;
  const double x = 42 * lap + up * up + 6 * level + 6 * down - down * down;
  return {time, {x, 0, 0}, heading(0), {2 * (up - down), 0, 0}, {a, 0, 0}, {0, 0, 0}};
}

// The models of the closed forms, and the cost of learning them.
TEST(ModelChoice, CostsAtMostTwoPerCentMore) {
  struct Case {
    const char* name;
    Motion motion;
    double seconds;
    Model best;
  };
  const Case cases[] = {{"turns evenly", circle, 600, Model::rpb},
                        {"speeds up", speeding_up, 600, Model::rvw},
                        {"stands and goes", stop_and_go, 3600, Model::rvw}};
  for (const Case& path : cases) {
    ModelChoice choice;
    int named = 0;
    const int by_choice = updates(
        path.motion,
        [&](const MotionSample& truth) {
          choice.note(truth, {});
          named += choice.chosen() == path.best ? 1 : 0;
          return choice.chosen();
        },
        path.seconds);
    int best = std::numeric_limits<int>::max();
    for (const Model model : kChosenModels) {
      const auto always = [model](const MotionSample&) { return model; };
      best = std::min(best, updates(path.motion, always, path.seconds));
    }
    const auto alone = [&](const MotionSample&) { return path.best; };
    EXPECT_EQ(updates(path.motion, alone, path.seconds), best) << path.name;
    EXPECT_LE(by_choice, best + 0.02 * best) << path.name;
    EXPECT_GT(named, 9.7 * path.seconds) << path.name;
  }
}

// Accelerates at 2 m/s^2, but the first sample has no acceleration: FPW reaches an error of 1 m
// each second, RVW once. Two updates against one may be chance; more are not.
TEST(ModelChoice, IsNotMisledByTheFirstFewUpdates) {
  Thresholds any_angle;
  any_angle.angle = 4;
  const auto chosen_after = [&](double seconds) {
    ModelChoice choice;
    for (double t = 0; t < seconds; t += 0.1) {
      MotionSample sample = speeding_up(t);
      if (t == 0) sample.acceleration.setZero();
      choice.note(sample, any_angle);
    }
    return choice.chosen();
  };
  EXPECT_EQ(chosen_after(3), Model::fpw);
  EXPECT_EQ(chosen_after(10), Model::rvw);
}

TEST(ModelChoice, IgnoresSamplesThatAreNotFinite) {
  ModelChoice choice;
  MotionSample bad = straight(0);
  bad.position.x() = std::numeric_limits<double>::quiet_NaN();
  choice.note(bad, {});
  for (double t = 0; t < 60; t += 0.1) {
    choice.note(circle(t), {});
    bad.time = t;
    choice.note(bad, {});
  }
  EXPECT_EQ(choice.chosen(), Model::rpb);
}

// The same pose, velocity and acceleration are restored, as far as the model contains them.
TEST(KinematicState, OfASampleRestoresTheSample) {
  Random random(8);
  for (int model = 0; model <= 9; ++model) {
    const auto algorithm = static_cast<Model>(model);
    const DrmTerms terms = drm_terms(algorithm);
    for (int i = 0; i < 100; ++i) {
      MotionSample sample{1.0,
                          random.vector(1e3),
                          random.rotation(),
                          random.vector(50),
                          random.vector(9),
                          random.vector(2)};
      const MotionSample again = motion_sample(kinematic_state(sample, algorithm), 1.0);
      if (!terms.velocity) sample.velocity.setZero();
      // A turning body accelerates across its path whether the model contains an acceleration or
      // not.
      if (!terms.rotation) sample.angular_velocity.setZero();
      EXPECT_EQ(again.position, sample.position);
      EXPECT_NEAR((again.velocity - sample.velocity).norm(), 0, 1e-12);
      EXPECT_EQ(again.angular_velocity, sample.angular_velocity);
      if (terms.acceleration) {
        EXPECT_NEAR((again.acceleration - sample.acceleration).norm(), 0, 1e-11) << model;
      }
    }
  }
}

}  // namespace
}  // namespace reckon::deadreckon
