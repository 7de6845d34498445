// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The way of a peer to its LAN: UDP multicast, or to a list of addresses, behind a bad network
// where one is asked for.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "reckon/peer/clocks/clock.hpp"
#include "reckon/peer/network/fan_out_link.hpp"
#include "reckon/peer/network/impaired_link.hpp"
#include "reckon/peer/network/impairment.hpp"
#include "reckon/peer/network/udp_multicast.hpp"
#include "reckon/peer/network/unicast_peers.hpp"

namespace reckon::peer {

/// What to open.
struct LanLinkOptions {
  UdpMulticastOptions udp;
  ImpairmentLaw law;          ///< of what arrives; a perfect one costs nothing
  std::uint64_t seed{1};      ///< of the law
  std::uint64_t receiver{0};  ///< number of this peer; those with other numbers lose others
  /// Where there is no multicast: to whom each datagram goes. Empty: to the groups themselves.
  std::vector<NamedPeer> peers;
  GroupPool pool = GroupPool::ipv4_default();  ///< whose groups are distinguished then
  std::uint8_t exercise{1};
  bool plain{false};  ///< plain DIS, see FanOutOptions
};

/// Owns the links. The law's outages count from construction.
class LanLink {
 public:
  /// `clock` outlives this. @throws what UdpMulticast and ImpairedLink throw.
  LanLink(const LanLinkOptions& options, const Clock& clock);

  /// What a peer talks to.
  [[nodiscard]] Link& link() noexcept {
    if (impaired_) return *impaired_;
    return fan_out_ ? *fan_out_ : static_cast<Link&>(udp_);
  }
  [[nodiscard]] const UdpMulticast& udp() const noexcept { return udp_; }
  /// Sentences for the user: the interface taken and why, then what is less than asked for.
  [[nodiscard]] std::vector<std::string> report() const;

 private:
  UdpMulticast udp_;
  std::unique_ptr<FanOutLink> fan_out_;  // null where groups are multicast
  std::unique_ptr<ImpairedLink> impaired_;
};

}  // namespace reckon::peer
