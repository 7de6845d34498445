// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A few peers in simulated time: the steps of their servos, and their measurement.
#include "reckon/tools/exercise/exercise.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <fstream>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "reckon/tests/support/scratch_folder.hpp"

namespace reckon::tools::exercise_test {
namespace {

using namespace std::chrono_literals;
using std::chrono::nanoseconds;
using Device = std::pair<std::size_t, std::size_t>;  // peer index, device index

ExerciseOptions simulated(std::size_t peers) {
  ExerciseOptions options;
  options.peers = peers;
  options.simulated_time = true;
  options.epoch = 1;
  return options;
}

std::map<Device, std::vector<nanoseconds>> steps_of(Exercise& exercise, nanoseconds span) {
  std::map<Device, std::vector<nanoseconds>> steps;
  exercise.on_step([&](std::size_t peer, std::size_t device, const auto& step) {
    steps[{peer, device}].push_back(step.time);
  });
  exercise.run(span);
  return steps;
}

TEST(Exercise, StepsEachServoAtItsDevicesPeriod) {
  Exercise exercise(peer::parse_scene_file("[[operator]]\npassive = true\n"
                                           "[[device]]\npeer = 1\nrate = \"250 Hz\"\n"
                                           "[[device]]\npeer = 1\nrate = \"700 Hz\"\n"
                                           "[[device]]\npeer = 1\n"
                                           "[[device]]\npeer = 2\nrate = \"4 kHz\"\n"
                                           "[[device]]\npeer = 2\nrate = \"10 kHz\"\n",
                                           "x.toml"),
                    simulated(2));
  const auto steps = steps_of(exercise, 1s);
  const std::map<Device, double> rates{
      {{0, 0}, 250}, {{0, 1}, 700}, {{0, 2}, 1000}, {{1, 0}, 4000}, {{1, 1}, 10'000}};
  ASSERT_EQ(steps.size(), rates.size());
  for (const auto& [device, rate] : rates) {
    const auto& times = steps.at(device);
    EXPECT_NEAR(static_cast<double>(times.size()), rate, 1.0) << rate;
    const auto period = times[1] - times[0];
    EXPECT_NEAR(static_cast<double>(period.count()), 1e9 / rate, 1.0) << rate;
    for (std::size_t i = 2; i < times.size(); ++i) EXPECT_EQ(times[i] - times[i - 1], period);
  }
  EXPECT_NEAR(exercise.raw_rate(), 15'950.0, 1e-3);
  EXPECT_EQ(exercise.unmeasured_steps(), 0u);
  for (std::size_t i = 0; i < 2; ++i) {
    for (const peer::HandView& hand : exercise.view(i).own_hands()) {
      EXPECT_EQ(hand.servo.tally.late, 0u) << "the clock is perfect";
      EXPECT_EQ(hand.servo.tally.force_drops, 0u);
    }
  }
}

// 3/4 of 0.95 x 2 b/T, for 1 N s/m at 10 kHz, and the grip of 300 N/m in series.
TEST(Exercise, FasterDevicesShowStifferWalls) {
  const std::string scene =
      "[[object]]\nname = \"floor\"\nplane = [0, 0, 1]\nsurface = { stiffness = 20000 }\n"
      "[[operator]]\nsweep = { from = \"0 0 5 mm\", to = \"0 0 -5 mm\", period = \"2 s\" }\n"
      "[[device]]\nrate = \"10 kHz\"\n";
  Exercise exercise(peer::parse_scene_file(scene, "x.toml"), simulated(1));
  exercise.run(2s);
  EXPECT_NEAR(exercise.view(0).hands[0].stiffness.walls, 14'250, 1e-6);
  EXPECT_NEAR(exercise.measurement().peak_force(), 0.005 / (1.0 / 300 + 1.0 / 14'250), 0.005);
  EXPECT_EQ(exercise.view(0).servo().tally.force_drops, 0u)
      << "steps come before a force is let go";
  EXPECT_GE(exercise.measurement().energy_min(), -1e-9);
}

// Two hands that press a floor and each other from the start, at rates without whole milliseconds.
TEST(Exercise, CountsNoMoreTimeInContactThanPassed) {
  for (const char* rate : {"250 Hz", "1 kHz", "4 kHz"}) {
    SCOPED_TRACE(rate);
    std::string scene =
        "[hand]\nradius = \"10 mm\"\nk1 = 400\ndamping = 0\n"
        "[[object]]\nname = \"floor\"\nplane = [0, 0, 1]\nsurface = { stiffness = 200 }\n";
    for (const char* x : {"-8", "8"})
      scene += std::string("[[operator]]\npassive = true\nposition = \"") + x + " 0 -2 mm\"\n";
    for (int peer = 1; peer <= 2; ++peer)
      scene += "[[device]]\npeer = " + std::to_string(peer) +
               "\noperator = " + std::to_string(peer) + "\nrate = \"" + rate + "\"\n";
    Exercise exercise(peer::parse_scene_file(scene, "x.toml"), simulated(2));
    exercise.run(2s);
    const DemoMeasurement& measured = exercise.measurement();
    for (const double touching : {measured.touching_scene(), measured.touching_hands()}) {
      EXPECT_LE(touching, 2 * 2.0);
      EXPECT_GE(touching, 2 * 1.9);
    }
    EXPECT_EQ(measured.touching_entities(), 0.0);
  }
}

std::string ball_of_another(const std::string& more) {
  return "[hand]\nradius = \"10 mm\"\n"
         "[[entity]]\npeer = 1\nmarking = \"BALL\"\ntype = \"5.1\"\n" +
         more +
         "force_model = { kind = \"sphere\", radius = \"30 mm\", k1 = 400, damping = 0 }\n"
         "[[operator]]\nsweep = { from = \"-60 0 0 mm\", to = \"-20 0 0 mm\", period = \"2 s\" }\n"
         "[[device]]\npeer = 2\n";
}

TEST(Exercise, CountsContactWithEntitiesApartFromHands) {
  Exercise exercise(peer::parse_scene_file(ball_of_another(""), "x.toml"), simulated(2));
  exercise.run(2s);
  const DemoMeasurement& measured = exercise.measurement();
  EXPECT_GT(measured.touching_entities(), 0.5);
  EXPECT_LT(measured.touching_entities(), 2.0);
  EXPECT_NEAR(measured.touching_entities(), exercise.view(1).servo().tally.hands, 0.02);
  EXPECT_EQ(measured.touching_hands(), 0.0);
  EXPECT_GT(measured.peak_force(), 1.0);
}

// It moves 5 cm back and forth each second: the shown error is at most the threshold, and never
// zero.
TEST(Exercise, MeasuresThePoseOfTracks) {
  const reckon::test::ScratchFolder folder;
  std::ofstream track(folder.file("ball.csv"));
  track << "t_s,px_m,py_m,pz_m\n";
  for (int i = 0; i <= 200; ++i)
    track << 0.01 * i << ",0," << 0.05 * std::sin(0.02 * 3.14159265358979 * i) << ",0\n";
  track.close();
  const std::string path = folder.file("scene.toml");
  std::ofstream(path) << "[[entity]]\npeer = 1\nmarking = \"BALL\"\ntype = \"5.1\"\n"
                         "track = \"ball.csv\"\ndead_reckoning = { position = \"2 mm\" }\n"
                         "[[entity]]\npeer = 2\nmarking = \"POST\"\ntype = \"5.1\"\n";
  Exercise exercise(peer::load_scene_file(path), simulated(2));
  EXPECT_EQ(exercise.hands(), 0u);
  exercise.run(4s);
  const peer::Spread pose = exercise.measurement().pose_error();
  EXPECT_GT(pose.count, 5000u);
  EXPECT_GT(pose.p99, 0.5e-3);
  EXPECT_LT(pose.p99, 4e-3);
}

TEST(Exercise, HasNoPoseErrorWithoutRemoteEntities) {
  Exercise exercise(peer::parse_scene_file("[[operator]]\npassive = true\n", "x.toml"),
                    simulated(1));
  exercise.run(1s);
  EXPECT_EQ(exercise.measurement().pose_error().count, 0u);
}

}  // namespace
}  // namespace reckon::tools::exercise_test
