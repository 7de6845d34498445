// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/world/near_bodies.hpp"

#include <algorithm>

namespace reckon::peer {

using std::chrono::nanoseconds;

void NearBodies::add_remote(const NearEntities& found) noexcept {
  left_out_ += found.left_out();
  for (const NearEntity& near : found.all()) {
    NearBody body;
    body.row = near.row;
    body.centre = near.point;
    body.velocity = near.velocity;
    body.depth = near.depth;
    insert(body);
  }
}

void NearBodies::add_own(const OwnedEntities& owned, EntityNumber except,
                         const deadreckon::ProbeState& probe, nanoseconds now) noexcept {
  for (const EntityNumber number : owned.touchable()) {
    const OwnedEntity* entity = owned.find(number);
    if (number == except || entity->truth().time <= nanoseconds(0)) continue;
    const EntityTruth truth = entity->truth_at(now);
    const deadreckon::Pose pose{truth.position, truth.orientation, truth.velocity,
                                truth.angular_velocity};
    NearBody body;
    body.own = entity;
    body.number = number;
    body.centre = pose.position + pose.orientation * entity->touch()->model().point;
    body.velocity = pose.velocity;
    body.depth =
        deadreckon::contact(entity->touch()->model(), pose, probe.position, probe.radius).depth;
    insert(body);
  }
}

bool NearBodies::has_hand(double margin) const noexcept {
  return std::any_of(bodies().begin(), bodies().end(), [&](const NearBody& body) {
    return body.row != nullptr && body.depth > -margin && body.is_hand();
  });
}

void NearBodies::insert(const NearBody& body) noexcept {
  if (!(body.depth >= -kContactReach)) return;
  const auto end = bodies_.begin() + static_cast<std::ptrdiff_t>(count_);
  const auto place =
      std::find_if(bodies_.begin(), end, [&](const NearBody& b) { return body.depth > b.depth; });
  if (count_ == bodies_.size()) ++left_out_;
  if (place == bodies_.end()) return;
  count_ = std::min(count_ + 1, bodies_.size());
  std::move_backward(place, bodies_.begin() + static_cast<std::ptrdiff_t>(count_) - 1,
                     bodies_.begin() + static_cast<std::ptrdiff_t>(count_));
  *place = body;
}

std::size_t to_probes(std::span<const NearBody> bodies, double margin,
                      std::span<deadreckon::ProbeState, haptics::kMaxRemoteHands> out) noexcept {
  std::size_t count = 0;
  for (const NearBody& body : bodies) {
    if (!body.is_hand()) continue;
    const bool nearly = body.depth < 0 && body.depth > -margin;
    out[count++] = {body.centre, body.velocity, body.model().radius + (nearly ? margin : 0.0)};
  }
  return count;
}

}  // namespace reckon::peer
