// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/bench/studies/figures/figure_list.hpp"

#include <array>

#include "reckon/bench/studies/figures/interactions.hpp"
#include "reckon/bench/studies/figures/network_drawings.hpp"
#include "reckon/bench/studies/figures/one_user.hpp"
#include "reckon/bench/studies/figures/reduced_environment.hpp"
#include "reckon/bench/studies/figures/sampled_spring.hpp"
#include "reckon/bench/studies/figures/two_users.hpp"
#include "reckon/bench/studies/figures/world_drawings.hpp"

namespace reckon::bench {

std::span<const FigureKind> figure_kinds() {
  static constexpr std::array kKinds{
      FigureKind{"3.1", "Energy made by a sampled spring", figure_sampled_spring},
      FigureKind{"3.2", "Two-port model of a haptic simulation", drawing_two_port, true},
      FigureKind{"3.3", "Simplified model of the haptic display", drawing_display, true},
      FigureKind{"3.4", "Block diagram of the stand-alone system", drawing_stand_alone, true},
      FigureKind{"3.5", "Force, one user, environments of order 1 and 2", figure_low_order_force},
      FigureKind{"3.6", "Velocity, one user, environments of order 1 and 2",
                 figure_low_order_velocity},
      FigureKind{"3.7", "Force, one user, environments of order 3 and 4", figure_high_order_force},
      FigureKind{"3.8", "Velocity, one user, environments of order 3 and 4",
                 figure_high_order_velocity},
      FigureKind{"4.1", "Two users over a network", drawing_networked_pair, true},
      FigureKind{"4.2", "Signal graph of two users", drawing_signal_graph, true},
      FigureKind{"4.3", "Force, two users who exchange speeds", figure_two_users_force},
      FigureKind{"4.4", "Velocity, two users who exchange speeds", figure_two_users_velocity},
      FigureKind{"4.5", "Junction with delay", drawing_delayed_junction, true},
      FigureKind{"4.6", "Transmission line", drawing_transmission_line, true},
      FigureKind{"4.7", "Complex and simple environment", drawing_environments, true},
      FigureKind{"4.8", "Force, complex environment", figure_complex_force},
      FigureKind{"4.9", "Force, simple environment", figure_simple_force},
      FigureKind{"4.10", "Force, error of the simple environment", figure_force_error},
      FigureKind{"4.11", "Velocity, complex environment", figure_complex_velocity},
      FigureKind{"4.12", "Velocity, simple environment", figure_simple_velocity},
      FigureKind{"4.13", "Velocity, error of the simple environment", figure_velocity_error},
      FigureKind{"5.1", "Parent, child and sibling", drawing_family, true},
      FigureKind{"5.2", "Traversal of the scene graph", drawing_traversal, true},
      FigureKind{"5.3", "Surface contact point", drawing_contact_point, true},
      FigureKind{"5.4", "Application and haptic process", drawing_processes, true},
      FigureKind{"5.5", "Simulation loop", drawing_simulation_loop, true},
      FigureKind{"5.6", "Work space", drawing_work_space, true},
      FigureKind{"5.7", "Collision with a wall, complex and simple model",
                 figure_unilateral_collision},
      FigureKind{"5.8", "Collision with a movable object, complex and simple model",
                 figure_bilateral_collision},
      FigureKind{"5.9", "Slip, complex and simple model", figure_slip},
  };
  return kKinds;
}

}  // namespace reckon::bench
