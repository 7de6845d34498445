// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Reports to the user why bodies rest or have another owner. Hand-overs are only counted.
#pragma once

#include <chrono>

#include "reckon/haptics/exchange/spsc_ring.hpp"
#include "reckon/peer/loops/notice.hpp"
#include "reckon/peer/loops/notice_condition.hpp"
#include "reckon/peer/ownership/ownership.hpp"

namespace reckon::peer {

/// One thread; no allocation.
class OwnershipWatch {
 public:
  using Nanoseconds = std::chrono::nanoseconds;

  /// @param out outlives this
  explicit OwnershipWatch(haptics::SpscRing<Notice>& out) : out_(out) {}

  void note(const OwnershipEvent& event) noexcept;
  /// Call it in each pass.
  void look(const Ownership& protocol, Nanoseconds now) noexcept;
  /// Whether this peer waits for others that own or may own bodies.
  [[nodiscard]] bool rests() const noexcept { return rests_; }

 private:
  haptics::SpscRing<Notice>& out_;
  NoticeCondition condition_;
  Nanoseconds leased_{-1};  // last time with a lease, or without a world
  bool rests_ = false;
};

}  // namespace reckon::peer
