// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The environment of a coupling study, along one axis, and the hand that touches it. Positions
// increase into the surface, which is at 0 unless it moves; SI units.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string_view>

#include "reckon/haptics/devices/simulated_device.hpp"

namespace reckon::bench {

enum class EnvironmentKind : std::uint8_t {
  linear,     ///< K d
  hardening,  ///< k1 d + k3 d^3 with k1 = K/4 and twice the linear force at d = 1 N/k1
  moving,     ///< K, with the surface 3 mm nearer in every second half of a period
  switching,  ///< K/4 and K alternately
};
[[nodiscard]] std::string_view name_of(EnvironmentKind kind) noexcept;

/// Linearisation as a server sends it: force = stiffness (x - surface).
struct Tangent {
  double stiffness = 0.0;  ///< [N/m]
  double surface = 0.0;    ///< [m]
};

/// The spring of an environment at one time; depths [m], no force for depths below 0.
struct ContactLaw {
  double k1 = 0.0;       ///< [N/m]
  double k3 = 0.0;       ///< [N/m^3]
  double surface = 0.0;  ///< [m]

  /// Force against a probe at x [m]: [N] >= 0.
  [[nodiscard]] double force(double x) const noexcept {
    const double d = std::max(0.0, x - surface);
    return (k1 + k3 * d * d) * d;
  }
  /// Energy stored with a probe at x [J].
  [[nodiscard]] double energy(double x) const noexcept {
    const double d = std::max(0.0, x - surface);
    return (0.5 * k1 + 0.25 * k3 * d * d) * d * d;
  }
  /// Linearisation of the force at x.
  [[nodiscard]] Tangent tangent(double x) const noexcept;
};

/// A one-sided spring whose law may depend on time.
class Environment {
 public:
  /// @param stiffness K [N/m] >= 0 @param period [s] of moving and switching; 0 means 1 s and 0.6 s
  Environment(EnvironmentKind kind, double stiffness, double period = 0.0);

  /// @param t [s]
  [[nodiscard]] ContactLaw at(double t) const noexcept;
  /// K [N/m].
  [[nodiscard]] double stiffness() const noexcept { return stiffness_; }
  [[nodiscard]] EnvironmentKind kind() const noexcept { return kind_; }

 private:
  EnvironmentKind kind_;
  double stiffness_;
  double cubic_ = 0.0;  // [N/m^3]
  double period_;
};

/// A hand: its spring and damper to a target, and its push.
struct OperatorModel {
  double stiffness = 0.0;      ///< [N/m]
  double damping = 0.0;        ///< [N s/m]
  haptics::HandScript script;  ///< along x; stays at kCouplingStart until kCouplingWait
};

enum class OperatorKind : std::uint8_t {
  push,      ///< a constant 2 N
  soft,      ///< 100 N/m, 0.5 N s/m around 20 mm, and 2 N at 0.7 Hz
  tracking,  ///< 500 N/m, 2 N s/m after 4 mm + 6 mm at 1 Hz
};
[[nodiscard]] std::string_view name_of(OperatorKind kind) noexcept;
[[nodiscard]] OperatorModel operator_model(OperatorKind kind);
/// A hand that holds the handle at its start, with a grip of 150 N/m and 3 N s/m.
[[nodiscard]] OperatorModel resting_operator();

inline constexpr double kCouplingStart = -0.002;  ///< [m], outside
inline constexpr double kCouplingWait = 1.0;      ///< [s], until the first updates have arrived

}  // namespace reckon::bench
