// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// An assured message that did not reach a peer.
#pragma once

#include <cstdint>

#include "reckon/aoim/groups/peer_id.hpp"

namespace reckon::peer {

/// Why a peer did not get an assured message.
enum class UndeliveredCause : std::uint8_t {
  gave_up,    ///< it did not acknowledge within AcknowledgedSet::kGiveUp
  left,       ///< it left or fell silent before it acknowledged
  refused,    ///< it refused the message, for example as of an entity that the sender does not own
  in_flight,  ///< not sent: too many messages were in flight
};

/// One peer that did not get one message.
struct Undelivered {
  std::uint64_t tag = 0;    ///< of the message, as given by the sender
  std::uint32_t epoch = 0;  ///< of the peer
  aoim::PeerId peer{};      ///< its ID, as last announced
  UndeliveredCause cause = UndeliveredCause::gave_up;
};

/// Receives each. Must neither throw nor block.
class DeliveryWatch {
 public:
  virtual ~DeliveryWatch() = default;
  virtual void note_undelivered(const Undelivered&) noexcept {}
};

}  // namespace reckon::peer
