// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Identifies a peer: the first two numbers of each of its entities' IDs.
#pragma once

#include <cstdint>

#include "reckon/pdu/codec/records.hpp"

namespace reckon::aoim {

/// DIS simulation address: site and application.
using PeerId = pdu::SimulationAddress;

/// The site of the scene itself. No peer may have it. IEEE 1278.1-2012 6.2.80 permits it (0 and
/// 65535 are reserved), and the site that a host derives from its address is lower.
inline constexpr std::uint16_t kSceneSite = 65534;
/// Simulation address of the scene's bodies, which keep their IDs when their owner changes. It is
/// the same in each scene, so that filters and captures need no scene file.
inline constexpr PeerId kSceneId{kSceneSite, 1};

}  // namespace reckon::aoim
