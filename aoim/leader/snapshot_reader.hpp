// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What a newcomer still lacks of the snapshots of the cells that it has entered.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "reckon/aoim/leader/leader_config.hpp"
#include "reckon/pdu/reckon/cell_roles.hpp"
#include "reckon/pdu/reckon/cell_snapshot.hpp"

namespace reckon::aoim {

/// One thread; allocates when a cell is new.
class SnapshotReader {
 public:
  explicit SnapshotReader(const LeaderConfig& config) : config_(config) {}

  /// We have joined this cell and know nothing of it.
  void begin(CellId cell, std::chrono::nanoseconds now);
  /// We have left it, or lead it: nobody could tell us.
  void drop(CellId cell);
  /// Who could tell us is gone: take_given_up() names it, where anything of it is lacking.
  void give_up(CellId cell, std::chrono::nanoseconds now) noexcept;
  /// A part from the leader of its cell: true where it is new and asked for, so that its states are
  /// to be used. @param leader life that sent it
  bool receive(const pdu::CellSnapshot& part, std::uint32_t leader, std::chrono::nanoseconds now);

  /// Calls say(CellId) for each cell whose leader is to be asked now.
  template <typename Say>
  void for_each_due(std::chrono::nanoseconds now, Say&& say) const {
    for (const Reading& reading : readings_) {
      if (now >= reading.next_ask) say(reading.cell);
    }
  }
  /// Fills in what is lacking of the role's cell, if anything and if it is time to ask: the first
  /// 64 parts from `from` on. The next place to look from; 0 where there is no more to ask.
  std::size_t fill(pdu::CellRole& role, std::size_t from, std::chrono::nanoseconds now);
  /// A cell of which nobody has sent us all in time, which is given up; false where there is none.
  bool take_given_up(std::chrono::nanoseconds now, CellId& cell);
  /// Whether something of this cell is still lacking.
  [[nodiscard]] bool reads(CellId cell) const noexcept;
  [[nodiscard]] std::chrono::nanoseconds next_step() const noexcept;

 private:
  using Nanoseconds = std::chrono::nanoseconds;
  struct Reading {
    CellId cell;
    Nanoseconds since{}, next_ask{};
    std::uint32_t leader = 0;
    std::uint16_t serial = 0;
    std::vector<bool> got;
    std::size_t missing = 0;
  };
  [[nodiscard]] Reading* find(CellId cell) noexcept;

  LeaderConfig config_;
  std::vector<Reading> readings_;
};

}  // namespace reckon::aoim
