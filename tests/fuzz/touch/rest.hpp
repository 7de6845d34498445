// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The forces that resting hands should feel, and when a force is wrong.
#pragma once

#include <string>
#include <vector>

#include "reckon/tests/fuzz/touch/scenario.hpp"

namespace reckon::fuzz {

inline constexpr double kStill = 3;    // [s], after which forces have to be right
inline constexpr double kWatched = 1;  // [s], at the end, over which forces are averaged

/// Greatest overlap of the goals of two grips [m]: hands that part for a moment could change sides
/// beyond it.
inline constexpr double kDeepestGoals = 0.03;

/// The stiffness with which the device of one hand shows others, walls and regions [N/m], see
/// ServoLoop.
struct Shows {
  double hands = 0, walls = 0, regions = 1e4;
};

/// Greatest travel of a hand until an event device has a change that follows from its position [m].
[[nodiscard]] double event_way(const Scenario& scenario);
/// [s], from when on nothing moves or fails by itself; infinity if something always does.
[[nodiscard]] double still_since(const Scenario& scenario);
/// Whether failed readings, a switch, an outage, a silence or a late discovery interrupt the touch.
[[nodiscard]] bool is_interrupted(const Scenario& scenario);
/// Final overlap of the goals of the first two grips [m].
[[nodiscard]] double depth_of_goals(const Scenario& scenario);
/// Whether right_forces() is valid and promised for two honest hands: no loss, at most 50 ms delay,
/// grips of at most 600 N/m that damp 1 N s/m with goals that overlap by at most kDeepestGoals,
/// springs as the only effects; or in a region that is weight, spring, magnet or border.
[[nodiscard]] bool is_promised(const Scenario& scenario);

/// The greatest force of each hand from a neighbour without any delay [N]: springs in a row between
/// grips, of which only the pressed ones exist. At the end of the paths.
[[nodiscard]] std::vector<double> forces_in_a_row(const Scenario& scenario,
                                                  const std::vector<Shows>& shows, double time);
/// The force that the device of each hand should show [N]; requires is_promised().
[[nodiscard]] std::vector<double> right_forces(const Scenario& scenario,
                                               const std::vector<Shows>& shows, double time);

/// One hand that rested for kStill.
struct Rest {
  double right = 0, shown = 0;  ///< [N]
  bool interrupted = false;     ///< before that

  /// Missing share of the right force, 0 if negligible.
  [[nodiscard]] double lacks() const;
  /// Relative error of the shown force, in either direction.
  [[nodiscard]] double off() const;
  /// More than 20 % and 0.1 N off; after an interruption also if 10 % and 0.05 N are missing.
  [[nodiscard]] bool is_wrong() const;
};

}  // namespace reckon::fuzz
