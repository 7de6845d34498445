// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The sources of known peers, for the read loop: each has a share of its own of what may arrive.
#pragma once

#include <vector>

#include "reckon/aoim/presence/presence.hpp"
#include "reckon/haptics/exchange/triple_buffer.hpp"
#include "reckon/peer/loops/sender_budget.hpp"

namespace reckon::peer {

/// One thread; allocates at construction alone.
class KnownSourcesPublisher {
 public:
  /// @param out outlives it; null: nobody asks
  explicit KnownSourcesPublisher(haptics::TripleBuffer<KnownSources>* out);

  /// Publishes where the peers are that have joined and been confirmed, where that has changed: one
  /// that has announced itself once only may be invented.
  void publish(const aoim::Presence& presence) noexcept;

 private:
  haptics::TripleBuffer<KnownSources>* out_;
  std::vector<IpEndpoint> published_, now_;
};

}  // namespace reckon::peer
