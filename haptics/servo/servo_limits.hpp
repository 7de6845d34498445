// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Checks of a servo's settings, and the stiffness that its device can render.
#pragma once

#include <memory>

#include "reckon/haptics/bodies/body_world.hpp"
#include "reckon/haptics/devices/haptic_device.hpp"
#include "reckon/haptics/exchange/servo_types.hpp"
#include "reckon/haptics/scene/effect_plan.hpp"

namespace reckon::haptics {

/// Returns the setting unchanged. @throws std::invalid_argument if a setting is out of range; the
/// text names the setting and the reason.
[[nodiscard]] ServoConfig checked_config(const ServoConfig& config, const DeviceLimits& limits);
[[nodiscard]] DeviceLimits checked_limits(const DeviceLimits& limits);
[[nodiscard]] std::shared_ptr<const EffectPlan> checked_plan(
    std::shared_ptr<const EffectPlan> plan);
/// Null if the plan has no bodies.
[[nodiscard]] std::shared_ptr<BodyWorld> checked_bodies(std::shared_ptr<BodyWorld> bodies,
                                                        const EffectPlan& plan,
                                                        const ServoConfig& config);

/// Greatest stiffness for each N s/m of damping [1/s].
[[nodiscard]] double stiffness_per_damping(const ServoConfig& config, const DeviceLimits& limits);
/// Greatest stiffness of a surface of the static scene [N/m].
/// @param damping [N s/m], guaranteed damping for all probes together @param per_damping [1/s], see
/// above
[[nodiscard]] double static_cap(const EffectPlan& plan, const ServoConfig& config,
                                const DeviceLimits& limits, double damping, double per_damping);

}  // namespace reckon::haptics
