// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Cost of order reduction and the error of its force, compared with the thesis' eigenvectors. N is
// the number of states (two for each mass), r the number kept. Error: greatest difference of the
// response over frequency, as a share of the greatest response (body: of the contact's stiffness
// 900 N/m); twice_tail is the a-priori bound. Rows of one system are adjacent: time against error.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <random>
#include <string>
#include <vector>

#include "reckon/bench/reduction/balanced_reduction.hpp"
#include "reckon/bench/reduction/congruence_reduction.hpp"
#include "reckon/bench/reduction/eigen_truncation.hpp"
#include "reckon/bench/reduction/order_choice.hpp"
#include "reckon/bench/statistics/quantile.hpp"
#include "reckon/tests/bench/support/linear_systems.hpp"
#include "reckon/tests/bench/support/membranes.hpp"

namespace {

using namespace reckon::bench;
namespace test = reckon::test;

constexpr double kStiffness = 900.0;  // of the contact [N/m]

enum class Method { krylov, snapshots, modes, balanced, eigenvectors, eigenvectors_at_rest };
constexpr const char* kNames[] = {"krylov",   "snapshots",    "modes",
                                  "balanced", "eigenvectors", "eigenvectors_at_rest"};

double largest(const StateSpace& system, double lowest, double highest) {
  const StateSpace nothing =
      static_gain(Eigen::MatrixXd::Zero(system.outputs(), system.inputs()), 0.0);
  return test::largest_difference(system, nothing, lowest, highest, 1.1);
}

StateSpace reduced(const StateSpace& system, Method method, int order) {
  switch (method) {
    case Method::eigenvectors:
      return truncated_by_eigenvectors(system, order, Dropped::forgotten).system;
    case Method::eigenvectors_at_rest:
      return truncated_by_eigenvectors(system, order, Dropped::at_rest).system;
    default:
      return BalancedReduction(system).model(order);
  }
}

Basis basis_of(Method method) {
  return method == Method::krylov      ? Basis::krylov
         : method == Method::snapshots ? Basis::snapshots
                                       : Basis::modes;
}

// A membrane of side x side masses under one point.
void membrane(benchmark::State& state, int side, int modes, Method method) {
  const SecondOrderSystem body = test::make_membrane({.side = side});
  ModalForceModel model;
  for (auto _ : state) {
    model = BodyReduction(body, basis_of(method)).model(modes);
    benchmark::DoNotOptimize(model.rest.data());
  }
  BodyCompliance full(body);
  double error = 0.0, most = 0.0;
  for (double w = 1.0; w < 6e3; w *= 1.1) {
    const auto force = [&](const std::complex<double>& u) { return 1.0 / (1.0 / kStiffness + u); };
    const std::complex<double> right = force(full.at(w)(0, 0));
    error = std::max(error, std::abs(right - force(compliance(model, w)(0, 0))));
    most = std::max(most, std::abs(right));
  }
  state.counters["masses"] = side * side;
  state.counters["modes"] = modes;
  state.counters["error"] = error / most;
}

// Least number of modes within 0.1 N for strokes of 3 mm up to 30 Hz. A damper at the corner
// couples all modes: the full body is then solved at each frequency.
void choice_of_order(benchmark::State& state, int side, bool is_coupled) {
  SecondOrderSystem body = test::make_membrane({.side = side});
  if (is_coupled) body.D.coeffRef(0, 0) += 0.01;
  const BodyReduction reduction(body);
  OrderChoice<ModalForceModel> choice;
  for (auto _ : state) {
    choice = choose_order(reduction, {3e-3, 30.0}, kStiffness, 0.1);
    benchmark::DoNotOptimize(choice.refusal.data());
  }
  state.counters["masses"] = side * side;
  state.counters["modes"] = choice.order;
  state.counters["error_N"] = choice.error;
  state.counters["bound_N"] = choice.bound;
}

// Reduces a general system of `states` states to `order`.
void general(benchmark::State& state, const StateSpace& system, int order, Method method) {
  StateSpace model;
  for (auto _ : state) {
    model = reduced(system, method, order);
    benchmark::DoNotOptimize(model.D.data());
  }
  const double size = largest(system, 1e-2, 1e5);
  state.counters["N"] = static_cast<double>(system.order());
  state.counters["r"] = order;
  state.counters["error"] = test::largest_difference(system, model, 1e-2, 1e5, 1.05) / size;
  if (method == Method::balanced) {
    state.counters["twice_tail"] = BalancedReduction(system).bound(order) / size;
  }
}

// Random passive bodies of `states` states: a chain held at one end, pressed at the other. Median
// and greatest error, and the cost of a step of the reduced model.
void random_bodies(benchmark::State& state, int states, int order) {
  std::mt19937 random(31);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<double> errors;
  StateSpace model;
  for (int round = 0; round < 60; ++round) {
    const StateSpace full = test::pressed(
        test::make_chain(states / 2, 0.005 + 0.05 * unit(random), 200 + 3000 * unit(random),
                         50 + 500 * unit(random), 10 * unit(random), 5e-3 * unit(random)),
        kStiffness);
    const BalancedReduction reduction(full);
    model = reduction.model(std::min(order, reduction.most_order()));
    errors.push_back(test::largest_difference(full, model, 1e-1, 1e5, 1.15) /
                     largest(full, 1e-1, 1e5));
  }
  const StateSpace step = discretise_zero_order_hold(model, 1e-3);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(step.order()), next = x;
  double force = 0.0;
  for (auto _ : state) {
    next.noalias() = step.A * x;
    next += step.B.col(0) * 1e-3;
    force = step.C.row(0).dot(x) + step.D(0, 0) * 1e-3;
    x.swap(next);
    benchmark::DoNotOptimize(force);
  }
  state.counters["N"] = states;
  state.counters["r"] = order;
  state.counters["median_error"] = reckon::bench::median(errors);
  state.counters["worst_error"] = reckon::bench::quantile(errors, 1);
}

void add_general(const std::string& name, const StateSpace& system, int order) {
  for (const Method method :
       {Method::balanced, Method::eigenvectors, Method::eigenvectors_at_rest}) {
    const std::string row = name + "/" + kNames[static_cast<int>(method)];
    benchmark::RegisterBenchmark(row.c_str(), [=](benchmark::State& state) {
      general(state, system, order, method);
    })->Unit(benchmark::kMillisecond);
  }
}

[[maybe_unused]] const bool registered = [] {
  for (const int side : {6, 8, 14}) {
    for (const int modes : {4, 8, 16}) {
      for (const Method method : {Method::krylov, Method::snapshots, Method::modes}) {
        const std::string row = "membrane/" + std::to_string(side * side) + "_masses/" +
                                std::to_string(modes) + "_modes/" +
                                kNames[static_cast<int>(method)];
        benchmark::RegisterBenchmark(row.c_str(), [=](benchmark::State& state) {
          membrane(state, side, modes, method);
        })->Unit(benchmark::kMillisecond);
      }
    }
  }
  for (const int side : {6, 8, 14}) {
    for (const bool is_coupled : {false, true}) {
      const std::string row = "choice_of_order/" + std::to_string(side * side) + "_masses" +
                              (is_coupled ? "_damper" : "");
      benchmark::RegisterBenchmark(row.c_str(), [=](benchmark::State& state) {
        choice_of_order(state, side, is_coupled);
      })->Unit(benchmark::kMillisecond);
    }
  }
  // As strongly damped as soft tissue.
  const auto chain = [](int masses) {
    return test::pressed(test::make_chain(masses, 0.01, 2000, 400, 5, 1e-3), kStiffness);
  };
  add_general("chain_64_to_16", chain(32), 16);
  add_general("chain_32_to_8", chain(16), 8);
  add_general("critical_damping_2_to_1", test::oscillator(1.0), 1);
  add_general("nearly_critical_2_to_1", test::oscillator(1.0 + 1e-9), 1);
  add_general("equal_lags_8_to_3", test::cascade(8, 20, 0), 3);
  add_general("near_lags_8_to_3", test::cascade(8, 20, 1e-3), 3);
  for (const int states : {4, 8, 16, 32}) {
    for (int order = 2; order < states; order *= 2) {
      const std::string row =
          "random_bodies/" + std::to_string(states) + "_to_" + std::to_string(order);
      benchmark::RegisterBenchmark(
          row.c_str(), [=](benchmark::State& state) { random_bodies(state, states, order); });
    }
  }
  return true;
}();

}  // namespace
