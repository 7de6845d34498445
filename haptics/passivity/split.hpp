// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The part of a force that the present energy allows to hold for one sample. A share of its
// potential is booked, so that it releases like a spring. The remainder is a constant force, called
// rest. On a device with a delay, the pending forces are treated together.
#pragma once

#include <Eigen/Core>
#include <optional>

namespace reckon::haptics {

/// Forces [N] of a device with `axes` axes, and torques [N m] for rotational axes; see DampedAxes.
template <int axes>
using AxisForces = Eigen::Matrix<double, axes, 1>;

/// Pending forces, written and not yet at the handle: d of them, each minus the force of the walls.
template <int axes>
struct UnderWayOf {
  double count = 0.0;                               ///< d
  AxisForces<axes> sum = AxisForces<axes>::Zero();  ///< of q_j [N]
  double squares = 0.0;                             ///< of |q_j|^2 [N^2]
};

/// A force with potential S, force F = -grad S and curvature of at most 2 k / (d + 1), at a port
/// whose damping pays c0 |dx|^2 over each of the next d + 1 samples. A force A is held in the last
/// of them, and the pending forces q_j before it. The part w F of each is booked as w S. The
/// remainder is a rest, whose worst motion costs its square over 4 (c0 - w k):
///   w S + (|A - w F|^2 + sum |q_j - w F|^2) / (4 (c0 - w k)) <= E
template <int axes>
struct SplitBoundOf {
  using Force = AxisForces<axes>;
  double energy = 0.0;            ///< E [J] >= 0, available energy
  double stored = 0.0;            ///< S [J] >= 0
  Force springs = Force::Zero();  ///< F [N]
  double spare = 0.0;             ///< c0 [N/m]
  double half_slope = 0.0;        ///< k [N/m] >= 0
  UnderWayOf<axes> under_way;

  /// |A - w F|^2 + sum |q_j - w F|^2 [N^2]. @param wanted A [N]
  [[nodiscard]] double rests(const Force& wanted, double w) const noexcept {
    return (wanted - w * springs).squaredNorm() + rests_under_way(w);
  }
  /// sum |q_j - w F|^2 [N^2], >= 0.
  [[nodiscard]] double rests_under_way(double w) const noexcept {
    if (!(under_way.count > 0)) return 0.0;
    const double rests = under_way.squares - 2.0 * w * springs.dot(under_way.sum) +
                         under_way.count * w * w * springs.squaredNorm();
    return rests > 0 ? rests : 0.0;
  }
};
using UnderWay = UnderWayOf<3>;
using SplitBound = SplitBoundOf<3>;

/// The largest w in [0, 1] that the bound allows, which books as much as possible. No value if no w
/// allows the whole of A. @param wanted A [N]
/// `axes` is 3 or 6.
template <int axes>
[[nodiscard]] std::optional<double> largest_weight(
    const SplitBoundOf<axes>& bound, const typename SplitBoundOf<axes>::Force& wanted) noexcept;

/// The w that allows the largest share of F, if the whole F is not allowed.
struct Strongest {
  double weight = 0.0;
  double share = 0.0;  ///< of F, in [0, 1]
};
/// No value if the pending forces alone exceed the bound with any share of F.
template <int axes>
[[nodiscard]] std::optional<Strongest> strongest(const SplitBoundOf<axes>& bound) noexcept;

}  // namespace reckon::haptics
