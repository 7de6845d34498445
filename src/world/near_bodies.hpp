// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The bodies that an entity of ours could touch within an update: of others and our own, nearest
// first.
#pragma once

#include <Eigen/Core>
#include <array>
#include <chrono>
#include <cstddef>
#include <span>

#include "reckon/deadreckon/force/force_model.hpp"
#include "reckon/haptics/exchange/servo_types.hpp"
#include "reckon/peer/world/near_search.hpp"
#include "reckon/peer/world/owned_entities.hpp"
#include "reckon/peer/world/state_table.hpp"

namespace reckon::peer {

/// One body with a force model: a row of the state table or an entity of ours.
struct NearBody {
  const RemoteEntity* row = nullptr;                   ///< null for one of ours
  const OwnedEntity* own = nullptr;                    ///< null for one of others
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
class NearBodies {
 public:
  void clear() noexcept { count_ = left_out_ = 0; }
  /// Takes what a search found.
  void add_remote(const NearEntities& found) noexcept;
  /// Looks at our own, but for `except`.
  void add_own(const OwnedEntities& owned, EntityNumber except, const deadreckon::ProbeState& probe,
               std::chrono::nanoseconds now) noexcept;

  [[nodiscard]] std::span<const NearBody> bodies() const noexcept {
    return {bodies_.data(), count_};
  }
  /// Near by, but beyond what a servo can hold; the farthest.
  [[nodiscard]] std::size_t left_out() const noexcept { return left_out_; }
  [[nodiscard]] bool empty() const noexcept { return count_ == 0; }
  /// Whether a hand of others is touched, or apart by less than `margin` [m].
  [[nodiscard]] bool has_hand(double margin) const noexcept;

 private:
  void insert(const NearBody& body) noexcept;

  std::array<NearBody, haptics::kMaxRemoteHands> bodies_{};
  std::size_t count_ = 0;
  std::size_t left_out_ = 0;
};

/// The hands among the bodies as probes at which a force has to be right; returns how many were
/// written. At what nobody holds, nobody feels ours. One that is apart by less than `margin` [m] is
/// so much larger: its owner's hand may be nearer by then than its copy, and what is off by a
/// little there is felt as soon as both touch.
std::size_t to_probes(std::span<const NearBody> bodies, double margin,
                      std::span<deadreckon::ProbeState, haptics::kMaxRemoteHands> out) noexcept;

}  // namespace reckon::peer
