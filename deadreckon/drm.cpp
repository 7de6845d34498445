// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "deadreckon/drm.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "deadreckon/rotation.hpp"

namespace reckon::deadreckon {

namespace {

using Algorithm = pdu::DeadReckoningAlgorithm;
using Eigen::Quaterniond;
using Eigen::Vector3d;

// Series in (w t)^2 below this angle [rad]; kTerms leave 1e-17 there.
constexpr double kSeriesAngle = 1.0;
constexpr std::size_t kTerms = 9;
using Series = std::array<double, kTerms>;

// Coefficients (-1)^n numerator(n) / (2n + offset)! of the powers of (w t)^2.
constexpr Series series(std::size_t offset, std::size_t numerator_slope,
                        std::size_t numerator_start) {
  Series c{};
  double factorial = 1;
  std::size_t reached = 0;
  for (std::size_t n = 0; n < kTerms; ++n) {
    while (reached < 2 * n + offset) factorial *= static_cast<double>(++reached);
    const auto numerator = static_cast<double>(numerator_slope * n + numerator_start);
    c[n] = (n % 2 == 0 ? 1.0 : -1.0) * numerator / factorial;
  }
  return c;
}

constexpr Series kSineOver = series(1, 0, 1);       // sin x / x
constexpr Series kCosine = series(0, 0, 1);         // cos x
constexpr Series kVelocityTwice = series(3, 0, 1);  // (x - sin x) / x^3
constexpr Series kPositionTwice = series(4, 2, 3);  // (x^2/2 - cos x - x sin x + 1) / x^4

constexpr double sum(const Series& c, double square) {
  double total = c[kTerms - 1];
  for (std::size_t n = kTerms - 1; n-- > 0;) total = total * square + c[n];
  return total;
}

// With u = |r|, r = w t: R1 v = t (f1 v + h1 r x v + g1 r (r.v)) and R2 a = t^2 (f2 a + h2 r x a +
// g2 r (r.a)); q = exp(r/2). No division by |w| is left, so zero rate is no special case.
struct TurnTerms {
  double f1, h1, g1;
  double f2, h2, g2;
  double half_cosine, half_sine_over_angle;  // cos(u/2), sin(u/2)/u
};

TurnTerms series_terms(double square) {
  const double quarter = 0.25 * square;
  const double cosine = sum(kCosine, quarter);
  const double sine_over = sum(kSineOver, quarter);  // sin(u/2) / (u/2)
  const double f1 = sine_over * cosine;              // sin u / u
  const double h1 = 0.5 * sine_over * sine_over;     // (1 - cos u) / u^2
  const double g1 = sum(kVelocityTwice, square);
  return {f1, h1, g1, f1 - h1, h1 - g1, sum(kPositionTwice, square), cosine, 0.5 * sine_over};
}

TurnTerms closed_terms(double square) {
  const double angle = std::sqrt(square);
  const double s = std::sin(0.5 * angle);
  const double c = std::cos(0.5 * angle);
  const double f1 = 2.0 * s * c / angle;
  const double h1 = 2.0 * s * s / square;  // 1 - cos u as 2 sin^2(u/2)
  const double g1 = (1.0 - f1) / square;
  const double f2 = f1 - h1;
  return {f1, h1, g1, f2, h1 - g1, (0.5 - f2) / square, c, s / angle};
}

TurnTerms turn_terms(const Vector3d& turn) {
  const double square = turn.squaredNorm();
  return square < kSeriesAngle * kSeriesAngle ? series_terms(square) : closed_terms(square);
}

constexpr std::array<DrmTerms, 10> kTermsOf = {{
    {false, false, false, false},  // 0 other
    {false, false, false, false},  // 1 static
    {true, false, false, false},   // 2 FPW
    {true, false, true, false},    // 3 RPW
    {true, true, true, false},     // 4 RVW
    {true, true, false, false},    // 5 FVW
    {true, false, false, true},    // 6 FPB
    {true, false, true, true},     // 7 RPB
    {true, true, true, true},      // 8 RVB
    {true, true, false, true},     // 9 FVB
}};

Pose extrapolate_reference(const KinematicState& s, const DrmTerms& terms, double t) {
  Pose pose{s.position, s.orientation, Vector3d::Zero(), Vector3d::Zero()};
  if (terms.velocity) {
    pose.position += t * s.velocity;
    pose.velocity = s.velocity;
  }
  if (terms.acceleration) {
    pose.position += (0.5 * t * t) * s.acceleration;
    pose.velocity += t * s.acceleration;
  }
  if (terms.rotation) {
    pose.orientation = s.orientation * exponential(t * s.angular_velocity);
    pose.angular_velocity = s.angular_velocity;
  }
  return pose;
}

// FPB and FVB: the frame does not turn, so R1 = t I and R2 = t^2/2 I.
Pose extrapolate_fixed_body(const KinematicState& s, const DrmTerms& terms, double t) {
  Vector3d way = t * s.velocity;
  Vector3d velocity = s.velocity;
  if (terms.acceleration) {
    way += (0.5 * t * t) * s.acceleration;
    velocity += t * s.acceleration;
  }
  return {s.position + s.orientation * way, s.orientation, s.orientation * velocity,
          Vector3d::Zero()};
}

Pose extrapolate_turning_body(const KinematicState& s, const DrmTerms& terms, double t,
                              AccelerationReading reading) {
  const Vector3d turn = t * s.angular_velocity;
  const TurnTerms k = turn_terms(turn);
  Vector3d velocity = s.velocity;
  Vector3d way = t * (k.f1 * s.velocity + k.h1 * turn.cross(s.velocity) +
                      (k.g1 * turn.dot(s.velocity)) * turn);
  if (terms.acceleration) {
    Vector3d a = s.acceleration;
    if (reading == AccelerationReading::inertial) a -= s.angular_velocity.cross(s.velocity);
    way += (t * t) * (k.f2 * a + k.h2 * turn.cross(a) + (k.g2 * turn.dot(a)) * turn);
    velocity += t * a;
  }
  Quaterniond step;
  step.w() = k.half_cosine;
  step.vec() = k.half_sine_over_angle * turn;
  const Quaterniond orientation = s.orientation * step;
  return {s.position + s.orientation * way, orientation, orientation * velocity,
          s.angular_velocity};
}

}  // namespace

double bounded_tau(double tau) noexcept {
  if (std::isnan(tau)) return 0;
  return std::clamp(tau, -kLongestExtrapolation, kLongestExtrapolation);
}

DrmTerms drm_terms(Algorithm algorithm) noexcept {
  const auto row = static_cast<std::size_t>(algorithm);
  return row < kTermsOf.size() ? kTermsOf[row] : kTermsOf[0];
}

Pose extrapolate(const KinematicState& state, double tau, AccelerationReading reading) noexcept {
  const DrmTerms terms = drm_terms(state.algorithm);
  const double t = bounded_tau(tau);
  if (!terms.body_axes) return extrapolate_reference(state, terms, t);
  if (!terms.rotation) return extrapolate_fixed_body(state, terms, t);
  return extrapolate_turning_body(state, terms, t, reading);
}

}  // namespace reckon::deadreckon
