// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Savings of a deadband and of a force model: on signals with a known result, on recorded ones, and
// in the shipped scene.
#include "reckon/bench/studies/force/force_study.hpp"

#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <fstream>
#include <numbers>
#include <random>

#include "reckon/pdu/random/split_mix.hpp"
#include "reckon/tests/support/places.hpp"
#include "reckon/tests/support/reference_data.hpp"
#include "reckon/tests/support/scratch_folder.hpp"

namespace reckon::bench {
namespace {

using Eigen::Vector3d;
using ::testing::HasSubstr;

constexpr std::array kTenPercent{0.1};

template <typename Value>
ForceSignal signal_of(Value value) {
  ForceSignal signal;
  for (int i = 0; i <= 1000; ++i) {
    signal.times.push_back(i * 1e-3);
    signal.values.emplace_back(value(i * 1e-3), 0, 0);
  }
  return signal;
}

TEST(ForceSignalRows, ConstantForceCostsOnePacket) {
  for (const ForceRow& row :
       force_signal_rows(signal_of([](double) { return 3.0; }), kTenPercent, 0.05)) {
    EXPECT_NEAR(row.packets_per_s, 1, 1e-9) << row.setting;
    EXPECT_EQ(row.error.max, 0) << row.setting;
    EXPECT_EQ(row.outside, 0U);
    EXPECT_EQ(row.samples, 1001U);
    EXPECT_NEAR(row.raw_packets_per_s, 1001, 1e-9);
    EXPECT_NEAR(row.octets_per_s, kSignalOctets, 1e-6);
  }
}

TEST(ForceSignalRows, RampCostsFewLinesButManyHeldValues) {
  const auto rows =
      force_signal_rows(signal_of([](double t) { return 1 + 4 * t; }), kTenPercent, 0.05);
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_EQ(rows[0].setting, "hold, 10 % Weber");
  // Each packet moves the value by 10 % / 90 %: ln 5 / ln (10/9) = 15.3 packets in all, and the
  // first.
  EXPECT_NEAR(rows[0].packets_per_s, 16, 1);
  // One packet before the slope is known, then one with the slope each 0.25 s, the longest line.
  EXPECT_LE(rows[1].packets_per_s, 6);
  EXPECT_LE(rows[2].packets_per_s, rows[0].packets_per_s);
  for (const ForceRow& row : rows) {
    EXPECT_EQ(row.outside, 0U);
    EXPECT_LE(row.error.p99, 0.5);
    EXPECT_LE(row.error.rms, row.error.p99);
    EXPECT_LE(row.error.p99, row.error.max);
  }
}

TEST(ForceSignalRows, ChoiceFollowsTheBetterOfLineAndHold) {
  const auto sine = [](double t) { return 5 + 3 * std::sin(std::numbers::pi * t); };
  std::mt19937_64 engine(1);
  const auto noisy = [&](double t) { return sine(t) + 2.0 * (pdu::unit_of(engine()) - 0.5); };
  constexpr std::array kFivePercent{0.05};
  const auto smooth = force_signal_rows(signal_of(sine), kFivePercent, 0.05);
  EXPECT_GT(smooth[0].packets_per_s, 3 * smooth[1].packets_per_s);
  EXPECT_LT(smooth[2].packets_per_s, 0.6 * smooth[0].packets_per_s);
  const auto rough = force_signal_rows(signal_of(noisy), kFivePercent, 0.05);
  EXPECT_LT(rough[0].packets_per_s, rough[1].packets_per_s);
  EXPECT_LT(rough[2].packets_per_s, 1.1 * rough[0].packets_per_s);
}

TEST(ForceSignalRows, EverySampleOfANoisyForceIsInside) {
  // Alternating steps larger than the deadband: no model helps, all samples stay inside.
  const ForceSignal signal =
      signal_of([](double t) { return 2 + (std::fmod(t * 1000, 2) < 1 ? 0.5 : -0.5); });
  for (const ForceRow& row : force_signal_rows(signal, kTenPercent, 0.05)) {
    EXPECT_EQ(row.outside, 0U);
    EXPECT_GT(row.share(), 0.5);
  }
}

TEST(ForceSignalRows, StayInsideTheBandOnRecordedForces) {
  RECKON_NEED_DATA("haptic-traces");
  std::uint64_t sent = 0, samples = 0;
  for (const auto& entry :
       std::filesystem::directory_iterator(test::reference_data() / "haptic-traces")) {
    if (entry.path().extension() != ".csv") continue;
    const ForceSignal signal = read_force_signal(entry.path());
    for (const ForceRow& row : force_signal_rows(signal, std::array{0.05, 0.1, 0.2}, 0.05)) {
      EXPECT_EQ(row.outside, 0U) << row.name << " " << row.setting;
      if (row.setting != "auto, 10 % Weber") continue;
      sent +=
          static_cast<std::uint64_t>(std::llround(row.share() * static_cast<double>(row.samples)));
      samples += row.samples;
    }
  }
  EXPECT_LE(static_cast<double>(sent), 0.13 * static_cast<double>(samples));
}

class ForceSignalFile : public testing::Test {
 protected:
  std::string write(const std::string& text) {
    const std::string path = folder_.file("touch.csv");
    std::ofstream(path) << text;
    return path;
  }
  test::ScratchFolder folder_;
};

TEST_F(ForceSignalFile, TakesForceColumnsByDefaultOthersByName) {
  const std::string path = write("t_s,fx_N,fy_N,grip\n0,1,2,3\n0,9,9,9\n1,4,5,6\n");
  const ForceSignal force = read_force_signal(path);
  ASSERT_EQ(force.values.size(), 2U);  // the second row has no later time
  EXPECT_EQ(force.values[1], Vector3d(4, 5, 0));
  EXPECT_EQ(force.unit, "N");
  const ForceSignal grip = read_force_signal(path, std::array<std::string, 1>{"GRIP"});
  EXPECT_EQ(grip.values[1], Vector3d(6, 0, 0));
  EXPECT_EQ(read_force_signal(write("f_n,t_s\n7,0\n8,1\n")).values[1], Vector3d(8, 0, 0));
}

TEST_F(ForceSignalFile, NamesTheMissingColumn) {
  const auto error_of = [&](const std::string& text, std::vector<std::string> columns = {}) {
    try {
      (void)read_force_signal(write(text), columns);
    } catch (const std::runtime_error& error) {
      return std::string(error.what());
    }
    return std::string("nothing was wrong");
  };
  EXPECT_THAT(error_of("x,f_n\n0,1\n"), HasSubstr("no column t_s"));
  EXPECT_THAT(error_of("t_s,grip\n0,1\n"), HasSubstr("--columns, of t_s, grip"));
  EXPECT_THAT(error_of("t_s,f_n\n0,1\n", {"fz"}), HasSubstr("no column fz"));
  EXPECT_THAT(error_of("t_s,f_n\n0,1\n"), HasSubstr("fewer than two"));
  EXPECT_THAT(error_of("t_s,f_n\n0,1\n1,inf\n"), HasSubstr(":3:3: f_n 'inf'"));
}

TEST(ForceModelRows, KeepTheForceWithFarFewerPackets) {
  const peer::SceneFile scene =
      peer::load_scene_file(reckon::test::source_dir() + "/scenes/two_hands.toml");
  const auto rows = force_model_rows(scene, std::array{0.01, 0.2}, 60);
  ASSERT_EQ(rows.size(), 2U);
  for (const ForceRow& row : rows) {
    EXPECT_EQ(row.raw_packets_per_s, 2000);
    EXPECT_LT(row.share(), 0.1);
    EXPECT_GT(row.packets_per_s, 1);
    EXPECT_GT(row.samples, 0U) << "the hands never touched";
    EXPECT_LE(row.error.p99, row.error.max);
  }
  // The packets are not compared: the force felt changes the motion of a hand.
  EXPECT_GE(rows[0].for_force_per_s, rows[1].for_force_per_s);
  EXPECT_LE(rows[0].error.p99, rows[1].error.p99);
  EXPECT_LT(rows[0].error.p99, 0.03);
}

TEST(ForceModelRows, AreDeterministic) {
  const peer::SceneFile scene =
      peer::load_scene_file(reckon::test::source_dir() + "/scenes/two_hands.toml");
  const auto rows = force_model_rows(scene, std::array{0.1, 0.1}, 3);
  EXPECT_EQ(rows[0].packets_per_s, rows[1].packets_per_s);
  EXPECT_EQ(rows[0].octets_per_s, rows[1].octets_per_s);
}

}  // namespace
}  // namespace reckon::bench
