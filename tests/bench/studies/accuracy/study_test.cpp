// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The studies of poses against closed forms, and the marking of undominated settings.
#include "reckon/bench/studies/accuracy/study.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "reckon/bench/studies/accuracy/circle_study.hpp"
#include "reckon/bench/studies/accuracy/equal_error.hpp"
#include "reckon/bench/studies/pose/study_text.hpp"
#include "reckon/bench/studies/tracks/motions.hpp"
#include "reckon/deadreckon/sending/update_policy.hpp"

namespace reckon::bench::study_test {
namespace {

using deadreckon::ConvergenceCurve;

PoseModel model(std::string_view name) {
  return *std::find_if(kPoseModels.begin(), kPoseModels.end(),
                       [&](const PoseModel& row) { return row.name == name; });
}

StudySubject subject(std::string_view name, double seconds) {
  const auto row = std::find_if(motions().begin(), motions().end(),
                                [&](const Motion& motion) { return motion.name == name; });
  return {std::string(name), "", {row->generate(seconds, 1)}};
}

/// One model, 1 m, position only, no heartbeat, snap.
AccuracyGrid grid_of(std::string_view name) {
  AccuracyGrid grid;
  grid.models = {model(name)};
  grid.curves = {ConvergenceCurve::snap};
  grid.angle = kAnyAngle;
  grid.heartbeat = kNoHeartbeat;
  return grid;
}

PoseResult result_of(std::string_view motion, const AccuracyGrid& grid, double seconds = 60) {
  return run_accuracy_study(subject(motion, seconds), grid).rows.front().result;
}

// --- closed forms ---

TEST(PoseStudy, NeedsOneUpdateForAStraightLine) {
  for (const PoseModel& row : kPoseModels) {
    if (row.name == "static") continue;
    const PoseResult result = result_of("straight", grid_of(row.name));
    EXPECT_EQ(result.updates, 1U) << row.name;
    // Float velocities on the wire: 6e-8 of 1,200 m.
    EXPECT_LE(result.position.max, 2e-4) << row.name;
  }
}

TEST(PoseStudy, AddsHeartbeatsToTheOneUpdate) {
  AccuracyGrid grid = grid_of("fpw");
  grid.heartbeat = 5;
  // At the first sample at or after the heartbeat, and again from there.
  const double wait = std::min(5.0, deadreckon::jittered_heartbeat(5, {1, 1, 0}));
  const auto samples = static_cast<std::uint64_t>(std::ceil(wait * 60 - 1e-9));
  EXPECT_EQ(result_of("straight", grid).updates, 1 + 3600 / samples);
}

TEST(PoseStudy, RepeatsAChangeAfterDoublingSilences) {
  AccuracyGrid grid = grid_of("fpw");
  grid.heartbeat = 50;
  grid.first_heartbeat = 0.5;
  // At 0, and after 0.5, 1, 2, 4, 8 and 16 s of silence: at 31.5 s; the next would be at 63.5 s.
  EXPECT_EQ(result_of("straight", grid).updates, 7U);
}

TEST(PoseStudy, TurningModelNeedsOneUpdateForACircle) {
  for (const char* name : {"rpb", "rvb"}) {
    const PoseResult result = result_of("circle", grid_of(name));
    EXPECT_EQ(result.updates, 1U) << name;
    EXPECT_LE(result.position.max, 1e-3) << name;
    EXPECT_LE(result.angle.max, 1e-5) << name;
  }
}

TEST(PoseStudy, TangentModelSendsWhenItLeavesTheCircle) {
  // FPW moves along the tangent: its error is |(wt - sin wt, 1 - cos wt)| r.
  const auto off = [](std::uint64_t samples) {
    const double angle = 0.2 * static_cast<double>(samples) / 60;
    return 100 * std::hypot(angle - std::sin(angle), 1 - std::cos(angle));
  };
  std::uint64_t samples = 1;
  while (off(samples) <= 1) ++samples;
  const PoseResult result = result_of("circle", grid_of("fpw"));
  EXPECT_EQ(result.updates, 1 + 3600 / samples);
  EXPECT_NEAR(result.position.max, off(samples), 1e-3);
}

TEST(PoseStudy, HeldFastPositionIsSentAtEverySample) {
  AccuracyGrid grid = grid_of("static");
  grid.thresholds = {0.1};  // 20 m/s / 60 Hz = 0.33 m
  const PoseResult result = result_of("straight", grid, 10);
  EXPECT_EQ(result.updates, 601U);
  EXPECT_NEAR(result.position.max, 20.0 / 60, 1e-3);
}

TEST(PoseStudy, CountsUpdatesByTheirModels) {
  const PoseResult result = result_of("weave", grid_of("auto"));
  std::uint64_t sum = 0;
  for (const std::uint64_t updates : result.by_model) sum += updates;
  EXPECT_EQ(sum, result.updates);
  const auto fpw = static_cast<std::size_t>(pdu::DeadReckoningAlgorithm::fpw);
  EXPECT_EQ(result_of("weave", grid_of("fpw")).by_model[fpw],
            result_of("weave", grid_of("fpw")).updates);
}

TEST(PoseStudy, ErrorIsWithinTheThresholdPlusOneSample) {
  for (const Motion& motion : motions()) {
    if (motion.name == "jump") continue;
    const StudySubject moving = subject(motion.name, 30);
    double speed = 0, acceleration = 0;
    for (const auto& sample : moving.tracks.front().samples) {
      speed = std::max(speed, sample.velocity.norm());
      acceleration = std::max(acceleration, sample.acceleration.norm());
    }
    for (const PoseModel& row : kPoseModels) {
      if (row.prediction != Prediction::as_sent) continue;
      AccuracyGrid grid = grid_of(row.name);
      grid.thresholds = {motion.thresholds[2]};
      grid.heartbeat = 5;
      // Truth and prediction may both move, the latter with the speed gained in 5 s.
      const double moved = (2 * speed + 5 * acceleration) / 60;
      EXPECT_LE(run_accuracy_study(moving, grid).rows.front().result.position.max,
                motion.thresholds[2] + moved)
          << motion.name << " " << row.name;
    }
  }
}

// --- the study ---

TEST(AccuracyStudy, GivesTheSameTwice) {
  AccuracyGrid grid;
  grid.thresholds = {0.2, 1};
  grid.network = {peer::delayed_by(0.08, 0.4, 0.1), 5};
  const auto a = run_accuracy_study(subject("weave", 10), grid);
  const auto b = run_accuracy_study(subject("weave", 10), grid);
  ASSERT_EQ(a.rows.size(), 2 * kPoseModels.size());
  for (std::size_t i = 0; i < a.rows.size(); ++i) {
    EXPECT_EQ(a.rows[i].result.updates, b.rows[i].result.updates);
    EXPECT_EQ(a.rows[i].result.position.rms, b.rows[i].result.position.rms);
    EXPECT_EQ(a.rows[i].result.velocity_step.max, b.rows[i].result.velocity_step.max);
    EXPECT_EQ(a.rows[i].beaten.has_value(), b.rows[i].beaten.has_value());
  }
}

TEST(AccuracyStudy, GivesTheMedianOfItsSeeds) {
  const StudySubject moving = subject("weave", 10);
  PoseSetting setting;
  setting.model = pdu::DeadReckoningAlgorithm::rvw;
  peer::ImpairmentConfig network{peer::delayed_by(0.1, 0.5, 0.3)};
  std::vector<double> each;
  for (network.seed = 1; network.seed <= 3; ++network.seed)
    each.push_back(run_pose_study(moving.tracks, setting, network).position.rms);
  network.seed = 1;
  const double middle = run_seeds(moving.tracks, setting, network, 3).position.rms;
  std::sort(each.begin(), each.end());
  EXPECT_LT(each[0], each[2]);
  EXPECT_EQ(middle, each[1]);
}

TEST(AccuracyStudy, UsesTheConvergenceOfTheGrid) {
  AccuracyGrid grid = grid_of("fpw");
  grid.curves = {ConvergenceCurve::linear};
  grid.convergence.duration = 1e-6;  // over before the next sample: snap
  grid.convergence.longest = 0;
  EXPECT_EQ(result_of("weave", grid).position.rms, result_of("weave", grid_of("fpw")).position.rms);
  grid.convergence.duration = 0.5;
  EXPECT_GT(result_of("weave", grid).position.rms,
            1.1 * result_of("weave", grid_of("fpw")).position.rms);
}

TEST(AccuracyStudy, StopsOnRequest) {
  AccuracyGrid grid;
  grid.thresholds = {1, 2, 5};
  const auto two = run_accuracy_study(subject("circle", 2), grid,
                                      [](std::size_t done, std::size_t) { return done < 2; });
  EXPECT_EQ(two.rows.size(), 2U);
}

TEST(AccuracyStudy, GivesTheVelocityStepOfTheTruth) {
  // v w h = 20 x 0.2 / 60 along the chord.
  EXPECT_NEAR(run_accuracy_study(subject("circle", 5), AccuracyGrid{}).own_velocity_step, 4.0 / 60,
              1e-6);
  EXPECT_NEAR(run_accuracy_study(subject("straight", 5), AccuracyGrid{}).own_velocity_step, 0,
              1e-9);
}

TEST(AccuracyStudy, CountsUdpAndIpWithTheEntityState) {
  AccuracyGrid grid = grid_of("static");
  grid.thresholds = {0.1};
  const auto result = run_accuracy_study(subject("straight", 10), grid);
  EXPECT_DOUBLE_EQ(result.rows.front().octets_per_second(), 172 * 60.1);
}

TEST(QueryCosts, WeighTheModelsByTheirUpdates) {
  QueryCosts costs;
  const auto cubic = static_cast<std::size_t>(ConvergenceCurve::cubic);
  costs.as_sent[2][cubic] = 20;
  costs.as_sent[8][cubic] = 60;
  costs.adaptive[cubic] = 90;
  PoseResult result;
  result.by_model[2] = 1;
  result.by_model[8] = 3;
  EXPECT_DOUBLE_EQ(costs.of(result, Prediction::as_sent, ConvergenceCurve::cubic), 50);
  EXPECT_DOUBLE_EQ(costs.of(result, Prediction::adaptive, ConvergenceCurve::cubic), 90);
}

// --- equal error ---

TEST(EqualError, FindsThatAModelSavesNothingAgainstItself) {
  const StudySubject moving = subject("weave", 20);
  const EqualError found =
      find_equal_error(moving.tracks, grid_of("rvw"), model("rvw"), 1, model("rvw"));
  ASSERT_GT(found.threshold, 0);
  EXPECT_LE(found.result.position.p99, found.baseline_result.position.p99);
  EXPECT_GE(found.saving(), 0);
  EXPECT_LT(found.saving(), 0.1);
}

TEST(EqualError, TurningModelNeedsOneUpdateForACircle) {
  const StudySubject moving = subject("circle", 20);
  const EqualError found =
      find_equal_error(moving.tracks, grid_of("fpw"), model("fpw"), 1, model("rvb"));
  EXPECT_EQ(found.result.updates, 1U);
  EXPECT_GT(found.saving(), 0.9);
}

TEST(EqualError, ReportsThatNoThresholdSuffices) {
  const StudySubject moving = subject("circle", 20);
  const EqualError found =
      find_equal_error(moving.tracks, grid_of("rvb"), model("rvb"), 1, model("static"));
  EXPECT_EQ(found.threshold, 0);
}

// --- the circle ---

TEST(CircleStudy, DefaultClearsTheBar) {
  const std::vector<PoseModel> models{model("auto")};
  const std::vector<ConvergenceCurve> curves{deadreckon::ConvergenceSettings{}.curve};
  const CircleRow row = run_circle_study(models, curves).front();
  EXPECT_LE(row.result.position.rms, kCircleError);
  EXPECT_LE(row.result.velocity_step.max, kCircleVelocityStep);
  EXPECT_TRUE(row.clears());
}

TEST(CircleStudy, OnlyTheTurningModelIsExact) {
  const std::vector<PoseModel> models{model("rvb"), model("rvw")};
  const std::vector<ConvergenceCurve> curves{ConvergenceCurve::cubic};
  CircleCase circle;
  circle.seeds = 5;
  const auto rows = run_circle_study(models, curves, circle);
  EXPECT_LE(rows[0].result.position.rms, 1e-4);
  EXPECT_NEAR(rows[0].result.velocity_step.max, 0.0667, 0.001);
  EXPECT_FALSE(rows[1].clears());
}

// --- the front ---

TEST(MarkFront, MarksAHandMadeSet) {
  const std::vector<Costs> settings{
      {1, 9, 5},  // cheapest
      {2, 5, 5},  // in the middle
      {3, 5, 5},  // worse than 1 in one cost
      {9, 1, 5},  // most exact
      {2, 6, 1},  // smoothest
      {2, 5, 5},  // the same as 1
      {9, 9, 9},  // worse than all
  };
  const auto marks = mark_front(settings);
  for (const std::size_t i : {0U, 1U, 3U, 4U}) EXPECT_FALSE(marks[i]) << i;
  ASSERT_TRUE(marks[2]);
  EXPECT_EQ(marks[2]->by, 1U);
  EXPECT_FALSE(marks[2]->equal);
  ASSERT_TRUE(marks[5]);
  EXPECT_EQ(marks[5]->by, 1U);
  EXPECT_TRUE(marks[5]->equal);
  ASSERT_TRUE(marks[6]);
  EXPECT_EQ(marks[6]->by, 0U);
}

TEST(MarkFront, AgreesWithAllPairComparisons) {
  std::mt19937 engine(3);
  std::vector<Costs> settings(300);
  for (Costs& cost : settings)
    for (double& value : cost) value = static_cast<double>(engine() % 8);
  const auto marks = mark_front(settings);
  for (std::size_t i = 0; i < settings.size(); ++i) {
    bool beaten = false;
    for (std::size_t j = 0; j < settings.size(); ++j) {
      const Costs &a = settings[j], &b = settings[i];
      beaten =
          beaten || (j != i && a[0] <= b[0] && a[1] <= b[1] && a[2] <= b[2] && (a != b || j < i));
    }
    EXPECT_EQ(marks[i].has_value(), beaten) << i;
    if (marks[i]) {
      EXPECT_FALSE(marks[marks[i]->by]) << "beaten by what is itself beaten";
    }
  }
}

TEST(MarkFront, TreatsNaNAsTheWorst) {
  const std::vector<Costs> settings{{std::nan(""), 1, 1}, {1, 1, 1}};
  const auto marks = mark_front(settings);
  EXPECT_TRUE(marks[0]);
  EXPECT_FALSE(marks[1]);
  EXPECT_TRUE(mark_front({}).empty());
}

// --- text ---

TEST(StudyText, WritesThreeDigitsAndASuitableUnit) {
  EXPECT_EQ(number_text(0), "0");
  EXPECT_EQ(number_text(0.5), "0.5");
  EXPECT_EQ(number_text(12.345), "12.3");
  EXPECT_EQ(number_text(41234), "41234");
  EXPECT_EQ(length_text(0), "0 m");
  EXPECT_EQ(length_text(0.00033), "330 um");
  EXPECT_EQ(length_text(0.0025), "2.5 mm");
  EXPECT_EQ(length_text(0.99999), "1 m");
  EXPECT_EQ(length_text(5.347), "5.35 m");
  EXPECT_EQ(length_text(1e-12), "< 1 nm");
}

TEST(StudyText, ComparesTheDisplayedDigits) {
  EXPECT_DOUBLE_EQ(in_three_digits(0.012345), 0.0123);
  EXPECT_DOUBLE_EQ(in_three_digits(-41250), -41300);
  EXPECT_EQ(in_three_digits(99.96), in_three_digits(100.04));
  EXPECT_NE(in_three_digits(1.004), in_three_digits(1.006));
  EXPECT_EQ(in_three_digits(0), 0);
  EXPECT_EQ(in_three_digits(std::numeric_limits<double>::quiet_NaN()), 0);
  EXPECT_EQ(in_three_digits(std::numeric_limits<double>::infinity()),
            std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace reckon::bench::study_test
