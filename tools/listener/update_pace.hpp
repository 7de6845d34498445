// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// How much time lies between two updates of an entity whose timestamps and arrivals need not agree:
// streams of any make, replayed at any speed. What a sender's clock says of one that runs is
// peer::SenderClock.
#pragma once

#include <cstdint>

#include "reckon/tools/listener/fixed_octets.hpp"

namespace reckon::tools {

/// Time between two updates.
struct Interval {
  double seconds = 0;
  double noise = 0;        ///< [s]
  bool late = false;       ///< overtaken by the one before: not to be used
  bool duplicate = false;  ///< a copy of the one before
  bool set_back = false;   ///< the sender's clock was set back: nothing to compare
};

/// The pace of one entity's timestamps against its arrivals. One thread.
class UpdatePace {
 public:
  /// From the update before to one that arrives now: by timestamps where they run at about the
  /// pace of the arrivals (up to 100 times faster, as a replay does, 4 times slower), else by
  /// arrivals.
  /// @param passed between the two arrivals [s]
  [[nodiscard]] Interval interval(const FixedOctets& before, const FixedOctets& now,
                                  double passed) const noexcept;

  /// The update is used: it goes on from the one before.
  void advance(const FixedOctets& before, const FixedOctets& now, double passed) noexcept;
  /// The update is used, and nothing can be compared with what was before.
  void restart() noexcept { *this = {}; }
  /// The update was late.
  void note_late() noexcept { ++late_in_a_row_; }

 private:
  double stated_time_ = 0;          // passed by timestamps, where they went forward [s]
  double arrival_time_ = 0;         // and by arrivals meanwhile [s]
  std::uint8_t late_in_a_row_ = 0;  // timestamps in a row that lay before
};

}  // namespace reckon::tools
