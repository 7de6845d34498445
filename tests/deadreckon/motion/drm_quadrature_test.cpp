// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Every dead-reckoning model against quadrature, from the numbers of the wire.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>

#include "reckon/deadreckon/motion/drm.hpp"
#include "reckon/deadreckon/motion/geocentric.hpp"
#include "reckon/tests/deadreckon/support/oracle.hpp"
#include "reckon/tests/deadreckon/support/quadrature.hpp"
#include "reckon/tests/support/soak.hpp"

namespace reckon::deadreckon::test::drm_quadrature_test {
namespace {

using Algorithm = pdu::DeadReckoningAlgorithm;
using Eigen::Vector3d;

constexpr int kStates = 100'000;
constexpr double kLongest = 10;   // [s]
constexpr double kFastest = 10;   // [rad/s]
constexpr double kMetres = 1e-6;  // required accuracy
constexpr double kRadians = 1e-9;
// Accuracy achieved: a last digit of 6.4e6 m is 1e-9 m, one of 100 rad 1e-14 rad, and in the
// inertial reading the acceleration w x v gives a speed of 1e5 m/s. Asserted here, so that a series
// that loses its ninth digit is detected.
constexpr double kMetresReached = 5e-9;
constexpr double kRadiansReached = 1e-13;
constexpr double kSpeedReached = 1e-8;  // [m/s]

struct Case {
  Algorithm algorithm;
  AccelerationReading reading;
};
constexpr auto kOwn = AccelerationReading::component_rate;
constexpr auto kOther = AccelerationReading::inertial;
constexpr std::array<Case, 11> kCases{{
    {Algorithm::static_, kOwn},
    {Algorithm::fpw, kOwn},
    {Algorithm::rpw, kOwn},
    {Algorithm::rvw, kOwn},
    {Algorithm::fvw, kOwn},
    {Algorithm::fpb, kOwn},
    {Algorithm::rpb, kOwn},
    {Algorithm::rvb, kOwn},
    {Algorithm::fvb, kOwn},
    {Algorithm::rvb, kOther},
    {Algorithm::fvb, kOther},
}};

// Not inlined: otherwise GCC 12 may carry the unrounded number into the long double of the
// reference.
[[gnu::noinline]] double as_float(double value) {
  return static_cast<double>(static_cast<float>(value));
}

Vector3d as_floats(const Vector3d& v) {
  return {as_float(v.x()), as_float(v.y()), as_float(v.z())};
}

// The motion of an Entity State, and the time of its extrapolation.
struct Motion {
  Euler euler;
  Vector3d position, velocity, acceleration, rate;
  double tau;

  [[nodiscard]] KinematicState state(Algorithm algorithm) const {
    return {algorithm, position, quaternion_from_euler(euler), velocity, acceleration, rate};
  }
};

class Motions {
 public:
  explicit Motions(unsigned seed) : random_(seed) {}

  Motion next() {
    Motion m;
    m.tau = tau();
    m.rate = along(rate(m.tau));
    m.euler = {as_float(random_.real(-3.14159, 3.14159)), as_float(random_.real(-1.5707, 1.5707)),
               as_float(random_.real(-3.14159, 3.14159))};
    m.position = random_.direction() * 6.4e6;
    m.velocity = along(random_.real(0, 1000));
    m.acceleration = along(random_.real(0, 100));
    return m;
  }

 private:
  Vector3d along(double size) { return as_floats(size * random_.direction()); }
  double decades(double low, double high) { return std::pow(10, random_.real(low, high)); }

  // Mostly 0 to 10 s; also exactly 0, tiny, and negative.
  double tau() {
    const double kind = random_.real(0, 1);
    if (kind < 0.05) return 0;
    if (kind < 0.10) return decades(-12, 0);
    if (kind < 0.20) return random_.real(-2, 0);
    return random_.real(0, kLongest);
  }

  // All magnitudes of rate: zero, denormal float32 values, every decade up to 10 rad/s, the fast
  // ones again, and rates where series and closed form meet.
  double rate(double t) {
    const double kind = random_.real(0, 1);
    if (kind < 0.05) return 0;
    if (kind < 0.10) return decades(-45, -12);
    if (kind < 0.70) return decades(-12, 1);
    if (kind < 0.90 || std::abs(t) < 0.11) return random_.real(0, kFastest);
    return random_.real(0.99, 1.01) / std::abs(t);
  }

  Random random_;
};

struct Off {
  double metres = 0, radians = 0, metres_a_second = 0;

  void take(const Off& o) {
    metres = std::max(metres, o.metres);
    radians = std::max(radians, o.radians);
    metres_a_second = std::max(metres_a_second, o.metres_a_second);
  }
};

// The reference for one motion: axes and rotation are computed once for all models.
class Reference {
 public:
  explicit Reference(const Motion& m, int finer = 1)
      : motion_(m),
        start_(body_to_reference(m.euler.psi, m.euler.theta, m.euler.phi)),
        turning_(m.rate.cast<Real>(), m.tau, finer),
        still_(RealVector::Zero(), m.tau, finer) {}

  struct Truth {
    RealVector position, velocity;
    RealMatrix rotation;
  };

  [[nodiscard]] Truth at(const Case& c) const {
    // The letters of the model's name, written out and not taken from drm_terms().
    static constexpr std::string_view kNames[] = {"",    "",    "FPW", "RPW", "RVW",
                                                  "FVW", "FPB", "RPB", "RVB", "FVB"};
    const std::string_view name = kNames[static_cast<std::size_t>(c.algorithm)];
    if (name.empty()) return {motion_.position.cast<Real>(), RealVector::Zero(), start_};
    const bool turns = name[0] == 'R', accelerates = name[1] == 'V', body = name[2] == 'B';
    const TurningBody& axes = turns && body ? turning_ : still_;
    const RealMatrix held_in = body ? start_ : RealMatrix(RealMatrix::Identity());
    const RealVector v = motion_.velocity.cast<Real>(), w = motion_.rate.cast<Real>();
    RealVector a = RealVector::Zero();
    if (accelerates) a = motion_.acceleration.cast<Real>();
    if (accelerates && turns && c.reading == AccelerationReading::inertial) a -= w.cross(v);
    const Real t = motion_.tau;
    return {motion_.position.cast<Real>() + held_in * axes.way(v, a),
            held_in * (axes.rotation() * (v + t * a)),
            turns ? RealMatrix(start_ * turning_.rotation()) : start_};
  }

 private:
  Motion motion_;
  RealMatrix start_;
  TurningBody turning_, still_;
};

Off compare(const Pose& pose, const Reference::Truth& truth) {
  return {static_cast<double>((pose.position.cast<Real>() - truth.position).norm()),
          static_cast<double>(angle_between(truth.rotation, rotation_of(pose.orientation))),
          static_cast<double>((pose.velocity.cast<Real>() - truth.velocity).norm())};
}

bool has_rate(Algorithm algorithm) {
  return algorithm == Algorithm::rpw || algorithm == Algorithm::rvw ||
         algorithm == Algorithm::rpb || algorithm == Algorithm::rvb;
}

TEST(DrmQuadrature, EveryModelMeetsItsAccuracyForAllRates) {
  Motions motions(20);
  std::array<Off, kCases.size()> worst;
  for (int i = 0; i < reckon::test::tries(30'000, kStates); ++i) {
    const Motion m = motions.next();
    const Reference reference(m);
    for (std::size_t k = 0; k < kCases.size(); ++k) {
      const KinematicState state = m.state(kCases[k].algorithm);
      const Pose pose = extrapolate(state, m.tau, kCases[k].reading);
      const Off off = compare(pose, reference.at(kCases[k]));
      worst[k].take(off);
      // Written so that NaN fails.
      ASSERT_TRUE(off.metres <= kMetres && off.radians <= kRadians &&
                  off.metres_a_second <= kSpeedReached)
          << "state " << i << " model " << static_cast<int>(kCases[k].algorithm) << " rate "
          << m.rate.norm() << " tau " << m.tau << ": " << off.metres << " m, " << off.radians
          << " rad, " << off.metres_a_second << " m/s";
      const Vector3d spin = has_rate(kCases[k].algorithm) ? m.rate : Vector3d(0, 0, 0);
      ASSERT_EQ(pose.angular_velocity, spin);
    }
  }
  for (std::size_t k = 0; k < kCases.size(); ++k) {
    std::printf("DRM %d%s: %.2g m, %.2g rad, %.2g m/s\n", static_cast<int>(kCases[k].algorithm),
                kCases[k].reading == kOther ? " (inertial)" : "", worst[k].metres, worst[k].radians,
                worst[k].metres_a_second);
    EXPECT_LE(worst[k].metres, kMetresReached);
    EXPECT_LE(worst[k].radians, kRadiansReached);
  }
}

// The states above cover every magnitude of turn, including zero.
TEST(DrmQuadrature, SamplesEveryDecadeOfTurn) {
  Motions motions(20);
  std::array<int, 14> in_decade{};  // |w t| from 1e-12 to 100 rad
  int none = 0, tiny = 0;
  for (int i = 0; i < kStates; ++i) {
    const Motion m = motions.next();
    const double turn = m.rate.norm() * std::abs(m.tau);
    const double decade = std::floor(std::log10(turn)) + 12;
    if (turn == 0) {
      ++none;
    } else if (decade < 0) {
      ++tiny;
    } else {
      ++in_decade[static_cast<std::size_t>(std::min(decade, 13.0))];
    }
    ASSERT_LE(m.rate.norm(), kFastest * (1 + 1e-6));
  }
  for (const int states : in_decade) EXPECT_GE(states, 1000);
  EXPECT_GE(none, 1000);
  EXPECT_GE(tiny, 1000);
}

TEST(DrmQuadrature, ReferenceIsTheSameWithTwiceThePanels) {
  Motions motions(21);
  Real worst = 0;
  for (int i = 0; i < 2000; ++i) {
    const Motion m = motions.next();
    const Reference coarse(m), fine(m, 2);
    for (const Case& c : kCases) {
      const auto a = coarse.at(c), b = fine.at(c);
      worst = std::max({worst, (a.position - b.position).norm(),
                        (a.rotation - b.rotation).lpNorm<Eigen::Infinity>()});
    }
  }
  std::printf("the reference moves by %.2Lg\n", worst);
  EXPECT_LE(worst, 1e-11L);
}

TEST(DrmQuadrature, ReferenceExponentialTurnsByItsAngle) {
  // Closed form about one axis; the weights of the nodes add up to the interval.
  const RealMatrix m = matrix_exponential({0, 0, 0.7L});
  EXPECT_LE(std::abs(m(0, 0) - std::cos(0.7L)), 1e-18L);
  EXPECT_LE(std::abs(m(1, 0) - std::sin(0.7L)), 1e-18L);
  Real sum = 0, fourteenth = 0;
  for (const auto& [x, weight] : gauss_legendre()) {
    sum += weight;
    fourteenth += weight * std::pow(x, 14.0L);
  }
  EXPECT_LE(std::abs(sum - 2), 1e-18L);
  EXPECT_LE(std::abs(fourteenth - 2.0L / 15), 1e-18L);
}

}  // namespace
}  // namespace reckon::deadreckon::test::drm_quadrature_test
