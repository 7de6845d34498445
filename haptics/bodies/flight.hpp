// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Free flight along one axis in closed form: a constant acceleration, drag, and two walls.
#pragma once

namespace reckon::haptics {

/// Place [m] and speed [m/s] along an axis.
struct Flight {
  double place = 0.0;
  double speed = 0.0;
};

/// After dt [s] >= 0 with v' = acceleration - drag v. Exact.
/// @param acceleration [m/s^2]  @param drag [1/s] >= 0, of the speed
[[nodiscard]] Flight fly(const Flight& from, double acceleration, double drag, double dt) noexcept;

/// Two walls across an axis, and what a rebound leaves of the speed.
struct Walls {
  double low = 0.0, high = 0.0;  ///< [m]
  double restitution = 0.0;      ///< 0 to 1
};

/// After dt [s] >= 0 between walls, each rebound at the time of its impact (thesis 5.5, fig. 5.6).
/// One that bounces without end comes to rest at its wall. Never outside, whatever its speed; one
/// that begins outside, or between walls that leave no room, is put to the nearest place inside.
[[nodiscard]] Flight bounce(const Flight& from, double acceleration, const Walls& walls,
                            double dt) noexcept;

/// One that is moved by something else: put inside, where it rebounds if it was on its way out.
[[nodiscard]] Flight stop(const Flight& from, const Walls& walls) noexcept;

}  // namespace reckon::haptics
