// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Sending rate and content by the channel table: one multicast stream for each entity, as rich as
// its most demanding known receiver needs.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "reckon/aoim/cells/position.hpp"
#include "reckon/aoim/interest/channel_table.hpp"
#include "reckon/aoim/interest/near_rows.hpp"

namespace reckon::aoim {

/// Positions of the receivers. Set all of them again several times a second:
///
///   channels.clear();
///   for (const Seen& seen : entities_of_others) channels.add(seen.position, seen.stretch);
///   if (const Channel* channel = channels.of(mine)) least_gap = 1 / channel->active_hz;
///
/// One thread; allocates only if there are more receivers than ever before.
class ReceiverChannels {
 public:
  /// @throws std::invalid_argument from ChannelTable.
  explicit ReceiverChannels(std::span<const Channel> channels) : table_(channels) {}

  void clear() noexcept { receivers_.clear(); }
  /// Adds a sensing receiver at this place [m, S]; a place that is not finite is ignored.
  /// @param stretch its factor on distances, to meet its budget; >= 1
  /// @param speed [m/s], >= 0, for served_row()
  void add(const Position& position, double stretch = 1.0, double speed = 0.0) {
    if (!is_finite(position) || !(stretch >= 1.0)) return;
    receivers_.push_back({position, stretch * stretch, speed >= 0.0 ? speed : 0.0});
  }
  [[nodiscard]] std::size_t size() const noexcept { return receivers_.size(); }

  /// The richest row that any receiver needs of an entity here; the last row if no receiver is
  /// known; null if all are beyond the last row. 2 ns a receiver.
  [[nodiscard]] const Channel* of(const Position& position) const noexcept {
    if (receivers_.empty()) return &table_.channel(table_.size() - 1);
    const Nearest nearest = find(position);
    const std::size_t plain = table_.row(std::sqrt(nearest.squared));
    const bool is_kept = plain < table_.size() && table_.channel(plain).kept;
    const std::size_t row = is_kept ? plain : table_.row(std::sqrt(nearest.stretched_squared));
    return row < table_.size() ? &table_.channel(row) : nullptr;
  }
  /// Number of the nearest row (without the kept ones, from 0) with a possible listener to an
  /// entity here, now or within kNearAhead; the last one if no receiver is known. If the inner rows
  /// have tiers, the ones before it need no updates. 4 ns a receiver.
  /// @param speed of the entity [m/s], >= 0
  /// @param slack [m] by which the two may be closer than the positions show; >= 0
  [[nodiscard]] std::size_t served_row(const Position& position, double speed,
                                       double slack) const noexcept {
    const double ahead = kNearAhead * speed + slack;
    double nearest = kNobody;
    for (const Receiver& receiver : receivers_) {
      const double least = ahead + kNearAhead * receiver.speed;
      const double away = std::max(0.0, distance(receiver.position, position) - least);
      nearest = std::min(nearest, away * std::sqrt(receiver.stretch_squared) / kNearLeave);
    }
    const std::size_t row = std::min(table_.row(nearest), table_.size() - 1);
    return row > table_.kept_rows() ? row - table_.kept_rows() : 0;
  }
  /// Distance [m] of the nearest receiver; infinite if there is none.
  [[nodiscard]] double nearest(const Position& position) const noexcept {
    return std::sqrt(find(position).squared);
  }
  /// For this peer as a receiver, see ChannelTable::fit.
  [[nodiscard]] ChannelBudget fit(std::span<const ChannelClient> clients, double octets) {
    return table_.fit(clients, octets);
  }
  [[nodiscard]] const ChannelTable& table() const noexcept { return table_; }

 private:
  static constexpr double kNobody = std::numeric_limits<double>::infinity();

  struct Receiver {
    Position position;
    double stretch_squared = 1.0;
    double speed = 0.0;
  };
  struct Nearest {
    double squared, stretched_squared;
  };
  [[nodiscard]] Nearest find(const Position& position) const noexcept {
    Nearest nearest{kNobody, kNobody};
    for (const Receiver& receiver : receivers_) {
      const double x = receiver.position.x - position.x, y = receiver.position.y - position.y,
                   z = receiver.position.z - position.z;
      const double squared = x * x + y * y + z * z;
      nearest.squared = std::min(nearest.squared, squared);
      nearest.stretched_squared =
          std::min(nearest.stretched_squared, squared * receiver.stretch_squared);
    }
    return nearest;
  }

  ChannelTable table_;
  std::vector<Receiver> receivers_;
};

}  // namespace reckon::aoim
