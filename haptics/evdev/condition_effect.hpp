// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Springs in the numbers of an effect of Linux (linux/input.h), and back. Pure.
#pragma once

#include <linux/input.h>

#include <chrono>
#include <cstddef>
#include <cstdint>

#include "reckon/haptics/passivity/spring_wall.hpp"

namespace reckon::haptics {

/// Of an axis, as EVIOCGABS tells it.
struct EventAxis {
  std::int32_t minimum = 0, maximum = 0;  ///< maximum > minimum
};

/// What a device's numbers mean. Nothing in them can be read from the device.
struct EffectScale {
  double travel = 0.0;          ///< [m] > 0, of the handle, from one end of an axis to the other
  double full_force = 0.0;      ///< [N] > 0, at the greatest level
  double full_stiffness = 0.0;  ///< [N/m] > 0, of the greatest coefficient
};

/// Steps of a coefficient and of a place from the middle to an end.
inline constexpr double kEffectSteps = 0x7FFF;
/// Steps of a level.
inline constexpr double kEffectLevels = 0xFFFF;
/// After which a device ends an effect that is not played again.
inline constexpr std::chrono::milliseconds kEffectLength{60};

/// [m], of a reading, from the middle of the axis.
[[nodiscard]] double place_of(std::int32_t reading, const EventAxis& axis,
                              const EffectScale& scale) noexcept;
/// [m], a reading's step.
[[nodiscard]] double step_of(const EventAxis& axis, const EffectScale& scale) noexcept;

/// The condition of a wall. It is rounded so that it stores no more than the wall does, at any
/// place; a wall beyond the end of the axis is none. The dead band is always 0: drivers differ in
/// whether it is a width or half of one, so that walls on both sides are two effects.
[[nodiscard]] ff_condition_effect condition_of(const SpringWall& wall, WallSide side,
                                               const EffectScale& scale) noexcept;
/// The wall that a device renders which is told this condition.
[[nodiscard]] SpringWall wall_of(const ff_condition_effect& condition, WallSide side,
                                 const EffectScale& scale) noexcept;

/// Whether a device that is told one renders what it renders of the other.
[[nodiscard]] bool is_same_condition(const ff_condition_effect& a,
                                     const ff_condition_effect& b) noexcept;

/// What rounding makes of a wall.
[[nodiscard]] SpringWall as_told(const SpringWall& wall, WallSide side,
                                 const EffectScale& scale) noexcept;

/// The effect of all walls of a side. @param model as told @param id of the effect; -1: a new one
/// @param length [ms], after which the device ends it by itself
[[nodiscard]] ff_effect effect_of(const SpringModel& model, WallSide side, const EffectScale& scale,
                                  std::int16_t id, std::uint16_t length) noexcept;

}  // namespace reckon::haptics
