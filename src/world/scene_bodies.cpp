// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/world/scene_bodies.hpp"

namespace reckon::peer {

bool SceneBodies::admits(const Inbound& update, const Arrival& arrival) noexcept {
  const aoim::BodyOwnership owner = owners_->of(update.entity);
  const bool is_named = update.ownership && update.ownership->owner == arrival.epoch;
  if (!is_named || arrival.epoch == 0 || owner.epoch != arrival.epoch) {
    counts_.bodies_disputed.add();
    last_disputed_ = {update.entity, arrival.from};
    return false;
  }
  const std::uint64_t version = update.ownership->version;
  aoim::BodyOwnership& last = recorded_[update.entity.entity - 1u];
  const bool is_older = last.epoch == arrival.epoch && version < last.version;
  if (version < owner.version || is_older) return counts_.bodies_stale.add(), false;
  last = {arrival.epoch, version};
  return true;
}

}  // namespace reckon::peer
