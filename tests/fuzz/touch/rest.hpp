// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What hands that hold still should feel, and when a force is wrong.
#pragma once

#include <string>
#include <vector>

#include "reckon/tests/fuzz/touch/scenario.hpp"

namespace reckon::fuzz {

inline constexpr double kStill = 3;    // [s], after which forces have to be right
inline constexpr double kWatched = 1;  // [s], at the end, over which they are looked at

/// How deep grips may want into each other [m]: hands that let go for a moment would else change
/// sides.
inline constexpr double kDeepestGoals = 0.03;

/// How stiff the device of one hand shows others, walls and regions [N/m], see ServoLoop.
struct Shows {
  double hands = 0, walls = 0, regions = 1e4;
};

/// How far a hand goes at most until an event device has a change that follows from its place [m].
[[nodiscard]] double event_way(const Scenario& scenario);
/// [s], from when on nothing moves or fails by itself; never, where something always does.
[[nodiscard]] double still_since(const Scenario& scenario);
/// Whether readings fail, a switch, an outage, a silence or a late discovery interrupts the touch.
[[nodiscard]] bool is_interrupted(const Scenario& scenario);
/// How deep the grips of the first two want into each other in the end [m].
[[nodiscard]] double depth_of_goals(const Scenario& scenario);
/// Whether right_forces() has what both of two honest hands should feel, and promises it: no loss,
/// at most 50 ms, grips of at most 600 N/m that damp 1 N s/m and want no farther than kDeepestGoals
/// into each other, no effects but springs; or in a region that is weight, spring, magnet or
/// border.
[[nodiscard]] bool is_promised(const Scenario& scenario);

/// What each hand would feel at most from a neighbour without any delay [N]: springs in a row
/// between grips, of which those are there that are pressed. At the end of the paths.
[[nodiscard]] std::vector<double> forces_in_a_row(const Scenario& scenario,
                                                  const std::vector<Shows>& shows, double time);
/// What the device of each hand should show [N]; wants is_promised().
[[nodiscard]] std::vector<double> right_forces(const Scenario& scenario,
                                               const std::vector<Shows>& shows, double time);

/// One hand that held still for kStill.
struct Rest {
  double right = 0, shown = 0;  ///< [N]
  bool interrupted = false;     ///< before that

  /// Share that is missing, 0 where nothing to speak of is.
  [[nodiscard]] double lacks() const;
  /// Share of what is right by which it is off, to either side.
  [[nodiscard]] double off() const;
  /// More than 20 % and 0.1 N off; after an interruption also where 10 % and 0.05 N are missing.
  [[nodiscard]] bool is_wrong() const;
};

}  // namespace reckon::fuzz
