// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/loops/felt_sources.hpp"

#include "reckon/peer/loops/aoim_setup.hpp"

namespace reckon::peer {
namespace {

void add(FeltSources& felt, const IpEndpoint& source) noexcept {
  if (felt.contains(source)) {
    felt.all = felt.all || source.is_unspecified();
  } else if (felt.count == FeltSources::kMost) {
    felt.all = true;
  } else {
    felt.sources[felt.count++] = source;
  }
}

bool is_same(const FeltSources& a, const FeltSources& b) noexcept {
  return a.all == b.all && a.count == b.count && a.sources == b.sources;
}

}  // namespace

void FeltSourcesPublisher::publish(std::span<const NearBodies> bodies, bool all,
                                   const RemoteEntities& remote) noexcept {
  if (out_ == nullptr) return;
  FeltSources felt;
  felt.all = all;
  for (const NearBodies& in_reach : bodies)
    for (const NearBody& body : in_reach.bodies())
      if (body.row != nullptr) add(felt, endpoint_of(remote.owner(*body.row)));
  if (is_same(felt, published_)) return;
  published_ = felt;
  out_->write_slot() = felt;
  out_->publish();
}

}  // namespace reckon::peer
