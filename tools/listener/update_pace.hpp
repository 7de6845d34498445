// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Time between two updates of an entity whose timestamps and arrivals may disagree: streams of any
// origin, replayed at any speed. peer::SenderClock is for a sender's running clock.
#pragma once

#include <cstdint>

#include "reckon/tools/listener/fixed_octets.hpp"

namespace reckon::tools {

/// Time between two updates.
struct Interval {
  double seconds = 0;
  double noise = 0;        ///< [s]
  bool late = false;       ///< overtaken by the one before: unusable
  bool duplicate = false;  ///< a copy of the one before
  bool set_back = false;   ///< the sender's clock was set back: no comparison
};

/// Compares one entity's timestamps with its arrivals. One thread.
class UpdatePace {
 public:
  /// Interval from the update before to the one that arrives now: by timestamps if they run at
  /// about the pace of the arrivals (up to 100 times faster, as in a replay, or 4 times slower),
  /// else by arrivals.
  /// @param passed between the two arrivals [s]
  [[nodiscard]] Interval interval(const FixedOctets& before, const FixedOctets& now,
                                  double passed) const noexcept;

  /// The update is used, as a continuation of the one before.
  void advance(const FixedOctets& before, const FixedOctets& now, double passed) noexcept;
  /// The update is used, and no comparison with earlier ones is possible.
  void restart() noexcept { *this = {}; }
  /// Counts a late update.
  void note_late() noexcept { ++late_in_a_row_; }

 private:
  double stated_time_ = 0;          // elapsed by timestamps, if they advanced [s]
  double arrival_time_ = 0;         // elapsed by arrivals in the same updates [s]
  std::uint8_t late_in_a_row_ = 0;  // consecutive earlier timestamps
};

}  // namespace reckon::tools
