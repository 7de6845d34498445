// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The groups that a peer must join to receive everything within the radius of interest of its own
// entities. It joins early (a join takes 9 to 30 ms on a snooping switch), leaves late (a leave
// costs 2 s of unwanted traffic), never alternates at a border and never exceeds the cap.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "reckon/aoim/cells/cell_partition.hpp"

namespace reckon::aoim {

/// The range of one local entity: a ball that moves.
struct Focus {
  Position position;    ///< [m], in S
  double speed = 0.0;   ///< [m/s], >= 0; magnitude of the velocity
  double radius = 0.0;  ///< R [m], >= 0
  /// Cells farther away are not joined [m], >= 0; see ReachLimit. No bound by default.
  double cut = std::numeric_limits<double>::infinity();
};

/// Tunables of the subscription.
struct SubscriptionConfig {
  /// A group is kept until its cell is farther than this times R; default 1.1, >= 1. A higher
  /// factor costs traffic (4 % at 1.1, 9 % at 1.25) and saves joins.
  double leave_factor = 1.1;
  /// Shortest time for which a group is kept; default 2 s, the cost of a leave on a snooping
  /// switch.
  std::chrono::nanoseconds minimum_stay = std::chrono::seconds(2);
  /// Cells that the focus could reach within this time are joined in advance; default 100 ms.
  std::chrono::nanoseconds lookahead = std::chrono::milliseconds(100);
  /// Most cell groups joined at once, >= 1; default: the largest pool. Each takes a separate
  /// socket. Groups beyond a lower cap are not received; more than about 20 let foreign groups pass
  /// the filter of common network cards.
  std::size_t maximum_groups = kMaximumPool;
};

/// Result of one update. The spans are valid until the next update.
struct SubscriptionChange {
  std::span<const GroupIndex> join;   ///< join these now
  std::span<const GroupIndex> leave;  ///< then leave these
  /// Groups needed but not joined because of the cap; the nearest cells were kept. Normally 0.
  std::size_t uncovered = 0;
  /// Share of the radius of interest that is wholly received, 0 .. 1; normally 1.
  double covered_share = 1.0;
};

/// Keeps the set of joined cell groups. One thread; allocates nothing after construction.
class Subscription {
 public:
  /// @throws std::invalid_argument for a leave factor < 1, negative times or a cap of 0.
  Subscription(const CellPartition& cells, const SubscriptionConfig& config);

  /// Recomputes the set for all foci of this peer. Cost: cells within 1.1 R of each focus, about 50
  /// ns each, plus one pass over the pool. Foci that are not finite are skipped.
  /// @param besides groups to hold regardless of their cells, 1 .. as many as there are
  SubscriptionChange update(std::span<const Focus> foci, std::chrono::nanoseconds now,
                            std::span<const GroupIndex> besides = {});

  /// Groups joined after the last update, ascending.
  [[nodiscard]] std::span<const GroupIndex> joined() const noexcept { return joined_; }
  [[nodiscard]] bool is_joined(GroupIndex group) const noexcept;
  /// Whether it is joined and was joined before this time.
  [[nodiscard]] bool is_joined_since(GroupIndex group,
                                     std::chrono::nanoseconds time) const noexcept {
    return is_joined(group) && entries_[group.value - 1u].since <= time;
  }
  /// A cell of this group: the one that was nearest to a focus when last within reach.
  [[nodiscard]] CellId cell(GroupIndex group) const noexcept {
    return entries_[group.value - 1u].cell;
  }

 private:
  struct Entry {
    CellId cell;
    double reach = 0.0;  ///< distance of the nearest cell of this group over R, minus the lookahead
    double cover = 0.0;  ///< the same without the lookahead
    std::chrono::nanoseconds since{};
    bool joined = false;
  };
  void name_cells();
  void measure(const Focus& focus);
  void choose(std::chrono::nanoseconds now);
  SubscriptionChange apply(std::chrono::nanoseconds now);

  CellPartition cells_;
  SubscriptionConfig config_;
  std::vector<Entry> entries_;  ///< by group index - 1
  std::vector<std::uint16_t> wanted_;
  std::vector<GroupIndex> joined_, join_, leave_;
};

}  // namespace reckon::aoim
