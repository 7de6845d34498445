// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The link of a peer to its LAN: UDP multicast, or a list of addresses, optionally behind a
// simulated bad network.
#pragma once

#include <cstdint>
#include <memory>
#include <stdexcept>
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
  LanLink(const LanLinkOptions& options, const Clock& clock) : udp_(options.udp, clock) {
    if (!options.peers.empty()) {
      FanOutOptions to;
      to.peers = resolve_peers(options.peers, options.pool.base().port, options.udp.ipv6);
      to.exercise = options.exercise;
      to.plain = options.plain;
      to.tap = options.udp.tap;
      fan_out_ = std::make_unique<FanOutLink>(udp_, options.pool, to);
    }
    if (options.law.is_perfect() && !options.changes) return;
    ImpairedLinkOptions impaired;
    impaired.law = options.law;
    impaired.seed = options.seed;
    impaired.receiver = options.receiver;
    impaired.start = clock.now();
    impaired.tap = options.udp.tap;
    impaired_ = std::make_unique<ImpairedLink>(link(), impaired, clock);
  }

  /// The link for the peer.
  [[nodiscard]] Link& link() noexcept {
    if (impaired_) return *impaired_;
    return fan_out_ ? *fan_out_ : static_cast<Link&>(udp_);
  }
  /// See ImpairedLink::change_law(). @throws std::logic_error without `changes`
  void change_law(const ImpairmentLaw& law) {
    if (!impaired_) throw std::logic_error("this link's impairment does not change: see `changes`");
    impaired_->change_law(law);
  }
  [[nodiscard]] const UdpMulticast& udp() const noexcept { return udp_; }
  /// Sentences for the user: the chosen interface, then what falls short of the request.
  [[nodiscard]] std::vector<std::string> report() const {
    std::vector<std::string> sentences{udp_.choice().sentence};
    if (fan_out_) {
      sentences.push_back("to no group: each datagram goes to " +
                          std::to_string(fan_out_->peers()) +
                          " others of the list; our address is " + udp_.local_endpoint().text());
    }
    sentences.insert(sentences.end(), udp_.warnings().begin(), udp_.warnings().end());
    return sentences;
  }

 private:
  UdpMulticast udp_;
  std::unique_ptr<FanOutLink> fan_out_;  // null if groups are multicast
  std::unique_ptr<ImpairedLink> impaired_;
};

}  // namespace reckon::peer
