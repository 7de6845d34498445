// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/deadreckon/sending/deadband.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "reckon/tests/deadreckon/support/oracle.hpp"

namespace reckon::deadreckon::deadband_test {
namespace {

using Eigen::Vector3d;
using Signal = std::vector<std::pair<double, Vector3d>>;

struct Sent {
  std::size_t packets = 0;
  double worst = 0;  // largest error as a share of the band, at the receiver
  SignalModel model = SignalModel::hold;
};

// Sender and receiver; the receiver gets the updates only.
Sent send(const Signal& signal, const Deadband& deadband = {}) {
  DeadbandSender sender(deadband);
  SignalUpdate received;
  Sent sent;
  for (const auto& [time, value] : signal) {
    if (const auto update = sender.sample(time, value)) {
      received = *update;
      ++sent.packets;
    }
    const double off = (predict(received, time) - value).norm();
    sent.worst = std::max(sent.worst, off / deadband_width(deadband, value));
  }
  sent.model = sender.model();
  return sent;
}

// Columns t_s ... fx_N fy_N fz_N of a trace.
Signal forces(const std::string& file) {
  std::ifstream in(reckon::test::reference_data() / "haptic-traces" / file);
  std::string line, cell;
  std::getline(in, line);
  std::vector<std::string> titles;
  for (std::istringstream row(line); std::getline(row, cell, ',');) titles.push_back(cell);
  Signal signal;
  while (std::getline(in, line)) {
    std::pair<double, Vector3d> sample{0, Vector3d::Zero()};
    std::istringstream row(line);
    for (std::size_t i = 0; std::getline(row, cell, ','); ++i) {
      if (titles[i] == "t_s") sample.first = std::stod(cell);
      if (titles[i] == "fx_N") sample.second.x() = std::stod(cell);
      if (titles[i] == "fy_N") sample.second.y() = std::stod(cell);
      if (titles[i] == "fz_N") sample.second.z() = std::stod(cell);
    }
    signal.push_back(sample);
  }
  return signal;
}

class RealForces : public testing::TestWithParam<const char*> {};

TEST_P(RealForces, NeedFewSamplesAtTenPercentWeber) {
  RECKON_NEED_DATA("haptic-traces");
  const Signal signal = forces(GetParam());
  ASSERT_GT(signal.size(), 900U);
  const Sent sent = send(signal);
  const double share =
      100.0 * static_cast<double>(sent.packets) / static_cast<double>(signal.size());
  std::printf("%s: %.1f %% sent, worst %.3f of the band\n", GetParam(), share, sent.worst);
  EXPECT_LE(share, 13);
  EXPECT_LE(sent.worst, 1);
}

INSTANTIATE_TEST_SUITE_P(Traces, RealForces,
                         testing::Values("wiping-fender-0.csv", "wiping-rim-0.csv",
                                         "wiping-rim-3.csv", "sim-wall-tap.csv",
                                         "sim-wall-hold.csv", "sim-drag-stick-slip.csv",
                                         "sim-stroke-mesh.csv"));

TEST(Deadband, FollowsSmoothSignalsAlongLinesAndHoldsNoise) {
  Signal smooth, noisy;
  test::Random random(3);
  for (int i = 0; i < 4000; ++i) {
    const double t = 0.001 * i;
    smooth.emplace_back(t, Vector3d(2 * std::sin(3 * t), 0, 0));
    noisy.emplace_back(t, Vector3d(1 + random.real(-0.15, 0.15), 0, 0));
  }
  EXPECT_EQ(send(smooth).model, SignalModel::line);
  EXPECT_EQ(send(noisy).model, SignalModel::hold);
}

TEST(Deadband, SendsOneSampleOfAConstantSignal) {
  Signal constant;
  for (int i = 0; i < 1000; ++i) constant.emplace_back(0.001 * i, Vector3d(0, 3, 0));
  EXPECT_EQ(send(constant).packets, 1U);
}

TEST(Deadband, WidthIsAShareOfTheValue) {
  const Deadband deadband{0.2, 0.05};
  EXPECT_EQ(deadband_width(deadband, {0, 0, 0}), 0.05);
  EXPECT_EQ(deadband_width(deadband, {3, 4, 0}), 1.0);
}

TEST(Deadband, LostUpdateDoesNotRunAway) {
  const SignalUpdate update{1, {1, 0, 0}, {10, 0, 0}, SignalModel::line};
  EXPECT_EQ(predict(update, 1e9), Vector3d(1 + 10 * kLongestLine, 0, 0));
  EXPECT_EQ(predict(update, 0), Vector3d(1, 0, 0));
}

TEST(Deadband, IgnoresNonFiniteAndOldSamples) {
  DeadbandSender sender;
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(sender.sample(kNan, {1, 0, 0}).has_value());
  EXPECT_FALSE(sender.sample(0, {kNan, 0, 0}).has_value());
  EXPECT_TRUE(sender.sample(0, {1, 0, 0}).has_value());
  EXPECT_FALSE(sender.sample(0, {9, 0, 0}).has_value());
  EXPECT_FALSE(sender.sample(-1, {9, 0, 0}).has_value());
  EXPECT_TRUE(sender.sample(1e-300, {9, 0, 0}).has_value());
  EXPECT_TRUE(predict(*sender.sample(1, {1e300, 0, 0}), 2).allFinite());
}

}  // namespace
}  // namespace reckon::deadreckon::deadband_test
