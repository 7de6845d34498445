// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/network/lan_link.hpp"

#include <stdexcept>

namespace reckon::peer {

LanLink::LanLink(const LanLinkOptions& options, const Clock& clock) : udp_(options.udp, clock) {
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

void LanLink::change_law(const ImpairmentLaw& law) {
  if (!impaired_) throw std::logic_error("this link's impairment does not change: see `changes`");
  impaired_->change_law(law);
}

std::vector<std::string> LanLink::report() const {
  std::vector<std::string> sentences{udp_.choice().explanation};
  if (fan_out_) {
    sentences.push_back("to no group: each datagram goes to " + std::to_string(fan_out_->peers()) +
                        " others of the list; our address is " + udp_.local_endpoint().text());
  }
  sentences.insert(sentences.end(), udp_.warnings().begin(), udp_.warnings().end());
  return sentences;
}

}  // namespace reckon::peer
