// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The measures of contacts on records with known results.
#include "reckon/bench/studies/contact/contact_measures.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

namespace reckon::bench {
namespace {

using Eigen::Vector3d;

constexpr ContactTruth kTruth{500, 0.04};  // [N/m], [m]
constexpr double kTurn = 2 * std::numbers::pi;

/// Two hands along a slanted line that overlap by depth(step) [m]. The first feels felt(step, true
/// force), the second the true force.
ContactRecord record_of(std::size_t steps, const std::function<double(double)>& depth,
                        const std::function<double(std::size_t, double)>& felt) {
  const Vector3d line = Vector3d(1, 2, -2) / 3;
  ContactRecord record;
  record.hands = 2;
  for (std::size_t step = 0; step < steps; ++step) {
    const double overlap = depth(1e-3 * static_cast<double>(step));
    const double force = kTruth.stiffness * std::max(0.0, overlap);
    record.positions.push_back(Vector3d(1, 1, 1));
    record.positions.push_back(Vector3d(1, 1, 1) + (kTruth.reach - overlap) * line);
    record.forces.insert(record.forces.end(), {Vector3d::Zero(), -felt(step, force) * line,
                                               force * line, Vector3d::Zero()});
  }
  return record;
}

double as_it_is(std::size_t, double force) { return force; }

TEST(ContactMeasures, FindNoErrorForTrueForces) {
  const auto record = record_of(
      500, [](double t) { return 0.001 + 0.01 * t; }, as_it_is);
  const ForceError error = error_at_instant(record, kTruth);
  EXPECT_EQ(error.samples, 1000U);
  EXPECT_LT(error.max, 1e-9);
  EXPECT_EQ(error.noticed, 0);
  EXPECT_EQ(linger(record, kTruth), 0);
}

TEST(ContactMeasures, SeparatePercentilesFromShareOfTime) {
  // 2 N all the time; the first hand feels 0.5 N too much in every tenth step.
  const auto record = record_of(
      1000, [](double) { return 0.004; },
      [](std::size_t step, double force) { return force + (step % 10 == 0 ? 0.5 : 0); });
  const ForceError error = error_at_instant(record, kTruth);
  EXPECT_EQ(error.samples, 2000U);
  EXPECT_NEAR(error.p50, 0, 1e-9);
  EXPECT_NEAR(error.p99, 0.5, 1e-9);
  EXPECT_NEAR(error.max, 0.5, 1e-9);
  EXPECT_NEAR(error.rms, 0.5 * std::sqrt(0.05), 1e-9);
  EXPECT_NEAR(error.noticed, 0.05, 1e-12);
}

TEST(ContactMeasures, NoticeATenthOrFiftyMillinewtons) {
  const auto noticed = [](double depth, double error) {
    return error_at_instant(record_of(
                                100, [=](double) { return depth; },
                                [=](std::size_t, double force) { return force + error; }),
                            kTruth)
        .noticed;
  };
  EXPECT_EQ(noticed(0.004, 0.19), 0);
  EXPECT_EQ(noticed(0.004, 0.21), 0.5);  // one hand of two
  EXPECT_EQ(noticed(0.0002, 0.04), 0);
  EXPECT_EQ(noticed(0.0002, 0.06), 0.5);
}

TEST(ContactMeasures, AnswerGainAndPhaseOfAStroke) {
  const double lag = 0.4;
  const auto wave = [=](double t, double phase) {
    return 0.005 + 0.002 * std::sin(kTurn * 2 * t - phase);
  };
  const auto record = record_of(
      3000, [&](double t) { return wave(t, 0); },
      [&](std::size_t step, double) {
        const double t = 1e-3 * static_cast<double>(step);
        return kTruth.stiffness * (0.005 + 1.3 * (wave(t, lag) - 0.005));
      });
  const auto response = stroke_response(record, kTruth, 2, 1000, 3000);
  ASSERT_TRUE(response);
  EXPECT_NEAR((*response)[0].gain, 1.3, 1e-9);
  EXPECT_NEAR((*response)[0].phase, -lag, 1e-9);
  EXPECT_NEAR((*response)[1].gain, 1, 1e-9);
  EXPECT_NEAR((*response)[1].phase, 0, 1e-9);
  EXPECT_FALSE(stroke_response(record, kTruth, 2, 1000, 4000));
  EXPECT_FALSE(stroke_response(record, kTruth, 0, 1000, 3000));
}

TEST(ContactMeasures, MeasureTheLingerOfAForce) {
  // The hands part at 0.1 s; the force felt falls by 10 N/s from 1 N, so it is 0.05 N after 95 ms.
  const auto record = record_of(
      1000, [](double t) { return t < 0.1 ? 0.002 : -0.01; },
      [](std::size_t step, double force) {
        return step < 100 ? force : std::max(0.0, 1 - 0.01 * static_cast<double>(step - 99));
      });
  EXPECT_NEAR(linger(record, kTruth), 0.095, 1.5e-3);
}

TEST(ContactMeasures, LingerExcludesForcesWithoutAnEarlierTouch) {
  const auto record = record_of(
      1000, [](double t) { return t < 0.1 ? 0.002 : -0.01; },
      [](std::size_t step, double force) { return step > 500 && step < 700 ? 1.0 : force; });
  EXPECT_EQ(linger(record, kTruth), 0);
}

TEST(ContactMeasures, CompareTheFirstPeakWithTheTwins) {
  const auto depth = [](double t) { return t < 0.5 ? -0.01 : t < 1 ? 0.004 : 0.002; };
  const auto twin = record_of(3000, depth, as_it_is);
  const auto record = record_of(3000, depth, [](std::size_t step, double force) {
    return step == 600 ? 1.2 * force : step == 2000 ? 9 * force : force;
  });
  ASSERT_TRUE(first_peak(record, twin));
  EXPECT_NEAR(*first_peak(record, twin), 1.2, 1e-9);
  EXPECT_NEAR(error_of_twin(twin, twin), 0, 1e-12);
  EXPECT_GT(error_of_twin(record, twin), 0.05);
  EXPECT_FALSE(first_peak(record, record_of(
                                      3000, [](double) { return -0.01; }, as_it_is)));
}

}  // namespace
}  // namespace reckon::bench
