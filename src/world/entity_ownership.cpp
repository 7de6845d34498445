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
Voice EntityOwnership::voice_of(const pdu::EntityId& id, const Arrival& arrival,
                                const RemoteEntity* row,
                                aoim::SourceAddress& owner) const noexcept {
  // RemoteEntities::claim() ensures this
  if (row != nullptr && is_owner(*row, arrival)) return Voice::owner;
  const aoim::Presence& presence = aoim_.presence();
  if (const auto epoch = presence.epoch_of(id.simulation())) {
    if (*epoch == arrival.epoch) return Voice::owner;
    owner = presence.source_of(*epoch).value_or(aoim::SourceAddress());
    return Voice::refused;
  }
  if (row == nullptr) {
    const aoim::SourceAddress* guest = outside_.guest_of(id, arrival.now);
    if (guest == nullptr) return Voice::nobody;
    if (arrival.epoch == 0 && same(*guest, arrival.from)) return Voice::owner;
    owner = *guest;
    return Voice::refused;
  }
  const std::size_t place = table_.place_of(*row);
  if (arrival.now - owners_.last_heard(place) > patience_with(*row)) return Voice::nobody;
  owner = owners_.owner(place);
  return Voice::refused;
}

bool EntityOwnership::may_speak(const pdu::EntityId& id, const Arrival& arrival,
                                const RemoteEntity* row) noexcept {
  aoim::SourceAddress owner;
  if (voice_of(id, arrival, row, owner) != Voice::refused) return true;
  refuse(id, arrival, owner);
  return false;
}

Voice EntityOwnership::hear(std::span<const pdu::EntityId> ids, const Arrival& arrival) noexcept {
  const pdu::EntityId* other = nullptr;
  aoim::SourceAddress owner;
  for (const pdu::EntityId& id : ids) {
    const Voice voice =
        aoim_.presence().is_own(id) ? Voice::refused : voice_of(id, arrival, table_.find(id), owner);
    if (voice == Voice::owner) return voice;
    if (voice == Voice::refused && other == nullptr) other = &id;
  }
  if (other == nullptr) return Voice::nobody;
  refuse(*other, arrival, owner);
  return Voice::refused;
}

void EntityOwnership::refuse(const pdu::EntityId& id, const Arrival& arrival,
                             const aoim::SourceAddress& owner) noexcept {
  refused_.add();
  disputes_.note({id.simulation(), owner, arrival.from}, arrival.now);
}

}  // namespace reckon::peer
