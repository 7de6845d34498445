// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The link of a peer to its LAN: UDP multicast, or a list of addresses, optionally behind a
// simulated bad network.
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

/// Options of the link.
struct LanLinkOptions {
  UdpMulticastOptions udp;
  ImpairmentLaw law;          ///< of arriving datagrams; a perfect one costs nothing
  bool changes{false};        ///< the law may change: a perfect one costs a copy too
  std::uint64_t seed{1};      ///< of the law
  std::uint64_t receiver{0};  ///< number of this peer; other numbers lose other datagrams
  /// Recipients of each datagram if there is no multicast. Empty: the groups themselves.
  std::vector<NamedPeer> peers;
  GroupPool pool = GroupPool::ipv4_default();  ///< distinguished in that case
  std::uint8_t exercise{1};
  bool plain{false};  ///< plain DIS, see FanOutOptions
};

/// Owns the links. The law's outages count from construction.
class LanLink {
 public:
  /// @param clock outlives this.  @throws the exceptions of UdpMulticast and ImpairedLink.
  LanLink(const LanLinkOptions& options, const Clock& clock);

  /// The link for the peer.
  [[nodiscard]] Link& link() noexcept {
    if (impaired_) return *impaired_;
    return fan_out_ ? *fan_out_ : static_cast<Link&>(udp_);
  }
  /// See ImpairedLink::change_law(). @throws std::logic_error without `changes`
  void change_law(const ImpairmentLaw& law);
  [[nodiscard]] const UdpMulticast& udp() const noexcept { return udp_; }
  /// Sentences for the user: the chosen interface with the reason, then what falls short of the
  /// request.
  [[nodiscard]] std::vector<std::string> report() const;

 private:
  UdpMulticast udp_;
  std::unique_ptr<FanOutLink> fan_out_;  // null if groups are multicast
  std::unique_ptr<ImpairedLink> impaired_;
};

}  // namespace reckon::peer
