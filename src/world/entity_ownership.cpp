// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/world/entity_ownership.hpp"

namespace reckon::peer {
namespace {

using std::chrono::nanoseconds;

// Longest silence of the owner after which it still owns the row.
nanoseconds patience_with(const RemoteEntity& row) {
  return row.epoch != 0 ? RowOwners::kSilence : RowOwners::patience_with_guest(row.timeout);
}

}  // namespace

// @param row of the entity, null if it has none  @param owner set if the sender is refused
SenderRight EntityOwnership::right_of(const pdu::EntityId& id, const Arrival& arrival,
                                      const RemoteEntity* row,
                                      aoim::SourceAddress& owner) const noexcept {
  // RemoteEntities::claim() ensures this
  if (row != nullptr && is_owner(*row, arrival)) return SenderRight::owner;
  const aoim::Presence& presence = aoim_.presence();
  if (bodies_.contains(id)) {
    const std::uint32_t epoch = bodies_.owner_of(id);
    if (epoch != 0 && epoch == arrival.epoch) return SenderRight::owner;
    owner = presence.source_of(epoch).value_or(aoim::SourceAddress());
    return SenderRight::refused;
  }
  if (const auto epoch = presence.epoch_of(id.simulation())) {
    if (*epoch == arrival.epoch) return SenderRight::owner;
    owner = presence.source_of(*epoch).value_or(aoim::SourceAddress());
    return SenderRight::refused;
  }
  if (row == nullptr) {
    const aoim::SourceAddress* guest = outside_.guest_of(id, arrival.now);
    if (guest == nullptr) return SenderRight::unknown;
    if (arrival.epoch == 0 && same(*guest, arrival.from)) return SenderRight::owner;
    owner = *guest;
    return SenderRight::refused;
  }
  const std::size_t place = table_.place_of(*row);
  if (arrival.now - owners_.last_heard(place) > patience_with(*row)) return SenderRight::unknown;
  owner = owners_.owner(place);
  return SenderRight::refused;
}

bool EntityOwnership::may_update(const pdu::EntityId& id, const Arrival& arrival,
                                 const RemoteEntity* row) noexcept {
  aoim::SourceAddress owner;
  if (right_of(id, arrival, row, owner) != SenderRight::refused) return true;
  refuse(id, arrival, owner);
  return false;
}

SenderRight EntityOwnership::sender_right(std::span<const pdu::EntityId> ids,
                                          const Arrival& arrival) noexcept {
  const pdu::EntityId* other = nullptr;
  aoim::SourceAddress owner;
  for (const pdu::EntityId& id : ids) {
    const SenderRight right = aoim_.presence().is_own(id)
                                  ? SenderRight::refused
                                  : right_of(id, arrival, table_.find(id), owner);
    if (right == SenderRight::owner) return right;
    if (right == SenderRight::refused && other == nullptr) other = &id;
  }
  if (other == nullptr) return SenderRight::unknown;
  refuse(*other, arrival, owner);
  return SenderRight::refused;
}

void EntityOwnership::refuse(const pdu::EntityId& id, const Arrival& arrival,
                             const aoim::SourceAddress& owner) noexcept {
  refused_.add();
  disputes_.note({id.simulation(), owner, arrival.from}, arrival.now);
}

}  // namespace reckon::peer
