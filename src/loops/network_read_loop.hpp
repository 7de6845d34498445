// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Takes datagrams off the link as they come, as far as the model loop has room for them: what it
// has not stays with the kernel. What is of no use, or of a sender that floods, is dropped before
// it takes room. Joins and leaves happen here too: a link has one reader.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "reckon/haptics/exchange/spsc_ring.hpp"
#include "reckon/haptics/exchange/triple_buffer.hpp"
#include "reckon/peer/counters/counters.hpp"
#include "reckon/peer/loops/datagram_gate.hpp"
#include "reckon/peer/loops/datagram_ring.hpp"
#include "reckon/peer/loops/sender_budget.hpp"
#include "reckon/peer/network/datagram_tap.hpp"
#include "reckon/peer/network/link.hpp"

namespace reckon::peer {

/// A group to join or leave, by order of the model loop.
struct GroupCommand {
  GroupAddress group;
  bool join = true;
};

/// A ring of its own for what comes in some groups, those behind the base of the pool.
struct FeltRing {
  GroupPool groups;
  DatagramRing& ring;
};

/// The loop. step() by one thread; allocates in joins alone. What has waited in the kernel for more
/// than kStale, as while this process stood still, is dropped and counted: newer states follow.
class NetworkReadLoop {
 public:
  static constexpr std::chrono::nanoseconds kStale = std::chrono::seconds(1);

  /// All references outlive the loop. The first group that it joins is the base group.
  /// @param exercise of which datagrams are taken; nothing: any octets are
  /// @param tap receives what it drops and why; may be null
  /// @param felt where those of contact groups go, so that none waits behind others; nothing: where
  /// all go. While one of the two rings is full nothing is taken.
  NetworkReadLoop(Link& link, haptics::SpscRing<GroupCommand>& commands, DatagramRing& out,
                  Counters& counters, std::optional<std::uint8_t> exercise = {},
                  DatagramTap* tap = nullptr, std::optional<FeltRing> felt = {});

  /// Carries out joins and leaves, then takes what has arrived until the ring is full. Returns
  /// datagrams put there: the model loop need not wake for others. A group that could not be joined
  /// is tried again each second, the base group first.
  std::size_t step(std::chrono::nanoseconds now) noexcept;
  /// Whether the last step ended for want of room: wait for the model loop, not for the link.
  [[nodiscard]] bool is_full() const noexcept { return full_; }
  /// Who was muted and who is heard again, oldest first; one reader thread.
  [[nodiscard]] haptics::SpscRing<MutedSender>& muted() noexcept { return muted_; }
  /// Where members speak from, published by the model loop whenever that changes; one writer
  /// thread.
  [[nodiscard]] haptics::TripleBuffer<KnownSources>& known() noexcept { return known_; }

 private:
  static constexpr std::size_t kBatch = 64;
  void obey(const GroupCommand& command) noexcept;
  void retry_joins(std::chrono::nanoseconds now) noexcept;
  void count_unjoined() noexcept;
  void drop(DatagramFate fate, const Datagram& datagram, Counter& counter) noexcept;
  [[nodiscard]] std::size_t room() const noexcept;
  [[nodiscard]] DatagramRing& ring_of(const GroupAddress& group) noexcept;
  bool take_datagram(const Datagram& datagram, std::chrono::nanoseconds now) noexcept;
  [[nodiscard]] bool is_wanted(const Datagram& datagram, std::chrono::nanoseconds came) noexcept;

  Link& link_;
  haptics::SpscRing<GroupCommand>& commands_;
  DatagramRing& out_;
  std::optional<std::uint8_t> exercise_;
  DatagramTap* tap_;
  std::optional<FeltRing> felt_;
  haptics::SpscRing<MutedSender> muted_{64};
  haptics::TripleBuffer<KnownSources> known_;
  SenderBudget budget_{muted_};
  bool pressed_ = false;  ///< less than half of the ring is free
  std::array<Datagram, kBatch> batch_{};
  bool full_ = false;
  std::optional<GroupAddress> base_;
  std::vector<GroupAddress> unjoined_;  ///< wanted, and refused by the link
  std::chrono::nanoseconds next_retry_{0};
  Counter& datagrams_;
  Counter& octets_;
  Counter& waits_;
  Counter& too_long_;
  Counter& muted_in_;
  std::array<Counter*, kRefusals> refused_;  ///< by Refusal; none of `none`
  Counter& join_errors_;
  Counter& groups_unjoined_;
  Counter& base_unjoined_;
  Counter& stale_;
};

}  // namespace reckon::peer
