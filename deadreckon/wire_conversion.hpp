// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Conversion of wire records to models and back. All values for which the formulas would fail are
// rejected here, with a reason for counters.
#pragma once

#include <cstdint>
#include <string_view>

#include "reckon/deadreckon/force/force_model.hpp"
#include "reckon/deadreckon/motion/drm.hpp"
#include "reckon/deadreckon/motion/geocentric.hpp"
#include "reckon/deadreckon/motion/kinematic_state.hpp"
#include "reckon/pdu/entity/entity_state.hpp"
#include "reckon/pdu/reckon/haptic_record.hpp"

namespace reckon::deadreckon {

/// Reason for the rejection of a record.
enum class ConversionError : std::uint8_t {
  none,
  not_finite,          ///< A NaN or an infinity.
  location_range,      ///< Farther than kLargestLocation from the earth's centre.
  speed_range,         ///< Velocity, acceleration or angular velocity past its limit.
  kind_unknown,        ///< A force model of a kind or order that is not evaluated here.
  negative_stiffness,  ///< k1 or k3 below zero: a spring that amplifies its deflection.
  negative_damping,    ///< Damping below zero.
  negative_mass,       ///< Mass below zero.
  stiffness_range,     ///< k1, k3, damping or mass past its limit.
  friction_range,      ///< Friction below zero, past 10, or kinetic above static.
  restitution_range,   ///< Restitution outside 0 to 1.
  normal_not_unit,     ///< Length of the normal not within 1e-3 of 1.
  size_range           ///< Radius below zero or past its limit, point too far from the entity.
};

/// The sentence for a ConversionError.
[[nodiscard]] std::string_view sentence(ConversionError error) noexcept;

inline constexpr double kLargestLocation = 1e9;         ///< [m]
inline constexpr double kLargestSpeed = 1e6;            ///< [m/s]
inline constexpr double kLargestAcceleration = 1e7;     ///< [m/s^2]
inline constexpr double kLargestAngularVelocity = 1e5;  ///< [rad/s]
inline constexpr double kLargestStiffness = 1e6;        ///< k1 [N/m]
inline constexpr double kLargestHardening = 1e12;       ///< k3 [N/m^3]
inline constexpr double kLargestDamping = 1e5;          ///< [N s/m]
inline constexpr double kLargestMass = 1e9;             ///< [kg]
inline constexpr double kLargestFriction = 10;          ///< Coefficient.
inline constexpr double kLargestSize = 1e4;             ///< Radius, distance of the point [m].

/// Motion of a received Entity State in the scene frame. A frozen or deactivated entity becomes
/// static. `reading` is the sender's meaning of the acceleration of RVB; `out` has ours, the rate
/// of the components. On an error `out` is unchanged. Any thread, no allocation.
[[nodiscard]] ConversionError from_wire(
    const pdu::EntityState& pdu, const LocalFrame& frame, KinematicState& out,
    AccelerationReading reading = AccelerationReading::component_rate) noexcept;

/// The same without the orientation, of which only the numbers are checked: `out.orientation` is
/// the identity. orientation_from_wire() computes it. Half the cost.
[[nodiscard]] ConversionError motion_from_wire(
    const pdu::EntityState& pdu, const LocalFrame& frame, KinematicState& out,
    AccelerationReading reading = AccelerationReading::component_rate) noexcept;
/// The orientation of from_wire(), body to S. @param wire finite
[[nodiscard]] Eigen::Quaterniond orientation_from_wire(const pdu::EulerAngles& wire,
                                                       const LocalFrame& frame) noexcept;

/// The same in the geocentric frame W of the wire, for listeners without a scene.
[[nodiscard]] ConversionError from_wire(
    const pdu::EntityState& pdu, KinematicState& out,
    AccelerationReading reading = AccelerationReading::component_rate) noexcept;

/// Sets location, orientation, velocity and the dead-reckoning fields of `pdu`. Other fields stay.
/// Rounds to the wire's float32: from_wire() of the result gives the state that peers will have.
/// Angular velocity is sent as 0 with models without rotation. `reading` is the receivers' meaning
/// of the acceleration of RVB. The same checks as from_wire; on an error `pdu` is unchanged.
[[nodiscard]] ConversionError to_wire(
    const KinematicState& state, const LocalFrame& frame, pdu::EntityState& pdu,
    AccelerationReading reading = AccelerationReading::component_rate) noexcept;

/// Converts a received force model. The normal becomes exactly unit; a sphere or field may leave it
/// zero. On an error `out` is unchanged.
[[nodiscard]] ConversionError from_wire(const pdu::HapticRecord& record, ForceModel& out) noexcept;

/// Converts a model to its record, with the validity rounded up to whole milliseconds (65.535 s at
/// most). The same checks as from_wire; on an error `record` is unchanged.
[[nodiscard]] ConversionError to_wire(const ForceModel& model, pdu::HapticRecord& record) noexcept;

}  // namespace reckon::deadreckon
