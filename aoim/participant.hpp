// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Drives the AOIM layer for whoever owns entities and shows those of others: in which order it is
// asked, and what follows from its answers.
#pragma once

#include <chrono>
#include <span>

#include "reckon/aoim/area_of_interest_manager.hpp"

namespace reckon::aoim {

/// What a participant has to do with its entities. Called within Participant::deliver(); must not
/// throw.
class ParticipantHandler {
 public:
  virtual ~ParticipantHandler() = default;
  /// Entities under this name belong to this life of a peer from now on.
  virtual void claim(const PeerId& name, std::uint32_t epoch) noexcept = 0;
  /// The entities of this life are not to be shown any more.
  /// @param silent it was not heard for too long; else it has left, or lost its name
  virtual void drop(const PresenceEvent::Dropped& life, bool silent) noexcept = 0;
  /// Our own name is this one now: our entities are renamed.
  virtual void rename(const PeerId& own) noexcept = 0;
  /// A leader has relayed an Entity State of a cell that we have come late to. It counts as if its
  /// owner had sent it then.
  /// @param from the address of its owner
  virtual void receive(const RelayedState& state, const SourceAddress& from) noexcept = 0;
  /// Each event, after what follows from it.
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

  /// Passes on who came and who went, then what leaders have relayed. To be called after datagrams
  /// were received, and after each step.
  void deliver(std::chrono::nanoseconds now) noexcept;

  /// Listens to what these foci sense, in the cells and in the near rows. To be called before
  /// start, and whenever a focus has moved.
  /// @param follow gets (std::size_t tier, const SubscriptionChange&): groups to join and to leave
  template <typename Follow>
  void listen(std::span<const Focus> foci, std::chrono::nanoseconds now, Follow&& follow) {
    follow(kCellTier, manager_.listen(kCellTier, foci, now));
    for (std::size_t row = 0; row < manager_.tiers().near_rows(); ++row) {
      const std::size_t tier = manager_.tiers().of_row(row);
      follow(tier, manager_.listen(tier, foci, now));
    }
  }

  /// A step, and all that is queued besides, due or not: for who leaves. The good-bye is among it
  /// once the manager was stopped.
  void drain(std::chrono::nanoseconds now, DatagramSink sink);

 private:
  void conclude(const PresenceEvent& event) noexcept;

  AreaOfInterestManager manager_;
  ParticipantHandler& handler_;
};

}  // namespace reckon::aoim
