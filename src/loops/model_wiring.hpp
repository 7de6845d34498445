// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The connections of the model loop and its stages.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "reckon/deadreckon/motion/geocentric.hpp"
#include "reckon/haptics/bodies/body_world.hpp"
#include "reckon/haptics/effects/effect_guard.hpp"
#include "reckon/haptics/exchange/spsc_ring.hpp"
#include "reckon/haptics/exchange/triple_buffer.hpp"
#include "reckon/peer/counters/counters.hpp"
#include "reckon/peer/loops/datagram_ring.hpp"
#include "reckon/peer/loops/network_read_loop.hpp"
#include "reckon/peer/loops/peer_hooks.hpp"
#include "reckon/peer/loops/sender_budget.hpp"
#include "reckon/peer/loops/stepped_bodies.hpp"
#include "reckon/peer/scene/scene_file.hpp"
#include "reckon/peer/world/peer_view.hpp"
#include "reckon/peer/world/shared_bodies.hpp"

namespace reckon::peer {

/// The connections of the model loop; all outlive it.
struct ModelWiring {
  const SceneFile& scene;
  const deadreckon::LocalFrame& frame;
  const GroupPool& pool;
  DatagramRing& inbound;
  DatagramRing& outbound;
  haptics::SpscRing<GroupCommand>& commands;
  Link& link;  ///< for its condition; the loop sends and receives by the rings
  haptics::SpscRing<ShownSample>* shown;  ///< may be null
  Counters& counters;
  bool record_changes = false;                          ///< for RemoteEntities::take_changes()
  haptics::SpscRing<MutedSender>* muted = nullptr;      ///< from the read loop; may be null
  haptics::SpscRing<RefusedSender>* refused = nullptr;  ///< from the read loop; may be null
  DatagramTap* tap = nullptr;      ///< receives the fate of each datagram; may be null
  DatagramRing* urgent = nullptr;  ///< datagrams of the urgent tier, taken first; may be null
  haptics::TripleBuffer<KnownSources>* known = nullptr;  ///< for the read loop; may be null
  haptics::TripleBuffer<FeltSources>* felt = nullptr;    ///< for the read loop; may be null
  haptics::BodyWorld* bodies = nullptr;                  ///< of the scene; may be null
  SteppedBodies* stepped = nullptr;  ///< bodies that no servo steps; may be null
  BodyMover* mover = nullptr;        ///< moves carried objects; may be null
  haptics::TripleBuffer<haptics::HandList>* pressing = nullptr;  ///< hands at bodies; may be null
  /// Fault reports of the program's own effects, from the servos.
  std::vector<std::shared_ptr<const haptics::GuardReport>> custom_effects = {};
  std::span<const NamedHooks> mechanisms = {};  ///< of the program; only for the construction
};

}  // namespace reckon::peer
