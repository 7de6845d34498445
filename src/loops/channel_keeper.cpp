// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/loops/channel_keeper.hpp"

#include "reckon/peer/world/scene_position.hpp"

namespace reckon::peer {

void ChannelKeeper::look(const RemoteEntities& remote, aoim::AreaOfInterestManager& aoim,
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

}  // namespace reckon::peer
