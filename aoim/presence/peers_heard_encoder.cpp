// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/aoim/presence/peers_heard_encoder.hpp"

#include <algorithm>

namespace reckon::aoim {

std::span<const std::byte> PeersHeardEncoder::encode(const HeardList& heard,
                                                     const ControlStamp& stamp) noexcept {
  const std::size_t count = std::min(heard.epochs.size(), kMostListed);
  for (std::size_t i = 0; i < count; ++i) {
    const std::span<std::byte> place = std::span(epochs_).subspan(i * kEpochSize, kEpochSize);
    static_cast<void>(pdu::store_record(pdu::PeerEpoch{heard.epochs[i]}, place));
  }
  pdu::PeersHeard list;
  stamp.put(list);
  list.continues = heard.continues;
  list.epochs = std::span(epochs_).first(count * kEpochSize);
  return std::span(octets_).first(pdu::encode(list, octets_));
}

}  // namespace reckon::aoim
