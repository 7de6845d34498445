// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Publishes the sources of known peers to the read loop: each has its own share of the arriving
// traffic.
#pragma once

#include <vector>

#include "reckon/aoim/presence/presence.hpp"
#include "reckon/haptics/exchange/triple_buffer.hpp"
#include "reckon/peer/loops/sender_budget.hpp"

namespace reckon::peer {

/// One thread; allocates only at construction.
class KnownSourcesPublisher {
 public:
  /// @param out outlives it; null: not published
  explicit KnownSourcesPublisher(haptics::TripleBuffer<KnownSources>* out);

  /// Publishes the addresses of joined and confirmed peers if they changed: a peer that has
  /// announced itself only once may be forged.
  void publish(const aoim::Presence& presence) noexcept;

 private:
  haptics::TripleBuffer<KnownSources>* out_;
  std::vector<IpEndpoint> published_, now_;
};

}  // namespace reckon::peer
