// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/world/tracked_entities.hpp"

namespace reckon::peer {

EntityDescription description_of(const EntityConfig& config) {
  EntityDescription description;
  description.marking = config.marking;
  description.type = config.type;
  description.force_id = config.force_id;
  description.appearance = config.appearance;
  description.capabilities = config.capabilities;
  description.dead_reckoning = config.dead_reckoning;
  description.model = config.model;
  description.power = config.power;
  description.beacon = config.beacon;
  return description;
}

EntityTruth truth_of(const deadreckon::KinematicState& motion,
                     std::chrono::nanoseconds now) noexcept {
  EntityTruth truth;
  truth.time = now;
  truth.position = motion.position;
  truth.orientation = motion.orientation;
  truth.velocity = motion.velocity;
  truth.acceleration = motion.acceleration;
  truth.angular_velocity = motion.angular_velocity;
  return truth;
}

void TrackedEntities::begin(std::chrono::nanoseconds now) noexcept {
  begun_ = now;
  for (Tracked& tracked : tracks_) tracked.due = now;
}

// The first truth of all entities is sent at once. After that, each has a different time within the
// period.
std::chrono::nanoseconds TrackedEntities::next_of(const Tracked& tracked,
                                                  std::chrono::nanoseconds now) const noexcept {
  constexpr int kPlaces = 16;
  if (now > begun_) return now + tracked.period;
  return now + tracked.period + (tracked.number % kPlaces) * tracked.period / kPlaces;
}

}  // namespace reckon::peer
