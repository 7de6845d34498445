// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/studies/figures/figure_list.hpp"

#include <array>

#include "reckon/tools/studies/figures/one_user.hpp"
#include "reckon/tools/studies/figures/reduced_environment.hpp"
#include "reckon/tools/studies/figures/sampled_spring.hpp"
#include "reckon/tools/studies/figures/two_users.hpp"

namespace reckon::tools {

std::span<const FigureKind> figure_kinds() {
  static constexpr std::array kKinds{
      FigureKind{"3.1", "Energy made by a sampled spring", figure_sampled_spring},
      FigureKind{"3.2", "Two-port model of a haptic simulation", nullptr},
      FigureKind{"3.3", "Simplified model of the haptic display", nullptr},
      FigureKind{"3.4", "Block diagram of the stand-alone system", nullptr},
      FigureKind{"3.5", "Force, one user, environments of order 1 and 2", figure_low_order_force},
      FigureKind{"3.6", "Velocity, one user, environments of order 1 and 2",
                 figure_low_order_velocity},
      FigureKind{"3.7", "Force, one user, environments of order 3 and 4", figure_high_order_force},
      FigureKind{"3.8", "Velocity, one user, environments of order 3 and 4",
                 figure_high_order_velocity},
      FigureKind{"4.1", "Two users over a network", nullptr},
      FigureKind{"4.2", "Signal graph of two users", nullptr},
      FigureKind{"4.3", "Force, two users who exchange speeds", figure_two_users_force},
      FigureKind{"4.4", "Velocity, two users who exchange speeds", figure_two_users_velocity},
      FigureKind{"4.5", "Junction with delay", nullptr},
      FigureKind{"4.6", "Transmission line", nullptr},
      FigureKind{"4.7", "Complex and simple environment", nullptr},
      FigureKind{"4.8", "Force, complex environment", figure_complex_force},
      FigureKind{"4.9", "Force, simple environment", figure_simple_force},
      FigureKind{"4.10", "Force, error of the simple environment", figure_force_error},
      FigureKind{"4.11", "Velocity, complex environment", figure_complex_velocity},
      FigureKind{"4.12", "Velocity, simple environment", figure_simple_velocity},
      FigureKind{"4.13", "Velocity, error of the simple environment", figure_velocity_error},
  };
  return kKinds;
}

}  // namespace reckon::tools
