// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The snapshot that a leader sends to newcomers: the last states of the entities in its cell. It is
// sent once for all requests of about the same time, in numbered parts at a steady pace. A missing
// part is repeated on request. Each state is read when it is sent, so a newcomer that has joined
// the group misses nothing.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "reckon/aoim/leader/leader_config.hpp"
#include "reckon/aoim/leader/state_store.hpp"
#include "reckon/aoim/numbered/due_parts.hpp"
#include "reckon/aoim/presence/introduction_budget.hpp"
#include "reckon/pdu/reckon/cell_roles.hpp"
#include "reckon/pdu/reckon/cell_snapshot.hpp"

namespace reckon::aoim {

/// The snapshots of the cells that one peer leads. One thread; allocates. Repeated requests get the
/// whole content once a second (IntroductionBudget): new snapshots and missing parts wait for that.
class SnapshotServer {
 public:
  /// States of one part [octets]: with its head and the datagram's trailer it fits a datagram that
  /// has room for eight bare Entity States.
  static constexpr std::size_t kMostOctets = 1216;
  static constexpr std::size_t kMostParts = 4096;

  explicit SnapshotServer(const LeaderConfig& config) : config_(config) {}

  /// Takes a request in a cell that we lead. Its states are kept under `number`, and its traffic
  /// uses `group`.
  void ask(const pdu::CellRole& role, GroupIndex number, GroupIndex group,
           std::chrono::nanoseconds now);
  /// Drops a cell that we no longer lead.
  void drop(CellId cell);

  /// Calls send(GroupIndex, pdu::CellSnapshot&) for each part that is due; the callee fills in the
  /// sender.
  void step(std::chrono::nanoseconds now, const StateStore& states, auto&& send) {
    for (Snapshot& snapshot : snapshots_) {
      begin_if_due(snapshot, now, states);
      pdu::CellSnapshot part;
      while (take_part(snapshot, now, states, part)) send(snapshot.group, part);
    }
  }
  [[nodiscard]] std::chrono::nanoseconds next_step() const noexcept;
  /// Parts sent since the start.
  [[nodiscard]] std::uint64_t parts_sent() const noexcept { return parts_sent_; }

 private:
  using Nanoseconds = std::chrono::nanoseconds;
  struct Snapshot {
    CellId cell;
    GroupIndex number, group;
    std::uint16_t serial = 0;
    bool asked = false;  ///< a new one begins at begin_at
    Nanoseconds begin_at{}, next{};
    std::vector<std::vector<pdu::EntityId>> parts;
    DueParts due;
  };
  void begin_if_due(Snapshot& snapshot, Nanoseconds now, const StateStore& states);
  bool take_part(Snapshot& snapshot, Nanoseconds now, const StateStore& states,
                 pdu::CellSnapshot& part);

  LeaderConfig config_;
  std::vector<Snapshot> snapshots_;
  IntroductionBudget budget_;
  std::vector<std::byte> octets_;  ///< of the part being sent
  std::uint64_t parts_sent_ = 0;
};

}  // namespace reckon::aoim
