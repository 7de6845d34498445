// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A body of the scene as a program names it and reads it.
#pragma once

#include <cstdint>

#include "reckon/aoim/groups/peer_id.hpp"
#include "reckon/haptics/scene/effect_plan.hpp"

namespace reckon::peer {

/// A body of the scene: an object with a mass. Its number counts the moving objects from 0, as the
/// entity IDs 65534:1:number + 1 do.
struct BodyHandle {
  std::uint32_t number = 0;
  friend constexpr bool operator==(const BodyHandle&, const BodyHandle&) = default;
};

/// A moving object at the end of a pass of the model loop.
struct KnownBody {
  haptics::ObjectMotion motion;  ///< as simulated or shown by this peer
  aoim::PeerId owner;            ///< 0:0: not known
  aoim::PeerId asker;            ///< waits longest for a body of this peer; 0:0: none
  bool is_ours = false;          ///< this peer may move it now
};

}  // namespace reckon::peer
