// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/tools/exercise/felt_device.hpp"

#include "reckon/haptics/servo/spring_scene.hpp"
#include "reckon/peer/drivers/driver.hpp"
#include "reckon/tools/exercise/simulated_hand.hpp"

namespace reckon::tools {

using peer::renders_springs;

FeltDevice::FeltDevice(const peer::SceneFile& scene, const peer::DeviceConfig& config) {
  if (renders_springs(config)) {
    springs_ = config.driver->springs->felt(config);
    return;
  }
  held_ = make_held_device(scene, config);
  mapped_.emplace(*held_, mapping_of(config));
}

void check_felt(const peer::SceneFile& scene, const haptics::EffectPlan& plan) {
  for (const peer::DeviceConfig& device : scene.devices) {
    if (!renders_springs(device)) continue;
    haptics::ServoConfig config;
    config.device_origin = device.position;
    config.device_orientation = device.orientation;
    config.contact_radius = scene.hand.contact_radius;
    const haptics::DeviceLimits limits = device.driver->springs->felt(device)->limits();
    static_cast<void>(haptics::SpringScene(plan, config, limits.axes, limits.max_stiffness));
  }
}

}  // namespace reckon::tools
