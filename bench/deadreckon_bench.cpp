// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What a pose, a smoothed pose and a force cost, and how far off they are: time and error in one
// row, with the plain way of doing the same beside it.
#include <benchmark/benchmark.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "deadreckon/convergence.hpp"
#include "deadreckon/drm.hpp"
#include "deadreckon/force_predictor.hpp"
#include "deadreckon/kinematic_table.hpp"
#include "deadreckon/rotation.hpp"
#include "deadreckon/update_policy.hpp"

namespace {

using namespace reckon::deadreckon;
using Algorithm = reckon::pdu::DeadReckoningAlgorithm;
using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr std::size_t kStates = 256;
constexpr double kTau = 2.0;
using States = std::array<KinematicState, kStates>;

// Entities at 100 m/s and 20 m/s^2 that turn at `rate` [rad/s].
States states(Algorithm algorithm, double rate) {
  std::mt19937 engine(1);
  std::normal_distribution<double> normal;
  const auto direction = [&] {
    return Vector3d(normal(engine), normal(engine), normal(engine)).normalized();
  };
  States all;
  for (KinematicState& s : all) {
    s.algorithm = algorithm;
    s.position = 1000 * direction();
    s.orientation = exponential(direction());
    s.velocity = 100 * direction();
    s.acceleration = 20 * direction();
    s.angular_velocity = rate * direction();
  }
  return all;
}

// Runge-Kutta in long double of P' = R (V + A t), R' = R [w]x.
class Reference {
 public:
  using Vector = Eigen::Matrix<long double, 3, 1>;
  using Matrix = Eigen::Matrix<long double, 3, 3>;
  explicit Reference(const KinematicState& s)
      : velocity_(s.velocity.cast<long double>()),
        acceleration_(s.acceleration.cast<long double>()),
        rotation_(s.orientation.toRotationMatrix().cast<long double>()),
        position_(s.position.cast<long double>()) {
    const Vector w = s.angular_velocity.cast<long double>();
    skew_ << 0, -w.z(), w.y(), w.z(), 0, -w.x(), -w.y(), w.x(), 0;
  }
  Vector3d position_at(double tau) {
    constexpr int kSteps = 3000;
    const long double h = static_cast<long double>(tau) / kSteps;
    for (int i = 0; i < kSteps; ++i) step(h * i, h);
    return position_.cast<double>();
  }

 private:
  Vector rate(const Matrix& r, long double t) const { return r * (velocity_ + t * acceleration_); }
  void step(long double t, long double h) {
    // Position needs the rotation at the start, middle and end of the step: Simpson's rule.
    const Matrix middle = turned(rotation_, h / 2), end = turned(middle, h / 2);
    position_ += h / 6 * (rate(rotation_, t) + 4 * rate(middle, t + h / 2) + rate(end, t + h));
    rotation_ = end;
  }
  Matrix turned(const Matrix& r, long double h) const {
    const Matrix a = h * skew_;
    return r + r * (a + a * a / 2 + a * a * a / 6 + a * a * a * a / 24);
  }

  Vector velocity_, acceleration_;
  Matrix rotation_, skew_;
  Vector position_;
};

// The closed form as it is printed and commonly typed in: matrices, a guard for exactly zero.
Pose textbook_rvb(const KinematicState& s, double t) {
  const Vector3d& w = s.angular_velocity;
  const double n = w.norm();
  Pose pose;
  Matrix3d r1 = t * Matrix3d::Identity(), r2 = 0.5 * t * t * Matrix3d::Identity();
  pose.orientation = s.orientation;
  if (n > 0) {
    Matrix3d skew;
    skew << 0, -w.z(), w.y(), w.z(), 0, -w.x(), -w.y(), w.x(), 0;
    const double x = n * t, sine = std::sin(x), cosine = std::cos(x);
    const Matrix3d outer = w * w.transpose();
    r1 = (x - sine) / std::pow(n, 3) * outer + sine / n * Matrix3d::Identity() +
         (1 - cosine) / (n * n) * skew;
    r2 = (0.5 * x * x - cosine - x * sine + 1) / std::pow(n, 4) * outer +
         (cosine + x * sine - 1) / (n * n) * Matrix3d::Identity() +
         (sine - x * cosine) / std::pow(n, 3) * skew;
    pose.orientation = s.orientation * Eigen::AngleAxisd(x, w / n);
  }
  const Matrix3d r0 = s.orientation.toRotationMatrix();
  pose.position = s.position + r0 * (r1 * s.velocity + r2 * s.acceleration);
  pose.velocity = pose.orientation * (s.velocity + t * s.acceleration);
  pose.angular_velocity = w;
  return pose;
}

// Velocity turned once at the update: what a second-order extrapolator without R1 and R2 does.
Pose straight_rvb(const KinematicState& s, double t) {
  Pose pose;
  pose.position = s.position + s.orientation * (t * s.velocity + 0.5 * t * t * s.acceleration);
  pose.orientation = s.orientation * exponential(t * s.angular_velocity);
  pose.velocity = pose.orientation * (s.velocity + t * s.acceleration);
  pose.angular_velocity = s.angular_velocity;
  return pose;
}

Pose reckon_rvb(const KinematicState& s, double t) { return extrapolate(s, t); }

// range(0): angular velocity in nanoradians a second.
template <Pose (*Extrapolate)(const KinematicState&, double)>
void rvb(benchmark::State& bench) {
  const States all = states(Algorithm::rvb, 1e-9 * static_cast<double>(bench.range(0)));
  double worst = 0;
  for (std::size_t i = 0; i < 16; ++i) {
    const Vector3d truth = Reference(all[i]).position_at(kTau);
    worst = std::max(worst, (Extrapolate(all[i], kTau).position - truth).norm());
  }
  std::size_t i = 0;
  for (auto _ : bench) {
    Pose pose = Extrapolate(all[i++ % kStates], kTau);
    benchmark::DoNotOptimize(pose);
  }
  bench.counters["error_m"] = worst;
}
constexpr std::int64_t kRates[] = {0, 1, 400'000'000, 5'000'000'000};
void rates(benchmark::internal::Benchmark* b) {
  for (const std::int64_t rate : kRates) b->Arg(rate);
}
BENCHMARK_TEMPLATE(rvb, reckon_rvb)->Name("rvb/reckon")->Apply(rates);
BENCHMARK_TEMPLATE(rvb, textbook_rvb)->Name("rvb/textbook")->Apply(rates);
BENCHMARK_TEMPLATE(rvb, straight_rvb)->Name("rvb/straight")->Apply(rates);

// The eight moving models; error of RVB's row above holds for the body ones, the rest are
// polynomials.
void model(benchmark::State& bench) {
  const States all = states(static_cast<Algorithm>(bench.range(0)), 0.4);
  double worst = 0;
  for (const KinematicState& s : all) {
    const Pose there = extrapolate(s, kTau);
    const Vector3d by_difference =
        (extrapolate(s, kTau + 1e-5).position - extrapolate(s, kTau - 1e-5).position) / 2e-5;
    worst = std::max(worst, (there.velocity - by_difference).norm());
  }
  std::size_t i = 0;
  for (auto _ : bench) {
    Pose pose = extrapolate(all[i++ % kStates], kTau);
    benchmark::DoNotOptimize(pose);
  }
  bench.counters["velocity_error_m_per_s"] = worst;
}
BENCHMARK(model)->Name("model/drm")->DenseRange(2, 9);

// A remote entity as drawn: prediction plus what is left of the error. The error is the largest
// step in velocity that a viewer sees at the update.
template <ConvergenceCurve Curve>
void smoothed(benchmark::State& bench) {
  const States all = states(Algorithm::rvb, 0.4);
  PoseConvergence convergence({Curve, 0.1, 10});
  const Pose predicted = extrapolate(all[0], 0);
  Pose shown = predicted;
  shown.position += Vector3d(0.1, 0.2, -0.1);
  shown.velocity += Vector3d(1, 0, 0);
  shown.orientation = predicted.orientation * exponential({0.02, 0, 0.05});
  convergence.restart(shown, predicted, 0);
  const Pose first = convergence.shown(predicted, 0);

  double t = 0;
  std::size_t i = 0;
  for (auto _ : bench) {
    t = t < 0.099 ? t + 1e-6 : 0;
    Pose pose = convergence.shown(extrapolate(all[i++ % kStates], t), t);
    benchmark::DoNotOptimize(pose);
  }
  bench.counters["step_m"] = (first.position - shown.position).norm();
  bench.counters["step_m_per_s"] = (first.velocity - shown.velocity).norm();
}
BENCHMARK_TEMPLATE(smoothed, ConvergenceCurve::snap)->Name("smoothed/snap");
BENCHMARK_TEMPLATE(smoothed, ConvergenceCurve::linear)->Name("smoothed/linear");
BENCHMARK_TEMPLATE(smoothed, ConvergenceCurve::cubic)->Name("smoothed/cubic");
BENCHMARK_TEMPLATE(smoothed, ConvergenceCurve::quintic)->Name("smoothed/quintic");

ForceModel hardening(reckon::pdu::ForceModelKind kind) {
  ForceModel m;
  m.kind = kind;
  m.k1 = 500;
  m.k3 = 2e6;
  m.radius = 0.02;
  m.validity = 12;
  return m;
}

// A probe 10 mm deep, and the force there to the last digit: 500 * 0.01 + 2e6 * 1e-6 = 7 N.
constexpr double kTrueForce = 7.0;
ProbeState probe_in(const ForceModel& m) {
  const bool round = m.kind == reckon::pdu::ForceModelKind::sphere;
  ProbeState probe;
  probe.position = (round ? 0.01 : -0.01) * m.normal;
  return probe;
}

void force(benchmark::State& bench) {
  const ForceModel m = hardening(static_cast<reckon::pdu::ForceModelKind>(bench.range(0)));
  const ProbeState probe = probe_in(m);
  const Pose entity;
  for (auto _ : bench) {
    Vector3d f = evaluate(m, entity, probe);
    benchmark::DoNotOptimize(f);
  }
  bench.counters["error_N"] = std::abs(evaluate(m, entity, probe).norm() - kTrueForce);
}
BENCHMARK(force)->Name("force/kind")->DenseRange(1, 4);

// The plane and probe of a local tangent, k (n . (x0 - x)): what a linear model sent once costs and
// gives when the probe is 1 mm deeper than where it was linearised.
void tangent(benchmark::State& bench) {
  const ForceModel m = hardening(reckon::pdu::ForceModelKind::plane);
  const double k = tangent_stiffness(m.k1, m.k3, 0.009);
  const double x0 = normal_force(m.k1, m.k3, 0.009) - k * 0.009;
  Vector3d probe = probe_in(m).position;
  for (auto _ : bench) {
    benchmark::DoNotOptimize(probe);
    Vector3d f = std::max(0.0, x0 - k * m.normal.dot(probe)) * m.normal;
    benchmark::DoNotOptimize(f);
  }
  bench.counters["error_N"] = std::abs(x0 + k * 0.01 - kTrueForce);
}
BENCHMARK(tangent)->Name("force/tangent");

// What the servo does for a remote hand each millisecond: pose at now, then its force.
void predicted_force(benchmark::State& bench) {
  const ForceModel m = hardening(reckon::pdu::ForceModelKind::sphere);
  KinematicState hand;
  hand.algorithm = Algorithm::rvb;
  hand.angular_velocity = {0, 0.4, 0};
  ForcePredictor predictor;
  predictor.update(m, hand, 0);
  const ProbeState probe = probe_in(m);
  double now = 0;
  for (auto _ : bench) {
    now = now < 1 ? now + 1e-6 : 0;
    Vector3d f = predictor.predict(probe, now);
    benchmark::DoNotOptimize(f);
  }
  bench.counters["error_N"] = std::abs(predictor.predict(probe, 0.5).norm() - kTrueForce);
}
BENCHMARK(predicted_force)->Name("force/predictor");

// The owner's question of each tick: is anybody wrong by more than the threshold?
void decide(benchmark::State& bench) {
  const States all = states(Algorithm::rvb, 0.4);
  UpdatePolicy policy({}, 5);
  policy.sent(all[0], 0);
  const Pose truth = extrapolate(all[0], 0.5);
  double wrong = 0;
  for (auto _ : bench) {
    const SendReason reason = policy.decide(truth, 0.5);
    wrong += reason == SendReason::none ? 0 : 1;
  }
  bench.counters["wrong"] = wrong;
}
BENCHMARK(decide)->Name("policy/decide");

// In eight sums, so that the additions do not wait for each other.
double add_up(const std::vector<double>& numbers, double start) {
  std::array<double, 8> sums{start};
  for (std::size_t i = 0; i + 8 <= numbers.size(); i += 8)
    for (std::size_t k = 0; k < 8; ++k) sums[k] += numbers[i + k];
  double sum = 0;
  for (const double part : sums) sum += part;
  return sum;
}

// A whole world at once: 1e6 entities, all models, up to 0.4 rad/s, 2 s after their updates.
constexpr std::size_t kWorld = 1'000'000;

const KinematicTable& world() {
  static const KinematicTable table = [] {
    KinematicTable made;
    made.resize(kWorld);
    for (int model = 0; model < 10; ++model) {
      const States some = states(static_cast<Algorithm>(model), 0.04 * (model + 1));
      for (std::size_t i = static_cast<std::size_t>(model); i < kWorld; i += 10)
        made.set(i, some[i % kStates], 0);
    }
    return made;
  }();
  return table;
}

void report_world(benchmark::State& state) {
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(kWorld));
  state.counters["octets_per_entity"] =
      static_cast<double>(sizeof(double) * (KinematicTable::kColumns + PoseTable::kColumns));
}

void world_at_once(benchmark::State& state) {
  const KinematicTable& table = world();
  PoseTable poses;
  poses.resize(kWorld);
  for (auto _ : state) {
    table.extrapolate(kTau, poses);
    benchmark::ClobberMemory();
  }
  report_world(state);
}
BENCHMARK(world_at_once)->Name("world/at_once")->Unit(benchmark::kMillisecond);

// The floor: the same columns read and written once.
void world_streamed(benchmark::State& state) {
  const KinematicTable& table = world();
  PoseTable poses;
  poses.resize(kWorld);
  for (auto _ : state) {
    for (std::size_t i = 0; i < PoseTable::kColumns; ++i)
      std::copy(table.column(i).begin(), table.column(i).end(), poses.data(i));
    double sum = 0;
    for (std::size_t i = PoseTable::kColumns; i < KinematicTable::kColumns; ++i)
      sum = add_up(table.column(i), sum);
    benchmark::DoNotOptimize(sum);
    benchmark::ClobberMemory();
  }
  report_world(state);
}
BENCHMARK(world_streamed)->Name("world/streamed")->Unit(benchmark::kMillisecond);

void world_one_by_one(benchmark::State& state) {
  std::vector<KinematicState> all(kWorld);
  std::vector<Pose> poses(kWorld);
  for (std::size_t model = 0; model < 10; ++model) {
    const States some =
        states(static_cast<Algorithm>(model), 0.04 * (static_cast<double>(model) + 1));
    for (std::size_t i = model; i < kWorld; i += 10) all[i] = some[i % kStates];
  }
  for (auto _ : state) {
    for (std::size_t i = 0; i < kWorld; ++i) poses[i] = extrapolate(all[i], kTau);
    benchmark::ClobberMemory();
  }
  report_world(state);
}
BENCHMARK(world_one_by_one)->Name("world/one_by_one")->Unit(benchmark::kMillisecond);

}  // namespace
