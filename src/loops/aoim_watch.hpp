// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Reports to the user what the area-of-interest layer excludes: each condition once when it begins
// and once when it ends.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>

#include "reckon/aoim/area_of_interest_manager.hpp"
#include "reckon/haptics/exchange/spsc_ring.hpp"
#include "reckon/peer/counters/counters.hpp"
#include "reckon/peer/loops/notice.hpp"
#include "reckon/peer/loops/notice_condition.hpp"
#include "reckon/peer/scene/scene_file.hpp"

namespace reckon::peer {

/// Watches the counts of one manager. One thread; allocates only at set-up.
class AoimWatch {
 public:
  /// Makes the counters updates_refused, peers_not_joined and entities_outside. `scene` and
  /// `counters` outlive it.
  AoimWatch(const SceneFile& scene, Counters& counters);

  /// Call it after each listen() of the manager for the cells, with its result. Notices are added
  /// to `out`.
  void look(aoim::AreaOfInterestManager& aoim, const aoim::SubscriptionChange& change,
            std::chrono::nanoseconds now, haptics::SpscRing<Notice>& out) noexcept;

 private:
  using Nanoseconds = std::chrono::nanoseconds;
  void report_cap(const aoim::SubscriptionChange& change) noexcept;
  void report_full(const aoim::Presence& presence) noexcept;
  void report_given_up(const aoim::SequenceTracker& sequences) noexcept;
  void report_outside(aoim::AreaOfInterestManager& aoim) noexcept;
  template <typename... Arguments>
  void report(NoticeKind kind, const char* format, const Arguments&... arguments) noexcept;
  template <typename... Arguments>
  void end(NoticeKind kind, const char* format, const Arguments&... arguments) noexcept;

  const SceneFile& scene_;
  Counter& updates_refused_;
  Counter& peers_not_joined_;
  Counter& entities_outside_;

  Nanoseconds now_{0};
  haptics::SpscRing<Notice>* out_ = nullptr;  // during look
  NoticeCondition capped_, full_, given_up_;
  std::uint64_t given_up_before_ = 0;
  bool begun_ = false;
  Nanoseconds window_end_{0};          // end of the window in which entities are counted
  aoim::InterestCounts at_begin_;      // at the begin of that window
  std::size_t peers_at_begin_ = 0;     // at the begin of that window
  bool all_outside_reported_ = false;  // and none has come inside since
};

}  // namespace reckon::peer
