// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/loops/body_stage.hpp"

#include <algorithm>

namespace reckon::peer {

BodyStage::BodyStage(const ModelWiring& wiring)
    : scene_(wiring.scene),
      own_(wiring.own_bodies),
      mover_(wiring.mover),
      has_any_(std::ranges::any_of(scene_.scene.objects, [](const haptics::SceneObject& object) {
        return object.matter.mass > 0;
      })) {
  if (mover_ != nullptr) remote_.emplace(mover_->shown(), owner_, scene_.network.interop);
}

EntityDescription BodyStage::description_of(const haptics::SceneObject& object,
                                            std::size_t number) const {
  EntityDescription description;
  description.marking = object.name;
  description.type = body_type(number);
  description.dead_reckoning = scene_.dead_reckoning;
  return description;
}

void BodyStage::note(const Inbound& update, const Arrival& arrival, const aoim::Presence& presence,
                     RemoteEntities& remote) noexcept {
  if (!remote_ || !update.has_state || !body_of(update.state.entity_type)) return;
  if (owner_.epoch() == 0) owner_.look(presence);
  remote_->note(update, arrival, remote);
}

void BodyStage::publish(std::chrono::nanoseconds offset, RemoteEntities& remote) noexcept {
  if (mover_ == nullptr) return;
  mover_->set_offset(offset);
  remote_->publish(remote);
}

void BodyStage::show(PeerView& view) const noexcept {
  if (own_ == nullptr) return;
  const haptics::BodyStates& states = own_->read();
  view.bodies = states.bodies.size();
  view.bodies_awake =
      static_cast<std::size_t>(std::ranges::count_if(states.bodies, &haptics::BodyState::awake));
  view.bodies_not_woken = states.crowded;
}

}  // namespace reckon::peer
