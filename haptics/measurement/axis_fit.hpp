// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Mass, friction and delay of one axis of a device, from how its handle went under known forces.
#pragma once

#include <vector>

namespace reckon::haptics {

/// One push: the handle all but rests, is pushed by forces that are held until the next, and comes
/// to rest. All lists are as long; times begin anywhere and never decrease.
struct AxisPush {
  bool creeps = false;         ///< it moved a little at first, at a speed that nobody knows
  std::vector<double> forces;  ///< [N]; before the first there was none
  std::vector<double> writes;  ///< [s], from when on each was asked for
  std::vector<double> places;  ///< [m]
  std::vector<double> reads;   ///< [s], when the handle was there
};

/// m x'' + b x' + f sign(x') = F(t - delay)
struct AxisModel {
  double mass = 0.1;      ///< [kg] > 0
  double damping = 0.0;   ///< [N s/m], below 0 where the handle gains energy by itself
  double friction = 0.0;  ///< [N] >= 0
  double delay = 0.0;     ///< [s] >= 0
};

/// The model that comes nearest, and how near.
struct AxisFit {
  AxisModel model;
  double residual = 0.0;       ///< [m], root of the mean square
  double damping_error = 0.0;  ///< [N s/m], one standard deviation, were the residuals independent
};

/// Places that the model says, one for each read of the push [m], from its first place on.
/// @param substep longest of the integration [s] > 0
[[nodiscard]] std::vector<double> places_of(const AxisModel& model, const AxisPush& push,
                                            double substep);

/// Least squares over all places of all pushes, by Levenberg and Marquardt from several delays.
/// Some 0.1 s of work for each second of pushes; allocates. @param pushes not empty
/// @param period of the servo [s] > 0  @param longest_delay [s], none beyond is looked for
[[nodiscard]] AxisFit fit_axis(const std::vector<AxisPush>& pushes, double period,
                               double longest_delay);

}  // namespace reckon::haptics
