// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Who owns which object: one peer's part of the protocol. Pure code: messages and the time go in,
// messages and events come out.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>

#include "reckon/peer/ownership/chair.hpp"
#include "reckon/peer/ownership/granting.hpp"
#include "reckon/peer/ownership/object_rows.hpp"
#include "reckon/peer/ownership/ownership_core.hpp"
#include "reckon/peer/ownership/rounds.hpp"
#include "reckon/peer/ownership/taking.hpp"
#include "reckon/peer/ownership/voting.hpp"

namespace reckon::peer {

/// At most one peer of a world owns an object at any instant, whatever the network does.
///
/// An owner acts while a majority of the voters has received it in the last 2 s (LeaseBook), and
/// gives objects away by itself (Granting, Taking). A majority removes a voter that it has not
/// received for 3 s, and gives its objects to the chair (Chair, ActBook). Peers fail by stopping
/// for ever: a restarted process is a new peer. Peers without a majority keep their objects at rest
/// until a majority returns, or until go_alone().
///
/// One thread. Allocates nothing after its first messages. Some us for a message.
class Ownership {
 public:
  using Nanoseconds = std::chrono::nanoseconds;
  /// Time between two calls of step() after which this peer has slept.
  static constexpr Nanoseconds kSlept = std::chrono::milliseconds(500);
  static constexpr Nanoseconds kLeaving = std::chrono::milliseconds(1500);

  /// @param user outlives this
  Ownership(const OwnershipConfig& config, OwnershipUser& user) : core_(config, user) {}
  Ownership(const Ownership&) = delete;
  Ownership& operator=(const Ownership&) = delete;

  /// @param from epoch of a live peer of this scene, as proved by its address or seal
  void receive(std::uint32_t from, const OwnershipMessage& message, Nanoseconds now);
  void step(Nanoseconds now);
  /// Messages to send now; valid until the next call of a function that is not const.
  [[nodiscard]] std::span<const OutgoingMessage> outgoing() const noexcept { return core_.out; }
  void clear_outgoing() noexcept { core_.out.clear(); }
  [[nodiscard]] std::span<const OwnershipEvent> events() const noexcept { return core_.events; }
  void clear_events() noexcept { core_.events.clear(); }

  /// Wants the object, until withdraw(). The owner grants it when nothing holds it there.
  void ask(std::size_t object) noexcept { taking_.ask(object); }
  void withdraw(std::size_t object) { taking_.withdraw(object); }
  /// The peer that waits longest for an object of ours; 0: none.
  [[nodiscard]] std::uint32_t asker_of(std::size_t object) const noexcept {
    return rows_[object].askers[0].epoch;
  }
  /// The state of an object as it was granted to us.
  [[nodiscard]] const ObjectState& granted_state(std::size_t object) const noexcept {
    return rows_[object].state;
  }
  /// The state in which this peer has stopped simulating an object; before yielded().
  void set_state(std::size_t object, const ObjectState& state) noexcept {
    rows_[object].state = state;
  }
  /// Answers OwnershipEvent::Kind::yield.
  void yielded(std::uint32_t transaction, Nanoseconds now) { granting_.yielded(transaction, now); }
  /// Gives all objects to other voters, and its vote up. Call step() until has_left(), at most for
  /// kLeaving.
  void leave() noexcept { core_.is_leaving = true; }
  [[nodiscard]] bool has_left() const noexcept;
  /// Goes on without the other voters, by the user's word: founds a world and owns all objects.
  /// @param utc [s] since 1970
  void go_alone(std::uint32_t utc, Nanoseconds now);

  /// Whether this peer may move the object now.
  [[nodiscard]] bool owns(std::size_t object, Nanoseconds now) const noexcept;
  /// Owner and version as known here.
  [[nodiscard]] const Tenure& tenure(std::size_t object) const noexcept {
    return core_.table[object];
  }
  /// Whether a majority receives this peer.
  [[nodiscard]] bool has_lease(Nanoseconds now) const noexcept { return core_.has_lease(now); }
  /// Voters of the last decided act that were received within the time of a lease, and this peer.
  [[nodiscard]] std::size_t received_voters(Nanoseconds now) const noexcept;
  /// Whether no round of this voter has arrived for `patience`.
  [[nodiscard]] bool is_silent(std::uint32_t voter, Nanoseconds patience,
                               Nanoseconds now) const noexcept {
    return voter != core_.config.epoch && now - core_.leases.silent_since(voter) > patience;
  }
  /// Whether this peer votes in the last decided act.
  [[nodiscard]] bool is_voter() const noexcept {
    return core_.acts.decided().roll.contains(core_.config.epoch);
  }
  /// Whether this peer knows what all acts gave; if not, it owns nothing.
  [[nodiscard]] bool is_informed() const noexcept { return core_.is_informed(); }
  [[nodiscard]] const WorldId& world() const noexcept { return core_.world; }
  [[nodiscard]] const ActBook& acts() const noexcept { return core_.acts; }
  [[nodiscard]] const TenureTable& table() const noexcept { return core_.table; }
  [[nodiscard]] const OwnershipCounts& counts() const noexcept { return core_.counts; }

 private:
  void receive(const Round& round, std::uint32_t from, Nanoseconds now) {
    rounds_.receive(round, from, now);
  }
  void receive(const Proposal& proposal, std::uint32_t from, Nanoseconds now);
  void receive(const Vote& vote, std::uint32_t from, Nanoseconds now);
  [[nodiscard]] bool is_of_world(const WorldId& world, const Round* round, std::uint32_t from,
                                 Nanoseconds now);
  void merge(const WorldId& older);
  void leave_world();
  void remember_world();
  void recall_world();
  void found_if_due(Nanoseconds now);
  void found(std::uint32_t number, Nanoseconds now);
  void decide(const Act& act, Nanoseconds now);
  void propose(Nanoseconds now);
  void promise(const Proposal& proposal, std::uint32_t from);
  void accept(const Proposal& proposal, Nanoseconds now);

  static constexpr Nanoseconds kNever = Nanoseconds::min() / 4;

  struct FormerWorld {
    WorldId world;
    ActBook acts;
    TenureTable table{0};
  };

  OwnershipCore core_;
  ObjectRows rows_{core_};
  Granting granting_{core_, rows_};
  Taking taking_{core_, rows_};
  Chair chair_{core_};
  Rounds rounds_{core_, rows_, granting_, chair_};
  Voting voting_{core_, rows_, rounds_, chair_};
  WorldId left_;  // the last world that could not admit us
  std::array<FormerWorld, 4> former_;
  std::size_t formers_ = 0;
  bool is_founding_ = false;
  Nanoseconds started_ = kNever, stepped_ = kNever;
  Nanoseconds joined_ = kNever;     // when we began to follow a world
  Nanoseconds leased_ = kNever;     // last time with a lease
  Nanoseconds old_lease_ = kNever;  // end of the lease when the pending act was accepted
};

}  // namespace reckon::peer
