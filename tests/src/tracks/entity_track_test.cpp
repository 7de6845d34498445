// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/tracks/entity_track.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <limits>
#include <map>
#include <numbers>
#include <random>
#include <stdexcept>
#include <string>

#include "reckon/deadreckon/motion/rotation.hpp"
#include "reckon/tests/support/allocation_guard.hpp"
#include "reckon/tests/support/reference_data.hpp"
#include "reckon/tests/support/scratch_folder.hpp"

namespace reckon::peer::entity_track_test {
namespace {

using deadreckon::KinematicState;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using testing::HasSubstr;

constexpr double kPi = std::numbers::pi;
constexpr double kRadius = 20.0;  // [m]
constexpr double kRate = 0.5;     // [rad/s], anticlockwise
constexpr double kLap = 2 * kPi / kRate;

Vector3d on_circle(double t) {
  return {kRadius * std::cos(kRate * t), kRadius * std::sin(kRate * t), 3.0};
}

/// A lap of `steps` steps; the last sample equals the first if `closed`, else it is omitted.
TrackSamples circle(int steps, bool closed = true) {
  TrackSamples samples;
  for (int i = 0; i < steps + (closed ? 1 : 0); ++i) {
    const double t = kLap * i / steps;
    samples.times.push_back(100.0 + t);  // recordings begin at any time
    samples.positions.push_back(on_circle(t));
  }
  return samples;
}

/// Random motion and rotation at uneven times.
TrackSamples tumbling(unsigned seed, int count) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> step(0.02, 0.3);
  std::normal_distribution<double> any;
  TrackSamples samples;
  double t = 0;
  Vector3d p = Vector3d::Zero();
  Quaterniond q = Quaterniond::Identity();
  for (int i = 0; i < count; ++i, t += step(random)) {
    samples.times.push_back(t);
    p += 0.2 * Vector3d(any(random), any(random), any(random));
    samples.positions.push_back(p);
    q = q * deadreckon::exponential(0.4 * Vector3d(any(random), any(random), any(random)));
    samples.orientations.push_back(q.normalized());
  }
  return samples;
}

TEST(TrackCurve, FollowsACircleByItsClosedForm) {
  const TrackCurve curve(circle(120));
  EXPECT_TRUE(curve.repeats());
  EXPECT_NEAR(curve.duration(), kLap, 1e-9);
  const double angle = kRate * kLap / 120;  // angle of one step
  double position = 0, velocity = 0, acceleration = 0, turn = 0, rate = 0;
  for (double t = 0; t < 2 * kLap; t += 0.00917) {
    const KinematicState state = curve.at(t);
    const Vector3d r = on_circle(t) - Vector3d(0, 0, 3);
    const Vector3d v = kRate * Vector3d(-r.y(), r.x(), 0);
    position = std::max(position, (state.position - on_circle(t)).norm());
    velocity = std::max(velocity, (state.velocity - v).norm());
    acceleration = std::max(acceleration, (state.acceleration + kRate * kRate * r).norm());
    turn = std::max(turn, (state.orientation * Vector3d::UnitX() - v.normalized()).norm());
    rate = std::max(rate, (state.angular_velocity - Vector3d(0, 0, -kRate)).norm());
  }
  RecordProperty("position_m", std::to_string(position));
  // Slopes over two steps are too small by a^2/6. A quintic with such slopes that must cover its
  // step has an acceleration error of 10/sqrt(3) times that per step.
  EXPECT_LE(velocity, kRadius * kRate * angle * angle / 6 * 1.1);
  EXPECT_LE(position, kRadius * angle * angle * angle / 20);
  EXPECT_LE(acceleration, kRadius * kRate * kRate * angle * 10 / std::sqrt(3.0) / 6 * 1.1);
  EXPECT_LE(turn, 1e-9);
  EXPECT_LE(rate, 1e-9);
}

TEST(TrackCurve, IsExactForConstantAccelerationAtUnevenTimes) {
  const auto truth = [](double t) {
    return Vector3d(1 + 2 * t, -0.5 * t * t, 3 - t + 0.2 * t * t);
  };
  TrackSamples samples;
  for (const double t : {0.0, 0.1, 0.15, 0.4, 1.0, 1.1, 1.9, 2.0, 3.0}) {
    samples.times.push_back(t);
    samples.positions.push_back(truth(t));
  }
  const TrackCurve curve(samples);
  for (double t = 0; t < 2.0; t += 0.013) {  // in the last step it comes to rest
    const KinematicState state = curve.at(t);
    EXPECT_LE((state.position - truth(t)).norm(), 1e-12) << t;
    EXPECT_LE((state.velocity - Vector3d(2, -t, -1 + 0.4 * t)).norm(), 1e-11) << t;
    EXPECT_LE((state.acceleration - Vector3d(0, -1, 0.4)).norm(), 1e-9) << t;
  }
}

TEST(TrackCurve, GoesThroughEverySample) {
  const TrackSamples samples = tumbling(1, 60);
  for (const bool repeat : {false, true}) {
    const TrackCurve curve(samples, repeat);
    for (std::size_t i = 0; i < samples.times.size(); ++i) {
      const KinematicState state = curve.at(samples.times[i]);
      EXPECT_LE((state.position - samples.positions[i]).norm(), 1e-9) << i;
      EXPECT_LE(deadreckon::angle_between(state.orientation, samples.orientations[i]), 1e-9) << i;
    }
  }
}

TEST(TrackCurve, ReturnsTheDerivativesOfItsMotion) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const TrackCurve curve(tumbling(seed, 30), seed % 2 == 0);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> any(0.01, 1.2 * curve.duration());
    for (int i = 0; i < 200; ++i) {
      const double t = any(random), h = 1e-5;
      const KinematicState before = curve.at(t - h), at = curve.at(t), after = curve.at(t + h);
      const Vector3d velocity = (after.position - before.position) / (2 * h);
      const Vector3d acceleration = (after.velocity - before.velocity) / (2 * h);
      const Vector3d turn =
          deadreckon::logarithm(before.orientation.conjugate() * after.orientation) / (2 * h);
      EXPECT_LE((velocity - at.velocity).norm(), 2e-4) << "seed " << seed << " t " << t;
      EXPECT_LE((acceleration - at.acceleration).norm(), 0.5) << "seed " << seed << " t " << t;
      EXPECT_LE((turn - at.angular_velocity).norm(), 5e-3) << "seed " << seed << " t " << t;
      EXPECT_NEAR(at.orientation.norm(), 1.0, 1e-9);
    }
  }
}

TEST(TrackCurve, BeginsAgainWithoutASeam) {
  for (const bool closed : {true, false}) {
    const TrackCurve curve(circle(100, closed));
    ASSERT_TRUE(curve.repeats());
    EXPECT_NEAR(curve.duration(), kLap, 1e-9) << "the way back is one step at the mean speed";
    const KinematicState end = curve.at(curve.duration() - 1e-9), begin = curve.at(0);
    EXPECT_LE((end.position - begin.position).norm(), 1e-7);
    EXPECT_LE((end.velocity - begin.velocity).norm(), 1e-6);
    EXPECT_LE((end.acceleration - begin.acceleration).norm(), 1e-5);
    EXPECT_LE(deadreckon::angle_between(end.orientation, begin.orientation), 1e-7);
    for (const double t : {0.1, 3.0, 12.0}) {
      const KinematicState late = curve.at(t + 1e5 * curve.duration());
      EXPECT_LE((late.position - curve.at(t).position).norm(), 1e-6);
    }
  }
}

TEST(TrackCurve, RestsAtItsEndWithoutRepetition) {
  TrackSamples samples = circle(100);
  samples.times.resize(60);
  samples.positions.resize(60);
  const TrackCurve curve(samples);
  EXPECT_FALSE(curve.repeats());
  const Vector3d last = samples.positions.back();
  EXPECT_LE(curve.at(curve.duration() - 1e-9).velocity.norm(), 1e-6);
  for (const double beyond : {0.0, 1e-9, 1.0, 1e9, std::numeric_limits<double>::infinity()}) {
    const KinematicState state = curve.at(curve.duration() + beyond);
    EXPECT_EQ(state.position, last);
    EXPECT_EQ(state.velocity.norm(), 0.0);
    EXPECT_EQ(state.acceleration.norm(), 0.0);
    EXPECT_EQ(state.angular_velocity.norm(), 0.0);
    EXPECT_LE(deadreckon::angle_between(state.orientation, curve.at(curve.duration()).orientation),
              1e-12);
  }
}

TEST(TrackCurve, ReturnsAtMeanSpeedWhereItsEndsDiffer) {
  TrackSamples samples;
  for (int i = 0; i <= 10; ++i) {
    samples.times.push_back(i);
    samples.positions.emplace_back(2.0 * i, 0, 0);
  }
  EXPECT_FALSE(TrackCurve(samples).repeats());
  const TrackCurve curve(samples, true);
  EXPECT_DOUBLE_EQ(curve.length(), 20);
  EXPECT_DOUBLE_EQ(curve.duration(), 20);
  for (double t = 0; t < 20; t += 0.01) EXPECT_LE(curve.at(t).velocity.norm(), 4.0) << t;
  EXPECT_EQ(TrackCurve({samples.times, samples.positions, {}}, false).duration(), 10);
}

TEST(TrackCurve, RestsWhereTheRecordingRests) {
  TrackSamples samples;
  for (int i = 0; i < 20; ++i) {
    samples.times.push_back(i);
    samples.positions.emplace_back(std::min(i, 5) * 10.0, 0, 0);
  }
  const TrackCurve curve(samples, false);
  for (double t = 6; t < 19; t += 0.1) {
    EXPECT_EQ(curve.at(t).position, Vector3d(50, 0, 0)) << t;
    EXPECT_EQ(curve.at(t).velocity, Vector3d::Zero()) << t;
    EXPECT_LE((curve.at(t).orientation * Vector3d::UnitX() - Vector3d::UnitX()).norm(), 1e-12)
        << "its nose stays where it was: " << t;
  }
}

TEST(TrackCurve, TakesAnyTimeAndAnyNumberOfSamples) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const int count : {1, 2, 3, 50}) {
    for (const bool repeat : {false, true}) {
      const TrackSamples samples = tumbling(7, count);
      const TrackCurve curve(samples, repeat);
      for (const double t : {-1.0, 0.0, -infinity, nan}) {
        EXPECT_LE((curve.at(t).position - samples.positions[0]).norm(), 1e-12) << count;
      }
      for (const double t : {infinity, 1e300, 1e-300, curve.duration(), 5e-324}) {
        EXPECT_TRUE(deadreckon::is_finite(curve.at(t))) << count << ' ' << t;
      }
    }
  }
  TrackSamples still = tumbling(7, 3);
  for (Vector3d& p : still.positions) p.setOnes();
  EXPECT_EQ(TrackCurve({still.times, still.positions, {}}).at(1e3).position, Vector3d::Ones());
}

TEST(TrackCurve, RefusesInvalidSamples) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto refused = [](const TrackSamples& samples) {
    EXPECT_THROW(TrackCurve{samples}, std::invalid_argument);
  };
  refused({});
  refused({{0, 1}, {Vector3d::Zero()}, {}});
  refused({{0, 0}, {Vector3d::Zero(), Vector3d::Ones()}, {}});
  refused({{0, 1e-9}, {Vector3d::Zero(), Vector3d::Ones()}, {}});
  refused({{0, nan}, {Vector3d::Zero(), Vector3d::Ones()}, {}});
  refused({{0}, {Vector3d(0, nan, 0)}, {}});
  refused({{0}, {Vector3d(0, 1e7, 0)}, {}});
  refused({{0}, {Vector3d::Zero()}, {Quaterniond(0, 0, 0, 0)}});
  refused({{0, 1}, {Vector3d::Zero(), Vector3d::Ones()}, {Quaterniond::Identity()}});
}

TEST(TrackCurve, AllocatesNothingWhenAsked) {
  const auto curve = std::make_shared<const TrackCurve>(tumbling(3, 1000), true);
  EntityTrack track(curve, {0, 0, 0});
  const test::AllocationGuard guard;
  for (double t = 0; t < 300; t += 0.37) (void)curve->at(t);
  for (double t = 0; t < 300; t += 0.37) (void)track.at(t);
  EXPECT_EQ(guard.count(), 0u);
}

TEST(EntityTrack, IsMovedAsideAndPlayedFaster) {
  const auto curve = std::make_shared<const TrackCurve>(circle(120));
  EntityTrack track(curve, {100, 200, 300}, Quaterniond::Identity(), 2.0);
  for (const double t : {0.0, 1.7, 40.0}) {
    const KinematicState fast = track.at(t), plain = curve->at(2 * t);
    EXPECT_EQ(fast.position, plain.position + Vector3d(100, 200, 300));
    EXPECT_EQ(fast.velocity, 2 * plain.velocity);
    EXPECT_EQ(fast.acceleration, 4 * plain.acceleration);
    EXPECT_EQ(fast.angular_velocity, 2 * plain.angular_velocity);
  }
  EXPECT_THROW(EntityTrack(curve, {0, 0, 0}, Quaterniond::Identity(), 0), std::invalid_argument);
  EXPECT_THROW(EntityTrack(nullptr, {0, 0, 0}), std::invalid_argument);
}

TEST(EntityTrack, MatchesItsCurveInAnyOrderOfCalls) {
  for (const bool repeat : {false, true}) {
    const auto curve = std::make_shared<const TrackCurve>(tumbling(11, 40), repeat);
    EntityTrack track(curve, {0, 0, 0});
    std::mt19937 random(4);
    std::uniform_real_distribution<double> any(-1.0, 3 * curve->duration());
    for (int i = 0; i < 5000; ++i) {
      const double t = i % 7 == 0 ? curve->duration() : any(random);
      const KinematicState ours = track.at(t), its = curve->at(t);
      ASSERT_EQ(ours.position, its.position) << t;
      ASSERT_EQ(ours.velocity, its.velocity) << t;
      ASSERT_EQ(ours.orientation.coeffs(), its.orientation.coeffs()) << t;
      ASSERT_EQ(ours.angular_velocity, its.angular_velocity) << t;
    }
  }
}

TEST(EntityTrack, KeepsItsOrientationOnCurvesWithoutTurns) {
  const Quaterniond own(Eigen::AngleAxisd(0.7, Vector3d::UnitZ()));
  EntityTrack held(std::make_shared<const TrackCurve>(circle(50), std::nullopt, TrackTurn::held),
                   {0, 0, 0}, own);
  EXPECT_EQ(held.at(3).orientation.coeffs(), own.coeffs());
  EXPECT_EQ(held.at(3).angular_velocity, Vector3d::Zero());
  EntityTrack stands({1, 2, 3}, own);
  EXPECT_FALSE(stands.moves());
  EXPECT_EQ(stands.at(1e9).position, Vector3d(1, 2, 3));
  EXPECT_EQ(stands.at(1e9).velocity, Vector3d::Zero());
  EXPECT_EQ(stands.at(1e9).orientation.coeffs(), own.coeffs());
}

// --- files ---

std::string write(const test::ScratchFolder& folder, const std::string& text) {
  const std::string path = folder.file("track.csv");
  std::ofstream(path) << text;
  return path;
}

std::string error_of(const std::string& text) {
  const test::ScratchFolder folder;
  try {
    (void)read_track_samples(write(folder, text));
  } catch (const CsvError& error) {
    return error.what();
  }
  return "";
}

TEST(TrackSamples, AreReadWithTheirOrientation) {
  const test::ScratchFolder folder;
  const TrackSamples by_heading = read_track_samples(
      write(folder, "t_s,px_m,py_m,pz_m,heading_rad\n0,1,2,3,0\n1,1,2,3,1.5707963267948966\n"));
  ASSERT_EQ(by_heading.orientations.size(), 2u);
  const auto nose = [&](std::size_t i) -> Vector3d {
    return by_heading.orientations[i] * Vector3d::UnitX();
  };
  EXPECT_LE((nose(0) - Vector3d::UnitX()).norm(), 1e-15) << "east";
  EXPECT_LE((nose(1) - Vector3d::UnitY()).norm(), 1e-15) << "anticlockwise from there: north";
  const Vector3d down = by_heading.orientations[1] * Vector3d::UnitZ();
  EXPECT_LE((down + Vector3d::UnitZ()).norm(), 1e-15);

  const TrackSamples by_quaternion =
      read_track_samples(write(folder, "qz,t_s,px_m,py_m,pz_m,qw,qx,qy\n0.8,0,1,2,3,0.6,0,0\n"));
  ASSERT_EQ(by_quaternion.orientations.size(), 1u);
  EXPECT_EQ(by_quaternion.orientations[0].coeffs(), Eigen::Vector4d(0, 0, 0.8, 0.6));
  EXPECT_TRUE(
      read_track_samples(write(folder, "t_s,px_m,py_m,pz_m\n0,1,2,3\n")).orientations.empty());
}

TEST(TrackSamples, ErrorsNameFileAndLine) {
  const std::string head = "t_s,px_m,py_m,pz_m";
  EXPECT_THAT(error_of("t_s,px_m,py_m\n0,0,0\n"), HasSubstr(".csv:1:1: no column pz_m"));
  EXPECT_THAT(error_of(head + "\n0,0,0,0\n1,0,x,0\n"), HasSubstr(".csv:3:5: py_m 'x' is not"));
  EXPECT_THAT(error_of(head + "\n0,0,0,0\n0,0,0,0\n"), HasSubstr("3:1: t_s does not increase"));
  EXPECT_THAT(error_of(head + "\n0,0,0,0\n1e-9,0,0,0\n"), HasSubstr("3:1: t_s increases by less"));
  EXPECT_THAT(error_of(head + "\n0,0,2e6,0\n"), HasSubstr(".csv:2:1: the position is more than"));
  EXPECT_THAT(error_of(head + ",qw,qx,qy\n0,0,0,0,1,0,0\n"), HasSubstr("all of qw, qx, qy and qz"));
  EXPECT_THAT(error_of(head + ",qw,qx,qy,qz\n0,0,0,0,1,1,0,0\n"),
              HasSubstr(".csv:2:9: qw, qx, qy and qz have length 1.41"));
  EXPECT_THAT(error_of(head + "\n"), HasSubstr("no samples"));
}

TEST(TrackShelf, ReadsAFileOnceForAllItsEntities) {
  const test::ScratchFolder folder;
  const std::string file = write(folder, "t_s,px_m,py_m,pz_m\n0,0,0,0\n1,1,0,0\n2,2,0,0\n");
  TrackShelf shelf;
  const auto curve = shelf.curve(file);
  EXPECT_EQ(shelf.curve(file), curve);
  EXPECT_NE(shelf.curve(file, true), curve);
  EXPECT_NE(shelf.curve(file, std::nullopt, TrackTurn::held), curve);
}

/// Tracks of cars in a town, sampled once a second, by their id.
std::map<std::string, TrackSamples> cars(const std::filesystem::path& file) {
  CsvReader csv(file);
  const auto id = *csv.find("id"), t = *csv.find("t_s"), x = *csv.find("x_m"), y = *csv.find("y_m");
  std::map<std::string, TrackSamples> tracks;
  while (csv.next()) {
    TrackSamples& car = tracks[std::string(csv.text(id))];
    car.times.push_back(csv.required(t));
    car.positions.emplace_back(csv.required(x), csv.required(y), 0);
  }
  return tracks;
}

TEST(TrackCurve, MovesTownCarsHardlyFasterThanRecorded) {
  RECKON_NEED_DATA("trajectories/vehicles_town_sumo.csv");
  const auto tracks = cars(test::reference_data() / "trajectories/vehicles_town_sumo.csv");
  EXPECT_GT(tracks.size(), 2000u);
  for (const auto& [id, samples] : tracks) {
    const TrackCurve curve(samples, false);
    double fastest_step = 0, fastest = 0;
    for (std::size_t i = 1; i < samples.times.size(); ++i) {
      const double span = samples.times[i] - samples.times[i - 1];
      const Vector3d way = samples.positions[i] - samples.positions[i - 1];
      fastest_step = std::max(fastest_step, way.norm() / span);
    }
    const double driven = curve.duration() - 1;  // then it stops, as the recording ends
    for (double t = 0; t < driven; t += 0.1) {
      const KinematicState state = curve.at(t);
      ASSERT_TRUE(deadreckon::is_finite(state)) << id;
      fastest = std::max(fastest, state.velocity.norm());
    }
    // A single fast step between two at rest overshoots by 3/8, at an end slightly more.
    EXPECT_LE(fastest, fastest_step * 1.5 + 1e-9) << id;
  }
}

}  // namespace
}  // namespace reckon::peer::entity_track_test
