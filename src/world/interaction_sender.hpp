// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Who said an interaction, as far as a peer knows.
#pragma once

#include <optional>

#include "reckon/aoim/groups/peer_id.hpp"
#include "reckon/aoim/presence/source_address.hpp"

namespace reckon::peer {

/// Who said an interaction: one in the name of another's entity is refused before anybody hears it.
/// A value.
struct InteractionSender {
  /// Where its datagram came from. Without a key an address proves nothing but that an answer to it
  /// would come there.
  aoim::SourceAddress address = {};
  /// The peer of this scene that said it; none: a program of plain DIS, or one that is not known.
  std::optional<aoim::PeerId> peer = {};
  /// The entity in whose name it is said is the sender's, by what it says of itself. False: nobody
  /// is heard under that name, so that anybody may have made it up, or the PDU names none.
  bool owns = false;
};

}  // namespace reckon::peer
