// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What of a force may be held for one sample with the energy at hand: which share of its potential
// is booked, so that it releases as a spring does, and which is a mere force held still. On a
// device with a delay all forces under way are held so, together.
#pragma once

#include <Eigen/Core>
#include <optional>

namespace reckon::haptics {

/// Forces that were written and are not at the handle yet, d of them, each less what walls push.
struct UnderWay {
  double count = 0.0;                             ///< d
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();  ///< of q_j [N]
  double squares = 0.0;                           ///< of |q_j|^2 [N^2]
};

/// A force with potential S, force F = -grad S and curvature at most 2 k / (d + 1), at a port whose
/// damping pays c0 |dx|^2 over each of the next d + 1 samples. In the last of them a force A is
/// held, before that the forces q_j under way. Of each, w F is booked as w S and what is left is a
/// rest, which costs at most its square over 4 (c0 - w k), its worst motion:
///   w S + (|A - w F|^2 + sum |q_j - w F|^2) / (4 (c0 - w k)) <= E
struct SplitBound {
  double energy = 0.0;                                ///< E [J] >= 0, all that may be spent
  double stored = 0.0;                                ///< S [J] >= 0
  Eigen::Vector3d springs = Eigen::Vector3d::Zero();  ///< F [N]
  double spare = 0.0;                                 ///< c0 [N/m]
  double half_slope = 0.0;                            ///< k [N/m] >= 0
  UnderWay under_way;

  /// |A - w F|^2 + sum |q_j - w F|^2 [N^2]. @param wanted A [N]
  [[nodiscard]] double rests(const Eigen::Vector3d& wanted, double w) const noexcept {
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

/// The largest w in [0, 1] that the bound allows: as much as possible is booked. None where no w
/// allows the whole of A. @param wanted A [N]
[[nodiscard]] std::optional<double> largest_weight(const SplitBound& bound,
                                                   const Eigen::Vector3d& wanted) noexcept;

/// Where F cannot be had whole: the w that allows the most of it.
struct Strongest {
  double weight = 0.0;
  double share = 0.0;  ///< of F, in [0, 1]
};
/// None where what is under way alone is more than the bound allows with any part of F.
[[nodiscard]] std::optional<Strongest> strongest(const SplitBound& bound) noexcept;

}  // namespace reckon::haptics
