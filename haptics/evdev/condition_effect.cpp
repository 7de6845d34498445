// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/evdev/condition_effect.hpp"

#include <algorithm>
#include <cmath>

namespace reckon::haptics {

double place_of(std::int32_t reading, const EventAxis& axis, const EffectScale& scale) noexcept {
  const double whole = static_cast<double>(axis.maximum) - axis.minimum;
  return ((static_cast<double>(reading) - axis.minimum) / whole - 0.5) * scale.travel;
}

double step_of(const EventAxis& axis, const EffectScale& scale) noexcept {
  return scale.travel / (static_cast<double>(axis.maximum) - axis.minimum);
}

ff_condition_effect condition_of(const SpringWall& wall, WallSide side,
                                 const EffectScale& scale) noexcept {
  ff_condition_effect out{};
  const double at = wall.at / (0.5 * scale.travel) * kEffectSteps;
  if (!(wall.stiffness > 0) || !(std::abs(at) <= kEffectSteps)) return out;
  const auto coefficient = static_cast<std::int16_t>(
      std::floor(kEffectSteps * std::min(1.0, wall.stiffness / scale.full_stiffness)));
  const auto level = static_cast<std::uint16_t>(
      std::floor(kEffectLevels * std::clamp(wall.most / scale.full_force, 0.0, 1.0)));
  const bool is_below = side == WallSide::below;
  out.center = static_cast<std::int16_t>(is_below ? std::floor(at) : std::ceil(at));
  (is_below ? out.left_coeff : out.right_coeff) = coefficient;
  (is_below ? out.left_saturation : out.right_saturation) = level;
  return out;
}

SpringWall wall_of(const ff_condition_effect& condition, WallSide side,
                   const EffectScale& scale) noexcept {
  const bool is_below = side == WallSide::below;
  const double coefficient = is_below ? condition.left_coeff : condition.right_coeff;
  const double level = is_below ? condition.left_saturation : condition.right_saturation;
  if (!(coefficient > 0)) return {};
  return {condition.center / kEffectSteps * 0.5 * scale.travel,
          coefficient / kEffectSteps * scale.full_stiffness,
          level / kEffectLevels * scale.full_force};
}

bool is_same_condition(const ff_condition_effect& a, const ff_condition_effect& b) noexcept {
  return a.center == b.center && a.left_coeff == b.left_coeff && a.right_coeff == b.right_coeff &&
         a.left_saturation == b.left_saturation && a.right_saturation == b.right_saturation;
}

SpringWall as_told(const SpringWall& wall, WallSide side, const EffectScale& scale) noexcept {
  return wall_of(condition_of(wall, side, scale), side, scale);
}

ff_effect effect_of(const SpringModel& model, WallSide side, const EffectScale& scale,
                    std::int16_t id, std::uint16_t length) noexcept {
  ff_effect out{};
  out.type = FF_SPRING;
  out.id = id;
  out.replay.length = length;
  for (std::size_t axis = 0; axis < SpringModel::kAxes; ++axis)
    out.u.condition[axis] = condition_of(model.wall(axis, side), side, scale);
  return out;
}

}  // namespace reckon::haptics
