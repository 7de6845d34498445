// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Publishes a view of a peer some twenty times a second, and the shown poses of remote entities.
#pragma once

#include <chrono>
#include <span>

#include "reckon/haptics/exchange/spsc_ring.hpp"
#include "reckon/haptics/exchange/triple_buffer.hpp"
#include "reckon/peer/emissions/emission_table.hpp"
#include "reckon/peer/loops/model_wiring.hpp"
#include "reckon/peer/world/peer_view.hpp"
#include "reckon/peer/world/remote_entities.hpp"

namespace reckon::peer {

/// Another thread may read views; the rest is for one thread. No allocation after construction.
class ViewPublisher {
 public:
  static constexpr std::chrono::nanoseconds kPeriod = std::chrono::milliseconds(50);

  explicit ViewPublisher(const ModelWiring& wiring) noexcept : shown_(wiring.shown) {}

  [[nodiscard]] haptics::TripleBuffer<PeerView>& views() noexcept { return views_; }
  void start(std::chrono::nanoseconds now) noexcept { started_ = next_ = now; }
  /// When the next view is due.
  [[nodiscard]] std::chrono::nanoseconds next() const noexcept { return next_; }

  /// Publishes the present shown pose of each remote entity, if requested.
  void publish_shown(const RemoteEntities& remote, std::chrono::nanoseconds now) noexcept {
    if (shown_ == nullptr) return;
    for (const RemoteEntity& row : remote.rows()) {
      static_cast<void>(shown_->push({now, row.id, row.shown(now).position}));
    }
  }

  /// The next view, to be filled except for remote entities.
  [[nodiscard]] PeerView& begin() noexcept { return views_.write_slot(); }
  /// Adds the remote entities nearest to view.middle, with their emissions, and publishes the view.
  void publish(PeerView& view, const RemoteEntities& remote, const EmissionTable& emissions,
               std::chrono::nanoseconds now) noexcept {
    const std::chrono::nanoseconds heard = remote.first_heard();
    view.time = now;
    view.started = started_;
    view.entities = remote.rows().size();
    view.first_remote = heard < std::chrono::nanoseconds(0) ? heard : heard - started_;
    view.count = 0;
    for (const std::uint32_t place : choice_.choose(remote.rows(), view.middle)) {
      view.rows[view.count++] = view_of(remote.rows()[place], view.own_hands(), now);
    }
    emissions.summarise(std::span(view.rows).first(view.count));
    views_.publish();
    next_ = now + kPeriod;
  }

 private:
  haptics::SpscRing<ShownSample>* shown_;
  haptics::TripleBuffer<PeerView> views_;
  ViewChoice choice_;
  std::chrono::nanoseconds started_{0}, next_{0};
};

}  // namespace reckon::peer
