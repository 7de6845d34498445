// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What a sender gives by the channel table: one multicast stream an entity, as rich as the receiver
// that asks for most wants it, of those that the sender knows.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "reckon/aoim/cells/position.hpp"
#include "reckon/aoim/interest/channel_table.hpp"
#include "reckon/aoim/interest/near_rows.hpp"

namespace reckon::aoim {

/// Where the receivers are. Tell all of them anew some times a second:
///
///   channels.clear();
///   for (const Seen& seen : entities_of_others) channels.add(seen.position, seen.stretch);
///   if (const Channel* channel = channels.of(mine)) least_gap = 1 / channel->active_hz;
///
/// One thread; allocates only where there are more receivers than ever before.
class ReceiverChannels {
 public:
  /// @throws std::invalid_argument as ChannelTable does.
  explicit ReceiverChannels(std::span<const Channel> channels) : table_(channels) {}

  void clear() noexcept { receivers_.clear(); }
  /// Somebody at this place [m, S] who senses; one that is not finite counts for nobody.
  /// @param stretch by which it counts distances as longer, to meet its budget; >= 1
  /// @param speed [m/s], >= 0, for served_row()
  void add(const Position& position, double stretch = 1.0, double speed = 0.0);
  [[nodiscard]] std::size_t size() const noexcept { return receivers_.size(); }

  /// The richest row that any of them asks for of an entity here; the last row where nobody is
  /// known, and null where all are beyond the last row. 2 ns a receiver.
  [[nodiscard]] const Channel* of(const Position& position) const noexcept;
  /// Of the rows that are not kept, numbered from 0, the nearest in which somebody may listen who
  /// hears an entity here, or will within kNearAhead: the last one where nobody is known. With
  /// groups for near rows it is of no use to say anything in the rows before it. 4 ns a receiver.
  /// @param ahead [m] by which the two may be nearer than they are here, beside what the receiver
  /// itself moves within kNearAhead; >= 0
  [[nodiscard]] std::size_t served_row(const Position& position, double ahead) const noexcept;
  /// How far [m] the nearest of them is; infinite where there is none.
  [[nodiscard]] double nearest(const Position& position) const noexcept;
  /// See ChannelTable::fit: of a receiver itself.
  [[nodiscard]] ChannelBudget fit(std::span<const ChannelClient> clients, double octets) {
    return table_.fit(clients, octets);
  }
  [[nodiscard]] const ChannelTable& table() const noexcept { return table_; }

 private:
  struct Receiver {
    Position position;
    double stretch_squared = 1.0;
    double speed = 0.0;
  };
  struct Nearest {
    double squared, stretched_squared;
  };
  [[nodiscard]] Nearest find(const Position& position) const noexcept;

  ChannelTable table_;
  std::vector<Receiver> receivers_;
};

}  // namespace reckon::aoim
