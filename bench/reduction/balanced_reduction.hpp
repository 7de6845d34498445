// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Order reduction of any linear force model (thesis 4.5, steps ii to iv). Unstable, free and very
// slow states are split off and kept unchanged. The stable rest is balanced, and its least
// important states are treated as at rest, so that the response to constant forces is exact. The
// error has an a-priori bound. For elastic bodies BodyReduction is faster, and passive by its form.
//
//   const BalancedReduction reduction(linearise(model, state, input).system);
//   const StateSpace small = reduction.model(8);   // within reduction.bound(8) at every frequency
#pragma once

#include <Eigen/Core>

#include "reckon/bench/linear_systems/state_space.hpp"

namespace reckon::bench {

/// Keeps the first `kept` states. The others follow without delay, as if always at rest, so that
/// the static gain stays. Continuous: x2' = 0; sampled: x2 at its fixed point, of which (4.21) is a
/// case.
/// @throws std::invalid_argument if the others have no rest (a pole at 0, sampled at 1)
[[nodiscard]] StateSpace residualised(const StateSpace& system, Eigen::Index kept);

class BalancedReduction {
 public:
  /// Slower poles [1/s] are kept unchanged.
  static constexpr double kSlowest = 1e-3;

  /// @param system continuous
  /// @throws std::invalid_argument from checked(), for a sampled system, and if separating the slow
  /// part from the rest needs numbers beyond 1e8. Cost: O(n^3), see order_reduction.md
  explicit BalancedReduction(StateSpace system, double slowest = kSlowest);

  [[nodiscard]] const StateSpace& system() const noexcept { return system_; }
  /// Hankel values of the stable part, descending; those below 1e-8 of the first are rounding.
  [[nodiscard]] const Eigen::VectorXd& hankel_values() const noexcept { return hankel_; }
  [[nodiscard]] int least_order() const noexcept;  ///< states that are always kept
  [[nodiscard]] int most_order() const noexcept;   ///< further states are only rounding

  /// Model with the static gain of the stable part to rounding. @param order in [least_order(),
  /// most_order()], else std::invalid_argument
  [[nodiscard]] StateSpace model(int order) const;
  /// Leaves states out instead of holding them at rest: it keeps high frequencies and not the
  /// static gain.
  [[nodiscard]] StateSpace truncated(int order) const;
  /// Bound of the error at every frequency, in the norm of the largest singular value: twice the
  /// sum of the Hankel values left out.
  [[nodiscard]] double bound(int order) const;

 private:
  void balance(const StateSpace& stable);
  void check_order(int order) const;

  StateSpace system_, slow_, balanced_;
  Eigen::MatrixXd static_gain_;  // of the stable part
  Eigen::VectorXd hankel_;
  double lost_ = 0.0;  // Hankel values below rounding, as a bound
};

}  // namespace reckon::bench
