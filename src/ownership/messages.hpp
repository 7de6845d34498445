// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What peers send each other about ownership. Any of it may be lost, doubled or late.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>
#include <variant>

#include "reckon/peer/ownership/act.hpp"
#include "reckon/peer/ownership/roll.hpp"
#include "reckon/peer/ownership/tenure.hpp"

namespace reckon::peer {

/// An object and its owner.
struct Holding {
  std::uint16_t object = 0;
  Tenure tenure;
};

/// Most of one message, so that it fits into a datagram.
inline constexpr std::size_t kMostHoldings = 64;

struct Holdings {
  std::array<Holding, kMostHoldings> all{};
  std::size_t count = 0;

  [[nodiscard]] std::span<const Holding> list() const noexcept {
    return std::span(all).first(count);
  }
  /// False if it is full.
  bool add(std::size_t object, const Tenure& tenure) noexcept {
    if (count == all.size()) return false;
    all[count++] = {static_cast<std::uint16_t>(object), tenure};
    return true;
  }
};

/// For Round::yields_to.
inline constexpr std::uint32_t kAnyAct = ~std::uint32_t{0};

/// A round, see LeaseBook. While the sender has no act (number 0), `world` is the one that it would
/// found.
struct Round {
  WorldId world;
  std::uint32_t act = 0;    ///< number of the last act that the sender has accepted
  std::uint32_t hash = 0;   ///< Act::hash() of it
  std::uint32_t table = 0;  ///< TenureTable::hash()
  std::uint8_t round = 0;
  bool is_decided = false;  ///< the act is
  bool is_active = false;   ///< the sender has or wants an object in motion
  bool has_lease = false;   ///< a majority receives the sender
  bool follows = false;     ///< the sender wants no vote
  /// Number of an act that may remove the sender; kAnyAct if it leaves, 0 for none.
  std::uint32_t yields_to = 0;
  std::array<std::uint8_t, Roll::kMost> heard{};  ///< last round of each voter of the act
};

/// The steps of a decision, as in Paxos.
enum class DecisionPhase : std::uint8_t {
  prepare,  ///< asks for promises; `act` has only its number
  promise,  ///< no lower ballot is accepted any more; or a refusal, with a higher ballot
  propose,  ///< asks for votes
  decided,
};

/// A step of the decision on an act. In a promise, `accepted` is the ballot of the act that its
/// sender has accepted, and `act` that act; proposer 0: none.
struct Proposal {
  WorldId world;
  Act act;
  Ballot ballot, accepted;
  std::uint32_t digest = 0;  ///< of the proposer's tenures of the objects that the act gives
  DecisionPhase phase = DecisionPhase::propose;
};

struct Vote {
  WorldId world;
  std::uint32_t act = 0;  ///< number
  Ballot ballot;
};

/// Owners known to the sender. With `asks`, all are the sender's own, and it asks for an Agreement.
struct TableExtract {
  WorldId world;
  Holdings holdings;
  std::uint32_t serial = 0;
  /// Number of the decided act, if the sender knows all objects that acts up to it have given; else
  /// 0.
  std::uint32_t act = 0;
  bool asks = false;
};

/// The objects of a TableExtract that the sender has noted as owned by their sender.
struct Agreement {
  WorldId world;
  std::uint32_t serial = 0;
  ObjectSet objects;
};

/// Asks an owner for objects, or withdraws that.
struct Request {
  WorldId world;
  ObjectSet objects;
  bool withdraws = false;
};

/// Pose and motion of an object at an instant.
struct ObjectState {
  std::chrono::nanoseconds utc{0};
  std::array<double, 3> position{};               ///< [m], S
  std::array<double, 4> orientation{1, 0, 0, 0};  ///< w, x, y, z: from the object's axes to S
  std::array<double, 3> velocity{}, turn_rate{};  ///< [m/s], [rad/s], S
  std::array<double, 3> acceleration{};           ///< [m/s^2], S
};

/// Most objects of one part of a grant.
inline constexpr std::size_t kMostGranted = 7;

/// Objects that change owner together. Each part names all of them and has some.
struct Grant {
  WorldId world;
  std::uint32_t transaction = 0;
  std::uint32_t to = 0;        ///< epoch of the new owner
  std::uint8_t round = 0;      ///< last round of the new owner that the sender received
  std::uint32_t lease_ms = 0;  ///< remainder of the sender's lease, rounded down
  bool is_pushed = false;      ///< the sender leaves: the objects need not be wanted
  ObjectSet objects;
  std::size_t count = 0;
  std::array<Holding, kMostGranted> part{};  ///< with the new version
  std::array<ObjectState, kMostGranted> states{};

  [[nodiscard]] std::span<const Holding> holdings() const noexcept {
    return std::span(part).first(count);
  }
};

/// The new owner does not take the objects.
struct GrantRefusal {
  WorldId world;
  std::uint32_t transaction = 0;
};

using OwnershipMessage =
    std::variant<Round, Proposal, Vote, TableExtract, Agreement, Request, Grant, GrantRefusal>;

}  // namespace reckon::peer
