// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/devices/replay_device.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

#include "reckon/tests/support/reference_data.hpp"

namespace reckon::haptics {
namespace {

using Eigen::Vector3d;
using namespace std::chrono_literals;

class TraceFile {
 public:
  explicit TraceFile(const std::string& text)
      : path_(std::filesystem::temp_directory_path() /
              ("reckon-trace-" + std::to_string(counter_++) + "-" +
               std::to_string(reinterpret_cast<std::uintptr_t>(this)) + ".csv")) {
    std::ofstream(path_) << text;
  }
  ~TraceFile() { std::filesystem::remove(path_); }
  TraceFile(const TraceFile&) = delete;
  TraceFile& operator=(const TraceFile&) = delete;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  static inline int counter_ = 0;
  std::filesystem::path path_;
};

std::string error_of(const std::string& text) {
  const TraceFile file(text);
  try {
    const HandTrace trace(file.path());
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

// Greatest difference between the stated velocity and the slope of the stated position.
double kink(const HandTrace& trace, double until) {
  double worst = 0;
  const double h = 1e-5;
  for (double t = h; t < until; t += 1e-3) {
    const Vector3d slope = (trace.at(t + h).position - trace.at(t - h).position) / (2 * h);
    worst = std::max(worst, (slope - trace.at(t).velocity).norm());
  }
  return worst;
}

TEST(HandTrace, ReadsColumnsInAnyOrderAndIgnoresOthers) {
  const TraceFile file("pz_m, fx_N ,t_s,py_m,px_m\r\n3,9,10,2,1\r\n6,9,10.5,5,4\r\n");
  const HandTrace trace(file.path());
  EXPECT_LE((trace.at(0).position - Vector3d(1, 2, 3)).norm(), 1e-15);
  EXPECT_LE((trace.at(0.25).position - Vector3d(2.5, 3.5, 4.5)).norm(), 1e-12);
  EXPECT_LE((trace.at(0.25).velocity - Vector3d(6, 6, 6)).norm(), 1e-12);
}

TEST(HandTrace, TellsFileAndLineOfWhatIsWrong) {
  const std::string head = "t_s,px_m,py_m,pz_m\n";
  EXPECT_NE(error_of("t_s,px_m,py_m\n0,0,0\n").find(".csv:1: no column pz_m"), std::string::npos);
  EXPECT_NE(error_of(head + "0,0,0,0\n1,0,x,0\n").find(".csv:3: x is not"), std::string::npos);
  EXPECT_NE(error_of(head + "0,0,0,0\n1,nan,0,0\n").find(".csv:3:"), std::string::npos);
  EXPECT_NE(error_of(head + "0,0,0,0\n0,0,0,0\n").find("does not grow"), std::string::npos);
  EXPECT_NE(error_of(head + "0,0\n").find("only 2 columns"), std::string::npos);
  EXPECT_NE(error_of(head).find("no samples"), std::string::npos);
  EXPECT_NE(error_of("").find("empty"), std::string::npos);
  EXPECT_THROW(HandTrace("/nonexistent/trace.csv"), std::runtime_error);
}

TEST(HandTrace, IsSmoothAlsoWhereItStartsAgain) {
  std::vector<double> t;
  std::vector<Vector3d> p;
  for (int i = 0; i < 40; ++i) {
    t.push_back(i / 90.0 + (i % 3) * 1e-3);
    p.emplace_back(0.05 * std::sin(t.back()), 0.01 * t.back(), 0.02 * std::cos(3 * t.back()));
  }
  const HandTrace trace(t, p);
  EXPECT_LT(kink(trace, 2.5 * trace.duration()), 1e-4);
  const double end = trace.duration();
  EXPECT_LT((trace.at(end - 1e-9).velocity - trace.at(end + 1e-9).velocity).norm(), 1e-6);
}

TEST(HandTrace, FitsTheMotionIntoABoxWithoutDistortingIt) {
  HandTraceOptions options;
  options.fit_to = Eigen::AlignedBox3d(Vector3d(-0.05, -0.05, 0), Vector3d(0.05, 0.05, 0.1));
  options.loop = false;
  const HandTrace trace({0, 1, 2}, {{0, 0, 0}, {1, 2, 0}, {2, 4, 0}}, options);
  EXPECT_TRUE(options.fit_to->contains(trace.bounds()));
  EXPECT_NEAR(trace.bounds().sizes().y(), 0.1, 1e-12);
  EXPECT_NEAR(trace.bounds().sizes().x(), 0.05, 1e-12);
  EXPECT_LE((trace.at(99).position - trace.at(2).position).norm(), 1e-15);
}

TEST(HandTrace, InterpolatesRecordingsOfRealHands) {
  for (const char* name : {"wiping-fender-0.csv", "wiping-rim-0.csv", "wiping-rim-3.csv"}) {
    RECKON_NEED_DATA(std::string("haptic-traces/") + name);
    HandTraceOptions options;
    options.fit_to = Eigen::AlignedBox3d(Vector3d::Constant(-0.05), Vector3d::Constant(0.05));
    const HandTrace trace(test::reference_data() / "haptic-traces" / name, options);
    EXPECT_GT(trace.duration(), 9.0);
    EXPECT_LT(kink(trace, trace.duration()), 2e-3) << name;
  }
}

TEST(ReplayDevice, FollowsTheRecordedHandInFreeSpace) {
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
  ReplayDevice device(trace, config);
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
