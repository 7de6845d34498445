// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// When to look again whether what is shown is still within sight: its owner says nothing because we
// went away, and one that stands is owed silence for minutes.
#pragma once

#include <chrono>
#include <cstddef>

#include "reckon/peer/world/due_column.hpp"

namespace reckon::peer {

/// What a look at a shown row finds.
struct Sight {
  double spare = 0.0;  ///< [m] that it and we may go apart before it is out of sight; <= 0: it is
  double speed = 0.0;  ///< its own [m/s], 0 where it stands
};

/// Beside the rows of a StateTable, 16 octets each. Each row is due by the way that we withdraw
/// (AreaOfInterestManager::withdrawn), and one that moves by time, too: what stands costs nothing
/// while we do. One thread; allocates at construction alone. An update costs some ns.
class SightWatch {
 public:
  using Nanoseconds = std::chrono::nanoseconds;
  /// What moves is looked at again after so long at the earliest and at the latest.
  static constexpr Nanoseconds kSoonest = std::chrono::milliseconds(100);
  static constexpr Nanoseconds kLatest = std::chrono::seconds(1);
  /// [m/s] by which something may be faster than it says before it is late.
  static constexpr double kSpareSpeed = 2.0;
  /// Looks in one pass at most; the others come with the next.
  static constexpr std::size_t kMostLooks = 4096;

  /// @param capacity rows of the table
  explicit SightWatch(std::size_t capacity) : by_way_(capacity), by_time_(capacity) {}

  /// A row was added at the end.
  void push();
  /// The last row goes to `place`.
  void erase(std::size_t place) noexcept;
  /// Has what note_update(place) writes brought near.
  void prefetch(std::size_t place) const noexcept {
    by_way_.prefetch(place);
    by_time_.prefetch(place);
  }
  /// An update has found the row within sight, by `spare` [m] at least. @param withdrawn [m] by now
  void note_update(std::size_t place, double withdrawn, double spare, bool moves,
                   Nanoseconds now) noexcept;

  /// Asks `look(place)`, a Sight, of the rows that may be out of sight, and calls leave(place) for
  /// each that is, which drops it. @param withdrawn [m] by now  @param step [m] of way that is
  /// worth another look, > 0
  template <typename Look, typename Leave>
  void look(Nanoseconds now, double withdrawn, double step, Look&& look, Leave&& leave) {
    std::size_t looks = 0;
    const auto pass = [&](DueColumn& column, Nanoseconds until) {
      for (std::size_t i = column.next_due(until, 0); i < column.size() && looks < kMostLooks;
           i = column.next_due(until, i)) {
        ++looks;
        const Sight sight = look(i);
        if (sight.spare > 0.0) {
          set(i, withdrawn, step, sight, now);
        } else {
          leave(i);
        }
      }
    };
    pass(by_way_, of_way(withdrawn));
    pass(by_time_, now);
  }

 private:
  /// A way as DueColumn has it: a nanosecond a millimetre.
  [[nodiscard]] static Nanoseconds of_way(double metres) noexcept;
  void set(std::size_t place, double withdrawn, double step, const Sight& sight,
           Nanoseconds now) noexcept;

  DueColumn by_way_;
  DueColumn by_time_;
};

}  // namespace reckon::peer
