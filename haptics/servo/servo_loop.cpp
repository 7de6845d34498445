// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/servo/servo_loop.hpp"

#include <utility>

namespace reckon::haptics {

ServoLoop::ServoLoop(HapticDevice& device, EffectPlan plan, const ServoConfig& config)
    : ServoLoop(device, std::make_shared<const EffectPlan>(std::move(plan)), config) {}

ServoLoop::ServoLoop(HapticDevice& device, std::shared_ptr<const EffectPlan> plan,
                     const ServoConfig& config, std::shared_ptr<BodyWorld> bodies)
    : core_(make_servo(device, std::move(plan), config, std::move(bodies))) {}

}  // namespace reckon::haptics
