// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// One leader for each cell, without a vote. The peer that entered first leads until it leaves or
// becomes silent; then the successor that it named leads. Of two leaders, as after a partition, the
// one that entered first remains. A newcomer never replaces a leader: it ranks behind the leader,
// whatever time its clock shows.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "reckon/aoim/leader/leader_config.hpp"
#include "reckon/pdu/reckon/cell_roles.hpp"

namespace reckon::aoim {

/// A change in a cell of ours.
struct LeaderEvent {
  CellId cell;
  std::uint32_t leader = 0;  ///< epoch that leads now; 0: none is known
  bool ours = false;         ///< we lead now
  bool lost = false;         ///< we led until now
};

/// The cells of one peer. One thread; allocates when cells or members are new.
class CellLeadership {
 public:
  /// @param epoch ours, not 0
  CellLeadership(const LeaderConfig& config, std::uint32_t epoch);

  /// Enters this cell; false if we are already in the maximum number of cells.
  /// @param utc our time since 1970, which ranks us
  bool enter(CellId cell, std::chrono::nanoseconds utc, std::chrono::nanoseconds now);
  /// Leaves the cell: its role is sent three more times, with kRoleLeaves.
  void leave(CellId cell, std::chrono::nanoseconds now);

  /// Takes the role of a known peer in one cell.  @param sender its epoch, from its datagram
  void receive(const pdu::CellRole& role, std::uint32_t sender, std::chrono::nanoseconds now);
  /// Presence has found that this epoch has ended.
  void forget(std::uint32_t epoch, std::chrono::nanoseconds now);

  /// Takes the lead where no other peer has it, and removes silent members.
  void step(std::chrono::nanoseconds now);
  /// Takes the next role that is due, without its requests; false if none is due. The caller sends
  /// all of them.
  bool take_role(std::chrono::nanoseconds now, pdu::CellRole& role);
  /// Makes the role of this cell due now, for example to request something.
  void say_soon(CellId cell, std::chrono::nanoseconds now) noexcept;
  [[nodiscard]] std::chrono::nanoseconds next_step() const noexcept;

  [[nodiscard]] bool is_member(CellId cell) const noexcept { return find(cell) != nullptr; }
  /// Epoch that leads a cell of ours; 0 if none is known or we are not in the cell.
  [[nodiscard]] std::uint32_t leader(CellId cell) const noexcept;
  [[nodiscard]] bool leads(CellId cell) const noexcept { return leader(cell) == epoch_; }
  /// Whether this epoch is known in the cell and entered after us, so that it yields if both lead.
  [[nodiscard]] bool came_later(CellId cell, std::uint32_t epoch) const noexcept;
  /// Whether a leader of the cell is known and has not missed its heartbeats.
  [[nodiscard]] bool is_led(CellId cell, std::chrono::nanoseconds now) const noexcept;
  /// Whether another peer has led the cell since we entered.
  [[nodiscard]] bool had_other_leader(CellId cell) const noexcept;
  /// Known other peers in a cell of ours.
  [[nodiscard]] std::size_t members(CellId cell) const noexcept;
  /// Calls visit(CellId, epoch that leads it, or 0 if none is known) for each cell of ours.
  void for_each_cell(auto&& visit) const {
    for (const Cell& cell : cells_) {
      if (cell.leave_repeats == 0) visit(cell.id, cell.leader.epoch);
    }
  }
  /// Events since the last call; valid until the next one.
  [[nodiscard]] std::span<const LeaderEvent> take_events();
  [[nodiscard]] std::uint32_t epoch() const noexcept { return epoch_; }

 private:
  using Nanoseconds = std::chrono::nanoseconds;
  struct Member {
    std::uint32_t epoch = 0;
    std::uint64_t entered = 0;
    Nanoseconds heard{}, since{};  ///< last and first reception
  };
  struct Leader {
    std::uint32_t epoch = 0, successor = 0;
    std::uint64_t entered = 0;
    Nanoseconds heard{};
  };
  struct Cell {
    CellId id;
    std::uint64_t entered = 0;
    bool ranked = false;  ///< our rank is fixed: we have led or received a leader
    bool other_led = false;
    int leave_repeats = 0;  ///< roles of leaving still to send; 0: we stay
    Leader leader;
    Nanoseconds since{}, next_send{}, said{};
    std::vector<Member> members;
  };
  [[nodiscard]] Cell* find(CellId id) noexcept;
  [[nodiscard]] const Cell* find(CellId id) const noexcept;
  [[nodiscard]] Nanoseconds patience() const noexcept { return config_.missed * config_.heartbeat; }
  [[nodiscard]] Nanoseconds leads_at(const Cell& cell) const noexcept;
  [[nodiscard]] std::uint32_t successor_of(const Cell& cell, Nanoseconds now) const noexcept;
  void note_member(Cell& cell, const pdu::CellRole& role, std::uint32_t sender, Nanoseconds now);
  void receive_claim(Cell& cell, const pdu::CellRole& role, std::uint32_t sender, Nanoseconds now);
  void receive_leave(Cell& cell, std::uint32_t sender, bool led, std::uint32_t successor,
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
