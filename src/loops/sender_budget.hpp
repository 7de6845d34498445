// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// How many datagrams one sender may have read: one that floods is muted, so that the others are
// heard. By the source address, which a hostile host may forge.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>

#include "reckon/haptics/exchange/spsc_ring.hpp"
#include "reckon/peer/network/link.hpp"

namespace reckon::peer {

/// A sender is muted, or heard again.
struct MutedSender {
  IpEndpoint who;  ///< port 0: all of that address together
  bool muted = false;
  std::uint64_t dropped = 0;  ///< datagrams, while it was muted
};

/// Counts the datagrams of each source, address and port, and of each address, in windows of
/// 100 ms. Who sends more than the limits is muted, until a window of its has less than
/// kCalm. One thread, fixed memory, no allocation; about 20 ns a datagram.
///
/// An honest peer introduces itself with up to 15,000 datagrams/s. The table has room for some
/// 1,000 sources and their addresses at a time; beyond, those that are new to it go uncounted.
class SenderBudget {
 public:
  static constexpr std::chrono::nanoseconds kWindow = std::chrono::milliseconds(100);
  /// Datagrams of one source in a window: at any time, and while the reader is under pressure.
  static constexpr std::uint32_t kMost = 2000, kMostPressed = 1600;
  /// Of all sources of one address, which may have many peers.
  static constexpr std::uint32_t kMostOfAddress = 8000, kMostOfAddressPressed = 6000;
  static constexpr std::uint32_t kCalm = 1000;  ///< fewer in a window: heard again

  /// @param told who is muted and heard again; outlives this
  explicit SenderBudget(haptics::SpscRing<MutedSender>& told) noexcept : told_(told) {}

  /// Whether a datagram is to be read. @param received when the link had it, steady time
  /// @param pressed whether little room is left for what is read
  [[nodiscard]] bool admit(const IpEndpoint& sender, std::chrono::nanoseconds received,
                           bool pressed) noexcept;
  /// Finds who has fallen silent while muted; call it some times a second.
  void look(std::chrono::nanoseconds now) noexcept;
  /// Senders that are muted now.
  [[nodiscard]] std::size_t muted() const noexcept { return muted_; }

 private:
  struct Source {
    IpEndpoint who;
    std::chrono::nanoseconds window{-1};  // its begin; < 0: free
    std::uint32_t count = 0;              // in it
    bool muted = false;
    std::uint64_t dropped = 0;
  };
  static constexpr std::size_t kWays = 4, kSets = 512;

  [[nodiscard]] Source* find(const IpEndpoint& who, std::chrono::nanoseconds received) noexcept;
  [[nodiscard]] bool count(Source* source, std::chrono::nanoseconds received,
                           std::uint32_t most) noexcept;
  void turn(Source& source, std::chrono::nanoseconds received) noexcept;
  void tell(Source& source, bool muted) noexcept;

  haptics::SpscRing<MutedSender>& told_;
  std::array<std::array<Source, kWays>, kSets> sources_{};
  std::size_t muted_ = 0;
};

}  // namespace reckon::peer
