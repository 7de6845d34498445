// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/devices/hand_trace.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "reckon/haptics/devices/simulated_device.hpp"
#include "reckon/tests/haptics/support/hand_trace_kink.hpp"

namespace reckon::haptics {
namespace {

using Eigen::Vector3d;
using namespace std::chrono_literals;

TEST(HandTrace, IsSmoothAtItsRestart) {
  std::vector<double> t;
  std::vector<Vector3d> p;
  for (int i = 0; i < 40; ++i) {
    t.push_back(i / 90.0 + (i % 3) * 1e-3);
    p.emplace_back(0.05 * std::sin(t.back()), 0.01 * t.back(), 0.02 * std::cos(3 * t.back()));
  }
  const HandTrace trace(t, p);
  EXPECT_LT(test::kink(trace, 2.5 * trace.duration()), 1e-4);
  const double end = trace.duration();
  EXPECT_LT((trace.at(end - 1e-9).velocity - trace.at(end + 1e-9).velocity).norm(), 1e-6);
}

TEST(HandTrace, FitsTheMotionIntoABoxUndistorted) {
  HandTraceOptions options;
  options.fit_to = Eigen::AlignedBox3d(Vector3d(-0.05, -0.05, 0), Vector3d(0.05, 0.05, 0.1));
  options.loop = false;
  const HandTrace trace({0, 1, 2}, {{0, 0, 0}, {1, 2, 0}, {2, 4, 0}}, options);
  EXPECT_TRUE(options.fit_to->contains(trace.bounds()));
  EXPECT_NEAR(trace.bounds().sizes().y(), 0.1, 1e-12);
  EXPECT_NEAR(trace.bounds().sizes().x(), 0.05, 1e-12);
  EXPECT_LE((trace.at(99).position - trace.at(2).position).norm(), 1e-15);
}

TEST(HandTrace, MovesASimulatedDeviceInFreeSpace) {
  std::vector<double> t;
  std::vector<Vector3d> p;
  for (int i = 0; i < 300; ++i) {
    t.push_back(i * 0.01);
    p.emplace_back(0.03 * std::sin(4 * t.back()), 0.03 * std::cos(4 * t.back()), 0);
  }
  const HandTrace trace(t, p);
  SimulatedDeviceConfig config;
  config.hand_stiffness = 500;
  config.hand_damping = 8;
  config.start = trace.at(0.0).position;
  SimulatedDevice device(config, [&trace](double time) { return trace.at(time); });
  EXPECT_EQ((device.position() - p[0]).norm(), 0.0);
  double worst = 0;
  for (auto now = 0ns; now < 2900ms; now += 1ms) {
    const Vector3d wanted = trace.at(1e-9 * static_cast<double>(now.count())).position;
    worst = std::max(worst, (device.read(now).position - wanted).norm());
    device.write(Vector3d::Zero(), now);
  }
  EXPECT_LT(worst, 0.003);
}

}  // namespace
}  // namespace reckon::haptics
