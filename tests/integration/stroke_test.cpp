// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Strokes, compared with the limits of the delay: two springs and grips whose ends know each
// other's position with the line's delay and nothing else.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstdio>
#include <numbers>
#include <string>
#include <vector>

#include "reckon/pdu/seconds.hpp"
#include "reckon/tests/support/in_process.hpp"

namespace reckon::test {
namespace {

using Complex = std::complex<double>;

constexpr double kBetween = 500;                     // [N/m]
constexpr double kStroker = 300, kHolder = 150;      // [N/m], stroking and resting hand
constexpr double kGripDamping = 3, kHandMass = 0.1;  // [N s/m], [kg]
constexpr double kDeep = 0.015, kAmplitude = 0.005;  // [m]
constexpr double kStrokesFrom = 4, kMeasuredFrom = 6, kStrokesEnd = 10;  // [s]

constexpr std::string_view kStrokes = R"(
[scene]
name = "stroke"
origin = {latitude = "47.05 deg", longitude = "8.31 deg", height = "430 m"}

[aoim]
pool = 16

[dead_reckoning]
force = "15 mN"

[hand]
radius = "20 mm"
k1 = "500 N/m"

[[operator]]
passive = true
position = "-100 0 0 mm"
stiffness = "300 N/m"
damping = "3 N s/m"

[[operator]]
passive = true
position = "40.001 0 0 mm"
stiffness = "150 N/m"
damping = "3 N s/m"
)";

// Forces of both ends at the stroke's frequency, for 1 m of stroke.
struct Response {
  Complex strokes, holds;
};

// Each end shows F = K (own position - the other's position `delay` ago), to first order.
Response coupled(double frequency, double delay) {
  const Complex s(0, 2 * std::numbers::pi * frequency), late = std::exp(-s * delay);
  const double damping = kGripDamping + peer::DeviceConfig{}.damping;
  const auto hand = [&](double grip) { return kHandMass * s * s + damping * s + grip + kBetween; };
  Eigen::Matrix2cd a;
  a << hand(kStroker), -kBetween * late, -kBetween * late, hand(kHolder);
  const Eigen::Vector2cd x = a.partialPivLu().solve(Eigen::Vector2cd(kStroker, 0));
  return {kBetween * (x(0) - x(1) * late), kBetween * (x(0) * late - x(1))};
}

Response measured(double frequency, double delay) {
  const peer::SceneFile scene = scene_of(kStrokes);
  InProcess world(2);
  peer::ImpairmentLaw law;
  law.delay = pdu::from_seconds(delay);
  law.jitter = pdu::from_seconds(0.3 * delay);
  world.network().impair(law);
  const double rate = 2 * std::numbers::pi * frequency;
  world.move_by(0, [rate](double t) {
    const double in = std::clamp((t - 1) / 1.5, 0.0, 1.0);
    haptics::HandTarget target;
    target.position.x() = -0.03 + in * in * (3 - 2 * in) * (0.03 + kDeep);
    if (t > kStrokesFrom) target.position.x() += kAmplitude * std::sin(rate * (t - kStrokesFrom));
    return target;
  });
  world.start(0, scene);
  world.start(1, scene);
  std::array<haptics::TraceRing, 2> steps{haptics::TraceRing(64), haptics::TraceRing(64)};
  std::array<double, 2> force{};
  std::array<Complex, 2> sum{};
  world.peer(0).trace(&steps[0]);
  world.peer(1).trace(&steps[1]);
  int count = 0;
  for (double t = 0; t < kStrokesEnd; t += 1e-3) {
    world.run(1);
    for (std::size_t i = 0; i < 2; ++i) {
      for (; const haptics::ServoSnapshot* servo = steps[i].front(); steps[i].pop())
        force[i] = servo->force.x() * (i == 0 ? -1 : 1);
      if (t >= kMeasuredFrom) sum[i] += force[i] * std::polar(1.0, -rate * (t - kStrokesFrom));
    }
    if (t >= kMeasuredFrom) ++count;
  }
  const Complex scale(0, 2.0 / (kAmplitude * count));  // of a sine
  return {sum[0] * scale, sum[1] * scale};
}

double factor(const Complex& a, const Complex& b) {
  const double ratio = std::abs(a) / std::abs(b);
  return std::max(ratio, 1 / ratio);
}

double degrees(const Complex& value) { return std::arg(value) * 180 / std::numbers::pi; }

// It prints the figures of docs/measurements/touch.md.
TEST(Strokes, AreNearTheLimitsOfTheDelay) {
  int near = 0, all = 0;
  std::printf(
      "Hz, delay: gain and phase [deg] beside no delay; of who strokes, of who holds still\n");
  for (const double frequency : {1.0, 1.5, 3.0, 6.0}) {
    for (const double delay : {0.0003, 0.005, 0.02, 0.05}) {
      const Response right = coupled(frequency, 0), best = coupled(frequency, delay);
      const Response ours = measured(frequency, delay);
      const auto say = [](const Complex& value, const Complex& of) {
        std::printf("  %.2f at %4.0f", std::abs(value / of), degrees(value / of));
      };
      std::printf("%.1f Hz, %4.1f ms: delay alone", frequency, 1e3 * delay);
      say(best.strokes, right.strokes);
      say(best.holds, right.holds);
      std::printf("; ours");
      say(ours.strokes, right.strokes);
      say(ours.holds, right.holds);
      std::printf("\n");
      for (const double off :
           {factor(ours.strokes, best.strokes), factor(ours.holds, best.holds)}) {
        ++all;
        near += off <= 1.3 ? 1 : 0;
        EXPECT_LE(off, 2.1) << frequency << " Hz, " << delay << " s";
      }
    }
  }
  std::printf("within 1.3 of what the delay allows: %d of %d\n", near, all);
  EXPECT_GE(near, 19);
}

}  // namespace
}  // namespace reckon::test
