// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Output of `reckon scene explain` about each peer of a scene.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "reckon/haptics/scene/effect_plan.hpp"
#include "reckon/peer/scene/scene_file.hpp"

namespace reckon::tools {

/// One fact about a part of a peer.
struct PeerFact {
  std::uint32_t peer = 1;
  std::string has;   ///< "device 1", "entity TRUCK"
  std::string what;  ///< "limits"
  std::string how;   ///< "10 N, 2 m/s"
};

/// Facts about every device and entity of every peer of `scene`, whose plan is `plan`. The
/// stiffness that a device shows comes from the servo that would drive it. @throws
/// std::runtime_error for a track or trace that cannot be read.
[[nodiscard]] std::vector<PeerFact> peer_facts(const peer::SceneFile& scene,
                                               const haptics::EffectPlan& plan);

}  // namespace reckon::tools
