// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The sources of what can be felt, for the read loop: only what they send wakes the model loop at
// once.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

#include "reckon/haptics/exchange/triple_buffer.hpp"
#include "reckon/peer/network/link.hpp"
#include "reckon/peer/world/near_bodies.hpp"
#include "reckon/peer/world/remote_entities.hpp"

namespace reckon::peer {

/// Source addresses of the remote bodies in reach of a hand.
struct FeltSources {
  static constexpr std::size_t kMost = 16;
  std::array<IpEndpoint, kMost> sources{};  ///< none twice
  std::size_t count = 0;
  bool all = true;  ///< what any source sends may be felt

  /// Whether a delay of what this source sends can be felt. An unspecified one may be any.
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

  /// Publishes the sources of these bodies when they have changed. Beyond FeltSources::kMost it is
  /// all.  @param bodies in reach of each hand  @param all whether more than these can be felt
  void publish(std::span<const NearBodies> bodies, bool all, const RemoteEntities& remote) noexcept;

 private:
  haptics::TripleBuffer<FeltSources>* out_;
  FeltSources published_;
};

}  // namespace reckon::peer
