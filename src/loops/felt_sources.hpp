// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Publishes the sources of felt bodies to the read loop: only their datagrams wake the model loop
// at once.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

#include "reckon/haptics/exchange/triple_buffer.hpp"
#include "reckon/peer/loops/aoim_setup.hpp"
#include "reckon/peer/network/link.hpp"
#include "reckon/peer/world/near_bodies.hpp"
#include "reckon/peer/world/remote_entities.hpp"

namespace reckon::peer {

/// Source addresses of the remote bodies within reach of a hand.
struct FeltSources {
  static constexpr std::size_t kMost = 16;
  std::array<IpEndpoint, kMost> sources{};  ///< without duplicates
  std::size_t count = 0;
  bool all = true;  ///< datagrams of any source may be felt

  /// Whether a delay of this source's datagrams can be felt. An unspecified source may be any.
  [[nodiscard]] bool contains(const IpEndpoint& source) const noexcept {
    const auto end = sources.begin() + static_cast<std::ptrdiff_t>(count);
    return all || source.is_unspecified() || std::find(sources.begin(), end, source) != end;
  }
};

/// One thread; no allocation.
class FeltSourcesPublisher {
 public:
  /// @param out outlives it; null: not published
  explicit FeltSourcesPublisher(haptics::TripleBuffer<FeltSources>* out) noexcept : out_(out) {}

  /// Publishes the sources of these bodies if they changed. With more than FeltSources::kMost,
  /// `all` is set.  @param bodies within reach of each hand  @param all whether further bodies can
  /// be felt
  void publish(std::span<const NearBodies> bodies, bool all,
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

 private:
  static void add(FeltSources& felt, const IpEndpoint& source) noexcept {
    if (felt.contains(source)) {
      felt.all = felt.all || source.is_unspecified();
    } else if (felt.count == FeltSources::kMost) {
      felt.all = true;
    } else {
      felt.sources[felt.count++] = source;
    }
  }
  static bool is_same(const FeltSources& a, const FeltSources& b) noexcept {
    return a.all == b.all && a.count == b.count && a.sources == b.sources;
  }

  haptics::TripleBuffer<FeltSources>* out_;
  FeltSources published_;
};

}  // namespace reckon::peer
