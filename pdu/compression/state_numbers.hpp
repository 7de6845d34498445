// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The motion of an Entity State as whole numbers of stated quanta, for the compressed forms.
// Rounding is the only loss, at most half a quantum. All other fields stay exact.
#pragma once

#include <array>
#include <cstdint>
#include <numbers>
#include <optional>

#include "reckon/pdu/entity/entity_state.hpp"

namespace reckon::pdu {

/// Steps in which motion is sent. Each doubling of one saves about a bit an axis and doubles its
/// error. All finite and above 0.
struct StateQuanta {
  double position = 1e-3;      ///< [m] 1e-6 .. 10
  double velocity = 1e-2;      ///< [m/s] 1e-6 .. 10
  unsigned turn_bits = 16;     ///< a turn has 2^this steps, 10 .. 16; 16: 9.6e-5 rad
  double acceleration = 5e-2;  ///< [m/s^2] 1e-6 .. 10
  double turn_rate = 5e-3;     ///< [rad/s] 1e-6 .. 1
};

/// Quanta with derived values, computed once; at compile time for the usual ones.
struct StateScale : StateQuanta {
  constexpr StateScale(const StateQuanta& quanta = {}) noexcept
      : StateQuanta(quanta),
        angle(2.0 * std::numbers::pi / static_cast<double>(1U << quanta.turn_bits)),
        per_metre(1.0 / quanta.position),
        per_speed(1.0 / quanta.velocity),
        per_radian(1.0 / angle),
        per_acceleration(1.0 / quanta.acceleration),
        per_turn_rate(1.0 / quanta.turn_rate) {}

  double angle;  ///< [rad] a step of orientation
  // Steps in one unit.
  double per_metre, per_speed, per_radian, per_acceleration, per_turn_rate;
};

/// Three numbers, in the axes of the field.
using Numbers3 = std::array<std::int32_t, 3>;

/// The motion of an Entity State in quanta.
struct StateNumbers {
  std::uint32_t timestamp = 0;  ///< as on the wire, exact
  DeadReckoningAlgorithm algorithm = DeadReckoningAlgorithm::other;
  std::array<std::int64_t, 3> location{};  ///< each below 2^44
  Numbers3 velocity{};                     ///< each below 2^22, as are the two rates
  Numbers3 orientation{};                  ///< -2^(turn_bits - 1) .. 2^(turn_bits - 1) - 1
  Numbers3 acceleration{};
  Numbers3 angular_velocity{};

  friend bool operator==(const StateNumbers&, const StateNumbers&) = default;
};

/// No value if a number is not finite or beyond the range of the forms, such as an angle beyond a
/// whole turn. About 15 ns.
[[nodiscard]] std::optional<StateNumbers> numbers_of(const EntityState& state,
                                                     const StateScale& scale) noexcept;

/// Writes the motion into `state`; its other fields stay. numbers_of() is the inverse. Inline, so
/// that numbers just read stay in registers.
[[gnu::always_inline]] inline void set_numbers(const StateNumbers& numbers, const StateScale& scale,
                                               EntityState& state) noexcept {
  const auto times = [](const Numbers3& of, double quantum) {
    return std::array{static_cast<float>(of[0] * quantum), static_cast<float>(of[1] * quantum),
                      static_cast<float>(of[2] * quantum)};
  };
  const auto [vx, vy, vz] = times(numbers.velocity, scale.velocity);
  const auto [psi, theta, phi] = times(numbers.orientation, scale.angle);
  const auto [ax, ay, az] = times(numbers.acceleration, scale.acceleration);
  const auto [p, q, r] = times(numbers.angular_velocity, scale.turn_rate);
  state.header.timestamp = numbers.timestamp;
  state.location = {static_cast<double>(numbers.location[0]) * scale.position,
                    static_cast<double>(numbers.location[1]) * scale.position,
                    static_cast<double>(numbers.location[2]) * scale.position};
  state.linear_velocity = {vx, vy, vz};
  state.orientation = {psi, theta, phi};
  state.dead_reckoning.algorithm = numbers.algorithm;
  state.dead_reckoning.linear_acceleration = {ax, ay, az};
  state.dead_reckoning.angular_velocity = {p, q, r};
}

/// Rounds the motion of a state in place, so that every form holds it exactly. False, without a
/// change, if numbers_of() has no value.
bool quantise(EntityState& state, const StateScale& scale) noexcept;

/// Whether everything but the motion is equal: header, ID, types, appearance, marking and the rest.
[[nodiscard]] bool is_alike(const EntityState& a, const EntityState& b) noexcept;

/// A timestamp from its lowest 21 bits `low`: the one from 1.5 s before `base` to 0.2 s after it.
inline constexpr unsigned kTimestampBits = 21;
[[nodiscard]] constexpr std::uint32_t timestamp_near(std::uint32_t low,
                                                     std::uint32_t base) noexcept {
  constexpr std::uint32_t kSpan = std::uint32_t{1} << kTimestampBits;
  const std::uint32_t ahead = (low - base) & (kSpan - 1);
  return ahead < kSpan / 8 ? base + ahead : base + ahead - kSpan;
}

}  // namespace reckon::pdu
