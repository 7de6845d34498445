// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Reports to the user when datagrams of other peers are lost.
#pragma once

#include <chrono>
#include <cstdint>

#include "reckon/aoim/groups/sequence_tracker.hpp"
#include "reckon/haptics/exchange/spsc_ring.hpp"
#include "reckon/peer/loops/notice.hpp"

namespace reckon::peer {

/// Evaluates the losses of each kWindow, and reports a share above kShare, at most once in kQuiet.
/// One thread; no allocation.
class LossWatch {
 public:
  using Nanoseconds = std::chrono::nanoseconds;
  static constexpr Nanoseconds kWindow = std::chrono::seconds(10);
  static constexpr Nanoseconds kQuiet = std::chrono::minutes(1);
  static constexpr double kShare = 0.05;
  /// With fewer lost datagrams in a window, the share is not evaluated.
  static constexpr std::uint64_t kLeast = 10;

  /// Call it some times a second.  @param counts of all senders  @param out receives notices
  void look(const aoim::SequenceCounts& counts, Nanoseconds now,
            haptics::SpscRing<Notice>& out) noexcept;

 private:
  Nanoseconds window_{-1}, reported_ = Nanoseconds::min() / 2;
  std::uint64_t received_ = 0, lost_ = 0;  // at the begin of the window
};

}  // namespace reckon::peer
