// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Recently joined groups: datagrams from before the join are not accepted.
#pragma once

#include <algorithm>
#include <chrono>
#include <vector>

#include "reckon/peer/network/link.hpp"
#include "reckon/peer/sealing/sender_time.hpp"

namespace reckon::peer {

/// Joins of the last two seconds. One thread; note() alone allocates.
class RecentJoins {
 public:
  void note(const GroupAddress& group, std::chrono::nanoseconds now) {
    const auto place = find(group);
    if (place != joins_.end() && place->group == group) {
      place->since = now;
    } else {
      joins_.insert(place, {group, now});
    }
  }

  /// When the group was joined; the earliest time if that is longer ago than the age of any
  /// accepted datagram.
  [[nodiscard]] std::chrono::nanoseconds since(const GroupAddress& group) noexcept {
    if (joins_.empty()) return std::chrono::nanoseconds::min();
    const auto place = find(group);
    return place != joins_.end() && place->group == group ? place->since
                                                          : std::chrono::nanoseconds::min();
  }

  void forget_old(std::chrono::nanoseconds now) noexcept {
    std::erase_if(joins_, [&](const Join& join) { return now - join.since > kKept; });
  }

 private:
  static constexpr std::chrono::nanoseconds kKept = 2 * SenderTime::kOldest;
  struct Join {
    GroupAddress group;
    std::chrono::nanoseconds since;
  };
  [[nodiscard]] std::vector<Join>::iterator find(const GroupAddress& group) noexcept {
    return std::ranges::lower_bound(joins_, group, {}, &Join::group);
  }

  std::vector<Join> joins_;  // sorted
};

}  // namespace reckon::peer
