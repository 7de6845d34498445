// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The curve of bandwidth against error on motions with a known result, its front and its knee.
#include "reckon/bench/studies/tune/tuning.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "reckon/bench/studies/tracks/track_file.hpp"
#include "reckon/tests/support/reference_data.hpp"

namespace reckon::bench::tuning_test {
namespace {

using Eigen::Vector3d;

/// `position(t)` and `velocity(t)` along x at 10 Hz for 20 s.
template <typename Position, typename Velocity>
std::vector<Track> track_along_x(Position position, Velocity velocity) {
  Track track;
  for (int i = 0; i <= 200; ++i) {
    const double t = i / 10.0;
    deadreckon::MotionSample sample;
    sample.time = t;
    sample.position = Vector3d(position(t), 0, 0);
    sample.velocity = Vector3d(velocity(t), 0, 0);
    track.samples.push_back(sample);
  }
  return {track};
}

std::vector<Track> straight_line() {
  return track_along_x([](double t) { return 10 * t; }, [](double) { return 10.0; });
}

TuneOptions options_for(std::vector<PoseModel> models, std::vector<double> thresholds) {
  TuneOptions options;
  options.models = std::move(models);
  options.thresholds = std::move(thresholds);
  options.angle = 1;
  options.heartbeat = 1000;
  return options;
}

PoseModel model(std::string_view name) {
  for (const PoseModel& found : tune_models())
    if (found.name == name) return found;
  throw std::invalid_argument("no such model");
}

TuneRow row_of(double packets_per_s, double p99) {
  TuneRow row;
  row.packets_per_s = packets_per_s;
  row.result.position.p99 = p99;
  return row;
}

TEST(Tuning, StraightLineCostsOnePacketAndTheHeartbeats) {
  const std::vector<Track> tracks = straight_line();
  TuneOptions options = options_for({model("fpw"), model("auto")}, {0.01, 1});
  for (const TuneRow& row : tune(tracks, options).rows) EXPECT_EQ(row.result.updates, 1U);
  options.heartbeat = 4;  // 3.6 to 4.4 s: four or five heartbeats within 20 s
  const TuneTable table = tune(tracks, options);
  EXPECT_GE(table.rows[0].result.updates, 5U);
  EXPECT_LE(table.rows[0].result.updates, 6U);
  EXPECT_EQ(table.every_sample.result.updates, 201U);
  EXPECT_NEAR(table.every_sample.packets_per_s, 10.05, 1e-9);
  EXPECT_NEAR(table.every_sample.octets_per_s, 172 * 10.05, 1e-9);
  EXPECT_NEAR(table.every_sample.result.position.p99, 1, 1e-3);  // held: the displacement of 0.1 s
}

TEST(Tuning, HeldPositionCostsAPacketPerThreshold) {
  // 200 m in steps of 1 m; every third step is the first with an error above 2.5 m.
  const TuneTable table = tune(straight_line(), options_for({model("static")}, {2.5}));
  EXPECT_EQ(table.rows[0].result.updates, 1U + 200 / 3);
}

TEST(Tuning, LargerThresholdsNeverCostMore) {
  const auto tracks = track_along_x([](double t) { return t * t; }, [](double t) { return 2 * t; });
  const std::vector<double> thresholds{0.01, 0.05, 0.1, 0.5, 1, 5, 20};
  const TuneTable table = tune(tracks, options_for({model("fpw")}, thresholds));
  for (std::size_t i = 1; i < table.rows.size(); ++i) {
    EXPECT_LE(table.rows[i].result.updates, table.rows[i - 1].result.updates);
    EXPECT_GE(table.rows[i].error(), table.rows[i - 1].error());
  }
  // The first sample after sqrt(h) s: after 0.8 s for 0.5 m, so every eighth of 0.1 s.
  EXPECT_EQ(table.rows[3].result.updates, 1U + 200 / 8);
}

TEST(Tuning, GivesTheSameOnAnyNumberOfCores) {
  const auto tracks =
      track_along_x([](double t) { return std::sin(t); }, [](double t) { return std::cos(t); });
  TuneOptions options = options_for(default_tune_models(), {0.01, 0.1});
  options.network = {peer::delayed_by(0.05, 0.4, 0.1), 3};
  const TuneTable first = tune(tracks, options);
  const TuneTable again = tune(tracks, options);
  for (std::size_t i = 0; i < first.rows.size(); ++i) {
    EXPECT_EQ(first.rows[i].result.updates, again.rows[i].result.updates);
    EXPECT_EQ(first.rows[i].error(), again.rows[i].error());
  }
}

TEST(Tuning, MatchesTheErrorOfTheCommonSetting) {
  const auto tracks = track_along_x([](double t) { return 50 * std::sin(t / 2); },
                                    [](double t) { return 25 * std::cos(t / 2); });
  const TuneTable table = tune(tracks, options_for({model("auto")}, {1}));
  ASSERT_TRUE(table.matched);
  EXPECT_LE(table.matched->error(), table.common.error());
  EXPECT_EQ(table.matched->model, "auto");
}

TEST(Tuning, StopsOnRequest) {
  TuneOptions options = options_for(default_tune_models(), {0.01, 0.1, 1});
  const TuneTable table =
      tune(straight_line(), options, [](std::size_t, std::size_t) { return false; });
  for (const TuneRow& row : table.rows) EXPECT_EQ(row.result.updates, 0U);
  EXPECT_FALSE(table.matched);
}

TEST(Tuning, OmitsModelsWithEqualResults) {
  // No rotation: RPW equals FPW and FVW equals RVW.
  auto tracks = track_along_x([](double t) { return 50 * std::sin(t / 2); },
                              [](double t) { return 25 * std::cos(t / 2); });
  for (auto& sample : tracks[0].samples)
    sample.acceleration.x() = -12.5 * std::sin(sample.time / 2);
  TuneOptions options =
      options_for({model("fpw"), model("rpw"), model("rvw"), model("fvw")}, {0.1, 1});
  EXPECT_EQ(tune(tracks, options).rows.size(), 8U);
  options.drop_twins = true;
  const TuneTable table = tune(tracks, options);
  ASSERT_EQ(table.twins.size(), 2U);
  EXPECT_EQ(table.twins[0][0], "rpw");
  EXPECT_EQ(table.twins[0][1], "fpw");
  ASSERT_EQ(table.rows.size(), 4U);
  EXPECT_EQ(table.rows[2].model, "rvw");
  EXPECT_EQ(table.rows[2].threshold, 0.1);
}

TEST(TuningFront, ContainsTheUndominatedRows) {
  std::vector<TuneRow> rows{row_of(1, 9), row_of(2, 9), row_of(3, 5),
                            row_of(3, 5), row_of(4, 6), row_of(5, 1)};
  mark_front(rows);
  std::vector<bool> front;
  for (const TuneRow& row : rows) front.push_back(row.on_front);
  EXPECT_EQ(front, (std::vector<bool>{true, false, true, false, false, true}));
}

TEST(TuningKnee, IsWhereTheCurveBendsMost) {
  std::vector<TuneRow> rows{row_of(100, 1), row_of(2, 2), row_of(1, 100), row_of(20, 1.5)};
  mark_front(rows);
  EXPECT_EQ(knee_of(rows), 1U);
}

TEST(TuningKnee, IsNotFoundOnAStraightCurve) {
  std::vector<TuneRow> rows{row_of(1, 8), row_of(2, 4), row_of(4, 2), row_of(8, 1)};
  mark_front(rows);
  EXPECT_FALSE(knee_of(rows));
  std::vector<TuneRow> two{row_of(1, 8), row_of(2, 4)};
  mark_front(two);
  EXPECT_FALSE(knee_of(two));
  EXPECT_FALSE(knee_of({}));
}

TEST(TuningKnee, GivesThePriceOfHalfTheError) {
  std::vector<TuneRow> rows{row_of(1, 8), row_of(3, 4), row_of(27, 1)};
  mark_front(rows);
  EXPECT_NEAR(price_of_half(rows).value_or(0), 3, 1e-12);
  EXPECT_FALSE(price_of_half({}));
}

TEST(TuningKnee, IgnoresRowsWithoutPacketsOrError) {
  std::vector<TuneRow> rows{row_of(100, 1), row_of(2, 2), row_of(1, 100), row_of(0, 500),
                            row_of(1000, 0)};
  mark_front(rows);
  EXPECT_EQ(knee_of(rows), 1U);
}

TEST(TuningGoals, TakeTheCheapestAndTheBestWithinLimits) {
  const std::vector<TuneRow> rows{row_of(10, 0.1), row_of(4, 0.5), row_of(5, 0.4), row_of(1, 2)};
  EXPECT_EQ(cheapest_within(rows, 0.5), 1U);
  EXPECT_EQ(cheapest_within(rows, 0.49), 2U);
  EXPECT_FALSE(cheapest_within(rows, 0.05));
  EXPECT_EQ(best_within(rows, 5), 2U);
  EXPECT_EQ(best_within(rows, 1000), 0U);
  EXPECT_FALSE(best_within(rows, 0.5));
}

TEST(ThresholdLadder, SpansAHundredthToTenTimesTheStep) {
  EXPECT_EQ(threshold_ladder(1),
            (std::vector<double>{0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10}));
  EXPECT_EQ(threshold_ladder(0.4).front(), 0.005);
  EXPECT_EQ(threshold_ladder(0.4).back(), 2);
  EXPECT_EQ(threshold_ladder(0).front(), 0.001);
  for (const double step : {1e-300, 1e300, std::nan("")}) {
    EXPECT_GE(threshold_ladder(step).front(), 1e-6);
    EXPECT_LE(threshold_ladder(step).back(), 1e4);
    EXPECT_LE(threshold_ladder(step).size(), 30U);
    EXPECT_GE(threshold_ladder(step).size(), 2U);
  }
}

TEST(TrackSummary, GivesMediansAndTheTotalSpan) {
  Track first, second;
  for (const double t : {0.0, 1.0, 2.0, 3.0}) {
    deadreckon::MotionSample sample;
    sample.time = t;
    sample.position = Vector3d(2 * t, 0, 0);
    first.samples.push_back(sample);
    sample.time = t + 10;
    sample.position.setZero();
    second.samples.push_back(sample);
  }
  const TrackSummary summary = summary_of(std::vector<Track>{first, second});
  EXPECT_EQ(summary.entities, 2U);
  EXPECT_EQ(summary.samples, 8U);
  EXPECT_EQ(summary.span, 13);
  EXPECT_EQ(summary.interval, 1);
  EXPECT_EQ(summary.step, 2);
}

TEST(Tuning, NeedsFewerPacketsThanDrm4OnPedestrians) {
  RECKON_NEED_DATA("trajectories");
  const TrackFile file =
      read_track_file(test::reference_data() / "trajectories" / "pedestrians_ucy_students03.csv");
  TuneOptions options = options_for({model("auto")}, {0.5});
  options.angle = 3.2;
  options.heartbeat = 60;
  const TuneTable table = tune(file.tracks, options);
  ASSERT_TRUE(table.matched);
  EXPECT_LT(table.matched->packets_per_s, table.common.packets_per_s);
  RecordProperty("matched_packets", static_cast<int>(table.matched->result.updates));
  RecordProperty("common_packets", static_cast<int>(table.common.result.updates));
}

}  // namespace
}  // namespace reckon::bench::tuning_test
