// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Mechanisms that watch a peer, called where they have a hook. A new one is a file and a row of THE
// list in peer_hooks.cpp.
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "reckon/aoim/area_of_interest_manager.hpp"
#include "reckon/haptics/exchange/spsc_ring.hpp"
#include "reckon/peer/loops/model_wiring.hpp"
#include "reckon/peer/loops/notice.hpp"
#include "reckon/peer/world/remote_entities.hpp"

namespace reckon::peer {

/// What there is to look at.
struct WatchedPeer {
  const RemoteEntities& remote;
  aoim::AreaOfInterestManager& aoim;
  std::size_t unfelt;                  ///< most bodies near by that a servo leaves out now
  const aoim::SourceAddress& crowder;  ///< whose most of what is near there are
  std::chrono::nanoseconds now;
  haptics::SpscRing<Notice>& notices;  ///< what is to be reported to the user
};

/// Called by the model loop's thread; must not throw nor block. Those that are not set cost
/// nothing.
struct PeerHooks {
  /// Some twenty times a second.
  std::function<void(const WatchedPeer&)> look = nullptr;
  /// Each datagram that leaves, with its trailer.
  std::function<void(std::span<const std::byte>)> sent = nullptr;
  /// Each datagram of this exercise that was received.
  std::function<void(std::span<const std::byte>)> received = nullptr;
};

/// The hooks of the rows that a scene has switched on. One thread; allocates at construction alone.
class HookList {
 public:
  /// What `wiring` refers to outlives this.
  explicit HookList(const ModelWiring& wiring);

  void look(const WatchedPeer& peer) const {
    for (const auto& hook : look_) hook(peer);
  }
  void sent(std::span<const std::byte> datagram) const {
    for (const auto& hook : sent_) hook(datagram);
  }
  void received(std::span<const std::byte> datagram) const {
    for (const auto& hook : received_) hook(datagram);
  }

 private:
  std::vector<std::function<void(const WatchedPeer&)>> look_;
  std::vector<std::function<void(std::span<const std::byte>)>> sent_, received_;
};

}  // namespace reckon::peer
