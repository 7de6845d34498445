// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The world as received up to one instant: the listener's table of entities, their remaining
// convergence errors, and the groups that carried their updates. A copy keeps the world of its
// instant.
#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "reckon/deadreckon/motion/convergence.hpp"
#include "reckon/deadreckon/motion/geocentric.hpp"
#include "reckon/tools/listener/entity_table.hpp"
#include "reckon/tools/viewer/history/received_groups.hpp"
#include "reckon/tools/viewer/history/roster.hpp"
#include "reckon/tools/viewer/protocol/picture.hpp"

namespace reckon::tools {

/// Differences between updates and predictions since the last call of take_jumps().
struct UpdateJumps {
  std::size_t count = 0;
  double sum = 0, worst = 0;  ///< [m]
};

/// One thread. Allocates for new entities. Some 0.5 us per state.
class ReceivedWorld {
 public:
  /// @param most entities
  ReceivedWorld(std::size_t most, const deadreckon::ConvergenceSettings& settings,
                const GroupTiers& tiers)
      : table_(most), settings_(settings), groups_(tiers) {}

  /// Takes one PDU with the inspector's result.
  /// @param start of the source
  void take_pdu(const PduRow& row, const peer::SourceDatagram& datagram, Roster& roster,
                std::chrono::nanoseconds start);
  /// Drops entities that left, and entities that were silent for longer than their time-out and
  /// than `silence`.
  void drop_silent(std::chrono::nanoseconds now, std::chrono::nanoseconds silence) {
    table_.drop_gone(now);
    table_.drop_silent(now, silence);
  }

  [[nodiscard]] const EntityTable& table() const noexcept { return table_; }
  [[nodiscard]] const ReceivedGroups& groups() const noexcept { return groups_; }
  /// Position of the first entity with a state; geocentric [m].
  [[nodiscard]] std::optional<Eigen::Vector3d> first_place() const;
  [[nodiscard]] UpdateJumps take_jumps() noexcept { return std::exchange(jumps_, {}); }
  /// Octets of a copy, approximately.
  [[nodiscard]] std::size_t weight() const noexcept;

  /// Adds a mark for each entity that the roster names and that is neither gone nor silent at
  /// `time`; without its cell. @param frame of the marks  @param start of the source
  void add_marks(std::chrono::nanoseconds time, std::chrono::nanoseconds start,
                 const Roster& roster, const deadreckon::LocalFrame& frame,
                 std::vector<EntityMark>& out) const;

 private:
  struct Watching;  // handles one PDU
  void note_update(const StateUpdate& update, const peer::SourceDatagram& datagram, Roster& roster,
                   std::chrono::nanoseconds start);

  EntityTable table_;
  deadreckon::ConvergenceSettings settings_;
  std::vector<deadreckon::ConvergingError> errors_;  // by slot
  UpdateJumps jumps_;
  ReceivedGroups groups_;
};

}  // namespace reckon::tools
