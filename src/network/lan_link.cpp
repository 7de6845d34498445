// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/network/lan_link.hpp"

namespace reckon::peer {

LanLink::LanLink(const LanLinkOptions& options, const Clock& clock) : udp_(options.udp, clock) {
  if (options.law.is_perfect()) return;
  ImpairedLinkOptions impaired;
  impaired.law = options.law;
  impaired.seed = options.seed;
  impaired.receiver = options.receiver;
  impaired.start = clock.now();
  impaired.tap = options.udp.tap;
  impaired_ = std::make_unique<ImpairedLink>(udp_, impaired, clock);
}

std::vector<std::string> LanLink::report() const {
  std::vector<std::string> sentences{udp_.choice().explanation};
  sentences.insert(sentences.end(), udp_.warnings().begin(), udp_.warnings().end());
  return sentences;
}

}  // namespace reckon::peer
