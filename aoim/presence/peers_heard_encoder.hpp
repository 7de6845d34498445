// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The list of peers that this one hears, as a PDU.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "reckon/aoim/groups/control_stamp.hpp"
#include "reckon/aoim/presence/presence.hpp"
#include "reckon/pdu/reckon/peers_heard.hpp"

namespace reckon::aoim {

/// Room for one list. One thread; allocates nothing.
class PeersHeardEncoder {
 public:
  /// Epochs of one list at most: it and its bundle stay below the payload limit.
  static constexpr std::size_t kMostListed = 256;

  /// @return a PeersHeard PDU of the first kMostListed epochs, until the next call
  [[nodiscard]] std::span<const std::byte> encode(const HeardList& heard,
                                                  const ControlStamp& stamp) noexcept;

 private:
  static constexpr std::size_t kEpochSize = pdu::kFixedSize<pdu::PeerEpoch>;

  std::array<std::byte, kMostListed * kEpochSize> epochs_{};
  std::array<std::byte, pdu::kFixedSize<pdu::PeersHeard> + kMostListed * kEpochSize> octets_{};
};

}  // namespace reckon::aoim
