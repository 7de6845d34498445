// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// An elastic body under probes, each on a contact spring over its point: its force in response to a
// displacement, at any frequency, and its resonances. For many frequencies of one body: its modes
// are computed once, and each response is a sum over them.
#pragma once

#include <optional>
#include <vector>

#include "reckon/bench/reduction/congruence_reduction.hpp"

namespace reckon::bench {

/// Effect of a mode on a response: greatest at omega, half as strong at half_width from it.
struct Resonance {
  double omega = 0.0;       ///< [rad/s], >= 0
  double half_width = 0.0;  ///< [rad/s], >= 0
};

/// Force per displacement of the probes: (1/stiffness + compliance)^-1, points x points [N/m].
[[nodiscard]] Eigen::MatrixXcd through_contact(const Eigen::MatrixXcd& compliance,
                                               double stiffness);

/// The full body, with all its modes.
class PressedBody {
 public:
  /// @param stiffness of the contact [N/m], > 0. Cost: the body's modes, O(n^3), twice. Above
  /// BodyReduction::kMostDense coordinates the modes of the basis give the resonances.
  PressedBody(const BodyReduction& reduction, double stiffness);

  /// By modes, O(n), if dampers do not couple them (for example D = a M + b K) and factors agree
  /// with the result to 1e-9 of the stiffness at some frequencies. Otherwise by a factor of the
  /// whole body each time.
  /// @param angular_frequency [rad/s]; > 0 for a free body
  [[nodiscard]] Eigen::MatrixXcd force(double angular_frequency);
  [[nodiscard]] const std::vector<Resonance>& resonances() const noexcept { return resonances_; }
  /// Whether force() is a sum over modes.
  [[nodiscard]] bool is_by_modes() const noexcept { return modes_.has_value(); }

 private:
  /// q_i'' + damping_i q_i' + stiffness_i q_i = shape_i.f
  struct Modes {
    Eigen::VectorXd stiffness, damping;
    Eigen::MatrixXd shape;
    [[nodiscard]] Eigen::MatrixXcd compliance(double angular_frequency) const;
  };
  void find_modes(const SecondOrderSystem& body);
  [[nodiscard]] bool agree(const Modes& modes);

  double contact_;
  BodyCompliance by_factor_;
  std::optional<Modes> modes_;
  std::vector<Resonance> resonances_;
};

/// Resonances of a reduced model under the same probes.
[[nodiscard]] std::vector<Resonance> resonances_of(const ModalForceModel& model, double stiffness);

}  // namespace reckon::bench
