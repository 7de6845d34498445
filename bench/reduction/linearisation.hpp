// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Linearisation of a force model at its operating point (thesis 4.5, step i). Dual numbers give the
// derivatives, exact to rounding, of a function that is written once for any scalar.
//
//   struct Wall {                                  // a mass that sinks into a hardening wall
//     template <typename Scalar>
//     ModelAnswer<Scalar> operator()(const VectorOf<Scalar>& state,
//                                    const VectorOf<Scalar>& input) const {
//       const Scalar depth = one_sided<Scalar>(state[0], state[1]);
//       ModelAnswer<Scalar> answer{VectorOf<Scalar>(2), VectorOf<Scalar>(1)};
//       answer.output[0] = 500.0 * depth + 1e6 * depth * depth * depth;
//       answer.rate << state[1], (input[0] - answer.output[0]) / 0.1;
//       return answer;
//     }
//   };
//   const Linearisation at = linearise(Wall{}, Eigen::Vector2d(0.004, 0.0), force);
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <stdexcept>
#include <string>
#include <unsupported/Eigen/AutoDiff>

#include "reckon/bench/linear_systems/state_space.hpp"

namespace reckon::bench {

template <typename Scalar>
using VectorOf = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;

/// Result of a force model: x' = rate(x, u), y = output(x, u).
template <typename Scalar>
struct ModelAnswer {
  VectorOf<Scalar> rate;    ///< of the size of the state
  VectorOf<Scalar> output;  ///< of any size
};

/// Value with its derivatives by each state and input.
using Dual = Eigen::AutoDiffScalar<Eigen::VectorXd>;

inline double value_of(double number) noexcept { return number; }
inline double value_of(const Dual& number) { return number.value(); }

/// Depth of a contact that only pushes: `depth` in contact, else 0, with the derivatives of that
/// side. Within `border` of the surface the motion decides: an approaching point is in contact, a
/// resting or receding one is not. @param depth [m], > 0 inside  @param approach its rate [m/s]
template <typename Scalar>
Scalar one_sided(const Scalar& depth, const Scalar& approach, double border = 1e-9) {
  const bool on_border = std::abs(value_of(depth)) <= border;
  const bool touches = on_border ? value_of(approach) > 0.0 : value_of(depth) > 0.0;
  return touches ? depth : Scalar(0.0);
}

/// Near the operating point: x' = rate + A dx + B du, y = output + C dx + D du.
struct Linearisation {
  StateSpace system;       ///< continuous
  Eigen::VectorXd rate;    ///< 0 at an equilibrium
  Eigen::VectorXd output;  ///< at the operating point
};

namespace linearisation_detail {

inline VectorOf<Dual> seeded(const Eigen::VectorXd& values, Eigen::Index first,
                             Eigen::Index unknowns) {
  VectorOf<Dual> seeded(values.size());
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    seeded[i] = Dual(values[i], Eigen::VectorXd::Unit(unknowns, first + i));
  }
  return seeded;
}

// A constant has no derivatives.
inline void split(const VectorOf<Dual>& answer, const char* what, Eigen::VectorXd& values,
                  Eigen::MatrixXd& slopes) {
  values.resize(answer.size());
  for (Eigen::Index i = 0; i < answer.size(); ++i) {
    values[i] = answer[i].value();
    if (answer[i].derivatives().size() > 0) slopes.row(i) = answer[i].derivatives().transpose();
    if (!std::isfinite(values[i]) || !slopes.row(i).allFinite()) {
      throw std::invalid_argument("linearise: " + std::string(what) + " " + std::to_string(i) +
                                  " or a derivative of it is not finite at the operating point; "
                                  "choose a point where the model is smooth");
    }
  }
}

}  // namespace linearisation_detail

/// @param model model(state, input) -> ModelAnswer for Scalar = Dual, without side effects. A
/// branch takes the side of the operating point; write a contact with one_sided()
/// @param state n  @param input of the model, at the operating point
/// @throws std::invalid_argument if the sizes of rate and state differ, or a result is not finite.
/// Cost: one call of the model with n + inputs derivatives a number.
template <typename Model>
[[nodiscard]] Linearisation linearise(const Model& model, const Eigen::VectorXd& state,
                                      const Eigen::VectorXd& input) {
  const Eigen::Index n = state.size(), unknowns = n + input.size();
  using linearisation_detail::seeded;
  const VectorOf<Dual> states = seeded(state, 0, unknowns), inputs = seeded(input, n, unknowns);
  const ModelAnswer<Dual> answer = model(states, inputs);
  if (answer.rate.size() != n) {
    throw std::invalid_argument("linearise: the model gives " + std::to_string(answer.rate.size()) +
                                " rates for " + std::to_string(n) +
                                " states; give one for each state");
  }
  Eigen::MatrixXd rates = Eigen::MatrixXd::Zero(n, unknowns);
  Eigen::MatrixXd outputs = Eigen::MatrixXd::Zero(answer.output.size(), unknowns);
  Linearisation at;
  linearisation_detail::split(answer.rate, "rate", at.rate, rates);
  linearisation_detail::split(answer.output, "output", at.output, outputs);
  at.system = {rates.leftCols(n), rates.rightCols(input.size()), outputs.leftCols(n),
               outputs.rightCols(input.size()), 0.0};
  return at;
}

}  // namespace reckon::bench
