// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// One leader for each cell, without a vote: who came first leads until it leaves or falls silent,
// then the successor it named. Where two lead, as after a partition, the one that came first stays.
// A newcomer never unseats a leader: it takes a place behind it, whatever its clock says.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "reckon/aoim/leader/leader_config.hpp"
#include "reckon/pdu/reckon/cell_roles.hpp"

namespace reckon::aoim {

/// What changed in a cell of ours.
struct LeaderEvent {
  CellId cell;
  std::uint32_t leader = 0;  ///< life that leads now; 0: none is known
  bool ours = false;         ///< it is we
  bool lost = false;         ///< we led until now
};

/// The cells of one peer. One thread; allocates when cells or members are new.
class CellLeadership {
 public:
  /// @param epoch our life, not 0
  CellLeadership(const LeaderConfig& config, std::uint32_t epoch);

  /// We are in this cell from now on. @param utc our time since 1970, which ranks us.
  /// False, and nothing done, where we are in the most cells already.
  bool enter(CellId cell, std::chrono::nanoseconds utc, std::chrono::nanoseconds now);
  /// We leave it, and say so three times.
  void leave(CellId cell, std::chrono::nanoseconds now);

  /// What a peer that is known says of one cell. @param sender its life, from its datagram
  void receive(const pdu::CellRole& role, std::uint32_t sender, std::chrono::nanoseconds now);
  /// Presence says that this life is over.
  void forget(std::uint32_t epoch, std::chrono::nanoseconds now);

  /// Takes the lead where nobody else does, and forgets who is silent.
  void step(std::chrono::nanoseconds now);
  /// The next role that is due to be said, without its asks; false where there is none. The caller
  /// says all of them.
  bool take_role(std::chrono::nanoseconds now, pdu::CellRole& role);
  /// Say the role of this cell at the next occasion, e.g. to ask for something.
  void say_soon(CellId cell, std::chrono::nanoseconds now) noexcept;
  [[nodiscard]] std::chrono::nanoseconds next_step() const noexcept;

  [[nodiscard]] bool is_member(CellId cell) const noexcept { return find(cell) != nullptr; }
  /// Life that leads a cell of ours; 0 where none is known or we are not in it.
  [[nodiscard]] std::uint32_t leader(CellId cell) const noexcept;
  [[nodiscard]] bool leads(CellId cell) const noexcept { return leader(cell) == epoch_; }
  /// Whether this life is heard in the cell and came after us: where both lead, it gives way.
  [[nodiscard]] bool came_later(CellId cell, std::uint32_t epoch) const noexcept;
  /// Whether somebody leads the cell, as far as known, and has not missed its heartbeats.
  [[nodiscard]] bool is_led(CellId cell, std::chrono::nanoseconds now) const noexcept;
  /// Whether anybody else has led the cell since we entered.
  [[nodiscard]] bool had_other_leader(CellId cell) const noexcept;
  /// Others in a cell of ours, as far as they are heard.
  [[nodiscard]] std::size_t members(CellId cell) const noexcept;
  /// Calls visit(CellId, life that leads it, 0 where none is known) for each cell of ours.
  template <typename Visit>
  void for_each_cell(Visit&& visit) const {
    for (const Cell& cell : cells_) {
      if (cell.farewells == 0) visit(cell.id, cell.leader.epoch);
    }
  }
  /// Events since the last call; good until the next one.
  [[nodiscard]] std::span<const LeaderEvent> take_events();
  [[nodiscard]] std::uint32_t epoch() const noexcept { return epoch_; }

 private:
  using Nanoseconds = std::chrono::nanoseconds;
  struct Member {
    std::uint32_t epoch = 0;
    std::uint64_t entered = 0;
    Nanoseconds heard{}, since{};  ///< last and first
  };
  struct Leader {
    std::uint32_t epoch = 0, successor = 0;
    std::uint64_t entered = 0;
    Nanoseconds heard{};
  };
  struct Cell {
    CellId id;
    std::uint64_t entered = 0;
    bool ranked = false;  ///< our place is settled: we have led or heard a leader
    bool other_led = false;
    int farewells = 0;  ///< still to say; 0: we stay
    Leader leader;
    Nanoseconds since{}, next_say{}, said{};
    std::vector<Member> members;
  };
  [[nodiscard]] Cell* find(CellId id) noexcept;
  [[nodiscard]] const Cell* find(CellId id) const noexcept;
  [[nodiscard]] Nanoseconds patience() const noexcept { return config_.missed * config_.heartbeat; }
  [[nodiscard]] Nanoseconds leads_at(const Cell& cell) const noexcept;
  [[nodiscard]] std::uint32_t successor_of(const Cell& cell, Nanoseconds now) const noexcept;
  void note_member(Cell& cell, const pdu::CellRole& role, std::uint32_t sender, Nanoseconds now);
  void hear_claim(Cell& cell, const pdu::CellRole& role, std::uint32_t sender, Nanoseconds now);
  void hear_farewell(Cell& cell, std::uint32_t sender, bool led, std::uint32_t successor,
                     Nanoseconds now);
  void follow(Cell& cell, const Leader& leader, Nanoseconds now);
  void take_lead(Cell& cell, Nanoseconds now);
  void tell(const Cell& cell, bool lost);
  void wake(Nanoseconds now);

  LeaderConfig config_;
  std::uint32_t epoch_;
  Nanoseconds stepped_ = Nanoseconds::min();
  std::vector<Cell> cells_;
  std::vector<LeaderEvent> events_, taken_;
};

}  // namespace reckon::aoim
