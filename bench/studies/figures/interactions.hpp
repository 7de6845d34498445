// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Thesis Figs 5.7 to 5.9: a wall, a movable object and a rough surface, felt through the complex
// model (5.4) and the simple one (5.5). Masses, pushes and gaps are not printed; ours are below.
#pragma once

#include "reckon/bench/studies/figures/figure.hpp"

namespace reckon::bench {

/// Values printed in the thesis: T of its haptic process, b and K_c. K_s is a parameter of each
/// scene.
struct PrintedModels {
  static constexpr double kPeriod = 0.001;       ///< [s]
  static constexpr double kDamping = 0.4;        ///< b of both models [N s/m]
  static constexpr double kComplexGain = 0.1;    ///< K_c
  static constexpr double kPrintedGain = 0.9;    ///< K_s as printed
  static constexpr double kFollowingGain = 0.1;  ///< K_s that follows from (4.21) for (5.4)
};

/// A hand that pushes: not printed, chosen so that a device with this damping may render all
/// models.
struct PushingHand {
  double mass = 0.1;     ///< [kg]
  double damping = 1.0;  ///< [N s/m]
  double push = 1.0;     ///< towards the surface [N]
  double gap = 0.005;    ///< to the surface at the start [m]
};

/// Curves of both models in a figure: the force of each, and simple minus complex.
struct ModelForces {
  FigureCurve complex, simple, error;
  double period = PrintedModels::kPeriod;
};

/// 5.7. @param simple_gain K_s
[[nodiscard]] ModelForces wall_forces(const PushingHand& hand, double simple_gain);

/// 5.8: the hand is thrown at a free object, which slides away with `object_damping`.
struct Thrown {
  PushingHand hand{.push = 0.0};
  double speed = 0.3;           ///< of the hand at the start [m/s]
  double object_mass = 0.2;     ///< [kg]
  double object_damping = 2.0;  ///< [N s/m]
};
[[nodiscard]] ModelForces thrown_forces(const Thrown& thrown, double simple_gain);
/// Number of samples by which the greatest force of the simple model precedes that of the complex
/// one; below 0: it follows.
[[nodiscard]] int lead_of_simple(const ModelForces& forces);

/// 5.9: the hand is pressed on a surface and pushed along it. Friction is the product's stick-slip
/// cone (static 0.5, kinetic 0.35).
struct Slip {
  PushingHand hand{.gap = 0.0};
  double along = 0.6;  ///< push along the surface [N]
};
[[nodiscard]] ModelForces slip_forces(const Slip& slip, double simple_gain);

[[nodiscard]] Figure figure_unilateral_collision();  ///< 5.7
[[nodiscard]] Figure figure_bilateral_collision();   ///< 5.8
[[nodiscard]] Figure figure_slip();                  ///< 5.9

}  // namespace reckon::bench
