// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// From a scene and an identity to the settings and the first words of the area-of-interest manager.
#pragma once

#include <cstdint>
#include <string_view>

#include "reckon/aoim/area_of_interest_manager.hpp"
#include "reckon/deadreckon/motion/geocentric.hpp"
#include "reckon/pdu/codec/records.hpp"
#include "reckon/pdu/reckon/presence_pdu.hpp"
#include "reckon/peer/network/link.hpp"
#include "reckon/peer/scene/scene_file.hpp"

namespace reckon::peer {

/// Who this peer is at first.
struct ModelIdentity {
  pdu::SimulationAddress simulation;
  std::string_view name;
  std::uint32_t epoch;    ///< random, not 0: names this life of the process
  std::uint32_t started;  ///< UTC second of the start; the older of two keeps a disputed address
  bool haptic;            ///< it has devices
};

/// Cells, bundles and patience as the scene asks for them.
[[nodiscard]] aoim::AreaOfInterestConfig aoim_config(const SceneFile& scene);

/// What the peer announces of itself.
[[nodiscard]] pdu::Presence presence(const SceneFile& scene, const deadreckon::LocalFrame& frame,
                                     const GroupPool& pool, const ModelIdentity& identity);

}  // namespace reckon::peer
