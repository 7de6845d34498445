// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What an owner of entities does when peers come, go or change, and when leaders relay states.
#pragma once

#include <chrono>

#include "reckon/aoim/area_of_interest_manager.hpp"

namespace reckon::aoim {

/// Reactions to events. deliver_events() calls them; they must not throw.
class EventHandler {
 public:
  virtual ~EventHandler() = default;
  /// Entities with this site and application belong to this epoch of a peer from now on.
  virtual void claim(const PeerId& name, std::uint32_t epoch) noexcept = 0;
  /// The entities of this epoch are no longer shown.
  /// @param silent true after a time-out; false if it has left or lost its identity
  virtual void drop(const PresenceEvent::Dropped& life, bool silent) noexcept = 0;
  /// Our identity has changed to this one: our entities get new IDs.
  virtual void rename(const PeerId& own) noexcept = 0;
  /// A leader has relayed an Entity State of a cell in which we are a newcomer. It counts as if its
  /// owner had sent it at its original time.
  /// @param from the address of its owner
  virtual void receive(const RelayedState& state, const SourceAddress& from) noexcept = 0;
  /// Called for each event after the specific function.
  virtual void report(const PresenceEvent& event) noexcept = 0;
};

/// Delivers arrivals and departures of peers, then relayed states. Call it after datagrams were
/// received and after each step.
void deliver_events(AreaOfInterestManager& aoim, EventHandler& handler,
                    std::chrono::nanoseconds now) noexcept;

}  // namespace reckon::aoim
