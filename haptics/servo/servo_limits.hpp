// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What a servo may be made of, and how stiff its device can show things.
#pragma once

#include <memory>

#include "reckon/haptics/devices/haptic_device.hpp"
#include "reckon/haptics/exchange/servo_types.hpp"
#include "reckon/haptics/scene/effect_plan.hpp"

namespace reckon::haptics {

/// What was given. @throws std::invalid_argument when a setting is out of range; the text says
/// which and why.
[[nodiscard]] ServoConfig checked_config(const ServoConfig& config);
[[nodiscard]] DeviceLimits checked_limits(const DeviceLimits& limits);
[[nodiscard]] std::shared_ptr<const EffectPlan> checked_plan(
    std::shared_ptr<const EffectPlan> plan);

/// Stiffest spring for each N s/m of damping [1/s].
[[nodiscard]] double stiffness_per_damping(const ServoConfig& config, const DeviceLimits& limits);
/// Stiffest surface of the static scene [N/m]. @param per_damping [1/s], see above
[[nodiscard]] double static_cap(const EffectPlan& plan, const DeviceLimits& limits,
                                double per_damping);

}  // namespace reckon::haptics
