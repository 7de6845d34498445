// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Energy at a port by the device's own ledger.
#pragma once

#include <Eigen/Eigenvalues>
#include <nlohmann/json.hpp>

#include "reckon/haptics/passivity/contact_spring.hpp"
#include <Eigen/Core>
#include <algorithm>

#include "reckon/haptics/passivity/energy_port.hpp"

namespace reckon::haptics::meters {

using Eigen::Vector3d;

inline constexpr double kT = 1e-3;
inline constexpr double kPassive = -1e-9;  // [J], rounding of sums of some joules

inline double cap_of(double b) { return 0.95 * b / kT; }

/// The true energy of a port of damping b: exact work of the held force, least damping loss.
struct Meter {
  double absorbed = 0, least = 0, surplus = 0;
  void move(const Vector3d& force, const Vector3d& dx, double b) {
    absorbed += b * dx.squaredNorm() / kT - force.dot(dx);
  }
  // The absorbed energy must cover the spendable energy, not only be >= 0.
  void check(const EnergyPort& port) {
    least = std::min(least, absorbed);
    surplus = std::min(surplus, absorbed - port.level());
  }
};

}  // namespace reckon::haptics::meters
