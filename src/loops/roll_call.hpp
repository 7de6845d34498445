// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Finds the present peers and a free peer number, before a peer joins a scene made for several
// peers. Two peers that start at the same instant get different numbers.
#pragma once

#include <chrono>
#include <cstdint>

#include "reckon/aoim/area_of_interest_manager.hpp"
#include "reckon/peer/clocks/clock.hpp"
#include "reckon/peer/network/link.hpp"

namespace reckon::peer {

/// Announces a peer without a number on the base group until its ID is settled, and then takes a
/// number. One thread; exclusive use of the link until leave().
class RollCall {
 public:
  /// Longest time that answer() takes.
  static constexpr std::chrono::seconds kLongest{4};

  /// @param own an announcement (see presence()) with a separate epoch.
  /// @param link,clock exclusive and real time; outlive this.
  RollCall(Link& link, const Clock& clock, const GroupAddress& base,
           const aoim::AreaOfInterestConfig& config, const pdu::Presence& own);

  /// Determines the number of this peer in the scene, from 1: the smallest that no peer has. Peers
  /// without a number take one in the order of their IDs. Takes about a second; announces the
  /// number to the others.
  [[nodiscard]] std::uint8_t answer();
  /// The ID, settled by answer().
  [[nodiscard]] aoim::PeerId id() const noexcept { return presence_.id(); }
  /// Sends the leaving announcement of this epoch; call it after the peer itself has announced its
  /// number.
  void leave();

 private:
  void listen(std::chrono::nanoseconds longest);
  void speak();

  Link& link_;
  const Clock& clock_;
  GroupAddress base_;
  aoim::Presence presence_;
};

}  // namespace reckon::peer
