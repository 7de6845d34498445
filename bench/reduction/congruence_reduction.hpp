// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Order reduction of elastic bodies to elastic bodies (thesis 4.5, steps ii to iv, without its
// eigenvectors, which fail on them). V^T M V, V^T D V, V^T K V are again a mass, a damping and a
// stiffness for any basis V, so that the result is passive. The response to constant forces is
// exact, because the static rest contains what the basis lacks.
//
//   const SecondOrderSystem body = checked({M, D, K, B});
//   const ModalForceModel small = BodyReduction(body).model(8);
#pragma once

#include "reckon/bench/reduction/modal_force_model.hpp"
#include "reckon/bench/reduction/second_order_system.hpp"

namespace reckon::bench {

/// Basis of the reduced body's motion; rigid motions of a free body come first.
enum class Basis {
  krylov,     ///< K^-1 B, K^-1 M K^-1 B, ..: moments at frequency 0; cheapest, rarely beaten
  snapshots,  ///< responses to forces of many frequencies, main parts first (POD)
  modes,      ///< its slowest modes: O(n^3), inaccurate under a point force; for comparison
};

/// One body, reduced to any number of modes from one basis. Bases are nested: the motions of fewer
/// modes are among those of more.
class BodyReduction {
 public:
  /// Greatest number of coordinates for Basis::modes and for free bodies, whose modes cost O(n^3).
  static constexpr Eigen::Index kMostDense = 1500;

  /// @param body symmetric, M > 0, D >= 0, K >= 0: checked here
  /// @throws std::invalid_argument from checked(), for more than ModalForceModel::kMostPoints
  /// points, and above kMostDense
  explicit BodyReduction(SecondOrderSystem body, Basis basis = Basis::krylov);

  /// The same from states of the body's own run, n x any number, main parts first.
  BodyReduction(SecondOrderSystem body, const Eigen::MatrixXd& snapshots);

  [[nodiscard]] const SecondOrderSystem& body() const noexcept { return body_; }
  [[nodiscard]] Basis basis() const noexcept { return kind_; }
  [[nodiscard]] int least_modes() const noexcept;  ///< rigid motions
  [[nodiscard]] int most_modes() const noexcept;   ///< of the basis, <= ModalForceModel::kMostModes

  /// @param modes in [least_modes(), most_modes()], else std::invalid_argument. The static
  /// compliance is that of the body to rounding. Coupling of modes by the dampers is left out (none
  /// if D = a M + b K); the error that choose_order() measures includes this.
  [[nodiscard]] ModalForceModel model(int modes) const;

 private:
  void check_size() const;
  void project();

  SecondOrderSystem body_;
  Basis kind_;
  StaticSolver solver_;
  Eigen::MatrixXd basis_, M_, D_, K_, B_;  // of the basis: projected
  Eigen::MatrixXd static_compliance_;      // of the elastic part
};

}  // namespace reckon::bench
