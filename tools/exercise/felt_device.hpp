// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A scene's device as its servo sees it, with no real device opened: for checks of a scene.
#pragma once

#include <memory>
#include <optional>

#include "reckon/haptics/devices/mapped_device.hpp"
#include "reckon/haptics/scene/effect_plan.hpp"
#include "reckon/peer/scene/scene_file.hpp"

namespace reckon::tools {

/// Has the limits of the real device. Opens nothing.
class FeltDevice {
 public:
  /// @throws as make_held_device()
  FeltDevice(const peer::SceneFile& scene, const peer::DeviceConfig& config);
  FeltDevice(const FeltDevice&) = delete;
  FeltDevice& operator=(const FeltDevice&) = delete;

  [[nodiscard]] haptics::HapticDevice& get() noexcept {
    if (springs_) return *springs_;
    return *mapped_;
  }

 private:
  std::shared_ptr<haptics::HapticDevice> springs_;  // a device that renders springs
  std::unique_ptr<haptics::HapticDevice> held_;
  std::optional<haptics::MappedDevice> mapped_;
};

/// @throws std::invalid_argument with the name of an effect that a device of the scene cannot show,
/// if that device renders springs by itself
void check_felt(const peer::SceneFile& scene, const haptics::EffectPlan& plan);

}  // namespace reckon::tools
