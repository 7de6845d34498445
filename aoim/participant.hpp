// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Drives the AOIM layer for an owner of entities: calls it in the right order and applies its
// events.
#pragma once

#include <chrono>
#include <span>

#include "reckon/aoim/area_of_interest_manager.hpp"

namespace reckon::aoim {

/// Reactions of a participant to events. Participant::deliver() calls them; they must not throw.
class ParticipantHandler {
 public:
  virtual ~ParticipantHandler() = default;
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

/// The manager of one peer and its driver. One thread.
class Participant {
 public:
  /// @param handler outlives this  @throws std::invalid_argument as AreaOfInterestManager does
  Participant(const AreaOfInterestConfig& config, const pdu::Presence& own,
              ParticipantHandler& handler)
      : manager_(config, own), handler_(handler) {}

  [[nodiscard]] AreaOfInterestManager& manager() noexcept { return manager_; }
  [[nodiscard]] const AreaOfInterestManager& manager() const noexcept { return manager_; }

  /// Delivers arrivals and departures of peers, then relayed states. Call it after datagrams were
  /// received and after each step.
  void deliver(std::chrono::nanoseconds now) noexcept;

  /// Subscribes to all tiers, each as far around these foci as it reaches. Call it before start(),
  /// and whenever a focus has moved.
  /// @param follow gets (std::size_t tier, const SubscriptionChange&): groups to join and to leave
  template <typename Follow>
  void listen(std::span<const Focus> foci, std::chrono::nanoseconds now, Follow&& follow) {
    listen_by_tier([&](std::size_t) { return foci; }, now, follow);
  }

  /// The same, each tier with foci of its own.
  /// @param foci_of gets a tier and returns its foci, valid until its next call
  template <typename FociOf, typename Follow>
  void listen_by_tier(FociOf&& foci_of, std::chrono::nanoseconds now, Follow&& follow) {
    for (std::size_t tier = 0; tier < manager_.tiers().count(); ++tier)
      follow(tier, manager_.listen(tier, foci_of(tier), now));
  }

  /// A step that also sends queued PDUs that are not due. For peers that leave: after stop() it
  /// sends the announcement of the end.
  void drain(std::chrono::nanoseconds now, DatagramSink sink);

 private:
  void conclude(const PresenceEvent& event) noexcept;

  AreaOfInterestManager manager_;
  ParticipantHandler& handler_;
};

}  // namespace reckon::aoim
