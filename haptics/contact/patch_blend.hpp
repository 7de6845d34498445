// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// How a contact goes from one patch of a surface to the next: never at a step, and never with
// energy that nobody has.
#pragma once

#include "reckon/haptics/scene/surface_patches.hpp"

namespace reckon::haptics {

/// What is felt follows the patch below the contact point through two lags of 10 ms, so that the
/// force and its rate are continuous and never outside of what the patches have, and no faster than
/// 100 N/s of normal force and 100 N/s of friction: at 1 kHz a border adds at most 0.15 N to what
/// the motion does to the force in a step. Stiffness grows only as far as the caller has energy for
/// it: a spring that is stretched by d takes d^2/2 for each N/m. Friction holds the contact point
/// and stores nothing, so that it may follow as it likes. O(1), no allocation.
class PatchBlend {
 public:
  /// Of each of the two lags [s]. Higher is smoother and longer wrong behind a border.
  static constexpr double kLag = 0.01;
  /// [N/s], of normal force and of friction each.
  static constexpr double kForceRate = 100.0;

  /// A contact begins on this patch.
  void begin(const SurfaceFeel& goal) noexcept { lagged_ = now_ = goal; }

  /// After `dt` [s] on a patch that feels like `goal`. @param depth [m] >= 0, of the spring
  /// @param energy [J] >= 0, that growing may take
  /// @return what it took [J]; below 0 where the spring got softer
  double follow(const SurfaceFeel& goal, double depth, double dt, double energy) noexcept;

  /// What is felt.
  [[nodiscard]] const SurfaceFeel& now() const noexcept { return now_; }
  /// Of the stiffness that would be felt with energy to spare, in (0, 1]: 1 where it is not short.
  [[nodiscard]] double share() const noexcept { return share_; }

 private:
  SurfaceFeel lagged_;
  SurfaceFeel now_;
  double share_ = 1.0;
};

}  // namespace reckon::haptics
