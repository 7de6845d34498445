// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The bodies of the scene in a pass of the model loop: their owner sends them, other peers show
// them.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <optional>
#include <vector>

#include "reckon/aoim/groups/body_owners.hpp"
#include "reckon/aoim/presence/presence.hpp"
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
        mover_(wiring.mover) {
    std::size_t moving = 0;
    for (const haptics::SceneObject& object : scene_.scene.objects) {
      const bool is_body = object.matter.mass > 0 && !object.carried;
      if (!is_body && !object.carried) continue;
      if (is_body && moving < kMostSharedBodies) bodies_.push_back({moving, &object});
      ++moving;
    }
    if (mover_ != nullptr) remote_.emplace(mover_->shown(), scene_.network.interop);
  }

  /// Makes entities of the bodies that this peer owns, at their numbers in the table from `first`
  /// on.  @param epoch of this peer
  void add_own(EntityNumber first, std::uint32_t epoch, OwnedEntities& owned) {
    first_ = first;
    pdu::OwnershipRecord ownership;
    ownership.owner = epoch;
    ownership.version = kFirstVersion;
    for (const Body& body : bodies_) {
      const auto number = static_cast<EntityNumber>(first + body.number);
      const EntityDescription description = description_of(*body.object, body.number);
      if (scene_.network.interop)
        static_cast<void>(owned.add(number, description));
      else
        static_cast<void>(owned.add_body(number, description, body_id(body.number), ownership));
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

  /// Finds the owner before an update of a body that the known owner has not sent. Call it for each
  /// update; some ns for most.
  void prepare(const Inbound& update, const Arrival& arrival, const aoim::Presence& presence,
               OwnedEntities& owned) noexcept {
    const bool is_new = aoim::BodyOwners::are_for(update.entity) && arrival.epoch != 0 &&
                        arrival.epoch != owner_.epoch() && looked_ < arrival.now;
    if (is_new) look(presence, owned, arrival.now);
  }
  /// Takes an update that the table of remote entities has accepted.
  void note(const Inbound& update, const Arrival& arrival, RemoteEntities& remote) noexcept {
    if (remote_ && update.has_state) remote_->note(update, arrival, remote);
  }
  /// Publishes the bodies of other owners. @param offset universal time minus the servos' time
  void publish(std::chrono::nanoseconds offset, const RemoteEntities& remote) noexcept {
    if (mover_ == nullptr) return;
    mover_->set_offset(offset);
    remote_->publish(remote);
  }
  /// Finds the owner of the bodies among the peers, if the scene has any, and writes the table of
  /// owners: one owner of all, with any version. After a rival of the owner has gone, the bodies of
  /// this peer are sent anew, because others may have refused their last states.
  void look(const aoim::Presence& presence, OwnedEntities& owned,
            std::chrono::nanoseconds now) noexcept {
    if (bodies_.empty()) return;
    looked_ = now;
    const bool had_rival = owner_.rival().has_value();
    owner_.look(presence);
    for (const Body& body : bodies_) owners_.set(body.number, {owner_.epoch(), 0});
    if (had_rival && !owner_.rival() && own_ != nullptr) restate(owned);
  }
  /// The owner of each body; null in an `interop` exercise.
  [[nodiscard]] const aoim::BodyOwners* owners() const noexcept {
    return scene_.network.interop ? nullptr : &owners_;
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
  static constexpr std::uint64_t kFirstVersion = 1;
  struct Body {
    std::size_t number;  // among the moving objects
    const haptics::SceneObject* object;
  };
  [[nodiscard]] EntityDescription description_of(const haptics::SceneObject& object,
                                                 std::size_t number) const {
    EntityDescription description;
    description.marking = object.name;
    description.type = body_type(number);
    description.dead_reckoning = scene_.dead_reckoning;
    return description;
  }

  void restate(OwnedEntities& owned) noexcept {
    for (const Body& body : bodies_) {
      const auto number = static_cast<EntityNumber>(first_ + body.number);
      if (OwnedEntity* entity = owned.find(number)) entity->event();
      owned.look_at(number);
    }
  }

  const SceneFile& scene_;
  haptics::TripleBuffer<haptics::BodyStates>* own_;  // null: none are ours
  EntityNumber first_ = 0;
  SteppedBodies* stepped_;    // null: servos step the bodies
  BodyMover* mover_;          // null: nothing is or will be carried
  std::vector<Body> bodies_;  // of the scene, of any owner
  BodyOwner owner_;
  aoim::BodyOwners owners_;
  std::chrono::nanoseconds looked_{-1};
  std::optional<RemoteBodies> remote_;
};

}  // namespace reckon::peer
