// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Converts spring walls to condition effects of Linux (linux/input.h) and back. Pure.
#pragma once

#include <linux/input.h>

#include <chrono>
#include <cstdint>

#include "reckon/haptics/passivity/spring_wall.hpp"

namespace reckon::haptics {

/// Range of an axis, as EVIOCGABS reports it.
struct EventAxis {
  std::int32_t minimum = 0, maximum = 0;  ///< maximum > minimum
};

/// Physical scale of a device. None of it can be read from the device.
struct EffectScale {
  double travel = 0.0;          ///< [m] > 0, handle travel from one end of an axis to the other
  double full_force = 0.0;      ///< [N] > 0, at the greatest level
  double full_stiffness = 0.0;  ///< [N/m] > 0, at the greatest coefficient
};

/// Greatest coefficient, and greatest center: the distance from the middle of the axis to an end.
inline constexpr double kEffectSteps = 0x7FFF;
/// Greatest saturation.
inline constexpr double kEffectLevels = 0xFFFF;
/// A device ends an effect that is not replayed for so long.
inline constexpr std::chrono::milliseconds kEffectLength{60};

/// Position of a reading [m], from the middle of the axis.
[[nodiscard]] double place_of(std::int32_t reading, const EventAxis& axis,
                              const EffectScale& scale) noexcept;
/// Resolution of the readings [m].
[[nodiscard]] double step_of(const EventAxis& axis, const EffectScale& scale) noexcept;

/// The condition of a wall. Rounding makes it store no more energy than the wall at any position. A
/// wall beyond the end of the axis becomes an empty condition. The dead band is always 0, because
/// drivers take it as a width or as half of one: walls on both sides need two effects.
[[nodiscard]] ff_condition_effect condition_of(const SpringWall& wall, WallSide side,
                                               const EffectScale& scale) noexcept;
/// The wall that a device renders from a condition.
[[nodiscard]] SpringWall wall_of(const ff_condition_effect& condition, WallSide side,
                                 const EffectScale& scale) noexcept;

/// Whether a device renders the same wall from both.
[[nodiscard]] bool is_same_condition(const ff_condition_effect& a,
                                     const ff_condition_effect& b) noexcept;

/// The wall after rounding to a condition.
[[nodiscard]] SpringWall as_told(const SpringWall& wall, WallSide side,
                                 const EffectScale& scale) noexcept;

/// The effect with the walls of one side. @param model as uploaded @param id of the effect; -1: a
/// new one
/// @param length [ms] until the device ends the effect by itself
[[nodiscard]] ff_effect effect_of(const SpringModel& model, WallSide side, const EffectScale& scale,
                                  std::int16_t id, std::uint16_t length) noexcept;

}  // namespace reckon::haptics
