// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/pdu/compression/state_numbers.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace reckon::pdu {
namespace {

constexpr double kMostNumber = 4194304.0;           // 2^22: a float32 holds it and its half
constexpr double kMostLocation = 17592186044416.0;  // 2^44

// To the nearest: adding 1.5 * 2^52 leaves no fraction. Good below 2^51; NaN gives some number.
double rounded(double value) noexcept {
  constexpr double kShift = 6755399441055744.0;
  return (value + kShift) - kShift;
}

// False where one of them is too large or no number.
bool round_each(const Vector3Float& v, double per, Numbers3& out) noexcept {
  const std::array<double, 3> scaled = {v.x * per, v.y * per, v.z * per};
  bool good = true;
  for (std::size_t i = 0; i < 3; ++i) {
    good = good && std::abs(scaled[i]) < kMostNumber;
    out[i] = good ? static_cast<std::int32_t>(rounded(scaled[i])) : 0;
  }
  return good;
}

bool round_location(const WorldCoordinates& v, double per,
                    std::array<std::int64_t, 3>& out) noexcept {
  const std::array<double, 3> scaled = {v.x * per, v.y * per, v.z * per};
  bool good = true;
  for (std::size_t i = 0; i < 3; ++i) {
    good = good && std::abs(scaled[i]) < kMostLocation;
    out[i] = good ? static_cast<std::int64_t>(rounded(scaled[i])) : 0;
  }
  return good;
}

// An angle of half a turn is the same as minus that.
bool round_angles(const EulerAngles& v, const StateScale& scale, Numbers3& out) noexcept {
  const unsigned turn_bits = scale.turn_bits;
  const auto turn = static_cast<double>(1U << turn_bits);
  const std::array<double, 3> scaled = {v.psi * scale.per_radian, v.theta * scale.per_radian,
                                        v.phi * scale.per_radian};
  bool good = true;
  for (std::size_t i = 0; i < 3; ++i) {
    good = good && std::abs(scaled[i]) < turn;
    const auto number =
        good ? static_cast<std::uint32_t>(static_cast<std::int32_t>(rounded(scaled[i]))) : 0U;
    out[i] = static_cast<std::int32_t>(number << (32 - turn_bits)) >> (32 - turn_bits);
  }
  return good;
}

Vector3Float times(const Numbers3& numbers, double quantum) noexcept {
  return {static_cast<float>(numbers[0] * quantum), static_cast<float>(numbers[1] * quantum),
          static_cast<float>(numbers[2] * quantum)};
}

}  // namespace

StateScale::StateScale(const StateQuanta& quanta) noexcept
    : StateQuanta(quanta),
      angle(2.0 * std::numbers::pi / static_cast<double>(1U << quanta.turn_bits)),
      per_metre(1.0 / quanta.position),
      per_speed(1.0 / quanta.velocity),
      per_radian(1.0 / angle),
      per_acceleration(1.0 / quanta.acceleration),
      per_turn_rate(1.0 / quanta.turn_rate) {}

std::optional<StateNumbers> numbers_of(const EntityState& state, const StateScale& scale) noexcept {
  StateNumbers numbers;
  numbers.timestamp = state.header.timestamp;
  numbers.algorithm = state.dead_reckoning.algorithm;
  const auto& rates = state.dead_reckoning;
  const bool good =
      round_location(state.location, scale.per_metre, numbers.location) &&
      round_each(state.linear_velocity, scale.per_speed, numbers.velocity) &&
      round_angles(state.orientation, scale, numbers.orientation) &&
      round_each(rates.linear_acceleration, scale.per_acceleration, numbers.acceleration) &&
      round_each(rates.angular_velocity, scale.per_turn_rate, numbers.angular_velocity);
  if (!good) return {};
  return numbers;
}

void set_numbers(const StateNumbers& numbers, const StateScale& scale,
                 EntityState& state) noexcept {
  state.header.timestamp = numbers.timestamp;
  state.dead_reckoning.algorithm = numbers.algorithm;
  state.location = {static_cast<double>(numbers.location[0]) * scale.position,
                    static_cast<double>(numbers.location[1]) * scale.position,
                    static_cast<double>(numbers.location[2]) * scale.position};
  state.linear_velocity = times(numbers.velocity, scale.velocity);
  state.orientation = {static_cast<float>(numbers.orientation[0] * scale.angle),
                       static_cast<float>(numbers.orientation[1] * scale.angle),
                       static_cast<float>(numbers.orientation[2] * scale.angle)};
  state.dead_reckoning.linear_acceleration = times(numbers.acceleration, scale.acceleration);
  state.dead_reckoning.angular_velocity = times(numbers.angular_velocity, scale.turn_rate);
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
