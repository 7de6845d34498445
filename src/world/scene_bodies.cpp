// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/world/scene_bodies.hpp"

namespace reckon::peer {
namespace {

constexpr std::chrono::seconds kEarly{1};

}  // namespace

// A new owner may be received before what made it the owner.
bool SceneBodies::is_early(const Inbound& update, const Arrival& arrival,
                           const aoim::BodyOwnership& owner) noexcept {
  const std::size_t body = update.entity.entity - 1u;
  const bool is_newer = update.ownership->version > owner.version;
  if (!is_newer || body >= early_.size() ||
      presence_.standing(arrival.epoch, &arrival.from) != aoim::Standing::member)
    return false;
  Early& early = early_[body];
  if (early.epoch != arrival.epoch || arrival.now - early.last > kEarly)
    early = {arrival.epoch, arrival.now, arrival.now};
  early.last = arrival.now;
  return arrival.now - early.since < kEarly;
}

bool SceneBodies::admits(const Inbound& update, const Arrival& arrival) noexcept {
  const aoim::BodyOwnership owner = owners_->of(update.entity);
  const bool is_named = update.ownership && update.ownership->owner == arrival.epoch;
  if (!is_named || arrival.epoch == 0 || owner.epoch != arrival.epoch) {
    if (is_named && is_early(update, arrival, owner)) return counts_.bodies_early.add(), false;
    counts_.bodies_disputed.add();
    last_disputed_ = {update.entity, arrival.from};
    return false;
  }
  const std::uint64_t version = update.ownership->version;
  aoim::BodyOwnership& last = recorded_[update.entity.entity - 1u];
  const bool is_new = last.epoch != arrival.epoch;
  // The table may lag behind the last owner, unless it names this very version.
  const bool counts = is_new && version != owner.version &&
                      presence_.standing(last.epoch) == aoim::Standing::member;
  const bool is_older = is_new ? counts && version <= last.version : version < last.version;
  if (version < owner.version || is_older) return counts_.bodies_stale.add(), false;
  last = {arrival.epoch, version};
  return true;
}

}  // namespace reckon::peer
