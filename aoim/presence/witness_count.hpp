// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// After a partition two established peers may hold the same ID. The one that more peers receive
// keeps it.
#pragma once

#include <chrono>
#include <cstddef>

#include "reckon/aoim/groups/peer_id.hpp"
#include "reckon/aoim/presence/claims.hpp"
#include "reckon/aoim/presence/peer_table.hpp"
#include "reckon/aoim/presence/presence_config.hpp"

namespace reckon::aoim {

/// Counts the witnesses of a dispute about our ID: the peers whose lists contain us, and those
/// whose lists contain the rival. One thread; allocates nothing.
class WitnessCount {
 public:
  /// @param config, peers, claims outlive this
  WitnessCount(const PresenceConfig& config, const PeerTable& peers, const Claims& claims) noexcept
      : config_(config), peers_(peers), claims_(claims) {}

  /// Whether we lose our ID to a rival; evaluated at most four times a second, false in between.
  /// @param own our announcement @param excess number of IDs lost in a row, minus the number after
  /// which a dispute lasts longer
  [[nodiscard]] bool is_against(const pdu::Presence& own, int excess,
                                std::chrono::nanoseconds now) noexcept;
  /// When a dispute about our ID must be checked; nanoseconds::max() if there is none.
  [[nodiscard]] std::chrono::nanoseconds next_step(PeerId own) const noexcept;

 private:
  // How many peers list a peer: by addresses, and in total.
  struct Support {
    std::size_t addresses = 0, peers = 0;
    auto operator<=>(const Support&) const = default;
  };
  [[nodiscard]] bool is_won_by(const Claimant& rival, const pdu::Presence& own, int excess,
                               std::chrono::nanoseconds now) const noexcept;
  [[nodiscard]] Support support(const auto& names) const noexcept;

  const PresenceConfig& config_;
  const PeerTable& peers_;
  const Claims& claims_;
  std::chrono::nanoseconds next_{0};  // when witnesses are counted again
};

}  // namespace reckon::aoim
