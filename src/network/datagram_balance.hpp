// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The balance of one peer: the fate of each datagram that it numbered or received, by sender and
// group. It has to satisfy equations without any tolerance; see docs/robustness.md.
#pragma once

#include <array>
#include <chrono>
#include <compare>
#include <cstdint>
#include <map>
#include <vector>

#include "reckon/peer/network/datagram_tap.hpp"

namespace reckon::peer {

/// One epoch of a sender in one group, or one stream of its envelopes there.
struct SenderInGroup {
  std::uint64_t epoch = 0;  ///< as in DatagramEvent; 0: of datagrams without a number
  std::uint8_t stream = 0;
  GroupAddress group;
  auto operator<=>(const SenderInGroup&) const = default;
};

/// Datagrams of one sender in one group, by fate, since the last report.
struct FateCounts {
  SenderInGroup key;
  std::array<std::uint64_t, kFates> counts{};
};

/// The numbers of one sender in one group that arrived while this peer was a member. From the
/// smallest to the largest, last - first + 1 = arrived + missing.
struct Stretch {
  SenderInGroup key;
  std::uint32_t first = 0, last = 0;
  std::uint64_t arrived = 0;  ///< distinct numbers
  /// Lost on the way, dropped by the kernel, or never sent. Envelopes are numbered over all groups,
  /// so envelopes to other groups count here too.
  std::uint64_t missing = 0;
  std::uint64_t copies = 0;  ///< of arrived numbers
  /// When the group was joined, from its Membership; negative for a list, which is not joined.
  std::chrono::nanoseconds joined{-1};
};

/// The same as counted by the sequence tracker, for datagrams from peers that are known at that
/// time: last - first + 1 = received + lost. A new stretch begins when the tracker starts again.
struct TrackedStretch {
  SenderInGroup key;
  std::uint32_t first = 0, last = 0;
  std::uint64_t received = 0;
  std::int64_t lost = 0;  ///< by the tracker
};

/// The socket of a group, from joining to leaving.
struct Membership {
  GroupAddress group;
  /// When the kernel was asked, and when it had finished; that takes long while the interfaces of
  /// any namespace change. Negative: not left.
  std::chrono::nanoseconds joining{0}, joined{0}, leaving{-1}, left{-1};
  std::uint64_t kernel_drops = 0;  ///< a run that the kernel held as one counts once
};

/// News since the last report: counts, and finished stretches and memberships. Sums of reports are
/// totals.
struct BalanceReport {
  std::vector<FateCounts> fates;
  std::vector<Stretch> stretches;
  std::vector<TrackedStretch> tracked;
  std::vector<Membership> memberships;
  std::uint64_t missed = 0;  ///< events lost since the start: if any, the sums are wrong
};

/// Adds up the events of one tap. One thread; allocates. Memory grows with the number of senders
/// received: a stretch ends and is reported when its sender was silent for kSilence.
class DatagramBalance {
 public:
  static constexpr std::chrono::nanoseconds kSilence = std::chrono::minutes(5);

  explicit DatagramBalance(DatagramTap& tap) : tap_(tap) {}

  /// Takes the events since the last call, at most as many as any peer produces in a second. Call
  /// it every 100 ms.
  void look();
  /// @param end true: the last report, with unfinished stretches too
  [[nodiscard]] BalanceReport report(std::chrono::nanoseconds now, bool end);

  /// Takes one event; look() calls it.
  void take(const DatagramEvent& event);

 private:
  /// Numbers between the first and the last of a stretch that did not arrive.
  struct Gap {
    std::uint32_t first = 0, last = 0;
  };
  struct OpenStretch {
    Stretch stretch;
    std::vector<Gap> gaps;  ///< ascending
    bool heard = true;      ///< received since the last report
    std::chrono::nanoseconds silent_since{0};
  };
  struct OpenTracked {
    TrackedStretch stretch;
    std::uint32_t leapt_to = 0;  ///< a number that the tracker does not believe yet
    bool has_leapt = false;
    bool heard = true;
    std::chrono::nanoseconds silent_since{0};
  };
  void arrive(const DatagramEvent& event);
  static bool fill_gap(OpenStretch& stretch, std::uint32_t number);
  void end_stretches(const GroupAddress& group);
  void track(const DatagramEvent& event);
  void end_membership(const DatagramEvent& end);
  template <class Open, class Over>
  static void end_silent(std::map<SenderInGroup, Open>& open, std::vector<Over>& over,
                         std::chrono::nanoseconds now, bool end);

  DatagramTap& tap_;
  std::map<SenderInGroup, FateCounts> fates_;
  std::map<SenderInGroup, OpenStretch> open_;
  std::map<SenderInGroup, OpenTracked> tracked_;
  std::map<GroupAddress, Membership> memberships_;
  BalanceReport over_;  ///< finished since the last report
};

}  // namespace reckon::peer
