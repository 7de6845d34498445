// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Any text as the descriptor of a device: numbers within their limits, or problems with places.
#include <cmath>
#include <string_view>

#include "reckon/peer/scene/device_descriptor.hpp"
#include "reckon/peer/scene/scene_file.hpp"
#include "reckon/tests/fuzz/fuzz_target.hpp"

namespace reckon::fuzz {

void check(std::span<const std::byte> input) {
  try {
    const auto device = peer::parse_device_descriptor(text_of(input), "fuzz.toml");
    require(!device.name.empty(), "a device without a name");
    require(device.max_force >= 0.01 && device.max_force <= 1e3, "a force out of range");
    require(device.damping >= 0 && std::isfinite(device.damping), "a damping that is none");
    require(device.axes == 3 || device.axes == 6, "axes that no servo has");
    require((device.work_space.to - device.work_space.from).minCoeff() > 0, "no work space");
  } catch (const peer::SceneFileError& error) {
    require(!error.problems().empty(), "refused without a problem");
    for (const auto& problem : error.problems())
      require(!problem.sentence.empty(), "a problem without a sentence");
  }
}

}  // namespace reckon::fuzz
