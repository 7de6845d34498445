// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Admission control: the table of peers is not filled with names that nobody bears.
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

/// How many are believed of one source, and who goes where the table is full. One thread; allocates
/// nothing after construction.
class Admission {
 public:
  /// @param config, peers, claims, events outlive this
  Admission(const PresenceConfig& config, const PeerTable& peers, const Claims& claims,
            PresenceEvents& events);

  /// Whether this source speaks for as many peers as one may: no further one is believed. Counted,
  /// and reported once for each source, as long as it is remembered. @param own our announcement
  [[nodiscard]] bool is_crowd(const SourceAddress& from, const pdu::Presence& own);
  /// The row that goes for a newcomer; nothing where each may stay. It is the first that came of
  /// those that announced themselves once and were silent since, or have never sent a list.
  [[nodiscard]] std::optional<std::size_t> stale_row(std::chrono::nanoseconds now) noexcept;

  /// Announcements refused for too many of one source.
  [[nodiscard]] std::uint64_t refused() const noexcept { return refused_; }

 private:
  static constexpr std::size_t kCrowds = 16;  // sources remembered as reported

  const PresenceConfig& config_;
  const PeerTable& peers_;
  const Claims& claims_;
  PresenceEvents& events_;
  std::vector<SourceAddress> crowds_;          // reported, oldest first
  std::chrono::nanoseconds next_eviction_{0};  // when one of a crowd may go again
  std::uint64_t refused_ = 0;
};

}  // namespace reckon::aoim
