// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Which received updates of the scene's bodies are taken: those of their owner, with the record of
// its ownership.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>

#include "reckon/aoim/groups/body_owners.hpp"
#include "reckon/aoim/presence/presence.hpp"
#include "reckon/deadreckon/motion/drm.hpp"
#include "reckon/peer/world/arrival.hpp"
#include "reckon/peer/world/datagram_decoder.hpp"
#include "reckon/peer/world/force_model_intake.hpp"
#include "reckon/peer/world/remote_counters.hpp"
#include "reckon/peer/world/state_table.hpp"

namespace reckon::peer {

/// The received side of the bodies' ownership. One thread; no allocation; some ns for other
/// entities.
class SceneBodies {
 public:
  /// References outlive this.  @param owners null in a plain DIS exercise, where a body has an ID
  /// of its sender, and an ID of the scene is like any other
  SceneBodies(const aoim::BodyOwners* owners, const aoim::Presence& presence,
              const RemoteCounters& counts)
      : owners_(owners), presence_(presence), counts_(counts) {}

  /// Whether only the owner of a body may send this entity.
  [[nodiscard]] bool contains(const pdu::EntityId& id) const noexcept {
    return owners_ != nullptr && aoim::BodyOwners::are_for(id);
  }
  /// Whether an update of a body may be taken; then its ownership is recorded, else it is counted.
  [[nodiscard]] bool admits(const Inbound& update, const Arrival& arrival) noexcept;
  /// Epoch of the owner of a body; 0 if it is not known.
  [[nodiscard]] std::uint32_t owner_of(const pdu::EntityId& body) const noexcept {
    return owners_->of(body).epoch;
  }
  /// Last recorded owner of a body, and the version.
  [[nodiscard]] const aoim::BodyOwnership& recorded(const pdu::EntityId& body) const noexcept {
    return recorded_[body.entity - 1u];
  }
  /// Whether it is a body whose owner is not in the exercise.
  [[nodiscard]] bool is_orphan(const RemoteEntity& row) const noexcept {
    return contains(row.id) && row.epoch != presence_.own().epoch &&
           presence_.standing(row.epoch) != aoim::Standing::member;
  }
  /// Position and velocity for the check against the radius of interest. A body or a resting entity
  /// is at its stated position: if the owner of a body fails, a new owner adopts it there.
  [[nodiscard]] RemoteEntity::Motion seen(const RemoteEntity& row,
                                          std::chrono::nanoseconds now) const noexcept {
    const deadreckon::KinematicState& stated = row.state.motion();
    if (contains(row.id) || deadreckon::stands_still(stated))
      return {stated.position, Eigen::Vector3d::Zero()};
    return row.motion(now);
  }
  /// Simulation address of the owner of a row; of an orphan the scene's.
  [[nodiscard]] aoim::PeerId owner_of(const RemoteEntity& row) const noexcept {
    const aoim::PeerId named = row.id.simulation();
    return contains(row.id) ? presence_.id_of(row.epoch).value_or(named) : named;
  }

  /// Updates whose sender does not own the body, and the last such body.
  [[nodiscard]] std::uint64_t disputed() const noexcept { return counts_.bodies_disputed.value(); }
  [[nodiscard]] const Untouchable& last_disputed() const noexcept { return last_disputed_; }

 private:
  struct Early {
    std::uint32_t epoch = 0;
    std::chrono::nanoseconds since{0}, last{0};
  };
  [[nodiscard]] bool is_early(const Inbound& update, const Arrival& arrival,
                              const aoim::BodyOwnership& owner) noexcept;

  const aoim::BodyOwners* owners_;
  const aoim::Presence& presence_;
  const RemoteCounters& counts_;
  std::array<aoim::BodyOwnership, aoim::BodyOwners::kMost> recorded_{};
  std::array<Early, aoim::BodyOwners::kMost> early_{};
  Untouchable last_disputed_;
};

}  // namespace reckon::peer
