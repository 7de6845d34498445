// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Order reduction of any linear force model (thesis 4.5, steps ii to iv): unstable, free and very
// slow states are set aside and kept as they are; the stable rest is balanced, and states that
// matter little are taken as at rest, so that forces that last are answered exactly. The error has
// a bound that is known before. For elastic bodies BodyReduction is quicker and passive by form.
//
//   const BalancedReduction reduction(linearise(model, state, input).system);
//   const StateSpace small = reduction.model(8);   // within reduction.bound(8) at every frequency
#pragma once

#include <Eigen/Core>

#include "reckon/haptics/analysis/state_space.hpp"

namespace reckon::haptics {

/// The first `kept` states; the others follow without delay, as if always at rest: static gain
/// stays. Continuous: x2' = 0; sampled: x2 at its fixed point, (4.21) is a case of it.
/// @throws std::invalid_argument where the others have no rest (a pole at 0, sampled at 1)
[[nodiscard]] StateSpace residualised(const StateSpace& system, Eigen::Index kept);

class BalancedReduction {
 public:
  /// Poles slower than this are kept as they are [1/s].
  static constexpr double kSlowest = 1e-3;

  /// @param system continuous
  /// @throws std::invalid_argument as checked(), for a sampled system, and where the slow part
  /// cannot be parted from the rest without numbers beyond 1e8. Cost: O(n^3), see
  /// order_reduction.md
  explicit BalancedReduction(StateSpace system, double slowest = kSlowest);

  [[nodiscard]] const StateSpace& system() const noexcept { return system_; }
  /// Of the stable part, falling; those below 1e-8 of the first are rounding.
  [[nodiscard]] const Eigen::VectorXd& hankel_values() const noexcept { return hankel_; }
  [[nodiscard]] int least_order() const noexcept;  ///< states that are kept in any case
  [[nodiscard]] int most_order() const noexcept;   ///< above it nothing but rounding is left

  /// Static gain of the stable part to rounding. @param order in [least_order(), most_order()],
  /// else std::invalid_argument
  [[nodiscard]] StateSpace model(int order) const;
  /// States left out instead of held at rest: static gain is not kept, high frequencies are.
  [[nodiscard]] StateSpace truncated(int order) const;
  /// No frequency has a larger error, in the norm that takes the largest singular value: twice the
  /// Hankel values left out.
  [[nodiscard]] double bound(int order) const;

 private:
  void balance(const StateSpace& stable);
  void check_order(int order) const;

  StateSpace system_, slow_, balanced_;
  Eigen::MatrixXd static_gain_;  // of the stable part
  Eigen::VectorXd hankel_;
  double lost_ = 0.0;  // Hankel values below rounding, as a bound
};

}  // namespace reckon::haptics
