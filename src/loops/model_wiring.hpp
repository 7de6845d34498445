// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What the model loop and its stages are connected to.
#pragma once

#include <cstddef>

#include "reckon/deadreckon/motion/geocentric.hpp"
#include "reckon/haptics/exchange/spsc_ring.hpp"
#include "reckon/haptics/exchange/triple_buffer.hpp"
#include "reckon/peer/counters/counters.hpp"
#include "reckon/peer/loops/datagram_ring.hpp"
#include "reckon/peer/loops/known_sources_publisher.hpp"
#include "reckon/peer/loops/network_read_loop.hpp"
#include "reckon/peer/scene/scene_file.hpp"
#include "reckon/peer/world/peer_view.hpp"

namespace reckon::peer {

/// What the model loop is connected to; all of it outlives the loop.
struct ModelWiring {
  const SceneFile& scene;
  const deadreckon::LocalFrame& frame;
  const GroupPool& pool;
  DatagramRing& inbound;
  DatagramRing& outbound;
  haptics::SpscRing<GroupCommand>& commands;
  Link& link;  ///< to hear how it fares; the loop sends and reads by the rings
  haptics::SpscRing<ShownSample>* shown;  ///< may be null
  Counters& counters;
  std::size_t capacity = 100'000;                   ///< of the table of remote entities
  bool record_changes = false;                      ///< for RemoteEntities::take_changes()
  haptics::SpscRing<MutedSender>* muted = nullptr;  ///< of the read loop; may be null
  DatagramTap* tap = nullptr;    ///< of what becomes of each datagram; may be null
  DatagramRing* felt = nullptr;  ///< what came in contact groups, taken first; may be null
  haptics::TripleBuffer<KnownSources>* known = nullptr;  ///< of the read loop; may be null
};

}  // namespace reckon::peer
