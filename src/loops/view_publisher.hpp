// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What watchers see of a peer: a view some twenty times a second, and where others are shown.
#pragma once

#include <chrono>

#include "reckon/haptics/exchange/spsc_ring.hpp"
#include "reckon/haptics/exchange/triple_buffer.hpp"
#include "reckon/peer/loops/model_wiring.hpp"
#include "reckon/peer/world/peer_view.hpp"
#include "reckon/peer/world/remote_entities.hpp"

namespace reckon::peer {

/// Views may be read by another thread; all else by one. No allocation after construction.
class ViewPublisher {
 public:
  static constexpr std::chrono::nanoseconds kPeriod = std::chrono::milliseconds(50);

  explicit ViewPublisher(const ModelWiring& wiring) noexcept : shown_(wiring.shown) {}

  [[nodiscard]] haptics::TripleBuffer<PeerView>& views() noexcept { return views_; }
  void start(std::chrono::nanoseconds now) noexcept { started_ = next_ = now; }
  /// When the next view is due.
  [[nodiscard]] std::chrono::nanoseconds next() const noexcept { return next_; }

  /// Where each remote entity is shown now, where somebody asks.
  void publish_shown(const RemoteEntities& remote, std::chrono::nanoseconds now) noexcept;

  /// The next view, to be filled in but for remote entities.
  [[nodiscard]] PeerView& begin() noexcept { return views_.write_slot(); }
  /// Adds the remote entities that are nearest to view.middle, and publishes the view.
  void publish(PeerView& view, const RemoteEntities& remote, std::chrono::nanoseconds now) noexcept;

 private:
  haptics::SpscRing<ShownSample>* shown_;
  haptics::TripleBuffer<PeerView> views_;
  ViewChoice choice_;
  std::chrono::nanoseconds started_{0}, next_{0};
};

}  // namespace reckon::peer
