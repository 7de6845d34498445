// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Admission control: keeps invented peers from filling the table of peers.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "reckon/aoim/presence/claims.hpp"
#include "reckon/aoim/presence/peer_table.hpp"
#include "reckon/aoim/presence/presence_config.hpp"
#include "reckon/aoim/presence/presence_event.hpp"
#include "reckon/aoim/presence/source_address.hpp"

namespace reckon::aoim {

/// Limits the peers of one source, and selects the row to drop when the table is full. One thread;
/// allocates nothing after construction.
class Admission {
 public:
  /// @param config, peers, claims, events outlive this
  Admission(const PresenceConfig& config, const PeerTable& peers, const Claims& claims,
            PresenceEvents& events);

  /// Whether this source has the most peers that one source may have, so that no further one is
  /// accepted. Counted, and reported once for each remembered source. @param own our announcement
  [[nodiscard]] bool is_crowd(const SourceAddress& from, const pdu::Presence& own);
  /// Whether it announces the site of the scene, which no peer may have. Counted and reported in
  /// the same way.
  [[nodiscard]] bool is_reserved(const pdu::Presence& heard, const SourceAddress& from);
  /// The row to drop for a newcomer; nothing if all rows stay. It is the oldest of the peers that
  /// announced themselves once and were silent since, or have never sent a list.
  [[nodiscard]] std::optional<std::size_t> stale_row(std::chrono::nanoseconds now) noexcept;

  /// Announcements refused because their source had too many peers.
  [[nodiscard]] std::uint64_t refused() const noexcept { return refused_; }
  /// Announcements refused because of their site.
  [[nodiscard]] std::uint64_t reserved() const noexcept { return reserved_; }

 private:
  [[nodiscard]] static bool is_new(std::vector<SourceAddress>& reported, const SourceAddress& from);

  static constexpr std::size_t kCrowds = 16;  // sources remembered as reported

  const PresenceConfig& config_;
  const PeerTable& peers_;
  const Claims& claims_;
  PresenceEvents& events_;
  std::vector<SourceAddress> crowds_, reserving_;  // reported, oldest first
  std::chrono::nanoseconds next_eviction_{
      0};  // when a peer of a crowded source may be dropped again
  std::uint64_t refused_ = 0, reserved_ = 0;
};

}  // namespace reckon::aoim
