// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The bodies that an entity of ours could touch within an update: of others and our own, and which
// of them a servo takes where they are more than it can hold.
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

/// Farther away than this between surfaces [m], a body is not worth the servo's time; nothing moves
/// so far within one update.
inline constexpr double kContactReach = 0.25;

/// One body with a force model: a row of the state table or an entity of ours.
struct NearBody {
  const RemoteEntity* row = nullptr;                   ///< null for one of ours
  const OwnedEntity* own = nullptr;                    ///< null for one of others
  pdu::EntityId id;
  EntityNumber number = 0;                             ///< of ours
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();    ///< of its model's point, S [m]
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< S [m/s]
  double depth = 0.0;                                  ///< [m]; below 0 the surfaces are apart

  [[nodiscard]] const deadreckon::ForceModel& model() const noexcept {
    return row != nullptr ? row->model : own->touch()->model();
  }
  /// Whether somebody holds it, who feels what touches it.
  [[nodiscard]] bool is_hand() const noexcept {
    return (row != nullptr ? row->type.kind : own->type().kind) == pdu::EntityKind::life_form;
  }
};

/// The bodies near one probe. Pointers are good until the state table or the owned ones change.
///
/// Where they are more than a servo can hold, places are shared: whoever sends the most gives up
/// first. Each host has kSure of them before any has more, and its senders take turns; among equals
/// what touches or nearly does goes before what is farther, a peer's before a guest's, what was
/// touched at the last look before what is new, the deeper before the others. What can give no force
/// that a hand feels comes last. One thread; no allocation.
class NearBodies {
 public:
  static constexpr std::size_t kMost = haptics::kMaxRemoteHands;
  /// Of one host, before what is left goes by rank.
  static constexpr std::size_t kSure = 4;
  /// Apart by less [m], two bodies may touch before the next look at 2 m/s and 15 ms.
  static constexpr double kSoonTouching = 0.03;
  /// [N] a decimetre deep, or at 1 m/s: less is not felt.
  static constexpr double kLeastForce = 1e-3;

  /// A new look begins: those touched at the last one are kept in mind.
  void clear() noexcept;
  /// One of others within reach; choose() is to follow. Some 20 ns; where they are many 100 ns.
  void add(const RemoteEntity& row, const deadreckon::Contact& touch,
           const Eigen::Vector3d& velocity) noexcept;
  /// Looks at our own, but for `except`, and chooses.
  void add_own(const OwnedEntities& owned, EntityNumber except, const deadreckon::ProbeState& probe,
               std::chrono::nanoseconds now) noexcept;
  /// Orders them by rank and leaves out those without a place; after the last one was added.
  void choose() noexcept;

  [[nodiscard]] std::span<const NearBody> bodies() const noexcept {
    return {bodies_.data(), count_};
  }
  /// Near by, but beyond what a servo can hold.
  [[nodiscard]] std::size_t left_out() const noexcept { return left_out_; }
  /// Where some are left out: one of the host that has the most here, null where that is ours.
  [[nodiscard]] const RemoteEntity* crowding() const noexcept { return crowding_; }
  [[nodiscard]] bool empty() const noexcept { return count_ == 0; }
  /// Whether a hand of others is touched, or apart by less than `margin` [m].
  [[nodiscard]] bool has_hand(double margin) const noexcept;

 private:
  static constexpr std::size_t kRoom = 4 * kMost;  // between two choices
  struct Rank {
    Party party;
    bool weak = false, far = false, fresh = false;
    std::uint8_t of_sender = 0, of_host = 0;  // how many of them go before it
    std::uint64_t shallow = 0;  // the less, the deeper
  };
  // What bodies are sorted by: the first of these that differs.
  struct Key {
    std::uint64_t rank, shallow;
    std::uint8_t at;  // in bodies_
    auto operator<=>(const Key&) const = default;
  };

  void insert(const NearBody& body) noexcept;
  [[nodiscard]] Rank rank_of(const NearBody& body) const noexcept;
  template <typename RankKey>
  [[nodiscard]] std::span<const Key> sorted(const RankKey& rank_key) noexcept;
  void note_crowding(std::span<const Key> by_host) noexcept;
  void take_in_order(std::span<const Key> order) noexcept;

  std::array<NearBody, kRoom> bodies_{};
  std::array<Rank, kRoom> ranks_{};  // of bodies_
  std::array<Key, kRoom> keys_{};    // for choose()
  std::size_t count_ = 0;
  std::size_t left_out_ = 0;
  const RemoteEntity* crowding_ = nullptr;
  std::array<pdu::EntityId, kMost> touched_{};  // at the last look
  std::size_t touched_count_ = 0;
};

/// The hands among the bodies as probes at which a force has to be right; returns how many were
/// written. At what nobody holds, nobody feels ours. One that is apart by less than `margin` [m] is
/// so much larger: its owner's hand may be nearer by then than its copy, and what is off by a
/// little there is felt as soon as both touch.
std::size_t to_probes(std::span<const NearBody> bodies, double margin,
                      std::span<deadreckon::ProbeState, haptics::kMaxRemoteHands> out) noexcept;

}  // namespace reckon::peer
