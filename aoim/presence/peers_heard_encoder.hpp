// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Encodes the list of received peers as a PDU.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

#include "reckon/aoim/groups/control_stamp.hpp"
#include "reckon/aoim/presence/presence.hpp"
#include "reckon/pdu/reckon/peers_heard.hpp"

namespace reckon::aoim {

/// A buffer for one list. One thread; allocates nothing.
class PeersHeardEncoder {
 public:
  /// Greatest number of epochs in one list, so that it and its bundle stay below the payload limit.
  static constexpr std::size_t kMostListed = 256;

  /// @return a PeersHeard PDU of the first kMostListed epochs, valid until the next call
  [[nodiscard]] std::span<const std::byte> encode(const HeardList& heard,
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

 private:
  static constexpr std::size_t kEpochSize = pdu::kFixedSize<pdu::PeerEpoch>;

  std::array<std::byte, kMostListed * kEpochSize> epochs_{};
  std::array<std::byte, pdu::kFixedSize<pdu::PeersHeard> + kMostListed * kEpochSize> octets_{};
};

}  // namespace reckon::aoim
