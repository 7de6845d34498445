// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What of a force may be held for one sample with the energy at hand: which share of its potential
// is booked, so that it releases as a spring does, and which is a mere force held still.
#pragma once

#include <Eigen/Core>
#include <optional>

namespace reckon::haptics {

/// A force with potential S, force F = -grad S and curvature at most 2 k, at a port whose damping
/// pays c0 |dx|^2 over the next sample. Of a force A that is to be held, w F is booked as w S and
/// A - w F is a rest that costs at most |A - w F|^2 / (4 (c0 - w k)), its worst motion.
struct SplitBound {
  double energy = 0.0;                                ///< E [J] >= 0, all that may be spent
  double stored = 0.0;                                ///< S [J] >= 0
  Eigen::Vector3d springs = Eigen::Vector3d::Zero();  ///< F [N]
  double spare = 0.0;                                 ///< c0 [N/m]
  double half_slope = 0.0;                            ///< k [N/m] >= 0
};

/// The largest w in [0, 1] with w S + |A - w F|^2 / (4 (c0 - w k)) <= E: as much as possible is
/// booked. None where no w allows the whole of A. @param wanted A [N]
[[nodiscard]] std::optional<double> largest_weight(const SplitBound& bound,
                                                   const Eigen::Vector3d& wanted) noexcept;

/// Where F cannot be had whole: the w that allows the most of it.
struct Strongest {
  double weight = 0.0;
  double share = 0.0;  ///< of F, in [0, 1]
};
[[nodiscard]] Strongest strongest(const SplitBound& bound) noexcept;

}  // namespace reckon::haptics
