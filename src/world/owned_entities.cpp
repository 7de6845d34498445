// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/world/owned_entities.hpp"

#include <algorithm>

namespace reckon::peer {

using std::chrono::nanoseconds;

std::optional<EntityNumber> EntityNumbers::take() {
  if (next_ < kMostOwned) return static_cast<EntityNumber>(++next_);
  if (free_.empty()) return std::nullopt;
  const EntityNumber number = free_.front();
  free_.pop_front();
  return number;
}

// Null if the number is in use.
OwnedEntity* OwnedEntities::place(EntityNumber number, const EntityDescription& description,
                                  const pdu::EntityId& id) {
  if (number == 0 || number > kMostOwned || find(number) != nullptr) return nullptr;
  if (number > slots_.size()) slots_.resize(number);
  Slot& slot = slots_[number - 1u];
  slot.entity = std::make_unique<OwnedEntity>(frame_, description, id, settings_.exercise,
                                              settings_.teleport_distance);
  slot.entity->set_tiers(settings_.urgent_tiers, settings_.rows);
  slot.scheduled = nanoseconds::max();
  ++size_;
  return slot.entity.get();
}

bool OwnedEntities::add(EntityNumber number, const EntityDescription& description,
                        const EntityTruth& truth) {
  const pdu::EntityId id{settings_.simulation.site, settings_.simulation.application, number};
  OwnedEntity* entity = place(number, description, id);
  if (entity == nullptr) return false;
  entity->compress(settings_.compression);
  if (description.model) touchable_.push_back(number);
  if (truth.time > nanoseconds(0) && entity->move(truth)) look_at(number);
  return true;
}

bool OwnedEntities::add_body(EntityNumber number, const EntityDescription& description,
                             const pdu::EntityId& id, const pdu::OwnershipRecord& ownership) {
  OwnedEntity* entity = place(number, description, id);
  if (entity == nullptr) return false;
  entity->own_by(ownership);
  return true;
}

void OwnedEntities::remove(EntityNumber number) noexcept {
  if (find(number) == nullptr) return;
  Slot& slot = slots_[number - 1u];
  slot.entity.reset();
  slot.scheduled = nanoseconds::max();
  std::erase(touchable_, number);
  --size_;
}

OwnedEntity* OwnedEntities::find(EntityNumber number) noexcept {
  return number == 0 || number > slots_.size() ? nullptr : slots_[number - 1u].entity.get();
}

const OwnedEntity* OwnedEntities::find(EntityNumber number) const noexcept {
  return number == 0 || number > slots_.size() ? nullptr : slots_[number - 1u].entity.get();
}

pdu::EntityId OwnedEntities::first_id() const noexcept {
  for (EntityNumber number = 1; number <= last_number(); ++number) {
    const OwnedEntity* entity = find(number);
    if (entity != nullptr && !entity->is_body()) return entity->id();
  }
  return simulation();
}

void OwnedEntities::rename(const pdu::SimulationAddress& simulation) noexcept {
  settings_.simulation = simulation;
  for_each([&](OwnedEntity& entity, EntityNumber number) {
    if (entity.is_body()) return;
    entity.rename({simulation.site, simulation.application, number});
    look_at(number);
  });
}

void OwnedEntities::look_at(EntityNumber number) noexcept {
  if (find(number) == nullptr) return;
  Slot& slot = slots_[number - 1u];
  if (slot.waits) return;
  slot.waits = true;
  waiting_.push_back(number);
}

void OwnedEntities::note_sent(EntityNumber number) noexcept {
  if (find(number) != nullptr) schedule(slots_[number - 1u], number);
}

// Only the entry at `scheduled` counts. A later entry may be added after it has come up.
void OwnedEntities::schedule(Slot& slot, EntityNumber number) noexcept {
  const nanoseconds time = slot.entity->next_heartbeat();
  if (time >= slot.scheduled) return;
  slot.scheduled = time;
  due_.push_back({time, number});
  std::push_heap(due_.begin(), due_.end());
}

void OwnedEntities::wake_due(nanoseconds now) noexcept {
  while (!due_.empty() && due_.front().time <= now) {
    const Due due = due_.front();
    std::pop_heap(due_.begin(), due_.end());
    due_.pop_back();
    Slot& slot = slots_[due.number - 1u];
    if (!slot.entity || due.time != slot.scheduled) continue;
    slot.scheduled = nanoseconds::max();
    if (slot.entity->next_heartbeat() <= now) {
      look_at(due.number);
    } else {
      schedule(slot, due.number);
    }
  }
}

nanoseconds OwnedEntities::next_due() const noexcept {
  if (!waiting_.empty()) return nanoseconds::min();
  return due_.empty() ? nanoseconds::max() : due_.front().time;
}

}  // namespace reckon::peer
