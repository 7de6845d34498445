// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// An elastic body under probes, each on a contact spring over its point: the force that it answers
// a displacement with, at any frequency, and where it rings. Many frequencies of one body: its
// modes are found once, an answer is then a sum over them.
#pragma once

#include <optional>
#include <vector>

#include "reckon/haptics/reduction/congruence_reduction.hpp"

namespace reckon::haptics {

/// What a mode does to a response: greatest at omega, half as strong half_width beside it.
struct Resonance {
  double omega = 0.0;       ///< [rad/s], >= 0
  double half_width = 0.0;  ///< [rad/s], >= 0
};

/// Force a displacement of the probes: (1/stiffness + compliance)^-1, points x points [N/m].
[[nodiscard]] Eigen::MatrixXcd through_contact(const Eigen::MatrixXcd& compliance,
                                               double stiffness);

/// The body itself, none of its modes left out.
class PressedBody {
 public:
  /// @param stiffness of the contact [N/m], > 0. Cost: the body's modes, O(n^3), two times; above
  /// BodyReduction::kMostDense coordinates the modes of the basis stand for where it rings.
  PressedBody(const BodyReduction& reduction, double stiffness);

  /// By modes, O(n), where dampers do not couple them (D = a M + b K is such a case) and factors
  /// agree with that to 1e-9 of the stiffness at some frequencies; else by a factor of the whole
  /// body each time.
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

/// Where a reduced model rings under the same probes.
[[nodiscard]] std::vector<Resonance> resonances_of(const ModalForceModel& model, double stiffness);

}  // namespace reckon::haptics
