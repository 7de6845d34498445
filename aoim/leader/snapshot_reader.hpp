// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The missing parts of the snapshots of cells that a newcomer has entered.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "reckon/aoim/leader/leader_config.hpp"
#include "reckon/aoim/numbered/missing_parts.hpp"
#include "reckon/pdu/reckon/cell_roles.hpp"
#include "reckon/pdu/reckon/cell_snapshot.hpp"

namespace reckon::aoim {

/// One thread; allocates when a cell is new.
class SnapshotReader {
 public:
  explicit SnapshotReader(const LeaderConfig& config) : config_(config) {}

  /// Starts to read a cell that we have joined and of which we have no states.
  void begin(CellId cell, std::chrono::nanoseconds now);
  /// Drops a cell that we have left or that we lead, so that no other peer could answer.
  void drop(CellId cell);
  /// The peer that could answer has gone: take_given_up() returns the cell if parts of it are
  /// missing.
  void give_up(CellId cell, std::chrono::nanoseconds now) noexcept;
  /// Takes a part from the leader of its cell. True if it is new and requested, so that its states
  /// are to be used.  @param leader epoch that sent it
  bool receive(const pdu::CellSnapshot& part, std::uint32_t leader, std::chrono::nanoseconds now);

  /// Calls say(CellId) for each cell for which a request to the leader is due.
  void for_each_due(std::chrono::nanoseconds now, auto&& say) const {
    for (const Reading& reading : readings_) {
      if (now >= reading.next_ask) say(reading.cell);
    }
  }
  /// Fills in the missing parts of the role's cell, at most 64 from `from` on, if any are missing
  /// and a request is due. Returns the next `from`; 0 if there is no more to request.
  std::size_t fill(pdu::CellRole& role, std::size_t from, std::chrono::nanoseconds now);
  /// Takes a cell that is given up because its parts did not arrive in time; false if there is
  /// none.
  bool take_given_up(std::chrono::nanoseconds now, CellId& cell);
  /// Whether parts of this cell are still missing.
  [[nodiscard]] bool reads(CellId cell) const noexcept;
  [[nodiscard]] std::chrono::nanoseconds next_step() const noexcept;

 private:
  using Nanoseconds = std::chrono::nanoseconds;
  struct Reading {
    CellId cell;
    Nanoseconds since{}, next_ask{};
    std::uint32_t leader = 0;
    std::uint16_t serial = 0;
    MissingParts parts;
  };
  [[nodiscard]] Reading* find(CellId cell) noexcept;

  LeaderConfig config_;
  std::vector<Reading> readings_;
};

}  // namespace reckon::aoim
