// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/loops/view_publisher.hpp"

#include <span>

namespace reckon::peer {

using std::chrono::nanoseconds;

void ViewPublisher::publish_shown(const RemoteEntities& remote, nanoseconds now) noexcept {
  if (shown_ == nullptr) return;
  for (const RemoteEntity& row : remote.rows()) {
    static_cast<void>(shown_->push({now, row.id, row.shown(now).position}));
  }
}

void ViewPublisher::publish(PeerView& view, const RemoteEntities& remote,
                            const EmissionTable& emissions, nanoseconds now) noexcept {
  const nanoseconds heard = remote.first_heard();
  view.time = now;
  view.started = started_;
  view.entities = remote.rows().size();
  view.first_remote = heard < nanoseconds(0) ? heard : heard - started_;
  view.count = 0;
  for (const std::uint32_t place : choice_.choose(remote.rows(), view.middle)) {
    view.rows[view.count++] = view_of(remote.rows()[place], view.own_hands(), now);
  }
  emissions.summarise(std::span(view.rows).first(view.count));
  views_.publish();
  next_ = now + kPeriod;
}

}  // namespace reckon::peer
