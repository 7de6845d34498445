// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Reports the condition of a peer's link to the user: interfaces that appear and disappear, groups
// that cannot be joined, failed sends, datagrams dropped by the kernel.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "reckon/haptics/exchange/spsc_ring.hpp"
#include "reckon/peer/counters/counters.hpp"
#include "reckon/peer/loops/notice.hpp"
#include "reckon/peer/loops/notice_condition.hpp"
#include "reckon/peer/network/link.hpp"

namespace reckon::peer {

/// Watches one link. One thread; allocates only at set-up.
class LinkWatch {
 public:
  /// `link` and `counters` outlive it; it watches base_unjoined and groups_unjoined.
  /// @param longest_bundle in the scene [octets]
  LinkWatch(Link& link, const GroupAddress& base, std::size_t longest_bundle, Counters& counters);

  /// Call it some times a second. Each problem is reported with its remedy when it begins, and
  /// again when it is over. Notices are added to `out`.
  void look(std::chrono::nanoseconds now, haptics::SpscRing<Notice>& out) noexcept;
  /// Present source address of sent datagrams.
  [[nodiscard]] IpEndpoint own_endpoint() const noexcept { return link_.local_endpoint(); }

 private:
  void report_payload() noexcept;
  void report_base(bool is_deaf) noexcept;
  void report_groups(std::uint64_t count) noexcept;
  void report_sends() noexcept;
  void report_drops() noexcept;
  template <typename... Arguments>
  void report(NoticeKind kind, const char* format, const Arguments&... arguments) noexcept;
  template <typename... Arguments>
  void end(NoticeKind kind, const char* format, const Arguments&... arguments) noexcept;

  Link& link_;
  std::array<char, 64> base_{};  ///< "239.192.1.0:3000"
  std::size_t longest_bundle_;   ///< 0 after its comparison
  const Counter& base_unjoined_;
  const Counter& groups_unjoined_;
  LinkStatistics before_, at_;  ///< in the last call, and in this one
  std::chrono::nanoseconds now_{0};
  haptics::SpscRing<Notice>* out_ = nullptr;  // during look
  // The first failed send: its time, and the number of datagrams sent by the end of that call.
  struct Refusal {
    std::chrono::nanoseconds since;
    std::uint64_t sent;
    bool reported;
  };
  std::optional<Refusal> refusal_;
  bool any_unjoined_ = false;  ///< in the last call, other than the base group
  NoticeCondition deaf_, unjoined_, unsent_, held_, dropped_;
};

}  // namespace reckon::peer
