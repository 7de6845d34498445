// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/deadreckon/motion/drm.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "reckon/deadreckon/motion/geocentric.hpp"
#include "reckon/deadreckon/motion/rotation.hpp"
#include "reckon/tests/deadreckon/support/oracle.hpp"

namespace reckon::deadreckon {
namespace {

using Algorithm = pdu::DeadReckoningAlgorithm;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using test::Random;

constexpr std::array<Algorithm, 10> kAll = {
    Algorithm::other, Algorithm::static_, Algorithm::fpw, Algorithm::rpw, Algorithm::rvw,
    Algorithm::fvw,   Algorithm::fpb,     Algorithm::rpb, Algorithm::rvb, Algorithm::fvb};

KinematicState state_of(const nlohmann::json& v) {
  const auto& e = v.at("euler");
  return {static_cast<Algorithm>(v.at("drm").get<int>()),
          test::vector(v.at("p0")),
          quaternion_from_euler({test::number(e[0]), test::number(e[1]), test::number(e[2])}),
          test::vector(v.at("v")),
          test::vector(v.at("a")),
          test::vector(v.at("omega"))};
}

// Checks one column of expected values; returns how many vectors have it.
int check_column(const char* column, AccelerationReading reading) {
  int checked = 0;
  const auto file = test::oracle("dead_reckoning.json");
  for (const auto& v : file.at("vectors")) {
    if (!v.at("expected").contains(column)) continue;
    const auto& expected = v.at("expected").at(column);
    const Pose pose = extrapolate(state_of(v), test::number(v.at("dt")), reading);
    const double off = (pose.position - test::vector(expected.at("p"))).lpNorm<Eigen::Infinity>();
    const double turned = test::difference(pose.orientation, test::quaternion(expected.at("q_bw")));
    EXPECT_LE(off, test::number(v.at("tol").at("pos_m"))) << v.at("id");
    EXPECT_LE(turned, test::number(v.at("tol").at("quat"))) << v.at("id");
    ++checked;
  }
  return checked;
}

TEST(Drm, MeetsEveryOracleVectorAtItsTolerance) {
  RECKON_NEED_DATA("oracles/dead_reckoning.json");
  EXPECT_EQ(check_column("main", AccelerationReading::component_rate), 82);
}

TEST(Drm, MeetsEveryOracleVectorOfTheInertialReading) {
  RECKON_NEED_DATA("oracles/dead_reckoning.json");
  EXPECT_EQ(check_column("accel_inertial", AccelerationReading::inertial), 11);
}

// FPB and FVB of a state with an angular velocity can be read as moving along turning axes, with a
// constant orientation. Reckon does not use this reading; its position is then the position of RPB
// and RVB.
TEST(Drm, MeetsOraclesOfFixedModelsReadAsTurning) {
  RECKON_NEED_DATA("oracles/dead_reckoning.json");
  int checked = 0;
  const auto file = test::oracle("dead_reckoning.json");
  for (const auto& v : file.at("vectors")) {
    for (const auto& [column, reading] :
         {std::pair{"omega_used_component", AccelerationReading::component_rate},
          std::pair{"omega_used_inertial", AccelerationReading::inertial}}) {
      if (!v.at("expected").contains(column)) continue;
      const auto& expected = v.at("expected").at(column);
      KinematicState s = state_of(v);
      const Quaterniond fixed = s.orientation;
      s.algorithm = s.algorithm == Algorithm::fpb ? Algorithm::rpb : Algorithm::rvb;
      const Vector3d p = extrapolate(s, test::number(v.at("dt")), reading).position;
      EXPECT_LE((p - test::vector(expected.at("p"))).lpNorm<Eigen::Infinity>(),
                test::number(v.at("tol").at("pos_m")))
          << v.at("id") << column;
      EXPECT_LE(test::difference(fixed, test::quaternion(expected.at("q_bw"))),
                test::number(v.at("tol").at("quat")));
      ++checked;
    }
  }
  EXPECT_EQ(checked, 9);
}

// An independent reference: Runge-Kutta of R' = R [w]x and P' = R (V + A t) in long double, sharing
// no formula with the code under test.
class Reference {
 public:
  using Real = long double;
  using Vector = Eigen::Matrix<Real, 3, 1>;
  using Matrix = Eigen::Matrix<Real, 3, 3>;
  struct Motion {
    Matrix rotation;
    Vector position;
  };

  Reference(const KinematicState& s, AccelerationReading reading)
      : terms_(drm_terms(s.algorithm)),
        start_{s.orientation.toRotationMatrix().cast<Real>(), s.position.cast<Real>()},
        velocity_(terms_.velocity ? Vector(s.velocity.cast<Real>()) : Vector(Vector::Zero())),
        acceleration_(terms_.acceleration ? Vector(s.acceleration.cast<Real>())
                                          : Vector(Vector::Zero())),
        spin_(terms_.rotation ? Vector(s.angular_velocity.cast<Real>()) : Vector(Vector::Zero())) {
    const bool inertial = reading == AccelerationReading::inertial && terms_.body_axes;
    if (inertial && terms_.acceleration) acceleration_ -= spin_.cross(velocity_);
  }

  Motion at(double tau) const {
    const int steps =
        200 + static_cast<int>(400 * std::abs(tau) * static_cast<double>(spin_.norm()));
    const Real h = static_cast<Real>(tau) / steps;
    Motion m = start_;
    for (int i = 0; i < steps; ++i) step(m, h * i, h);
    return m;
  }

 private:
  Motion rate(const Motion& m, Real t) const {
    Matrix skew;
    skew << 0, -spin_.z(), spin_.y(), spin_.z(), 0, -spin_.x(), -spin_.y(), spin_.x(), 0;
    const Vector velocity = velocity_ + t * acceleration_;
    return {m.rotation * skew, terms_.body_axes ? Vector(m.rotation * velocity) : velocity};
  }
  static Motion add(const Motion& m, const Motion& rate, Real h) {
    return {m.rotation + h * rate.rotation, m.position + h * rate.position};
  }
  void step(Motion& m, Real t, Real h) const {
    const Motion k1 = rate(m, t);
    const Motion k2 = rate(add(m, k1, h / 2), t + h / 2);
    const Motion k3 = rate(add(m, k2, h / 2), t + h / 2);
    const Motion k4 = rate(add(m, k3, h), t + h);
    m = add(add(add(add(m, k1, h / 6), k2, h / 3), k3, h / 3), k4, h / 6);
  }

  DrmTerms terms_;
  Motion start_;
  Vector velocity_, acceleration_, spin_;
};

struct Residual {
  double position = 0;
  double angle = 0;
};

Residual residual(const KinematicState& s, double tau, AccelerationReading reading) {
  const Pose pose = extrapolate(s, tau, reading);
  const Reference::Motion reference = Reference(s, reading).at(tau);
  const Eigen::Matrix3d rotation = reference.rotation.cast<double>();
  return {(pose.position - reference.position.cast<double>()).norm(),
          angle_between(pose.orientation, Quaterniond(rotation).normalized())};
}

TEST(Drm, EqualsAnIndependentQuadratureForAllRates) {
  Random random(1);
  Residual worst;
  for (const Algorithm algorithm : kAll) {
    for (double rate = 1e-13; rate < 10; rate *= 4) {
      const KinematicState s = random.state(algorithm, rate);
      for (const AccelerationReading reading :
           {AccelerationReading::component_rate, AccelerationReading::inertial}) {
        const Residual r = residual(s, random.real(-5, 5), reading);
        worst = {std::max(worst.position, r.position), std::max(worst.angle, r.angle)};
        ASSERT_LE(r.position, 1e-6) << "rate " << rate << " model " << static_cast<int>(algorithm);
        ASSERT_LE(r.angle, 1e-9) << "rate " << rate << " model " << static_cast<int>(algorithm);
      }
    }
  }
  for (int i = 0; i < 120; ++i) {
    const KinematicState s = random.state(Algorithm::rvb, random.real(0, 10));
    const Residual r = residual(s, random.real(-5, 5), AccelerationReading::component_rate);
    ASSERT_LE(r.position, 1e-6);
    ASSERT_LE(r.angle, 1e-9);
  }
  std::printf("worst residual %.2g m, %.2g rad\n", worst.position, worst.angle);
}

TEST(Drm, EqualsTheQuadratureAroundTheSeriesSwitch) {
  Random random(2);
  for (double turn = 0.9; turn < 1.1; turn += 0.004) {
    const KinematicState s = random.state(Algorithm::rvb, turn);
    const Residual r = residual(s, 1.0, AccelerationReading::component_rate);
    ASSERT_LE(r.position, 1e-9) << turn;
    ASSERT_LE(r.angle, 1e-12) << turn;
  }
}

TEST(Drm, SeriesAndClosedFormMeetWithoutAStep) {
  Random random(3);
  KinematicState s = random.state(Algorithm::rvb, 1.0);
  const Pose below = extrapolate(s, std::nextafter(1.0, 0.0) - 4e-16);
  const Pose above = extrapolate(s, 1.0 + 4e-16);
  EXPECT_LE((below.position - above.position).norm(), 1e-12);
  EXPECT_LE(test::difference(below.orientation, above.orientation), 1e-15);
}

TEST(Drm, GivesTheRateOfItsPositionAsVelocity) {
  Random random(4);
  for (const Algorithm algorithm : kAll) {
    const KinematicState s = random.state(algorithm, 2.0);
    constexpr double h = 1e-5;
    const Pose before = extrapolate(s, 1.0 - h), at = extrapolate(s, 1.0),
               after = extrapolate(s, 1.0 + h);
    const Vector3d velocity = (after.position - before.position) / (2 * h);
    EXPECT_LE((at.velocity - velocity).norm(), 1e-6) << static_cast<int>(algorithm);
    const Vector3d spin = logarithm(before.orientation.conjugate() * after.orientation) / (2 * h);
    EXPECT_LE((at.angular_velocity - spin).norm(), 1e-8) << static_cast<int>(algorithm);
  }
}

TEST(Drm, IsTheUpdateItselfAtTimeZero) {
  Random random(5);
  for (const Algorithm algorithm : kAll) {
    const KinematicState s = random.state(algorithm, 3.0);
    const Pose pose = extrapolate(s, 0);
    EXPECT_EQ(pose.position, s.position);
    EXPECT_EQ(pose.orientation.coeffs(), s.orientation.coeffs());
  }
}

TEST(Drm, ZeroRateBodyModelsMoveAlongTheirAxes) {
  KinematicState s;
  s.velocity = {10, 0, 0};
  s.acceleration = {0, 2, 0};
  s.orientation = Quaterniond(Eigen::AngleAxisd(std::numbers::pi / 2, Vector3d::UnitZ()));
  for (const Algorithm algorithm : {Algorithm::rvb, Algorithm::fvb}) {
    s.algorithm = algorithm;
    const Pose pose = extrapolate(s, 3.0);
    EXPECT_LE((pose.position - Vector3d(-9, 30, 0)).norm(), 1e-14);
  }
  s.algorithm = Algorithm::rpb;
  EXPECT_LE((extrapolate(s, 3.0).position - Vector3d(0, 30, 0)).norm(), 1e-14);
}

TEST(Drm, FliesACircleInTheInertialReadingOnly) {
  // Steady turn: v forward, w about body z, inertial acceleration w x v.
  const double w = 0.1, v = 100;
  KinematicState s;
  s.algorithm = Algorithm::rvb;
  s.velocity = {v, 0, 0};
  s.acceleration = {0, v * w, 0};
  s.angular_velocity = {0, 0, w};
  const double full_turn = 2 * std::numbers::pi / w;
  EXPECT_LE(extrapolate(s, full_turn, AccelerationReading::inertial).position.norm(), 1e-9);
  EXPECT_GT(extrapolate(s, full_turn).position.norm(), 1000);
}

TEST(Drm, FixedModelsIgnoreAngularVelocity) {
  Random random(6);
  for (const Algorithm algorithm :
       {Algorithm::fpw, Algorithm::fvw, Algorithm::fpb, Algorithm::fvb}) {
    KinematicState s = random.state(algorithm, 5.0);
    const Pose spinning = extrapolate(s, 2.0);
    s.angular_velocity.setZero();
    EXPECT_EQ(spinning.position, extrapolate(s, 2.0).position);
    EXPECT_EQ(spinning.orientation.coeffs(), s.orientation.coeffs());
    EXPECT_EQ(spinning.angular_velocity, Vector3d::Zero());
  }
}

TEST(Drm, HoldsStillForStaticOtherAndUnknownModels) {
  Random random(7);
  for (const int code : {0, 1, 10, 77, 255}) {
    const KinematicState s = random.state(static_cast<Algorithm>(code), 3.0);
    const Pose pose = extrapolate(s, 9.0);
    EXPECT_EQ(pose.position, s.position);
    EXPECT_EQ(pose.velocity, Vector3d::Zero());
  }
}

TEST(Drm, StaysFiniteForEveryFloatAndEveryTime) {
  constexpr double kMost = std::numeric_limits<float>::max();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Random random(8);
  for (const Algorithm algorithm : kAll) {
    for (const double size : {0.0, 1e-320, 1e-45, 1.0, 1e10, kMost}) {
      for (const double tau : {0.0, 1e-300, 1.0, -1.0, 3600.0, 1e300, -1e300, kInfinity, -kInfinity,
                               std::numeric_limits<double>::quiet_NaN()}) {
        const KinematicState s = {algorithm,
                                  random.direction() * size,
                                  random.rotation(),
                                  random.direction() * size,
                                  random.direction() * size,
                                  random.direction() * size};
        EXPECT_TRUE(is_finite(extrapolate(s, tau))) << size << ' ' << tau;
        EXPECT_TRUE(is_finite(extrapolate(s, tau, AccelerationReading::inertial)));
      }
    }
  }
}

TEST(Drm, ExtrapolatesBackwardsInTime) {
  Random random(9);
  for (const Algorithm algorithm : {Algorithm::rpw, Algorithm::rpb}) {
    const KinematicState s = random.state(algorithm, 1.5);
    const Pose later = extrapolate(s, 4.0);
    KinematicState back = s;
    back.position = later.position;
    back.orientation = later.orientation;
    EXPECT_LE((extrapolate(back, -4.0).position - s.position).norm(), 1e-10);
  }
}

TEST(Drm, KeepsAUnitQuaternionAfterAMillionSeconds) {
  Random random(10);
  for (const Algorithm algorithm :
       {Algorithm::rpw, Algorithm::rvw, Algorithm::rpb, Algorithm::rvb}) {
    const Pose pose = extrapolate(random.state(algorithm, 0.7), 1e6);
    EXPECT_NEAR(pose.orientation.norm(), 1.0, 1e-12);
  }
}

TEST(Drm, TurnsThroughGimbalLockWithoutError) {
  // Pitching at 1 rad/s through theta = 90 degrees: the orientation is exact on either side.
  KinematicState s;
  s.algorithm = Algorithm::rvw;
  s.orientation = quaternion_from_euler({0.3, 1.2, -0.4});
  s.angular_velocity = {0, 1, 0};
  for (double tau = 0; tau < 2; tau += 0.01) {
    const Quaterniond expected = s.orientation * Eigen::AngleAxisd(tau, Vector3d::UnitY());
    const Quaterniond through_euler =
        quaternion_from_euler(euler_from_quaternion(extrapolate(s, tau).orientation));
    ASSERT_LE(test::difference(expected, through_euler), 2e-15) << tau;
  }
}

TEST(Drm, NamesStatesThatAreNotFinite) {
  Random random(11);
  const KinematicState good = random.state(Algorithm::rvb, 1.0);
  EXPECT_TRUE(is_finite(good));
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    for (const auto member : {&KinematicState::position, &KinematicState::velocity,
                              &KinematicState::acceleration, &KinematicState::angular_velocity}) {
      KinematicState s = good;
      (s.*member)[1] = bad;
      EXPECT_FALSE(is_finite(s));
    }
    KinematicState s = good;
    s.orientation.x() = bad;
    EXPECT_FALSE(is_finite(s));
  }
  KinematicState s = good;
  s.orientation.coeffs() *= 1.01;
  EXPECT_FALSE(is_finite(s));
}

}  // namespace
}  // namespace reckon::deadreckon
