// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Schedules checks whether shown entities are still within sight. They are needed because an owner
// sends nothing to us after we have moved away, and a resting entity may be silent for minutes.
#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>

#include "reckon/pdu/seconds.hpp"
#include "reckon/peer/world/due_column.hpp"

namespace reckon::peer {

/// Result of the check of a shown row.
struct Sight {
  double spare = 0.0;  ///< [m] by which we may separate before it is out of sight; <= 0: out of
                       ///< sight
  double speed = 0.0;  ///< its own [m/s], 0 at rest
};

/// Parallel to the rows of a StateTable, 16 octets each. A row is due by the distance that we
/// withdraw (AreaOfInterestManager::withdrawn), and a moving one by time, too: a resting entity
/// costs nothing while we rest. One thread; allocates only at construction. An update costs some
/// ns.
class SightWatch {
 public:
  using Nanoseconds = std::chrono::nanoseconds;
  /// Least and longest time before a moving entity is checked again.
  static constexpr Nanoseconds kSoonest = std::chrono::milliseconds(100);
  static constexpr Nanoseconds kLatest = std::chrono::seconds(1);
  /// [m/s] by which an entity may exceed its stated speed before a check is late.
  static constexpr double kSpareSpeed = 2.0;
  /// Most checks in one pass; the others come with the next.
  static constexpr std::size_t kMostLooks = 4096;

  /// @param capacity rows of the table
  explicit SightWatch(std::size_t capacity) : by_way_(capacity), by_time_(capacity) {}

  /// Adds a row at the end.
  void push() {
    by_way_.push(std::chrono::nanoseconds(0));
    by_time_.push(std::chrono::nanoseconds::max());
  }
  /// Moves the last row to `place`.
  void erase(std::size_t place) noexcept {
    by_way_.erase(place);
    by_time_.erase(place);
  }
  /// Prefetches the memory that note_update(place) writes.
  void prefetch(std::size_t place) const noexcept {
    by_way_.prefetch(place);
    by_time_.prefetch(place);
  }
  /// Records that an update has found the row within sight, by at least `spare` [m].
  /// @param withdrawn [m] by now
  void note_update(std::size_t place, double withdrawn, double spare, bool moves,
                   std::chrono::nanoseconds now) noexcept {
    // a row that lacks less than a millimetre is still within sight
    by_way_.set(place, of_way(withdrawn + spare) + std::chrono::nanoseconds(1));
    by_time_.set(place, moves ? now + kLatest : std::chrono::nanoseconds::max());
  }

  /// Calls `look(place)`, which returns a Sight, for the rows that may be out of sight. Calls
  /// leave(place) for each row out of sight; it must drop the row. @param withdrawn [m] by now
  /// @param step [m] of distance that justifies another check, > 0
  void look(Nanoseconds now, double withdrawn, double step, auto&& look, auto&& leave) {
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
  /// A distance in the unit of DueColumn: a nanosecond a millimetre.
  [[nodiscard]] static Nanoseconds of_way(double metres) noexcept {
    constexpr double kMost = 9e15;  // [mm] in 63 bits, with a margin of a thousand
    return std::chrono::nanoseconds(
        static_cast<std::int64_t>(std::floor(std::min(1000.0 * metres, kMost))));
  }
  void set(std::size_t place, double withdrawn, double step, const Sight& sight,
           std::chrono::nanoseconds now) noexcept {
    by_way_.set(place,
                of_way(withdrawn + std::max(sight.spare, step)) + std::chrono::nanoseconds(1));
    if (!(sight.speed > 0.0)) return by_time_.set(place, std::chrono::nanoseconds::max());
    const double least = pdu::to_seconds(kSoonest), most = pdu::to_seconds(kLatest);
    const double calm = std::clamp(sight.spare / (sight.speed + kSpareSpeed), least, most);
    by_time_.set(place, now + pdu::from_seconds(calm));
  }

  DueColumn by_way_;
  DueColumn by_time_;
};

}  // namespace reckon::peer
