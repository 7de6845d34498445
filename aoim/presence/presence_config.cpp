// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/aoim/presence/presence_config.hpp"

#include <cstdint>
#include <stdexcept>

#include "reckon/aoim/groups/peer_id.hpp"

namespace reckon::aoim {

using std::chrono::nanoseconds;

void PresenceConfig::check(const pdu::Presence& own) const {
  if (own.epoch == 0) throw std::invalid_argument("presence: epoch 0; draw one at random");
  if (own.simulation.site == kSceneSite)
    throw std::invalid_argument("site 65534 belongs to the scene's bodies: choose 1 to 65533");
  if (heartbeat.count() <= 0 || missed < 1) {
    throw std::invalid_argument("presence: heartbeat and number of misses must be positive");
  }
  if (most_listed < 1 || part < 2) {
    throw std::invalid_argument("presence: lists must have room for one, parts of them for two");
  }
}

nanoseconds PresenceConfig::patience() const noexcept { return missed * heartbeat + minimum_gap; }

nanoseconds PresenceConfig::list_round(std::size_t peers) const noexcept {
  if (peers <= most_listed) return nanoseconds(0);
  const std::size_t parts = (peers + part - 2) / (part - 1);
  return static_cast<std::int64_t>(parts - 1) * heartbeat;
}

}  // namespace reckon::aoim
