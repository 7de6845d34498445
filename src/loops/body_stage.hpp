// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The bodies of the scene in a pass of the model loop: their owner sends them, other peers show
// them.
#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "reckon/aoim/groups/body_owners.hpp"
#include "reckon/haptics/bodies/body_world.hpp"
#include "reckon/haptics/exchange/triple_buffer.hpp"
#include "reckon/peer/loops/entity_sender.hpp"
#include "reckon/peer/loops/model_wiring.hpp"
#include "reckon/peer/loops/stepped_bodies.hpp"
#include "reckon/peer/world/owned_entities.hpp"
#include "reckon/peer/world/peer_view.hpp"
#include "reckon/peer/world/remote_entities.hpp"
#include "reckon/peer/world/shared_bodies.hpp"

namespace reckon::peer {

/// Thread of the model loop.
class BodyStage {
 public:
  explicit BodyStage(const ModelWiring& wiring);

  /// Makes an entity of each body, at its number in the table from `first` on. It is sent while
  /// this peer owns it; in an `interop` exercise always.
  void add_own(EntityNumber first, OwnedEntities& owned);
  /// Sets who owns a body of this peer's table; its states carry the record.
  /// @param ownership with owner 0: another peer owns it
  /// @return whether this peer begins to own it
  bool set_own(std::size_t body, const pdu::OwnershipRecord& ownership,
               OwnedEntities& owned) noexcept;
  /// The entity of a body; null if there is none.
  [[nodiscard]] OwnedEntity* entity_of(std::size_t body, OwnedEntities& owned) const noexcept {
    return first_ == 0 ? nullptr : owned.find(static_cast<EntityNumber>(first_ + body));
  }
  /// Shows a body that this peer has stopped simulating as it would be received from this peer.
  /// @param end its last state, of this pass or earlier  @param ownership of this peer
  void leave(const haptics::BodyEnd& end, const Pass& pass, const pdu::OwnershipRecord& ownership,
             OwnedEntities& owned, RemoteEntities& remote) noexcept;

  /// Notes where its owner states a body, also beyond the radius of interest.
  void note_place(std::size_t body, const pdu::EntityState& state) noexcept;
  /// Motion of a body as this peer knows it: as shown, but with the dead-reckoned velocity, without
  /// that of the convergence; else as last stated or simulated.
  [[nodiscard]] haptics::ObjectMotion motion_now(std::size_t body, const RemoteEntities& remote,
                                                 std::chrono::nanoseconds now) const noexcept;

  /// Of an owned body [m/s^2]: gravity while it falls freely, else zero.
  [[nodiscard]] const Eigen::Vector3d& acceleration_of(std::size_t body) const noexcept {
    return motions_[body].acceleration;
  }

  /// Names the owner whose states of a body are taken.
  void name_owner(std::size_t body, const aoim::BodyOwnership& owner) noexcept {
    owners_.set(body, owner);
  }
  /// Whether the scene gives this object a mass, and nothing else moves it.
  [[nodiscard]] bool is_body(std::size_t number) const noexcept {
    return std::ranges::find(bodies_, number, &Body::number) != bodies_.end();
  }
  /// All moving objects, as last read.
  [[nodiscard]] const haptics::BodyStates* states() const noexcept {
    return own_ == nullptr ? nullptr : &own_->read();
  }

  /// Steps the bodies, if no servo does, and reads their states.
  void read(std::chrono::nanoseconds now, const OwnedEntities& owned) noexcept;
  /// Moves the entities of owned bodies, by move(number, truth, whether it was knocked). A sleeping
  /// one keeps its last state, which its heartbeat repeats.
  void move_own(const OwnedEntities& owned, auto&& move) noexcept {
    if (!std::exchange(is_fresh_, false)) return;
    const haptics::BodyStates& states = own_->read();
    for (std::size_t i = 0; i < states.bodies.size(); ++i) {
      const auto number = static_cast<EntityNumber>(first_ + i);
      const OwnedEntity* entity = owned.find(number);
      const haptics::BodyState& body = states.bodies[i];
      if (entity == nullptr || !body.is_owned() || !entity->is_ours()) continue;
      if (!body.awake && entity->is_resting() && is_at(*entity, body)) continue;
      EntityTruth truth = truth_of(body, states.time);
      truth.acceleration = motions_[i].acceleration;
      move(number, truth, std::exchange(motions_[i].is_due, false));
    }
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
  /// The owner of each body; null in an `interop` exercise.
  [[nodiscard]] const aoim::BodyOwners* owners() const noexcept {
    return scene_.network.interop ? nullptr : &owners_;
  }
  /// When read() is due if no servo steps the bodies.
  [[nodiscard]] std::chrono::nanoseconds next_step() const noexcept {
    return stepped_ != nullptr ? stepped_->next_step() : std::chrono::nanoseconds::max();
  }
  /// Writes their number, and the number of awake ones.
  void show(PeerView& view) const noexcept;

 private:
  // Between two read states of an owned body.
  struct Motion {
    Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
    Eigen::Vector3d acceleration = Eigen::Vector3d::Zero();
    int waits = 0;        // readings until a knock is sent
    bool is_due = false;  // a knock is to be sent
  };
  struct Stated {
    Eigen::Vector3d position;
    Eigen::Quaterniond orientation;
  };
  struct Body {
    std::size_t number;  // among the moving objects
    const haptics::SceneObject* object;
  };
  [[nodiscard]] EntityDescription description_of(const haptics::SceneObject& object,
                                                 std::size_t number) const;
  void note_motions() noexcept;
  [[nodiscard]] static bool is_at(const OwnedEntity& entity,
                                  const haptics::BodyState& body) noexcept;

  const SceneFile& scene_;
  const deadreckon::LocalFrame& frame_;
  haptics::TripleBuffer<haptics::BodyStates>* own_;  // null: the scene moves nothing here
  EntityNumber first_ = 0;
  SteppedBodies* stepped_;    // null: servos step the bodies
  BodyMover* mover_;          // null: nothing is or will be carried
  std::vector<Body> bodies_;  // of the scene, of any owner
  bool is_fresh_ = false;     // what own_ reads, or who owns it, since move_own()
  std::array<Motion, kMostSharedBodies> motions_{};
  std::chrono::nanoseconds read_at_{0};  // time of these
  aoim::BodyOwners owners_;
  std::array<std::optional<Stated>, kMostSharedBodies> stated_{};  // by other owners
  std::optional<RemoteBodies> remote_;
};

}  // namespace reckon::peer
