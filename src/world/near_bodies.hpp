// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The bodies, remote and our own, that an entity of ours could touch within an update, and the
// selection for a servo that cannot hold all of them.
#pragma once

#include <Eigen/Core>
#include <array>
#include <chrono>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <span>

#include "reckon/deadreckon/force/force_model.hpp"
#include "reckon/haptics/exchange/servo_types.hpp"
#include "reckon/peer/world/owned_entities.hpp"
#include "reckon/peer/world/state_table.hpp"

namespace reckon::peer {

/// Largest distance between surfaces [m] at which a body is given to the servo: nothing moves
/// farther within one update.
inline constexpr double kContactReach = 0.25;

/// One body with a force model: a row of the state table or an entity of ours.
struct NearBody {
  const RemoteEntity* row = nullptr;  ///< null for an own entity
  const OwnedEntity* own = nullptr;   ///< null for a remote one
  pdu::EntityId id;
  EntityNumber number = 0;                             ///< of an own entity
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();    ///< of its model's point, S [m]
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< S [m/s]
  double depth = 0.0;                                  ///< [m]; below 0 the surfaces are apart
  bool may_press = true;                               ///< see ContactBeginnings

  [[nodiscard]] const deadreckon::ForceModel& model() const noexcept {
    return row != nullptr ? row->model : own->touch()->model();
  }
  /// Whether a person holds it and feels what touches it.
  [[nodiscard]] bool is_hand() const noexcept {
    return (row != nullptr ? row->type.kind : own->type().kind) == pdu::EntityKind::life_form;
  }
};

/// The bodies near one probe. Pointers are valid until the state table or the owned entities
/// change.
/// If a servo cannot hold all of them, hosts share the places, and the host with the most bodies
/// loses some first. Each host gets kSure bodies before any host gets more, and its senders take
/// turns. Among equals, the order is: bodies that touch or nearly touch, bodies of peers before
/// bodies of guests, bodies touched at the last check, and deeper bodies. Bodies that come last are
/// those with a force too weak to feel, and those that may not press the hand yet. One thread; no
/// allocation.
class NearBodies {
 public:
  static constexpr std::size_t kMost = haptics::kMaxRemoteHands;
  /// Number of places for one host before rank decides on the remaining places.
  static constexpr std::size_t kSure = 4;
  /// Closer than this [m], two bodies may touch before the next check at 2 m/s and 15 ms.
  static constexpr double kSoonTouching = 0.03;
  /// Force [N] at a depth of a decimetre, or at 1 m/s, below which nothing is felt.
  static constexpr double kLeastForce = 1e-3;

  /// Begins a new check; remembers the bodies touched at the last one.
  void clear() noexcept;
  /// Adds a remote body within reach; choose() follows. Some 20 ns; 100 ns if they are many.
  void add(const RemoteEntity& row, const deadreckon::Contact& touch,
           const Eigen::Vector3d& velocity, bool may_press = true) noexcept;
  /// Adds our own bodies except `except`, and chooses.
  void add_own(const OwnedEntities& owned, EntityNumber except, const deadreckon::ProbeState& probe,
               std::chrono::nanoseconds now) noexcept;
  /// Orders the bodies by rank and drops those without a place. Call it after the last add().
  void choose() noexcept;

  [[nodiscard]] std::span<const NearBody> bodies() const noexcept {
    return {bodies_.data(), count_};
  }
  /// Bodies nearby that the servo cannot hold.
  [[nodiscard]] std::size_t left_out() const noexcept { return left_out_; }
  /// If some are left out: a body of the host that has the most here, null if that is ours.
  [[nodiscard]] const RemoteEntity* crowding() const noexcept { return crowding_; }
  [[nodiscard]] bool empty() const noexcept { return count_ == 0; }
  /// Whether a remote hand is touched or closer than `margin` [m].
  [[nodiscard]] bool has_hand(double margin) const noexcept;

 private:
  static constexpr std::size_t kRoom = 4 * kMost;  // between two choices
  struct Rank {
    Party party;
    bool weak = false, far = false, fresh = false;
    std::uint8_t of_sender = 0, of_host = 0;  // bodies before it of the same sender, host
    std::uint64_t shallow = 0;                // smaller if deeper
  };
  // Sort key of bodies: the first value that differs decides.
  struct Key {
    std::uint64_t rank, shallow;
    std::uint8_t at;  // in bodies_
    auto operator<=>(const Key&) const = default;
  };

  void insert(const NearBody& body) noexcept;
  [[nodiscard]] Rank rank_of(const NearBody& body) const noexcept;
  [[nodiscard]] std::span<const Key> sorted(const auto& rank_key) noexcept;
  void note_crowding(std::span<const Key> by_host) noexcept;
  void take_in_order(std::span<const Key> order) noexcept;

  std::array<NearBody, kRoom> bodies_{};
  std::array<Rank, kRoom> ranks_{};  // of bodies_
  std::array<Key, kRoom> keys_{};    // for choose()
  std::size_t count_ = 0;
  std::size_t left_out_ = 0;
  const RemoteEntity* crowding_ = nullptr;
  std::array<pdu::EntityId, kMost> touched_{};  // at the last check
  std::size_t touched_count_ = 0;
};

/// Writes the hands among the bodies as probes at which a force has to be right; returns their
/// number. A body without a hand feels none of our forces. The radius of a hand closer than
/// `margin` [m] is increased by that margin, because its owner's hand may already be nearer than
/// its copy here, and an error there is felt as soon as both touch.
std::size_t to_probes(std::span<const NearBody> bodies, double margin,
                      std::span<deadreckon::ProbeState, haptics::kMaxRemoteHands> out) noexcept;

}  // namespace reckon::peer
