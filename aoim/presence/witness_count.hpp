// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// After a partition two established peers may hold the same ID. The one that more peers receive
// keeps it.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>

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
                                std::chrono::nanoseconds now) noexcept {
    if (now < next_) return false;
    next_ = now + kVerdictGap;
    return std::any_of(claims_.begin(), claims_.end(), [&](const Claimant& claimant) {
      return claimant.id() == own.simulation && is_won_by(claimant, own, excess, now);
    });
  }
  /// When a dispute about our ID must be checked; nanoseconds::max() if there is none.
  [[nodiscard]] std::chrono::nanoseconds next_step(PeerId own) const noexcept {
    std::chrono::nanoseconds next = std::chrono::nanoseconds::max();
    for (const Claimant& claimant : claims_) {
      if (claimant.id() != own) continue;
      next = std::min(next, std::max(next_, claimant.since + config_.dispute / 2));
    }
    return next;
  }

 private:
  // Validity of a rival's claim: one announcement period, so that a silent rival never wins. And
  // validity of a witness's list: at 20 % loss all four lists of this time are lost once in 600
  // times.
  static constexpr std::chrono::milliseconds kRecent{1200}, kRecentList{4000};
  // Gap between two counts of the witnesses in a dispute.
  static constexpr std::chrono::milliseconds kVerdictGap{250};

  // How many peers list a peer: by addresses, and in total.
  struct Support {
    std::size_t addresses = 0, peers = 0;
    auto operator<=>(const Support&) const = default;
  };
  [[nodiscard]] bool is_won_by(const Claimant& rival, const pdu::Presence& own, int excess,
                               std::chrono::nanoseconds now) const noexcept {
    // The rival's own statements, such as its start time, count only if the witnesses are equal, so
    // a forger cannot evict a peer that others receive.
    const std::chrono::nanoseconds lasts = now - rival.since;
    const std::chrono::nanoseconds round = config_.list_round(peers_.size());
    const std::chrono::nanoseconds all_listed = config_.dispute + round;
    const std::chrono::nanoseconds least = excess > 0    ? 2 * all_listed
                                           : excess == 0 ? all_listed
                                                         : all_listed / 2;
    if (!announces_established(rival.announced) || lasts < least) return false;
    if (now - rival.last_heard > kRecent) return false;
    // A peer that was cut off from us, perhaps with the rival, has to receive us before its list
    // contains us.
    const bool any_is_back = std::ranges::any_of(peers_, [&](const Peer& peer) {
      return peer.tip.is_chained() && now - peer.back_since < config_.dispute / 2;
    });
    if (any_is_back) return false;
    const std::uint32_t theirs = rival.epoch();
    const std::chrono::nanoseconds since = now - kRecentList - round;
    const auto names_us = [since](const Hearing& hears) { return hears.us_at > since && hears.us; };
    const auto names_rival = [since, theirs](const Hearing& hears) {
      return hears.rival_at > since && hears.rival == theirs;
    };
    const Support mine =
        support([&](const Hearing& hears, std::uint32_t) { return names_us(hears); });
    const Support other = support([&](const Hearing& hears, std::uint32_t witness) {
      return names_rival(hears) && witness != theirs;
    });
    // Whether a received peer has listed neither of us and will: a newcomer, or one that was cut
    // off. A peer that never sends a list is no witness.
    const bool awaited = std::any_of(peers_.begin(), peers_.end(), [&](const Peer& peer) {
      const bool lists = peer.hears.came > since || now - peer.first_heard <= config_.established;
      return peer.joined && peer.confirmed && lists && now - peer.last_heard <= config_.listed &&
             !names_us(peer.hears) && !names_rival(peer.hears);
    });
    if (lasts < all_listed) return !awaited && mine < other;
    return mine != other ? mine < other : !awaited && precedes(rival.announced, own);
  }
  [[nodiscard]] Support support(const auto& names) const noexcept {
    Support sum;
    const std::size_t count = peers_.size() + claims_.size();
    const auto source_of_witness = [&](std::size_t i) -> const SourceAddress* {
      if (i < peers_.size())
        return names(peers_[i].hears, peers_.epoch(i)) ? &peers_[i].source : nullptr;
      const Claimant& claimant = claims_[i - peers_.size()];
      return names(claimant.hears, claimant.epoch()) ? &claimant.source : nullptr;
    };
    for (std::size_t i = 0; i < count; ++i) {
      const SourceAddress* source = source_of_witness(i);
      if (source == nullptr) continue;
      ++sum.peers;
      bool again = false;
      for (std::size_t j = 0; j < i && !again; ++j) {
        const SourceAddress* other = source_of_witness(j);
        again = other != nullptr && other->octets == source->octets;
      }
      if (!again) ++sum.addresses;
    }
    return sum;
  }

  const PresenceConfig& config_;
  const PeerTable& peers_;
  const Claims& claims_;
  std::chrono::nanoseconds next_{0};  // when witnesses are counted again
};

}  // namespace reckon::aoim
