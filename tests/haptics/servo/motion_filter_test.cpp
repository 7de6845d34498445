// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/servo/motion_filter.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <deque>
#include <random>

#include "reckon/tests/support/soak.hpp"

namespace reckon::haptics {
namespace {

using Eigen::Vector3d;

constexpr double kTolerance = 30e-6;  // [m], the filter's default
// In units of the motion's scale. The filter's equations have a condition of about 1e4 in doubles
// of 1e-16: 1e-12. The rest is for windows divided by a pause of up to 2 s, a thousand times the
// sample distance, with a condition a million times worse.
constexpr double kAgreement = 1e-9;
constexpr double kAgreementOverPauses = 1e-8;

struct Motion {
  Vector3d velocity = Vector3d::Zero();
  Vector3d acceleration = Vector3d::Zero();
  double speed_scale = 0.0;         // [m/s], displacement in the window over its length
  double acceleration_scale = 0.0;  // [m/s^2]
};

// The same parabolas fitted from scratch, by the filter's definition, with 11 more bits.
class DirectFit {
 public:
  void add(const Vector3d& position, double time) {
    if (!position.allFinite() || !std::isfinite(time)) return;
    if (!samples_.empty() && !(time > samples_.front().time)) return;
    samples_.push_front({time, position});
    if (samples_.size() > MotionFilter::kWindow) samples_.pop_back();
  }
  void reset() { samples_.clear(); }

  [[nodiscard]] Motion motion() const {
    Motion out;
    std::size_t window = samples_.size();
    if (window < 3) return out;
    Parabola parabola = fit(window);
    out.acceleration = (2 * parabola.c.row(2) / (parabola.span * parabola.span)).cast<double>();
    out.acceleration_scale = static_cast<double>(parabola.way / (parabola.span * parabola.span));
    for (window /= 2; window >= 8 && parabola.misfit > kTolerance; window /= 2) {
      parabola = fit(window);
    }
    out.velocity = (parabola.c.row(1) / parabola.span).cast<double>();
    out.speed_scale = static_cast<double>(parabola.way / parabola.span);
    return out;
  }

 private:
  using Real = long double;
  using Column = Eigen::Matrix<Real, 3, 1>;
  using Square = Eigen::Matrix<Real, 3, 3>;
  struct Sample {
    double time;
    Vector3d position;
  };
  struct Parabola {
    Square c;  // row: power of time over the span, column: axis
    Real misfit = 0, way = 0, span = 0;
  };

  [[nodiscard]] Parabola fit(std::size_t count) const {
    const Sample& now = samples_.front();
    Parabola out;
    out.span = Real(now.time) - Real(samples_[count - 1].time);
    const auto powers = [&](std::size_t i) {
      const Real t = (Real(samples_[i].time) - Real(now.time)) / out.span;
      return Column(1, t, t * t);
    };
    const auto way = [&](std::size_t i) {
      return Column(samples_[i].position.cast<Real>() - now.position.cast<Real>());
    };
    Square normal = Square::Zero();
    Square products = Square::Zero();
    for (std::size_t i = 0; i < count; ++i) {
      normal += powers(i) * powers(i).transpose();
      products += powers(i) * way(i).transpose();
      out.way = std::max(out.way, way(i).norm());
    }
    out.c = normal.inverse() * products;
    for (std::size_t i = 0; i < count; ++i) {
      const Column miss = way(i) - out.c.transpose() * powers(i);
      out.misfit = std::max(out.misfit, miss.cwiseAbs().maxCoeff());
    }
    return out;
  }

  std::deque<Sample> samples_;  // newest first
};

// Difference between filter and direct fit, in units of the motion's scale.
struct Worst {
  double velocity = 0.0;
  double acceleration = 0.0;

  void note(const MotionFilter& filter, const DirectFit& direct) {
    const Motion truth = direct.motion();
    const auto off = [](const Vector3d& a, const Vector3d& b, double scale) {
      const double difference = (a - b).norm();
      return difference > 0 ? difference / scale : 0.0;
    };
    velocity = std::max(velocity, off(filter.velocity(), truth.velocity, truth.speed_scale));
    acceleration = std::max(
        acceleration, off(filter.acceleration(), truth.acceleration, truth.acceleration_scale));
  }
};

// A hand that strokes, rests, trembles and jumps, sometimes read by an encoder of 10 um.
class Hand {
 public:
  explicit Hand(unsigned seed, double far) : random_(seed) { place_.setConstant(far); }

  Vector3d next(double dt) {
    if (u_(random_) < 0.002) mode_ = static_cast<int>(4 * u_(random_));
    if (u_(random_) < 1e-5) place_ += 0.5 * any();
    const Vector3d pull = mode_ == 0 ? Vector3d(-20.0 * velocity_) : Vector3d(30.0 * any());
    velocity_ += dt * pull - dt * velocity_;
    place_ += dt * velocity_;
    if (mode_ == 2) return (place_ / 1e-5).array().round().matrix() * 1e-5;
    if (mode_ == 3) return place_ + 1e-5 * any();
    return place_;
  }
  std::mt19937& random() { return random_; }

 private:
  Vector3d any() { return {n_(random_), n_(random_), n_(random_)}; }

  std::mt19937 random_;
  std::uniform_real_distribution<double> u_{0.0, 1.0};
  std::normal_distribution<double> n_;
  Vector3d place_, velocity_ = Vector3d::Zero();
  int mode_ = 1;
};

TEST(MotionFilter, EqualsTheDirectFitOverHours) {
  for (const double far : {0.0, 1e3, -1e3}) {
    MotionFilter filter;
    DirectFit direct;
    Hand hand(7, far);
    Worst worst;
    double time = far == 0.0 ? 0.0 : 1e5;
    // In a soak 10 million for all three: 2.8 hours at 1 kHz.
    const int steps = test::tries(400'000, 3'400'000);
    for (int i = 0; i < steps; ++i) {
      time += 1e-3;
      const Vector3d position = hand.next(1e-3);
      filter.add(position, time);
      direct.add(position, time);
      if (i % 41 == 0 || i > steps - 1000) worst.note(filter, direct);
    }
    std::printf("far %g m: velocity off by %.2g, acceleration by %.2g\n", far, worst.velocity,
                worst.acceleration);
    EXPECT_LE(worst.velocity, kAgreement) << "far " << far;
    EXPECT_LE(worst.acceleration, kAgreement) << "far " << far;
  }
}

TEST(MotionFilter, EqualsTheDirectFitForAnySpacing) {
  for (unsigned seed = 0; seed < test::tries(6U, 20U); ++seed) {
    MotionFilter filter;
    DirectFit direct;
    Hand hand(seed, seed % 2 == 0 ? 0.1 : 1e3);
    std::uniform_real_distribution<double> u(0.0, 1.0);
    Worst worst;
    double time = 0.0;
    for (int i = 0; i < 20'000; ++i) {
      const double draw = u(hand.random());
      double dt = seed % 3 == 0 ? 1e-3 : 1e-3 * (0.2 + 1.6 * u(hand.random()));
      if (draw < 0.01) dt = 0.1 * u(hand.random());   // a pause
      if (draw < 0.001) dt = 2.0 * u(hand.random());  // a long one
      if (draw > 0.98) dt = 0.0;                      // repeated: ignored
      if (draw > 0.995) dt = -1e-3;                   // out of order: ignored
      const Vector3d position = hand.next(std::max(dt, 0.0));
      filter.add(position, time + dt);
      direct.add(position, time + dt);
      time = std::max(time, time + dt);
      if (u(hand.random()) < 0.001) {
        filter.reset();
        direct.reset();
        continue;
      }
      worst.note(filter, direct);
    }
    EXPECT_LE(worst.velocity, kAgreementOverPauses) << "seed " << seed;
    EXPECT_LE(worst.acceleration, kAgreementOverPauses) << "seed " << seed;
  }
}

// Two instants a day ago give no slope: the parabola must not be used.
TEST(MotionFilter, StaysFiniteAndCalmAfterAnyPause) {
  for (const double pause : {1.0, 1e3, 1e5, 1e9}) {
    MotionFilter filter;
    for (int i = 0; i < 40; ++i) filter.add(Vector3d(1e-4 * i, 0.0, 0.0), 1e-3 * i);
    for (int i = 0; i < 40; ++i) {
      filter.add(Vector3d(5e-3, 1e-4 * i, 0.0), pause + 1e-3 * i);
      ASSERT_TRUE(filter.velocity().allFinite() && filter.acceleration().allFinite());
      EXPECT_LT(filter.velocity().norm(), 0.3) << "pause " << pause << " sample " << i;
    }
    EXPECT_NEAR(filter.velocity().y(), 0.1, 1e-4) << "pause " << pause;
  }
}

}  // namespace
}  // namespace reckon::haptics
