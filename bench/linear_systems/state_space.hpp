// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Linear time-invariant systems as matrices, continuous or sampled: the form in which force models,
// devices and their loops are analysed. Off-line code: it allocates and throws, and no servo loop
// calls it.
#pragma once

#include <Eigen/Core>
#include <complex>

namespace reckon::bench {

/// x' = A x + B u (continuous) or x_{k+1} = A x_k + B u_k (sampled), y = C x + D u.
/// A n x n, B n x inputs, C outputs x n, D outputs x inputs; n may be 0. The caller chooses the
/// units.
///
///     const StateSpace device{-b / m * I, I / m, I, 0 * I};  // force [N] to speed [m/s]
///     const StateSpace sampled = discretise_zero_order_hold(device, 1e-3);
struct StateSpace {
  Eigen::MatrixXd A, B, C, D;
  double sample_period = 0.0;  ///< [s]; 0: continuous

  [[nodiscard]] Eigen::Index order() const noexcept { return A.rows(); }
  [[nodiscard]] Eigen::Index inputs() const noexcept { return D.cols(); }
  [[nodiscard]] Eigen::Index outputs() const noexcept { return D.rows(); }
  [[nodiscard]] bool is_sampled() const noexcept { return sample_period > 0; }
};

/// Returns the system unchanged. @throws std::invalid_argument if sizes do not fit, an entry is not
/// finite or the sample period is not a number >= 0; the text says which.
[[nodiscard]] StateSpace checked(StateSpace system);

/// y = D u, without a state.
[[nodiscard]] StateSpace static_gain(const Eigen::MatrixXd& D, double sample_period);

/// A delay of `samples` >= 0 periods on each of `channels` signals. @param sample_period [s] > 0
[[nodiscard]] StateSpace sample_delay(int samples, Eigen::Index channels, double sample_period);

/// Point of the stability border at an angular frequency [rad/s]: j w, or e^{j w T}.
[[nodiscard]] std::complex<double> border_point(double sample_period, double angular_frequency);

/// G(p) = C (p I - A)^-1 B + D, outputs x inputs, by LU: O(n^3). Not finite at a pole.
/// @param point s for a continuous system, z for a sampled one
[[nodiscard]] Eigen::MatrixXcd evaluate(const StateSpace& system, std::complex<double> point);

/// G at many points: one complex Schur form, then O(n^2) a point.
class FrequencyResponse {
 public:
  /// @throws std::invalid_argument from checked(); std::runtime_error if the Schur form is not
  /// found
  explicit FrequencyResponse(const StateSpace& system);

  /// The same value as evaluate().
  [[nodiscard]] Eigen::MatrixXcd at(std::complex<double> point) const;
  /// Value on the border, at an angular frequency [rad/s].
  [[nodiscard]] Eigen::MatrixXcd at_frequency(double angular_frequency) const;

 private:
  Eigen::MatrixXcd triangle_, input_, output_, direct_;
  double sample_period_ = 0.0;
};

/// Eigenvalues of A, unordered. Each is a pole if the system is controllable and observable.
/// @throws std::runtime_error if the eigenvalues are not found (A not finite)
[[nodiscard]] Eigen::VectorXcd poles(const StateSpace& system);

/// Exact for an input that is held over each sample: A_d = e^{AT}, B_d the integral of e^{At} B
/// over [0, T], both from one matrix exponential. C and D stay.
/// @param sample_period [s] > 0
/// @throws std::invalid_argument if the system is already sampled or the period is not > 0
[[nodiscard]] StateSpace discretise_zero_order_hold(const StateSpace& continuous,
                                                    double sample_period);

/// `second` after `first`: y = second(first(u)).
/// @throws std::invalid_argument if sizes or sample periods differ (for all three functions)
[[nodiscard]] StateSpace series(const StateSpace& first, const StateSpace& second);
/// y = a(u) + b(u).
[[nodiscard]] StateSpace parallel(const StateSpace& a, const StateSpace& b);
/// y = forward(u - back(y)). @throws std::invalid_argument also if I + D_forward D_back is
/// singular: a loop without delay that has no solution
[[nodiscard]] StateSpace feedback(const StateSpace& forward, const StateSpace& back);

}  // namespace reckon::bench
