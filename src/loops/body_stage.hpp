// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The bodies of the scene in a pass of the model loop: their owner sends them, other peers show
// them.
#pragma once

#include <algorithm>
#include <chrono>
#include <optional>

#include "reckon/haptics/bodies/body_world.hpp"
#include "reckon/haptics/exchange/triple_buffer.hpp"
#include "reckon/peer/loops/model_wiring.hpp"
#include "reckon/peer/loops/stepped_bodies.hpp"
#include "reckon/peer/world/body_owner.hpp"
#include "reckon/peer/world/owned_entities.hpp"
#include "reckon/peer/world/peer_view.hpp"
#include "reckon/peer/world/remote_entities.hpp"
#include "reckon/peer/world/shared_bodies.hpp"

namespace reckon::peer {

/// Thread of the model loop.
class BodyStage {
 public:
  explicit BodyStage(const ModelWiring& wiring)
      : scene_(wiring.scene),
        own_(wiring.own_bodies),
        stepped_(wiring.stepped),
        mover_(wiring.mover),
        has_any_(std::ranges::any_of(scene_.scene.objects, [](const haptics::SceneObject& object) {
          return object.matter.mass > 0;
        })) {
    if (mover_ != nullptr) remote_.emplace(mover_->shown(), owner_, scene_.network.interop);
  }

  /// Makes entities of the bodies that this peer owns, by add(number, description), with numbers
  /// from `first` on.
  void add_own(EntityNumber first, auto&& add) {
    first_ = first;
    std::size_t body = 0;
    for (const haptics::SceneObject& object : scene_.scene.objects) {
      const bool is_body = object.matter.mass > 0 && !object.carried;
      if (!is_body && !object.carried) continue;
      const std::size_t number = body++;
      if (is_body) add(static_cast<EntityNumber>(first + number), description_of(object, number));
    }
  }
  /// Steps the bodies, if no servo does, and moves these entities, by move(number, truth). A
  /// sleeping one keeps its last state, which its heartbeat repeats.
  void move_own(std::chrono::nanoseconds now, const OwnedEntities& owned, auto&& move) noexcept {
    if (stepped_ != nullptr) {
      const OwnedEntity* first = owned.find(owned.first_id().entity);
      stepped_->step(now, first != nullptr && first->is_frozen());
    }
    if (own_ == nullptr || !own_->update()) return;
    const haptics::BodyStates& states = own_->read();
    for (std::size_t i = 0; i < states.bodies.size(); ++i) {
      const auto number = static_cast<EntityNumber>(first_ + i);
      const OwnedEntity* entity = owned.find(number);
      const haptics::BodyState& body = states.bodies[i];
      if (entity == nullptr || body.carried) continue;
      if (body.awake || !entity->is_resting() || entity->truth().position != body.position)
        move(number, truth_of(body, states.time));
    }
  }

  /// Takes an update that the table of remote entities has accepted.
  void note(const Inbound& update, const Arrival& arrival, const aoim::Presence& presence,
            RemoteEntities& remote) noexcept {
    if (!remote_ || !update.has_state || !body_of(update.state.entity_type)) return;
    if (owner_.epoch() == 0) owner_.look(presence);
    remote_->note(update, arrival, remote);
  }
  /// Publishes the bodies of other owners. @param offset universal time minus the servos' time
  void publish(std::chrono::nanoseconds offset, RemoteEntities& remote) noexcept {
    if (mover_ == nullptr) return;
    mover_->set_offset(offset);
    remote_->publish(remote);
  }
  /// Finds the owner of the bodies among the peers, if the scene has any.
  void look(const aoim::Presence& presence) noexcept {
    if (has_any_) owner_.look(presence);
  }
  /// When move_own() is due if no servo steps the bodies.
  [[nodiscard]] std::chrono::nanoseconds next_step() const noexcept {
    return stepped_ != nullptr ? stepped_->next_step() : std::chrono::nanoseconds::max();
  }
  [[nodiscard]] const BodyOwner& owner() const noexcept { return owner_; }
  /// Writes their number, and the number of awake ones.
  void show(PeerView& view) const noexcept {
    if (own_ == nullptr) return;
    const haptics::BodyStates& states = own_->read();
    view.bodies = states.bodies.size();
    view.bodies_awake =
        static_cast<std::size_t>(std::ranges::count_if(states.bodies, &haptics::BodyState::awake));
    view.bodies_not_woken = states.crowded;
  }

 private:
  [[nodiscard]] EntityDescription description_of(const haptics::SceneObject& object,
                                                 std::size_t number) const {
    EntityDescription description;
    description.marking = object.name;
    description.type = body_type(number);
    description.dead_reckoning = scene_.dead_reckoning;
    return description;
  }

  const SceneFile& scene_;
  haptics::TripleBuffer<haptics::BodyStates>* own_;  // null: none are ours
  EntityNumber first_ = 0;
  SteppedBodies* stepped_;  // null: servos step the bodies
  BodyMover* mover_;        // null: nothing is or will be carried
  bool has_any_;            // whether the scene has bodies, of any owner
  BodyOwner owner_;
  std::optional<RemoteBodies> remote_;
};

}  // namespace reckon::peer
