// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Publishes the sources of known peers to the read loop: each has its own share of the arriving
// traffic.
#pragma once

#include <algorithm>
#include <vector>

#include "reckon/aoim/presence/presence.hpp"
#include "reckon/haptics/exchange/triple_buffer.hpp"
#include "reckon/peer/loops/aoim_setup.hpp"
#include "reckon/peer/loops/sender_budget.hpp"

namespace reckon::peer {

/// One thread; allocates only at construction.
class KnownSourcesPublisher {
 public:
  /// @param out outlives it; null: not published
  explicit KnownSourcesPublisher(haptics::TripleBuffer<KnownSources>* out) : out_(out) {
    if (out_ == nullptr) return;
    published_.reserve(KnownSources::kMost);
    now_.reserve(KnownSources::kMost);
  }

  /// Publishes the addresses of joined and confirmed peers if they changed: a peer that has
  /// announced itself only once may be forged.
  void publish(const aoim::Presence& presence) noexcept {
    if (out_ == nullptr) return;
    now_.clear();
    for (const aoim::Peer& peer : presence.peers()) {
      const bool is_known = peer.joined && peer.confirmed && peer.source.port != 0;
      if (is_known && now_.size() < KnownSources::kMost) now_.push_back(endpoint_of(peer.source));
    }
    std::ranges::sort(now_);
    now_.erase(std::ranges::unique(now_).begin(), now_.end());
    if (now_ == published_) return;
    published_ = now_;
    KnownSources& known = out_->write_slot();
    known.count = now_.size();
    std::ranges::copy(now_, known.sources.begin());
    out_->publish();
  }

 private:
  haptics::TripleBuffer<KnownSources>* out_;
  std::vector<IpEndpoint> published_, now_;
};

}  // namespace reckon::peer
