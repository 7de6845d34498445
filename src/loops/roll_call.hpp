// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Before a peer joins a scene made for several: who is there already, and which of the scene's
// peers is left for it. Two that start in the same instant get different ones.
#pragma once

#include <chrono>
#include <cstdint>

#include "reckon/aoim/area_of_interest_manager.hpp"
#include "reckon/peer/clocks/clock.hpp"
#include "reckon/peer/network/link.hpp"

namespace reckon::peer {

/// Announces a peer without a number on the base group until its id is settled, and takes a number
/// then. One thread; the link is its own until leave().
class RollCall {
 public:
  /// Longest time that answer() takes.
  static constexpr std::chrono::seconds kLongest{4};

  /// @param own an announcement (see presence()) under an epoch of its own. @param link, clock, own
  /// and real time, outlive this.
  RollCall(Link& link, const Clock& clock, const GroupAddress& base,
           const aoim::AreaOfInterestConfig& config, const pdu::Presence& own);

  /// Which peer of the scene this is, from 1: the smallest number that nobody holds, where those
  /// that have none yet are served in the order of their ids. Takes about a second; tells the
  /// others.
  [[nodiscard]] std::uint8_t answer();
  /// Settled by answer().
  [[nodiscard]] aoim::PeerId id() const noexcept { return presence_.id(); }
  /// Says good-bye under this epoch; call it when the peer itself has announced its number.
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
