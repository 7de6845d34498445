// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A number that its holder gives up goes at once to a peer that has requested it and waits, not
// with its next announcement.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "reckon/tests/fuzz/peers/life.hpp"

namespace reckon::fuzz {

/// The number under which a datagram announces its sender; none for other datagrams and leave
/// announcements.
[[nodiscard]] std::optional<aoim::PeerId> announced_in(std::span<const std::byte> datagram);

/// Observes a trial: invariant I12.
class ClaimWatch {
 public:
  /// (other, sentence)
  using Report = std::function<void(std::size_t, std::string)>;

  /// If strangers fill the tables, or claim numbers themselves, nothing is checked.
  ClaimWatch(const Plan& plan, const std::vector<Life>& lives);

  void see_received(std::size_t life, const PeerDatagram& datagram, nanoseconds now);
  void see_event(std::size_t life, const aoim::PresenceEvent& event);
  /// Call it when all events of a step have been seen.
  void look(std::size_t life, nanoseconds now, const Report& report);

 private:
  struct Claim {
    aoim::PeerId id;
    nanoseconds at{};
  };
  [[nodiscard]] bool waits(std::size_t life, std::size_t claimant, aoim::PeerId id,
                           nanoseconds now) const;

  const std::vector<Life>& lives_;
  bool watches_;
  std::map<std::pair<std::size_t, std::size_t>, Claim> claims_;  ///< (life, claimed from)
  std::set<std::pair<std::size_t, std::uint32_t>> ended_;  ///< (life, epoch it knows as ended)
  std::vector<aoim::PeerId> freed_;                        ///< in the present step
};

}  // namespace reckon::fuzz
