// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/loops/known_sources_publisher.hpp"

#include <algorithm>

#include "reckon/peer/loops/aoim_setup.hpp"

namespace reckon::peer {

KnownSourcesPublisher::KnownSourcesPublisher(haptics::TripleBuffer<KnownSources>* out) : out_(out) {
  if (out_ == nullptr) return;
  published_.reserve(KnownSources::kMost);
  now_.reserve(KnownSources::kMost);
}

void KnownSourcesPublisher::publish(const aoim::Presence& presence) noexcept {
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

}  // namespace reckon::peer
