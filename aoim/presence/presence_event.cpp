// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/aoim/presence/presence_event.hpp"

#include <utility>

namespace reckon::aoim {

std::optional<PresenceEvent::Dropped> PresenceEvent::dropped() const noexcept {
  switch (kind) {
    case PresenceEventKind::restarted:
      return Dropped{peer(), former_epoch};
    case PresenceEventKind::renamed:
      return Dropped{former, announced.epoch};
    case PresenceEventKind::departed:
    case PresenceEventKind::timed_out:
    case PresenceEventKind::scene_mismatch:
      return Dropped{peer(), announced.epoch};
    default:
      return std::nullopt;
  }
}

PresenceEvents::PresenceEvents(std::size_t capacity) {
  pending_.reserve(capacity);
  taken_.reserve(capacity);
}

PresenceEvent& PresenceEvents::report(PresenceEventKind kind, const pdu::Presence& about) {
  PresenceEvent& event = pending_.emplace_back();
  event.kind = kind;
  event.announced = about;
  return event;
}

PresenceEvent& PresenceEvents::report(PresenceEventKind kind, const Peer& about) {
  PresenceEvent& event = report(kind, about.announced);
  event.source = about.source;
  event.heard_for = about.last_heard - about.known_since;
  return event;
}

std::span<const PresenceEvent> PresenceEvents::take() {
  taken_.clear();
  std::swap(taken_, pending_);
  return taken_;
}

}  // namespace reckon::aoim
