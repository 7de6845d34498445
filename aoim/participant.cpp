// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/aoim/participant.hpp"

namespace reckon::aoim {

using std::chrono::nanoseconds;

void Participant::deliver(nanoseconds now) noexcept {
  for (const PresenceEvent& event : manager_.take_events()) conclude(event);
  Leading* leading = manager_.leading();
  if (leading == nullptr || !leading->has_relayed()) return;
  for (const RelayedState& state : leading->take_relayed(now)) {
    const auto from = manager_.presence().source_of(state.epoch);
    if (from) handler_.receive(state, *from);
  }
}

void Participant::conclude(const PresenceEvent& event) noexcept {
  using Kind = PresenceEventKind;
  if (const auto dropped = event.dropped()) handler_.drop(*dropped, event.kind == Kind::timed_out);
  if (event.kind == Kind::newcomer || event.kind == Kind::renamed)
    handler_.claim(event.peer(), event.announced.epoch);
  if (event.kind == Kind::identity_changed) handler_.rename(event.peer());
  handler_.report(event);
}

void Participant::drain(nanoseconds now, DatagramSink sink) {
  manager_.step(now, sink);
  manager_.flush(now, sink);
}

}  // namespace reckon::aoim
