// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Free flight along one axis in closed form: a constant acceleration, drag, and two walls.
#pragma once

namespace reckon::haptics {

/// Position [m] and velocity [m/s] along an axis.
struct Flight {
  double place = 0.0;
  double speed = 0.0;
};

/// State after dt [s] >= 0 with v' = acceleration - drag v. Exact.
/// @param acceleration [m/s^2] @param drag [1/s] >= 0
[[nodiscard]] Flight fly(const Flight& from, double acceleration, double drag, double dt) noexcept;

/// Two walls across an axis, and the restitution of a rebound.
struct Walls {
  double low = 0.0, high = 0.0;  ///< [m]
  double restitution = 0.0;      ///< 0 to 1
};

/// State after dt [s] >= 0 between walls, each rebound at the time of its impact (thesis 5.5, fig.
/// 5.6). Endless bounces end at rest at the wall. Never outside, at any speed. A start outside, or
/// between walls that leave no room, moves to the nearest position inside.
[[nodiscard]] Flight bounce(const Flight& from, double acceleration, const Walls& walls,
                            double dt) noexcept;

/// For a body that something else has moved: puts it inside, where it rebounds if it moves
/// outwards.
[[nodiscard]] Flight stop(const Flight& from, const Walls& walls) noexcept;

}  // namespace reckon::haptics
