// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Entities of peers that leave, become silent or are received again.
#include <algorithm>

#include "reckon/peer/world/remote_entities.hpp"

namespace reckon::peer {

using std::chrono::nanoseconds;

void RemoteEntities::drop_peer(aoim::PeerId id, Gone how, nanoseconds now) noexcept {
  const Removal cause = how == Gone::silent ? Removal::silent : Removal::owner_left;
  // Erasing moves the last row into the hole, so look at the same place again.
  for (std::size_t i = 0; i < table_.rows().size();) {
    if (table_.rows()[i].id.simulation() == id) {
      drop(i, cause);
    } else {
      if (bodies_.is_orphan(table_.rows()[i])) doubt_row(i, now);
      ++i;
    }
  }
  outside_.forget_if([id](const OutsideEntity& entity) { return entity.id().simulation() == id; });
}

void RemoteEntities::doubt_peer(std::uint32_t epoch, nanoseconds now) noexcept {
  const std::span<const RemoteEntity> rows = table_.rows();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i].epoch == epoch) doubt_row(i, now);
  }
}

void RemoteEntities::doubt(const pdu::EntityId& id, nanoseconds now) noexcept {
  if (const RemoteEntity* row = table_.find(id)) doubt_row(table_.place_of(*row), now);
}

void RemoteEntities::believe_peer(std::uint32_t epoch, nanoseconds silent,
                                  nanoseconds now) noexcept {
  const std::span<RemoteEntity> rows = table_.rows();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    RemoteEntity& row = rows[i];
    if (row.epoch != epoch) continue;
    const bool doubted = row.doubted_at != RemoteEntity::kTrusted;
    const bool is_hand = row.haptic && row.type.kind == pdu::EntityKind::life_form;
    if (doubted || (is_hand && row.last_heard < silent)) end_force(row);
    if (doubted) believe_row(i, now);
  }
}

void RemoteEntities::end_force(const pdu::EntityId& id) noexcept {
  if (RemoteEntity* row = table_.find(id)) end_force(*row);
}

nanoseconds RemoteEntities::note_pressed(const pdu::EntityId& id, nanoseconds now) noexcept {
  RemoteEntity* row = table_.find(id);
  if (row == nullptr) return now;
  row->pressed_at = std::min(row->pressed_at, now);
  return row->pressed_at;
}

void RemoteEntities::fade(const pdu::EntityId& id, nanoseconds now) noexcept {
  RemoteEntity* row = table_.find(id);
  if (row == nullptr) return;
  row->felt_until = std::min(row->felt_until, now);
}

// Sets a time long ago, so that no force remains to fade: the owner had time to send a state.
void RemoteEntities::end_force(RemoteEntity& row) noexcept {
  row.felt_until = std::min(row.felt_until, row.last_heard);
}

void RemoteEntities::doubt_row(std::size_t place, nanoseconds now) noexcept {
  RemoteEntity& row = table_.rows()[place];
  if (row.doubted_at != RemoteEntity::kTrusted) return;
  row.doubted_at = now;
  row.felt_until = std::min(row.felt_until, now);
  changes_.updated(place);
}

void RemoteEntities::believe_row(std::size_t place, nanoseconds now) noexcept {
  motion_.resume(table_.rows()[place], now);
  near_.note_update(place);
  changes_.updated(place);
}

void RemoteEntities::forget(const pdu::EntityId& body) noexcept {
  if (const RemoteEntity* row = table_.find(body))
    drop(table_.place_of(*row), Removal::owner_changed);
  outside_.forget_if([&](const OutsideEntity& entity) { return entity.id() == body; });
}

void RemoteEntities::claim(aoim::PeerId id, std::uint32_t epoch) noexcept {
  for (std::size_t i = 0; i < table_.rows().size();) {
    const RemoteEntity& row = table_.rows()[i];
    if (row.id.simulation() == id && row.epoch != epoch) {
      drop(i, Removal::owner_changed);
    } else {
      ++i;
    }
  }
  outside_.forget_if([&](const OutsideEntity& entity) {
    return entity.id().simulation() == id && entity.arrival().epoch != epoch;
  });
}

}  // namespace reckon::peer
