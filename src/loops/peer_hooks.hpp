// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Mechanisms that watch a peer, called at their hooks. A new one is a file and a row of THE list in
// peer_hooks.cpp.
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

/// The watched state.
struct WatchedPeer {
  const RemoteEntities& remote;
  aoim::AreaOfInterestManager& aoim;
  std::size_t unfelt;                  ///< most bodies nearby that a servo omits now
  const aoim::SourceAddress& crowder;  ///< host of most of the bodies nearby
  std::chrono::nanoseconds now;
  haptics::SpscRing<Notice>& notices;  ///< for the user
};

/// Called by the model loop's thread; must neither throw nor block. Unset hooks cost nothing.
struct PeerHooks {
  /// Called some twenty times a second.
  std::function<void(const WatchedPeer&)> look = nullptr;
  /// Called for each sent datagram, with its trailer.
  std::function<void(std::span<const std::byte>)> sent = nullptr;
  /// Called for each received datagram of this exercise.
  std::function<void(std::span<const std::byte>)> received = nullptr;
};

/// The hooks of the rows that a scene enables. One thread; allocates only at construction.
class HookList {
 public:
  /// All references in `wiring` outlive this.
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
