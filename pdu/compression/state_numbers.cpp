// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/pdu/compression/state_numbers.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

namespace reckon::pdu {
namespace {

constexpr double kMostNumber = 4194304.0;           // 2^22: a float32 holds it and its half
constexpr double kMostLocation = 17592186044416.0;  // 2^44

// To the nearest integer: adding 1.5 * 2^52 leaves no fraction, and the number in the lowest bits.
// Valid below 2^51; beyond it the result is wrong, because the difference wraps.
std::int64_t rounded(double value) noexcept {
  constexpr double kShift = 6755399441055744.0;
  return static_cast<std::int64_t>(std::bit_cast<std::uint64_t>(value + kShift) -
                                   std::bit_cast<std::uint64_t>(kShift));
}

// Whether the magnitudes of all three are below the limit; false for NaN.
bool within(const std::array<double, 3>& v, double most) noexcept {
  const int below =
      int{std::abs(v[0]) < most} & int{std::abs(v[1]) < most} & int{std::abs(v[2]) < most};
  return below != 0;
}

// False if one of them is too large or NaN.
bool round_each(const Vector3Float& v, double per, Numbers3& out) noexcept {
  const std::array<double, 3> scaled = {v.x * per, v.y * per, v.z * per};
  for (std::size_t i = 0; i < 3; ++i) out[i] = static_cast<std::int32_t>(rounded(scaled[i]));
  return within(scaled, kMostNumber);
}

bool round_location(const WorldCoordinates& v, double per,
                    std::array<std::int64_t, 3>& out) noexcept {
  const std::array<double, 3> scaled = {v.x * per, v.y * per, v.z * per};
  for (std::size_t i = 0; i < 3; ++i) out[i] = rounded(scaled[i]);
  return within(scaled, kMostLocation);
}

// An angle of half a turn is the same as its negative.
bool round_angles(const EulerAngles& v, const StateScale& scale, Numbers3& out) noexcept {
  const unsigned unused = 32 - scale.turn_bits;
  const std::array<double, 3> scaled = {v.psi * scale.per_radian, v.theta * scale.per_radian,
                                        v.phi * scale.per_radian};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto number = static_cast<std::uint32_t>(rounded(scaled[i]));
    out[i] = static_cast<std::int32_t>(number << unused) >> unused;
  }
  return within(scaled, static_cast<double>(1U << scale.turn_bits));
}

}  // namespace

std::optional<StateNumbers> numbers_of(const EntityState& state, const StateScale& scale) noexcept {
  StateNumbers numbers;
  numbers.timestamp = state.header.timestamp;
  numbers.algorithm = state.dead_reckoning.algorithm;
  const auto& rates = state.dead_reckoning;
  // All checks always run: a branch for each would cost more.
  const int good =
      int{round_location(state.location, scale.per_metre, numbers.location)} &
      int{round_each(state.linear_velocity, scale.per_speed, numbers.velocity)} &
      int{round_angles(state.orientation, scale, numbers.orientation)} &
      int{round_each(rates.linear_acceleration, scale.per_acceleration, numbers.acceleration)} &
      int{round_each(rates.angular_velocity, scale.per_turn_rate, numbers.angular_velocity)};
  if (good == 0) return {};
  return numbers;
}

bool quantise(EntityState& state, const StateScale& scale) noexcept {
  const auto numbers = numbers_of(state, scale);
  if (numbers) set_numbers(*numbers, scale, state);
  return numbers.has_value();
}

bool is_alike(const EntityState& a, const EntityState& b) noexcept {
  const PduHeader &x = a.header, &y = b.header;
  return a.entity_id == b.entity_id && a.appearance == b.appearance &&
         x.pdu_status == y.pdu_status && x.protocol_version == y.protocol_version &&
         x.exercise_id == y.exercise_id && x.padding == y.padding && a.force_id == b.force_id &&
         a.entity_type == b.entity_type && a.alternative_entity_type == b.alternative_entity_type &&
         a.capabilities == b.capabilities &&
         a.dead_reckoning.other_parameters == b.dead_reckoning.other_parameters &&
         a.marking.character_set == b.marking.character_set && a.marking.text == b.marking.text &&
         std::ranges::equal(a.variable_parameters, b.variable_parameters);
}

}  // namespace reckon::pdu
