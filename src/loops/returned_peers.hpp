// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Sends touchable entities again to peers that were disconnected: such a peer does not feel our
// entities until it receives a new state.
#pragma once

#include <chrono>

#include "reckon/peer/world/hand_port.hpp"
#include "reckon/peer/world/owned_entities.hpp"

namespace reckon::peer {

/// One thread; no allocation.
class ReturnedPeers {
 public:
  /// A silent peer was received again.
  void note(std::chrono::nanoseconds now) noexcept { last_ = now; }
  /// Marks entities to be sent again. Even if many peers return, the rate is limited to the rate of
  /// hands in contact.
  void resend_touchable(OwnedEntities& owned, std::chrono::nanoseconds now) const noexcept {
    if (now - last_ > HandPort::kContactPeriod) return;
    for (const EntityNumber number : owned.touchable()) {
      OwnedEntity& entity = *owned.find(number);
      const bool is_sent = entity.last_sent >= last_;
      if (is_sent || now - entity.last_sent < HandPort::kContactPeriod) continue;
      entity.event();
      owned.look_at(number);
    }
  }

 private:
  std::chrono::nanoseconds last_ = std::chrono::nanoseconds::min() / 2;
};

}  // namespace reckon::peer
