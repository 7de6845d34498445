// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Transition of a contact from one patch of a surface to the next: without a step, and only with
// available energy.
#pragma once

#include "reckon/haptics/scene/surface_patches.hpp"

namespace reckon::haptics {

/// The felt parameters follow the patch below the contact point through two lags of 10 ms. So the
/// force and its rate are continuous and never outside the range of the patches. The change is
/// limited to 100 N/s of normal force and 100 N/s of friction: at 1 kHz a border adds at most 0.15
/// N to the change of the force by motion in a step. Stiffness grows only as far as the caller has
/// energy for it: a spring stretched by d needs d^2/2 for each N/m. Friction holds the contact
/// point and stores nothing, so that it may change freely. O(1), no allocation.
class PatchBlend {
 public:
  /// Time constant of each of the two lags [s]. A higher value is smoother, and longer wrong behind
  /// a border.
  static constexpr double kLag = 0.01;
  /// [N/s], limit for normal force and for friction, each.
  static constexpr double kForceRate = 100.0;

  /// Begins a contact on this patch.
  void begin(const SurfaceFeel& goal) noexcept { lagged_ = now_ = goal; }

  /// Advances by `dt` [s] on a patch with the parameters `goal`. @param depth [m] >= 0, of the
  /// spring
  /// @param energy [J] >= 0, available for growth
  /// @return the energy used [J]; negative if the spring became softer
  double follow(const SurfaceFeel& goal, double depth, double dt, double energy) noexcept;

  /// Parameters that are felt now.
  [[nodiscard]] const SurfaceFeel& now() const noexcept { return now_; }
  /// Share of the stiffness that would be felt with enough energy, in (0, 1]; 1 if energy is not
  /// short.
  [[nodiscard]] double share() const noexcept { return share_; }

 private:
  SurfaceFeel lagged_;
  SurfaceFeel now_;
  double share_ = 1.0;
};

}  // namespace reckon::haptics
