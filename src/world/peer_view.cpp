// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/world/peer_view.hpp"

#include <algorithm>

#include "reckon/pdu/seconds.hpp"

namespace reckon::peer {

EntityView view_of(const RemoteEntity& row, std::span<const HandView> hands,
                   std::chrono::nanoseconds now) noexcept {
  EntityView view;
  view.id = row.id;
  view.marking = row.marking;
  view.kind = row.type.kind;
  view.algorithm = row.state.algorithm;
  view.position = row.shown(now).position;
  const double span = pdu::to_seconds(row.last_heard - row.first_heard);
  view.rate_hz = span > 0.0 ? static_cast<double>(row.updates - 1) / span : 0.0;
  view.jump_m = row.jump_m;
  view.age = pdu::to_seconds(now - row.last_heard);
  view.haptic = row.haptic;
  view.frozen = row.frozen;
  view.k1 = row.model.k1;
  view.updates = row.updates;
  view.parts = row.parts;
  for (const HandView& hand : hands) {
    for (std::size_t i = 0; i < hand.servo.count; ++i) {
      const haptics::ContactAccount& contact = hand.servo.contacts[i];
      if (contact.id != row.id) continue;
      view.force_n = std::max(view.force_n, contact.force.norm());
      view.ledger_j += contact.ledger;
    }
  }
  return view;
}

}  // namespace reckon::peer
