// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/world/peer_view.hpp"

#include "reckon/pdu/seconds.hpp"

namespace reckon::peer {

EntityView view_of(const RemoteEntity& row, const haptics::ServoSnapshot& servo,
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
  for (std::size_t i = 0; i < servo.count; ++i) {
    if (servo.contacts[i].id != row.id) continue;
    view.force_n = servo.contacts[i].force.norm();
    view.ledger_j = servo.contacts[i].ledger;
  }
  return view;
}

}  // namespace reckon::peer
