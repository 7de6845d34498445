// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Reads datagrams from the link as they arrive, as long as the model loop's ring has room; the rest
// stays in the kernel. Useless datagrams and datagrams of flooding senders are dropped before they
// are queued. Joins and leaves are also executed here, because a link has one reader.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "reckon/haptics/exchange/spsc_ring.hpp"
#include "reckon/haptics/exchange/triple_buffer.hpp"
#include "reckon/peer/counters/counters.hpp"
#include "reckon/peer/loops/datagram_gate.hpp"
#include "reckon/peer/loops/datagram_ring.hpp"
#include "reckon/peer/loops/felt_sources.hpp"
#include "reckon/peer/loops/refused_senders.hpp"
#include "reckon/peer/loops/sender_budget.hpp"
#include "reckon/peer/network/datagram_tap.hpp"
#include "reckon/peer/network/link.hpp"

namespace reckon::peer {

/// A group to join or leave, ordered by the model loop.
struct GroupCommand {
  GroupAddress group;
  bool join = true;
};

/// A separate ring for the datagrams of some groups, those after the pool's base.
struct UrgentRing {
  GroupPool groups;
  DatagramRing& ring;
};

/// The loop. One thread calls step(); only joins allocate. Datagrams that have waited in the kernel
/// for more than kStale, for example while this process was suspended, are dropped and counted:
/// newer states follow.
class NetworkReadLoop {
 public:
  static constexpr std::chrono::nanoseconds kStale = std::chrono::seconds(1);

  /// All references outlive the loop. The first group that it joins is the base group.
  /// @param exercise of accepted datagrams; nothing: any octets are accepted
  /// @param lenient takes a PDU with length field 0 as the rest of its datagram
  /// @param tap receives dropped datagrams with the reason; may be null
  /// @param urgent separate ring for the groups of an urgent tier, so that their datagrams do not
  /// wait behind others; nothing: all use one ring. While either ring is full nothing is read.
  NetworkReadLoop(Link& link, haptics::SpscRing<GroupCommand>& commands, DatagramRing& out,
                  Counters& counters, std::optional<std::uint8_t> exercise = {},
                  bool lenient = false, DatagramTap* tap = nullptr,
                  std::optional<UrgentRing> urgent = {});

  /// Executes joins and leaves, then reads arrived datagrams until the ring is full. Returns the
  /// number of queued ones: the model loop must wake only for these. A failed join is retried each
  /// second, the base group first.
  std::size_t step(std::chrono::nanoseconds now) noexcept;
  /// Whether the last step ended because the ring was full: then wait for the model loop, not for
  /// the link.
  [[nodiscard]] bool is_full() const noexcept { return full_; }
  /// Whether the last step read a datagram whose delay can be felt.
  [[nodiscard]] bool has_taken_felt() const noexcept { return taken_felt_; }
  /// Senders that were muted or unmuted, oldest first; one reader thread.
  [[nodiscard]] haptics::SpscRing<MutedSender>& muted() noexcept { return muted_; }
  /// Senders whose datagrams are refused at once; one reader thread.
  [[nodiscard]] haptics::SpscRing<RefusedSender>& refused() noexcept { return refused_out_; }
  /// Source addresses of members, published by the model loop when they change; one writer thread.
  [[nodiscard]] haptics::TripleBuffer<KnownSources>& known() noexcept { return known_; }
  /// Sources of felt bodies; one writer thread.
  [[nodiscard]] haptics::TripleBuffer<FeltSources>& felt() noexcept { return felt_; }

 private:
  static constexpr std::size_t kBatch = 64;
  void obey(const GroupCommand& command) noexcept;
  void retry_joins(std::chrono::nanoseconds now) noexcept;
  void count_unjoined() noexcept;
  void drop(DatagramFate fate, const Datagram& datagram, Counter& counter) noexcept;
  [[nodiscard]] std::size_t room() const noexcept;
  [[nodiscard]] DatagramRing& ring_of(const GroupAddress& group) noexcept;
  bool take_datagram(const Datagram& datagram, std::chrono::nanoseconds now) noexcept;
  [[nodiscard]] std::span<const std::byte> mended(std::span<const std::byte> bytes) noexcept;
  [[nodiscard]] bool is_wanted(const Datagram& datagram, std::chrono::nanoseconds came) noexcept;

  Link& link_;
  haptics::SpscRing<GroupCommand>& commands_;
  DatagramRing& out_;
  std::optional<std::uint8_t> exercise_;
  bool lenient_;
  std::vector<std::byte> mended_;  ///< the present datagram with a corrected length field, if that
                                   ///< was 0
  DatagramTap* tap_;
  std::optional<UrgentRing> urgent_;
  haptics::SpscRing<MutedSender> muted_{64};
  haptics::TripleBuffer<KnownSources> known_;
  haptics::TripleBuffer<FeltSources> felt_;
  SenderBudget budget_{muted_};
  haptics::SpscRing<RefusedSender> refused_out_{64};
  RefusedSenders refused_senders_{refused_out_};
  bool pressed_ = false;  ///< less than half of the ring is free
  std::array<Datagram, kBatch> batch_{};
  bool full_ = false;
  bool taken_felt_ = false;
  std::optional<GroupAddress> base_;
  std::vector<GroupAddress> unjoined_;  ///< requested, but refused by the link
  std::chrono::nanoseconds next_retry_{0};
  Counter& datagrams_;
  Counter& octets_;
  Counter& waits_;
  Counter& too_long_;
  Counter& muted_in_;
  std::array<Counter*, kRefusals> refused_;  ///< by Refusal; none for `none`
  Counter& join_errors_;
  Counter& groups_unjoined_;
  Counter& base_unjoined_;
  Counter& stale_;
};

}  // namespace reckon::peer
