// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Estimates mass, friction and delay of one axis of a device from its motion under known forces.
#pragma once

#include <vector>

namespace reckon::haptics {

/// One push: the handle starts near rest, is pushed by a sequence of forces, each held until the
/// next, and comes to rest. All lists have the same length. Times start anywhere and never
/// decrease.
struct AxisPush {
  bool creeps = false;         ///< it moved a little at the start, at an unknown speed
  std::vector<double> forces;  ///< [N]; zero before the first
  std::vector<double> writes;  ///< [s], start of each force
  std::vector<double> places;  ///< [m]
  std::vector<double> reads;   ///< [s], instant of each position
};

/// m x'' + b x' + f sign(x') = F(t - delay)
struct AxisModel {
  double mass = 0.1;      ///< [kg] > 0
  double damping = 0.0;   ///< [N s/m]; below 0: the handle gains energy by itself
  double friction = 0.0;  ///< [N] >= 0
  double delay = 0.0;     ///< [s] >= 0
};

/// The best fit and its errors.
struct AxisFit {
  AxisModel model;
  double residual = 0.0;       ///< [m], root mean square
  double damping_error = 0.0;  ///< [N s/m], one standard deviation for independent residuals
};

/// Positions of the model [m], one for each read of the push, from its first position on.
/// @param substep longest integration step [s] > 0
[[nodiscard]] std::vector<double> places_of(const AxisModel& model, const AxisPush& push,
                                            double substep);

/// Least squares over all pushes, by Levenberg-Marquardt from several delays. About 0.1 s of work
/// for each second of pushes; allocates. @param pushes not empty
/// @param period of the servo [s] > 0 @param longest_delay [s], upper bound of the search
[[nodiscard]] AxisFit fit_axis(const std::vector<AxisPush>& pushes, double period,
                               double longest_delay);

}  // namespace reckon::haptics
