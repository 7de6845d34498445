// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Sender of an interaction, as far as a peer knows.
#pragma once

#include <optional>

#include "reckon/aoim/groups/peer_id.hpp"
#include "reckon/aoim/presence/source_address.hpp"

namespace reckon::peer {

/// Sender of an interaction. Interactions in the name of another owner's entity are refused before
/// delivery. A value.
struct InteractionSender {
  /// Source address of its datagram. Without a key, an address proves only that an answer would
  /// reach the sender.
  aoim::SourceAddress address = {};
  /// The peer of this scene that sent it; none: a plain DIS program, or an unknown one.
  std::optional<aoim::PeerId> peer = {};
  /// Whether the sender owns the issuing entity, according to its own statements. False if no
  /// entity of that name is received, so that any program may have invented it, or if the PDU names
  /// none.
  bool owns = false;
};

}  // namespace reckon::peer
