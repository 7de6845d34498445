// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/bodies/flight.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace reckon::haptics {
namespace {

constexpr double kLittleDrag = 1e-5;   // drag times time below which its square is lost in rounding
constexpr double kShortFlight = 1e-6;  // [s] between rebounds of a body that comes to rest
constexpr int kMostRebounds = 10'000;  // in a step

Flight parabola(const Flight& from, double acceleration, double t) noexcept {
  return {from.place + (from.speed + 0.5 * acceleration * t) * t, from.speed + acceleration * t};
}

// Time until `distance` [m] >= 0 is covered in the direction of positive speed; infinity if never.
double time_to(double distance, double speed, double acceleration) noexcept {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  const double square = speed * speed + 2.0 * acceleration * distance;
  if (square < 0.0) return kNever;
  const double root = std::sqrt(square);
  // These forms avoid cancellation.
  if (speed < 0.0) return acceleration > 0.0 ? (root - speed) / acceleration : kNever;
  if (speed + root > 0.0) return 2.0 * distance / (speed + root);
  return acceleration > 0.0 ? 0.0 : kNever;
}

}  // namespace

Flight fly(const Flight& from, double acceleration, double drag, double dt) noexcept {
  const double x = drag * dt;
  const double lost = -std::expm1(-x);
  // (1 - e^-x) / x, and the mean of that from 0 to x.
  double one = 1.0 - x / 2 * (1.0 - x / 3 * (1.0 - x / 4 * (1.0 - x / 5)));
  double two = 0.5 - x / 6 * (1.0 - x / 4 * (1.0 - x / 5 * (1.0 - x / 6)));
  if (x > kLittleDrag) {
    one = lost / x;
    two = (1.0 - one) / x;
  }
  return {from.place + (from.speed * one + acceleration * dt * two) * dt,
          from.speed - from.speed * lost + acceleration * dt * one};
}

Flight bounce(const Flight& from, double acceleration, const Walls& walls, double dt) noexcept {
  if (!(walls.low < walls.high)) return {0.5 * (walls.low + walls.high), 0.0};
  Flight now{std::clamp(from.place, walls.low, walls.high), from.speed};
  double left = dt;
  for (int i = 0; i < kMostRebounds; ++i) {
    const double up = time_to(walls.high - now.place, now.speed, acceleration);
    const double down = time_to(now.place - walls.low, -now.speed, -acceleration);
    const double hit = std::min(up, down);
    if (!(hit < left)) {
      now = parabola(now, acceleration, left);
      now.place = std::clamp(now.place, walls.low, walls.high);
      return now;
    }
    const bool is_high = up < down;
    left -= hit;
    now = {is_high ? walls.high : walls.low, -walls.restitution * (now.speed + acceleration * hit)};
    // The acceleration towards the wall brings it back at once.
    const double press = is_high ? acceleration : -acceleration;
    if (press > 0.0 && 2.0 * std::abs(now.speed) < kShortFlight * press) return {now.place, 0.0};
  }
  return {now.place, 0.0};
}

Flight stop(const Flight& from, const Walls& walls) noexcept {
  Flight out = bounce(from, 0.0, walls, 0.0);
  const bool leaves =
      (from.place > walls.high && from.speed > 0.0) || (from.place < walls.low && from.speed < 0.0);
  if (leaves && walls.low < walls.high) out.speed = -walls.restitution * from.speed;
  return out;
}

}  // namespace reckon::haptics
