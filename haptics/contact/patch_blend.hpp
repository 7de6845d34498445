// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Transition of a contact from one patch of a surface to the next: without a step, and only with
// available energy.
#pragma once

#include <algorithm>
#include <cmath>

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
  double follow(const SurfaceFeel& goal, double depth, double dt, double energy) noexcept {
    const double take = std::min(1.0, dt / kLag);
    const double most = kForceRate * dt;
    lagged_.surface.stiffness = lag(lagged_.surface.stiffness, goal.surface.stiffness, take);
    lagged_.surface.damping = lag(lagged_.surface.damping, goal.surface.damping, take);
    Friction& held = lagged_.friction;
    held.static_coefficient = lag(held.static_coefficient, goal.friction.static_coefficient, take);
    held.kinetic_coefficient =
        lag(held.kinetic_coefficient, goal.friction.kinetic_coefficient, take);

    // An unstretched spring may change at once: the bounds are infinite there.
    double& stiffness = now_.surface.stiffness;
    const double per_stiffness = 0.5 * depth * depth;  // [J m/N]
    const double wanted = step_towards(stiffness, lagged_.surface.stiffness, take, most / depth);
    const double step = per_stiffness > 0 ? std::min(wanted, energy / per_stiffness) : wanted;
    const double asked = std::max(goal.surface.stiffness, stiffness + wanted);
    share_ = step < wanted ? (stiffness + step) / asked : 1.0;
    stiffness += step;
    now_.surface.damping = lag(now_.surface.damping, lagged_.surface.damping, take);

    Friction& friction = now_.friction;
    const double most_friction = most / (stiffness * depth);
    friction.static_coefficient +=
        step_towards(friction.static_coefficient, held.static_coefficient, take, most_friction);
    friction.kinetic_coefficient +=
        step_towards(friction.kinetic_coefficient, held.kinetic_coefficient, take, most_friction);
    friction.kinetic_coefficient =
        std::min(friction.kinetic_coefficient, friction.static_coefficient);
    return step * per_stiffness;
  }

  /// Parameters that are felt now.
  [[nodiscard]] const SurfaceFeel& now() const noexcept { return now_; }
  /// Share of the stiffness that would be felt with enough energy, in (0, 1]; 1 if energy is not
  /// short.
  [[nodiscard]] double share() const noexcept { return share_; }

 private:
  // Distance at which the goal counts as reached, so that no number becomes subnormal.
  static constexpr double kThere = 1e-12;
  // The share `take` of the difference, limited to `most` in either direction.
  static double step_towards(double from, double to, double take, double most) {
    const double way = to - from;
    const double part = std::abs(way) < kThere ? way : take * way;
    return std::clamp(part, -most, most);
  }
  static double lag(double from, double to, double take) {
    return std::abs(to - from) < kThere ? to : from + take * (to - from);
  }

  SurfaceFeel lagged_;
  SurfaceFeel now_;
  double share_ = 1.0;
};

}  // namespace reckon::haptics
