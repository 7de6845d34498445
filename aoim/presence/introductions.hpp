// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Decides when a peer introduces its entities to newcomers of a group.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <vector>

#include "reckon/aoim/groups/group_index.hpp"
#include "reckon/aoim/presence/introduction.hpp"
#include "reckon/aoim/presence/introduction_budget.hpp"

namespace reckon::aoim {

/// Begins an introduction at once, unless the budget for introductions is spent. There is one
/// budget for introductions to unknown peers and one for introductions to known peers. One thread;
/// allocates only at construction.
class Introductions {
 public:
  /// @param groups number of groups of all tiers and cells, without the base group
  Introductions(const IntroductionConfig& config, std::size_t groups);

  /// Sets the number of entities that this peer owns. Call it when the number changes. An
  /// introduction of more entities takes longer, so that it sends at most about 15,000 datagrams a
  /// second.
  void set_owned(std::size_t count) noexcept;
  /// Counts `octets` that were sent because is_due() returned true. Newcomers that cause more than
  /// one introduction of all entities within a second wait for the next one.
  void note_sent(std::size_t octets, std::chrono::nanoseconds now) noexcept;

  /// A newcomer has joined `group` and lacks the states that we send there.
  /// @param heard_for how long we have been receiving from that peer
  void begin(GroupIndex group, std::chrono::nanoseconds heard_for, std::chrono::nanoseconds now);
  /// Begins pending introductions and removes finished ones.
  void step(std::chrono::nanoseconds now);
  /// When step() can begin the next pending introduction; nanoseconds::max() if none is pending.
  [[nodiscard]] std::chrono::nanoseconds next_step() const noexcept;

  /// False if no introduction is under way. Then is_due() is false for every entity.
  [[nodiscard]] bool is_pending() const noexcept { return introduction_.is_pending(); }
  /// See Introduction::is_due.
  [[nodiscard]] bool is_due(const pdu::EntityId& entity, GroupIndex group,
                            std::chrono::nanoseconds last_sent,
                            std::chrono::nanoseconds now) const noexcept {
    return introduction_.is_due(entity, group, last_sent, now);
  }

 private:
  /// The introductions that one class of peers, unknown or known, has caused.
  struct Askers {
    IntroductionBudget budget;
    std::vector<GroupIndex> waiting;  ///< each group once
    std::vector<bool> waits;          ///< by group: is in `waiting`
    std::chrono::nanoseconds until =
        std::chrono::nanoseconds::min();  ///< the last introduction ends
  };
  void begin_waiting(std::chrono::nanoseconds now);

  Introduction introduction_;
  std::array<Askers, 2> askers_;  ///< strangers, known peers
  std::size_t owned_ = 0;
  double octets_ = 208.0;  ///< of one entity, on average
};

}  // namespace reckon::aoim
