// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The view of a vehicle over a poor link: smoothness against error.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "reckon/deadreckon/motion/convergence.hpp"
#include "reckon/deadreckon/motion/drm.hpp"
#include "reckon/tests/deadreckon/support/oracle.hpp"

namespace reckon::deadreckon {
namespace {

using Eigen::Vector3d;
using test::Random;
using Curve = ConvergenceCurve;

// A vehicle on a circle over a network with delay and loss, drawn at 60 Hz.
struct Viewing {
  double rms = 0;            // displayed against true position [m]
  double velocity_step = 0;  // largest change of the displayed velocity between two frames [m/s]
};

KinematicState on_circle(double t) {
  constexpr double radius = 100, rate = 0.2;
  const Vector3d out = {std::cos(rate * t), std::sin(rate * t), 0};
  const Vector3d along = {-out.y(), out.x(), 0};
  KinematicState s;
  s.algorithm = pdu::DeadReckoningAlgorithm::rvw;
  s.position = radius * out;
  s.velocity = radius * rate * along;
  s.acceleration = -radius * rate * rate * out;
  return s;
}

Viewing view(Curve curve) {
  constexpr double frame = 1.0 / 60, period = 0.2;
  Random random(5);
  ConvergenceSettings settings;
  settings.curve = curve;
  settings.duration = settings.longest = period;
  PoseConvergence convergence(settings);
  KinematicState newest = on_circle(0);
  double sent = 0, next = period, squares = 0;
  double arrival = next + 0.08 * random.real(0.6, 1.4);
  Pose before = extrapolate(newest, 0);
  Vector3d velocity = newest.velocity;
  Viewing seen;
  int frames = 0;
  for (double now = frame; now < 120; now += frame, ++frames) {
    while (arrival <= now) {
      const bool lost = random.real(0, 1) < 0.1;
      if (!lost) {
        const Pose shown = convergence.shown(extrapolate(newest, now - sent), now);
        newest = on_circle(next);
        sent = next;
        convergence.restart(shown, extrapolate(newest, now - sent), now);
      }
      next += period;
      arrival = next + 0.08 * random.real(0.6, 1.4);
    }
    const Pose shown = convergence.shown(extrapolate(newest, now - sent), now);
    const Vector3d drawn = (shown.position - before.position) / frame;
    squares += (shown.position - on_circle(now).position).squaredNorm();
    seen.velocity_step = std::max(seen.velocity_step, (drawn - velocity).norm());
    velocity = drawn;
    before = shown;
  }
  seen.rms = std::sqrt(squares / frames);
  return seen;
}

TEST(Convergence, CubicIsTenTimesSmootherThanSnap) {
  const Viewing snap = view(Curve::snap), cubic = view(Curve::cubic);
  std::printf("snap %.4f m, %.3f m/s; cubic %.4f m, %.3f m/s\n", snap.rms, snap.velocity_step,
              cubic.rms, cubic.velocity_step);
  EXPECT_LE(cubic.velocity_step, 0.1 * snap.velocity_step);
  EXPECT_LE(cubic.rms, 2 * snap.rms);
}

}  // namespace
}  // namespace reckon::deadreckon
