// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/inspect/check/motion_rules.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "reckon/deadreckon/motion/drm.hpp"
#include "reckon/deadreckon/motion/geocentric.hpp"
#include "reckon/deadreckon/motion/rotation.hpp"
#include "reckon/pdu/entity/variable_parameter.hpp"
#include "reckon/pdu/seconds.hpp"
#include "reckon/pdu/timestamp.hpp"

namespace reckon::tools {
namespace {

using Fault = std::optional<RuleFault>;
using deadreckon::in_degrees;
using std::numbers::pi;

// Offsets of fields in an Entity State.
constexpr std::size_t kVelocityAt = 36;
constexpr std::size_t kOrientationAt = 72;
constexpr std::size_t kAccelerationAt = 104;
constexpr std::size_t kAngularVelocityAt = 116;
constexpr std::size_t kParametersAt = 144;

constexpr double kShortestInterval = 0.05;   // [s], below it rounding of positions is too large
constexpr double kLongestInterval = 5.0;     // [s], above it the motion may have changed unseen
constexpr double kGrossly = 0.5;             // share of the displacement, or of the turn
constexpr std::uint8_t kContradictions = 3;  // in a row: a sharp turn causes one, a spike two

constexpr double kLeastContradiction = 2.0;  // [m]

constexpr double kAngleRounding = 1e-5;  // of a float32, and of a sender's value of pi [rad]
constexpr double kLeastTurn = pi / 6;    // [rad]
constexpr double kTurnTimeError = 0.02;  // of an orientation against its timestamp [s]
constexpr double kFlip = pi / 2;         // least turn back and forth
constexpr double kBackWithin = 0.2;      // from the orientation before the last [rad]

bool is_zero(const pdu::Vector3Float& v) { return v.x == 0 && v.y == 0 && v.z == 0; }

Eigen::Vector3d vector_of(const pdu::Vector3Float& v) { return {v.x, v.y, v.z}; }

bool is_frozen(const pdu::EntityState& pdu) {
  return (pdu.appearance & pdu::kAppearanceFrozen) != 0;
}

Eigen::Vector3d position_of(const pdu::EntityState& pdu) {
  return {pdu.location.x, pdu.location.y, pdu.location.z};
}

Eigen::Quaterniond orientation_of(const pdu::EntityState& pdu) {
  return deadreckon::quaternion_from_euler(
      {pdu.orientation.psi, pdu.orientation.theta, pdu.orientation.phi});
}

deadreckon::DrmTerms terms_of(const pdu::EntityState& pdu) {
  return deadreckon::drm_terms(pdu.dead_reckoning.algorithm);
}

/// The velocity in geocentric axes, for any axes of the dead-reckoning model.
Eigen::Vector3d velocity_of(const pdu::EntityState& pdu) {
  const Eigen::Vector3d velocity = vector_of(pdu.linear_velocity);
  return terms_of(pdu).body_axes ? orientation_of(pdu) * velocity : velocity;
}

/// Interval since the entity's last update by timestamps [s]; none if either is frozen, or the
/// interval is too short or too long.
std::optional<double> comparable_interval(const CheckedPdu& checked) {
  if (!checked.has_history() || checked.memory->frozen || is_frozen(*checked.entity_state))
    return std::nullopt;
  const double interval =
      pdu::to_seconds(pdu::difference(checked.row.header.timestamp, checked.memory->timestamp));
  if (interval < kShortestInterval || interval > kLongestInterval) return std::nullopt;
  return interval;
}

/// Difference between the entity's displacement since the last update and its velocities [m], if it
/// is gross; else 0.
double contradiction(const CheckedPdu& checked) {
  const auto interval = comparable_interval(checked);
  if (!interval.has_value()) return 0;
  const EntityMemory& memory = *checked.memory;
  const Eigen::Vector3d way = position_of(*checked.entity_state) - memory.position;
  const Eigen::Vector3d stated =
      0.5 * *interval * (memory.velocity + velocity_of(*checked.entity_state));
  const double error = (way - stated).norm();
  const double scale = std::max(way.norm(), stated.norm());
  return error > kLeastContradiction && error > kGrossly * scale ? error : 0;
}

/// Change of an entity's orientation since the last update.
struct Turn {
  double seconds = 0;
  double turned = 0;  ///< [rad], at most pi
  double stated = 0;  ///< by the mean of both turn rates [rad]
  double error = 0;   ///< [rad], difference if it is gross; else 0
  bool is_flip = false;
};

Turn turn_of(const CheckedPdu& checked) {
  const auto interval = comparable_interval(checked);
  if (!interval.has_value()) return {};
  const EntityMemory& memory = *checked.memory;
  const pdu::EntityState& pdu = *checked.entity_state;
  const Eigen::Quaterniond now = orientation_of(pdu);
  Turn turn{*interval, deadreckon::angle_between(now, memory.orientation)};
  if (!memory.turns || !terms_of(pdu).rotation) {
    // Such a model has no turn rate. Only a turn back and forth is certainly an error.
    const bool is_back = memory.turn_contradictions == 0 ||
                         deadreckon::angle_between(now, memory.earlier_orientation) < kBackWithin;
    turn.is_flip = turn.turned > kFlip && is_back;
    turn.error = turn.is_flip ? turn.turned : 0;
    return turn;
  }
  const Eigen::Vector3d rate = vector_of(pdu.dead_reckoning.angular_velocity);
  const Eigen::Vector3d mean = 0.5 * (memory.turn_rate + rate);
  turn.stated = mean.norm() * *interval;
  const double error = deadreckon::angle_between(
      now, memory.orientation * deadreckon::exponential(mean * *interval));
  const double explained = kLeastTurn + kTurnTimeError * mean.norm() +
                           0.5 * (rate - memory.turn_rate).norm() * *interval;
  // After more than half a turn the orientation is ambiguous, so the error is not scaled.
  const double scale = turn.stated < pi ? std::max(turn.turned, turn.stated) : 0;
  turn.error = error > explained && error > kGrossly * scale ? error : 0;
  return turn;
}

/// The first angle that is out of its range.
Fault angle_out_of_range(const pdu::EulerAngles& angles) {
  struct Angle {
    std::string_view name;
    double value;
    double limit;
  };
  const std::array all{Angle{"psi", angles.psi, pi}, Angle{"theta", angles.theta, pi / 2},
                       Angle{"phi", angles.phi, pi}};
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto& [name, value, limit] = all[i];
    if (std::abs(value) <= limit + kAngleRounding) continue;
    const bool may_be_turn = value > 0 && value <= 2 * pi + kAngleRounding && limit == pi;
    return RuleFault{kOrientationAt + 4 * i,
                     fmt::format("entity_orientation.{} is {:.6g} rad, beyond {:.6g}: degrees{}?",
                                 name, value, limit, may_be_turn ? ", or 0 to 2 pi" : "")};
  }
  return std::nullopt;
}

/// Contradictions in a row, after one more update.
std::uint8_t counted_on(std::uint8_t count, bool again) {
  return again ? static_cast<std::uint8_t>(std::min(count + 1, 255)) : std::uint8_t{0};
}

}  // namespace

Fault static_moves(const CheckedPdu& checked) {
  const pdu::EntityState* pdu = checked.entity_state;
  if (pdu == nullptr || is_frozen(*pdu) ||
      pdu->dead_reckoning.algorithm != pdu::DeadReckoningAlgorithm::static_)
    return std::nullopt;
  const auto says = [](std::string_view field, const pdu::Vector3Float& v, std::string_view unit) {
    return fmt::format("DRM static (1), but {} is {:.3g} {}", field, vector_of(v).norm(), unit);
  };
  if (!is_zero(pdu->linear_velocity))
    return RuleFault{kVelocityAt, says("entity_linear_velocity", pdu->linear_velocity, "m/s")};
  const auto& reckoning = pdu->dead_reckoning;
  if (!is_zero(reckoning.linear_acceleration))
    return RuleFault{kAccelerationAt,
                     says("entity_linear_acceleration", reckoning.linear_acceleration, "m/s^2")};
  if (!is_zero(reckoning.angular_velocity))
    return RuleFault{kAngularVelocityAt,
                     says("entity_angular_velocity", reckoning.angular_velocity, "rad/s")};
  return std::nullopt;
}

Fault velocity_contradicts(const CheckedPdu& checked) {
  const double error = contradiction(checked);
  if (error == 0 || checked.memory->contradictions + 1 != kContradictions) return std::nullopt;
  const double interval =
      pdu::to_seconds(pdu::difference(checked.row.header.timestamp, checked.memory->timestamp));
  const double went =
      (position_of(*checked.entity_state) - checked.memory->position).norm() / interval;
  return RuleFault{kVelocityAt,
                   fmt::format("entity_linear_velocity is {:.3g} m/s, but the positions moved at "
                               "{:.3g} m/s: {:.3g} m apart in {:.3g} s, three times in a row",
                               velocity_of(*checked.entity_state).norm(), went, error, interval)};
}

Fault wrong_orientation(const CheckedPdu& checked) {
  if (checked.entity_state == nullptr) return std::nullopt;
  if (checked.memory != nullptr && checked.memory->out_of_range) return std::nullopt;
  if (auto fault = angle_out_of_range(checked.entity_state->orientation)) return fault;
  const Turn turn = turn_of(checked);
  if (turn.error == 0 || checked.memory->turn_contradictions + 1 != kContradictions)
    return std::nullopt;
  if (turn.is_flip)
    return RuleFault{kOrientationAt,
                     fmt::format("entity_orientation turns {:.3g} deg and back within {:.3g} s "
                                 "each, with a model without turn rate, three times in a row",
                                 in_degrees(turn.turned), turn.seconds),
                     in_degrees(turn.error)};
  return RuleFault{
      kAngularVelocityAt,
      fmt::format("entity_angular_velocity predicts a turn of {:.3g} deg in {:.3g} s, but the "
                  "orientation turned {:.3g} deg: {:.3g} deg apart, three times in a row",
                  in_degrees(turn.stated), turn.seconds, in_degrees(turn.turned),
                  in_degrees(turn.error)),
      in_degrees(turn.error)};
}

Fault float64_parameter(const CheckedPdu& checked) {
  if (checked.entity_state == nullptr) return std::nullopt;
  const auto parameters = checked.entity_state->variable_parameters;
  constexpr std::size_t kValueAt = 8;
  for (std::size_t at = 0; at + pdu::kVariableParameterSize <= parameters.size();
       at += pdu::kVariableParameterSize) {
    pdu::ArticulatedPart part;
    if (!pdu::load_record(parameters.subspan(at), part) ||
        part.record_type != pdu::ArticulatedPart::kType || part.padding == 0)
      continue;
    const auto wide = pdu::load_big_endian<double>(parameters.data() + at + kValueAt);
    const double size = std::abs(wide);
    if (!(size > 1e-6 && size < 1e6)) continue;  // metres, radians and their rates
    return RuleFault{
        kParametersAt + at + kValueAt,
        fmt::format(
            "parameter_value is {:.6g} and its padding {:#010x}: as one float64, they give {:.6g}",
            part.parameter_value, part.padding, wide)};
  }
  return std::nullopt;
}

void remember_motion(EntityMemory& memory, const CheckedPdu& checked) {
  const pdu::EntityState& pdu = *checked.entity_state;
  memory.contradictions = counted_on(memory.contradictions, contradiction(checked) > 0);
  memory.turn_contradictions = counted_on(memory.turn_contradictions, turn_of(checked).error > 0);
  memory.out_of_range = memory.out_of_range || angle_out_of_range(pdu.orientation).has_value();
  memory.frozen = is_frozen(pdu);
  memory.position = position_of(pdu);
  memory.velocity = velocity_of(pdu);
  memory.turns = terms_of(pdu).rotation;
  memory.turn_rate = vector_of(pdu.dead_reckoning.angular_velocity);
  memory.earlier_orientation = memory.orientation;
  memory.orientation = orientation_of(pdu);
}

}  // namespace reckon::tools
