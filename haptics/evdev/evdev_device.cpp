// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/evdev/evdev_device.hpp"

#include <algorithm>
#include <stdexcept>

namespace reckon::haptics {
namespace {

void require(double value, const char* key, const char* what) {
  if (value > 0) return;
  throw std::invalid_argument(std::string("an event device does not report ") + what + ": write '" +
                              key + "' in its [[device]]");
}

}  // namespace

DeviceLimits evdev_limits(const EvdevSettings& settings) {
  const EffectScale& scale = settings.scale;
  require(scale.travel, "travel", "the travel of its handle from end to end");
  require(scale.full_force, "full_force", "its force at the greatest level");
  require(scale.full_stiffness, "full_stiffness", "its stiffness at the greatest coefficient");
  require(settings.max_stiffness, "max_stiffness",
          "the stiffness that it renders without oscillation");
  if (settings.axes != 1 && settings.axes != 2)
    throw std::invalid_argument(
        "an event device has 1 or 2 axes: write 1 or 2 as 'event_axes' of its [[device]]");
  if (!(settings.max_force > 0) || !(settings.max_speed > 0) || settings.chain.count() <= 0)
    throw std::invalid_argument(
        "max_force, max_speed and delay of an event device must be above 0");
  DeviceLimits limits;
  limits.kind = DeviceKind::coefficients;
  limits.axes = settings.axes;
  limits.max_force = std::min(settings.max_force, scale.full_force);
  limits.max_stiffness = std::min(settings.max_stiffness, scale.full_stiffness);
  limits.max_speed = settings.max_speed;
  limits.workspace_min = limits.workspace_max = Eigen::Vector3d::Zero();
  limits.workspace_min.head(settings.axes).setConstant(-0.5 * scale.travel);
  limits.workspace_max.head(settings.axes).setConstant(0.5 * scale.travel);
  return limits;
}

DeviceSample EvdevDevice::read(std::chrono::nanoseconds now) noexcept {
  exchange_.reading.update();
  read_at_ = now;
  const EvdevReading& reading = exchange_.reading.read();
  DeviceSample sample;
  sample.ok = reading.is_there && now - reading.at <= kWatchdog;
  sample.position = reading.position;
  sample.buttons = reading.buttons;
  if (!sample.ok) return sample;
  if (placed_at_.count() > 0) sample.took = reading.placed_at - placed_at_;
  placed_at_ = reading.placed_at;
  return sample;
}

// A replay may reach the device up to kWatchdog later.
ShownModel EvdevDevice::shown() const noexcept {
  const EvdevReading& reading = exchange_.reading.read();
  const bool has_ended = read_at_ - reading.at > kEffectLength + kWatchdog;
  return has_ended ? ShownModel() : reading.shown;
}

void EvdevDevice::state(const SpringModel& wanted, std::chrono::nanoseconds now) noexcept {
  exchange_.model.write({wanted, now, true});
}

}  // namespace reckon::haptics
