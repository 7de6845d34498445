// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Cost and error of a pose, a smoothed pose and a force: time and error in one row, beside a plain
// implementation of the same.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>

#include "reckon/bench/micro/rvb_rivals.hpp"
#include "reckon/deadreckon/extrapolators/extrapolators.hpp"
#include "reckon/deadreckon/force/force_predictor.hpp"
#include "reckon/deadreckon/motion/convergence.hpp"
#include "reckon/deadreckon/motion/drm.hpp"
#include "reckon/deadreckon/motion/rotation.hpp"
#include "reckon/deadreckon/sending/model_choice.hpp"
#include "reckon/deadreckon/sending/update_policy.hpp"

namespace {

using namespace reckon::deadreckon;
using Eigen::Vector3d;
using reckon::bench::Algorithm;
using reckon::bench::kStates;
using reckon::bench::kTau;
using reckon::bench::Reference;
using reckon::bench::States;
using reckon::bench::states;
using reckon::bench::straight_rvb;
using reckon::bench::textbook_rvb;

Pose reckon_rvb(const KinematicState& s, double t) { return extrapolate(s, t); }

// range(0): angular velocity [nrad/s].
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

// The eight moving models. The error of the RVB row above is valid for the body models; the others
// are polynomials.
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

// The drawn pose of a remote entity: prediction plus the remaining error. The reported error is the
// greatest step in velocity that a viewer sees at the update.
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

// A probe 10 mm deep, with the exact force: 500 * 0.01 + 2e6 * 1e-6 = 7 N.
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

// The plane and probe of a local tangent, k (n . (x0 - x)): cost and force of a linear model sent
// once, with the probe 1 mm deeper than the point of linearisation.
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

// Work of the servo for a remote hand each millisecond: current pose, then its force.
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

// Each row of the list on three updates of a circle of 10 m at 1 rad/s, half a second later.
void history(benchmark::State& bench) {
  const Extrapolator& row = kExtrapolators[static_cast<std::size_t>(bench.range(0))];
  MotionHistory updates;
  const auto on_circle = [](double t) {
    const Vector3d x(10 * std::cos(t), 10 * std::sin(t), 0);
    return MotionSample{t, x, Eigen::Quaterniond::Identity(), {-x.y(), x.x(), 0}, -x, {0, 0, 0}};
  };
  for (const double t : {-0.5, -0.25, 0.0}) updates.add(on_circle(t));
  for (auto _ : bench) {
    Pose pose = row.predict(updates, kTau, {});
    benchmark::DoNotOptimize(pose);
  }
  bench.SetLabel(std::string(row.name));
  bench.counters["error_m"] =
      (row.predict(updates, kTau, {}).position - on_circle(kTau).position).norm();
}
BENCHMARK(history)->Name("history/row")->DenseRange(0, kExtrapolators.size() - 1);

// The owner's check at each tick: whether any receiver is wrong by more than the threshold.
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

// The owner's choice of model, checked at each tick of 1/60 s of a steady turn: 7 (RPB) is right.
void choose(benchmark::State& bench) {
  const auto on_circle = [](double t) {
    const Vector3d x(50 * std::cos(0.2 * t), 50 * std::sin(0.2 * t), 0);
    const Eigen::Quaterniond q(Eigen::AngleAxisd(0.2 * t, Vector3d::UnitZ()));
    return MotionSample{t, x, q, {-0.2 * x.y(), 0.2 * x.x(), 0}, -0.04 * x, {0, 0, 0.2}};
  };
  ModelChoice choice;
  std::array<MotionSample, 3600> samples;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    samples[i] = on_circle(static_cast<double>(i) / 60);
  }
  double lap = 0;
  std::size_t i = 0;
  for (auto _ : bench) {
    MotionSample sample = samples[i];
    sample.time += lap;
    choice.note(sample, {});
    benchmark::DoNotOptimize(choice);
    if (++i < samples.size()) continue;
    i = 0;
    lap += 60;
  }
  bench.counters["model"] = static_cast<double>(choice.chosen());
}
BENCHMARK(choose)->Name("policy/choose");

}  // namespace
