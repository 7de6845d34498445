// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Tiers by distance ([[aoim.tier]]): the positions of the receivers of this peer's updates.
#pragma once

#include <chrono>

#include "reckon/aoim/area_of_interest_manager.hpp"
#include "reckon/peer/world/remote_entities.hpp"
#include "reckon/peer/world/scene_position.hpp"

namespace reckon::peer {

/// Keeps the positions of receivers. One thread; allocates when more entities are received than
/// ever before; 0.1 us for each received entity, ten times a second. Does nothing without such
/// tiers.
class ChannelKeeper {
 public:
  /// Call it some twenty times a second, after the foci were set.
  void look(const RemoteEntities& remote, aoim::AreaOfInterestManager& aoim,
            std::chrono::nanoseconds now) noexcept {
    if (aoim.receivers() == nullptr || now < next_) return;
    next_ = now + std::chrono::milliseconds(100);
    aoim::ReceiverChannels& receivers = *aoim.receivers();
    receivers.clear();
    remote.for_each_place(
        now, [&](std::uint32_t epoch, const Eigen::Vector3d& position, double speed) {
          receivers.add(to_position(position), aoim.presence().stretch_of(epoch), speed);
        });
  }

 private:
  std::chrono::nanoseconds next_ = std::chrono::nanoseconds::min();
};

}  // namespace reckon::peer
