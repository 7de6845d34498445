// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/aoim/event_handler.hpp"

namespace reckon::aoim {
namespace {

void deliver(const PresenceEvent& event, EventHandler& handler) noexcept {
  using Kind = PresenceEventKind;
  if (const auto dropped = event.dropped()) handler.drop(*dropped, event.kind == Kind::timed_out);
  if (event.kind == Kind::newcomer || event.kind == Kind::renamed)
    handler.claim(event.peer(), event.announced.epoch);
  handler.report(event);
}

}  // namespace

void deliver_events(AreaOfInterestManager& aoim, EventHandler& handler,
                    std::chrono::nanoseconds now) noexcept {
  for (const PresenceEvent& event : aoim.take_events()) deliver(event, handler);
  Leading* leading = aoim.leading();
  if (leading == nullptr || !leading->has_relayed()) return;
  for (const RelayedState& state : leading->take_relayed(now)) {
    const auto from = aoim.presence().source_of(state.epoch);
    if (from) handler.receive(state, *from);
  }
}

}  // namespace reckon::aoim
