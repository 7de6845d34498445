// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// How many datagrams one sender may have read: one that floods is muted, so that the others are
// heard. By the source address, which a hostile host may forge. Who is a member has a share of its
// own, which no other process of its host can use up.
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

/// Where members speak from: lives that announced themselves and are heard.
struct KnownSources {
  static constexpr std::size_t kMost = 1024;
  std::array<IpEndpoint, kMost> sources{};  ///< ascending, none twice
  std::size_t count = 0;

  [[nodiscard]] std::span<const IpEndpoint> all() const noexcept {
    return std::span(sources).first(count);
  }
};

/// Counts the datagrams of each source, address and port, and of each address, in windows of
/// 100 ms. Who sends more than the limits is muted, until a window of its has less than
/// kCalm. One thread, fixed memory, no allocation; about 20 ns a datagram.
///
/// A known source has a share of its own beside what its address may send: as much as the address,
/// divided by the known sources of that address. What it sends within its share is read even where
/// the rest of its host is muted. All of an address are thus read at most twice what it may send.
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

  /// @param out receives who is muted and heard again; outlives this
  explicit SenderBudget(haptics::SpscRing<MutedSender>& out) noexcept : out_(out) {}

  /// Whether a datagram is to be read. @param received when the link had it, steady time
  /// @param pressed whether little room is left for what is read
  [[nodiscard]] bool admit(const IpEndpoint& sender, std::chrono::nanoseconds received,
                           bool pressed) noexcept;
  /// These are known from now on, in the place of those before. Linear in them; call it when they
  /// change.
  void know(const KnownSources& known) noexcept;
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
  // A known source, in a place that nobody takes from it.
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
  void tell(Source& source, bool muted) noexcept;

  haptics::SpscRing<MutedSender>& out_;
  std::array<std::array<Source, kWays>, kSets> sources_{};
  std::array<Known, KnownSources::kMost> known_{};
  std::array<Known, KnownSources::kMost> before_{};  // of know() alone
  std::array<std::uint16_t, kSlots> slots_{};        // place in known_ + 1, by hash; 0: free
  std::size_t known_count_ = 0;
  std::size_t muted_ = 0;
};

}  // namespace reckon::peer
