// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Limits the datagrams that are read from one sender: a flooding one is muted, so that others are
// received. The source address identifies a sender, and a hostile host may forge it. A member has a
// separate share that no other process of its host can use up.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>

#include "reckon/haptics/exchange/spsc_ring.hpp"
#include "reckon/peer/network/link.hpp"

namespace reckon::peer {

/// A sender that is muted or unmuted.
struct MutedSender {
  IpEndpoint who;  ///< port 0: all sources of the address together
  bool muted = false;
  std::uint64_t dropped = 0;  ///< datagrams dropped while it was muted
};

/// Source addresses of members: peers that have announced themselves and are received.
struct KnownSources {
  static constexpr std::size_t kMost = 1024;
  std::array<IpEndpoint, kMost> sources{};  ///< ascending, without duplicates
  std::size_t count = 0;

  [[nodiscard]] std::span<const IpEndpoint> all() const noexcept {
    return std::span(sources).first(count);
  }
};

/// Counts the datagrams of each source (address and port) and of each address, in windows of 100
/// ms. A sender above the limits is muted until it has a window with less than kCalm. One thread,
/// fixed memory, no allocation; about 20 ns per datagram.
///
/// A known source has its own share besides the share of its address: the limit of the address,
/// divided by the number of known sources there. Datagrams within this share are read even if the
/// rest of its host is muted. All sources of an address together are thus limited to twice the
/// limit of the address.
///
/// An honest peer introduces itself with up to 15,000 datagrams/s. The table has room for some
/// 1,000 sources and their addresses at a time; further new ones are not counted.
class SenderBudget {
 public:
  static constexpr std::chrono::nanoseconds kWindow = std::chrono::milliseconds(100);
  /// Limit for one source in a window: normally, and while the reader is under pressure.
  static constexpr std::uint32_t kMost = 2000, kMostPressed = 1600;
  /// The same for all sources of one address, which may have many peers.
  static constexpr std::uint32_t kMostOfAddress = 8000, kMostOfAddressPressed = 6000;
  static constexpr std::uint32_t kCalm = 1000;  ///< unmuted after a window with fewer

  /// @param out receives muted and unmuted senders; outlives this
  explicit SenderBudget(haptics::SpscRing<MutedSender>& out) noexcept : out_(out) {}

  /// Whether a datagram is to be read.  @param received steady time of its arrival at the link
  /// @param pressed whether the reader has little room left
  [[nodiscard]] bool admit(const IpEndpoint& sender, std::chrono::nanoseconds received,
                           bool pressed) noexcept;
  /// Replaces the known sources. Linear in their number; call it when they change.
  void know(const KnownSources& known) noexcept;
  /// Unmutes senders that have become silent; call it some times a second.
  void look(std::chrono::nanoseconds now) noexcept;
  /// Number of senders muted now.
  [[nodiscard]] std::size_t muted() const noexcept { return muted_; }

 private:
  struct Source {
    IpEndpoint who;
    std::chrono::nanoseconds window{-1};  // begin of the window; < 0: free
    std::uint32_t count = 0;              // in the window
    bool muted = false;
    std::uint64_t dropped = 0;
  };
  // A known source, in its own entry.
  struct Known {
    Source source;
    std::uint32_t sharers = 1;  // known sources of its address
  };
  static constexpr std::size_t kWays = 4, kSets = 512, kSlots = 2 * KnownSources::kMost;

  [[nodiscard]] Source* find(const IpEndpoint& who, std::uint64_t hash,
                             std::chrono::nanoseconds received) noexcept;
  [[nodiscard]] Known* find_known(const IpEndpoint& who, std::uint64_t hash) noexcept;
  [[nodiscard]] Source take_out(const IpEndpoint& who) noexcept;
  void forget(Known& known) noexcept;
  [[nodiscard]] bool count(Source* source, std::chrono::nanoseconds received,
                           std::uint32_t most) noexcept;
  void turn(Source& source, std::chrono::nanoseconds received) noexcept;
  void report(Source& source, bool muted) noexcept;

  haptics::SpscRing<MutedSender>& out_;
  std::array<std::array<Source, kWays>, kSets> sources_{};
  std::array<Known, KnownSources::kMost> known_{};
  std::array<Known, KnownSources::kMost> before_{};  // used only by know()
  std::array<std::uint16_t, kSlots> slots_{};        // index in known_ + 1, by hash; 0: free
  std::size_t known_count_ = 0;
  std::size_t muted_ = 0;
};

}  // namespace reckon::peer
