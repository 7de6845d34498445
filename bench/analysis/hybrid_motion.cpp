// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/analysis/hybrid_motion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace reckon::bench {
namespace {

// (1 - e^-y)/y and (e^-y - 1 + y)/y^2, which are 1 and 1/2 at 0.
double first_integral(double y) { return y == 0 ? 1.0 : -std::expm1(-y) / y; }
double second_integral(double y) {
  if (std::abs(y) > 0.5) return (std::expm1(-y) + y) / (y * y);
  // A series, because the difference above would lose its digits.
  double term = 0.5, sum = 0.5;
  for (int k = 3; k < 20; ++k) sum += term *= -y / k;
  return sum;
}

double acceleration(const MassDamper& body, const MotionState& s, double force) {
  return (force - body.damping * s.velocity) / body.mass;
}

// Time at which the velocity is 0, for a body that slows down; infinite if it never is.
double turning_time(const MassDamper& body, const MotionState& s, double force) {
  const double a = acceleration(body, s, force);
  if (s.velocity == 0) return 0.0;
  if (s.velocity * a >= 0) return std::numeric_limits<double>::infinity();
  const double rate = body.damping / body.mass;
  const double without = -s.velocity / a;
  if (rate == 0) return without;
  // v + a (1 - e^{-rt})/r = 0
  const double decay = without * rate;
  return decay < 1 ? -std::log1p(-decay) / rate : std::numeric_limits<double>::infinity();
}

// The single root in [low, high] on a falling section that is above the stop at `low` and not at
// `high`.
double root_between(const MassDamper& body, const MotionState& s, double force, double stop,
                    double low, double high) {
  double t = 0.5 * (low + high);
  for (int i = 0; i < 200; ++i) {
    const MotionState at = advanced(body, s, force, t);
    (at.position > stop ? low : high) = t;
    double next = at.velocity < 0 ? t - (at.position - stop) / at.velocity : low;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    if (next == t || high - low <= std::numeric_limits<double>::epsilon() * high) break;
    t = next;
  }
  return t;
}

}  // namespace

MotionState advanced(const MassDamper& body, const MotionState& s, double force,
                     double time) noexcept {
  const double y = body.damping * time / body.mass;
  const double a = acceleration(body, s, force);
  return {s.position + s.velocity * time + a * time * time * second_integral(y),
          s.velocity + a * time * first_integral(y)};
}

std::optional<double> first_contact(const MassDamper& body, const MotionState& s, double force,
                                    double stop, double horizon) noexcept {
  const double a = acceleration(body, s, force);
  const bool at_stop = s.position <= stop;
  if (at_stop && (s.velocity < 0 || (s.velocity == 0 && a < 0))) return 0.0;
  // The body falls from the start or from its turning point, and at most until its next turning
  // point.
  const double turn = turning_time(body, s, force);
  const bool rising = s.velocity > 0 || (s.velocity == 0 && a > 0);
  if (rising && (a >= 0 || turn >= horizon)) return std::nullopt;
  const double from = rising ? turn : 0.0;
  const double to = rising ? horizon : std::min(horizon, turn == 0.0 ? horizon : turn);
  if (advanced(body, s, force, to).position > stop) return std::nullopt;
  return root_between(body, s, force, stop, from, to);
}

HybridMotion::HybridMotion(const MassDamper& body, const MotionState& start, const RigidStop& stop)
    : body_(body), state_(start), stop_(stop) {
  const auto require = [](bool good, const char* what) {
    if (!good) throw std::invalid_argument(std::string("hybrid motion: ") + what);
  };
  require(body.mass > 0 && std::isfinite(body.mass), "the mass must be above 0 kg");
  require(body.damping >= 0 && std::isfinite(body.damping), "the damping must be 0 or more N s/m");
  require(std::isfinite(start.position) && std::isfinite(start.velocity) &&
              std::isfinite(stop.position),
          "position, velocity and stop must be finite");
  require(start.position >= stop.position, "the body must start at or above the stop");
  require(stop.restitution >= 0 && stop.restitution <= 1, "restitution must be 0 to 1");
  require(stop.rest_speed >= 0, "the rest speed must be 0 or more m/s");
}

bool HybridMotion::rests(double force) const noexcept {
  return state_.position == stop_.position && state_.velocity == 0 && force <= 0;
}

// Set to the stop exactly, so that the error of the root does not accumulate over many bounces.
void HybridMotion::bounce() {
  const double before = state_.velocity;
  state_.position = stop_.position;
  state_.velocity = -stop_.restitution * before;
  if (state_.velocity <= stop_.rest_speed) state_.velocity = 0.0;
  lost_ += 0.5 * body_.mass * (before * before - state_.velocity * state_.velocity);
  ++impacts_;
}

bool HybridMotion::run_to_impact(double force, double horizon) {
  if (rests(force)) return false;
  const auto contact = first_contact(body_, state_, force, stop_.position, horizon);
  if (!contact) return false;
  state_ = advanced(body_, state_, force, *contact);
  time_ += *contact;
  bounce();
  return true;
}

void HybridMotion::run(double force, double duration) {
  const double end = time_ + duration;
  while (time_ < end && run_to_impact(force, end - time_)) {
  }
  if (!rests(force)) state_ = advanced(body_, state_, force, std::max(0.0, end - time_));
  time_ = end;
}

}  // namespace reckon::bench
