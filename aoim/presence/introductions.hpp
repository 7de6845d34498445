// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// When the entities of a peer are introduced to those who begin to listen to a group.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <vector>

#include "reckon/aoim/groups/group_index.hpp"
#include "reckon/aoim/presence/introduction.hpp"
#include "reckon/aoim/presence/introduction_budget.hpp"

namespace reckon::aoim {

/// Begins introductions at once, as long as those who ask have not caused too much of it lately;
/// what strangers cause and what known peers cause has a budget each. One thread; allocates at
/// construction alone.
class Introductions {
 public:
  /// @param groups of all tiers and cells, behind the base group
  Introductions(const IntroductionConfig& config, std::size_t groups);

  /// How many entities this peer owns: the more, the longer answering a newcomer takes, so that no
  /// more than about 15,000 datagrams a second do so. Call it when the number changes.
  void set_owned(std::size_t count) noexcept;
  /// An entity was sent because is_due asked for it, in so many octets. Who causes more than one
  /// introduction of everything in a second waits for the next one.
  void note_sent(std::size_t octets, std::chrono::nanoseconds now) noexcept;

  /// Somebody listens to `group` from now on, and has not received what we send there.
  /// @param heard_for for how long we have been receiving from that peer
  void begin(GroupIndex group, std::chrono::nanoseconds heard_for, std::chrono::nanoseconds now);
  /// Begins what had to wait, and forgets what is over.
  void step(std::chrono::nanoseconds now);
  /// When step has something to begin; duration max where nothing waits.
  [[nodiscard]] std::chrono::nanoseconds next_step() const noexcept;

  /// False where nobody is to be introduced: no entity need be asked about.
  [[nodiscard]] bool is_pending() const noexcept { return introduction_.is_pending(); }
  /// See Introduction::is_due.
  [[nodiscard]] bool is_due(const pdu::EntityId& entity, GroupIndex group,
                            std::chrono::nanoseconds last_sent,
                            std::chrono::nanoseconds now) const noexcept {
    return introduction_.is_due(entity, group, last_sent, now);
  }

 private:
  /// What those who came lately cause together, and what those whom we have known for long do.
  struct Askers {
    IntroductionBudget budget;
    std::vector<GroupIndex> waiting;  ///< none twice
    std::vector<bool> waits;          ///< by group
    std::chrono::nanoseconds until = std::chrono::nanoseconds::min();  ///< the last one goes on
  };
  void begin_waiting(std::chrono::nanoseconds now);

  Introduction introduction_;
  std::array<Askers, 2> askers_;  ///< strangers, known peers
  std::size_t owned_ = 0;
  double octets_ = 208.0;  ///< of one entity, on average
};

}  // namespace reckon::aoim
