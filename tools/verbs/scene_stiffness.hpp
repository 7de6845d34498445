// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Parts of a scene that its devices show softer than the scene asks.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "reckon/haptics/scene/effect_plan.hpp"
#include "reckon/peer/scene/scene_file.hpp"
#include "reckon/peer/world/device_stiffness.hpp"

namespace reckon::tools {

/// One device of a scene: a [[device]], or a peer's default one if the scene names none.
struct SceneDevice {
  std::uint32_t peer = 1;
  std::string name;  ///< "device 1 LEFT"
  peer::DeviceStiffness stiffness;
  double period = 0.001;   ///< [s], of its servo
  bool has_limit = false;  ///< its max_stiffness limits the walls that it shows
};

/// Every device of every peer, with limits from the servo that would drive it. @throws
/// std::runtime_error for a trace that cannot be read.
[[nodiscard]] std::vector<SceneDevice> devices_in(const peer::SceneFile& scene,
                                                  const haptics::EffectPlan& plan);

/// A thing that a device shows softer than the scene asks.
struct Softened {
  std::uint32_t peer = 1;
  std::string device;  ///< as SceneDevice::name
  std::string what;    ///< "object NAME", "hand", "entity MARKING", "dampers of NAME", ..
  double shown = 0.0;  ///< [N/m]
  double asked = 0.0;  ///< [N/m]; 0: a slope that increases by k3 up to the device's limit
  double from = 0.0;   ///< [m], depth from which the device cannot show it
  double alone = 0.0;  ///< [N/m], shown stiffness without its damper; 0: there is none
  /// Whether it is a damper: `asked` and `shown` are in [N s/m].
  bool damps = false;
  bool has_limit = false;  ///< as SceneDevice::has_limit
  /// Whether a light body limits the effect's coefficient [N s/m].
  bool is_light = false;
  [[nodiscard]] bool is_hardening() const noexcept { return asked == 0.0; }
};

/// All softened things of a scene.
[[nodiscard]] std::vector<Softened> softened(const peer::SceneFile& scene,
                                             const haptics::EffectPlan& plan,
                                             const std::vector<SceneDevice>& devices);

/// The same as sentences, one for each kind of thing and set of devices that show it equally.
[[nodiscard]] std::vector<std::string> softened_notes(const std::vector<Softened>& rows,
                                                      std::size_t devices);

/// One row as a JSON object.
void append_softened(std::string& out, const Softened& row);

/// "felt with 1425 N/m", or "felt with 950 to 1425 N/m"; empty if all devices show an object of
/// this stiffness [N/m] as asked.
[[nodiscard]] std::string felt_with(double asked, const std::vector<SceneDevice>& devices);

}  // namespace reckon::tools
