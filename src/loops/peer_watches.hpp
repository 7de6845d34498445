// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Reports about a peer to the user: peers that join, leave and become silent, and refusals.
#pragma once

#include <chrono>
#include <span>
#include <string_view>

#include "reckon/aoim/area_of_interest_manager.hpp"
#include "reckon/peer/loops/model_wiring.hpp"
#include "reckon/peer/loops/notice.hpp"
#include "reckon/peer/loops/notice_gate.hpp"
#include "reckon/peer/loops/refusal_watch.hpp"
#include "reckon/peer/loops/silence_watch.hpp"
#include "reckon/peer/world/remote_entities.hpp"

namespace reckon::peer {

/// Another thread may read notices; the rest is for one thread. No allocation after construction.
class PeerWatches {
 public:
  using Nanoseconds = std::chrono::nanoseconds;

  explicit PeerWatches(const ModelWiring& wiring)
      : muted_(wiring.muted),
        refused_(wiring.refused),
        interop_(wiring.scene.network.interop),
        notices_(256),
        silence_watch_(wiring.counters) {}
  PeerWatches(const PeerWatches&) = delete;
  PeerWatches& operator=(const PeerWatches&) = delete;

  [[nodiscard]] haptics::SpscRing<Notice>& notices() noexcept { return notices_; }
  /// Reports an event of a peer.
  void report(const aoim::PresenceEvent& event, Nanoseconds now) noexcept {
    // The sender of a discovery request is no peer yet.
    if (event.announced.scene_peer == pdu::kScenePeerWanted) return;
    notice_gate_.report(event, now, notices_);
  }
  /// Reports a refused order; see RefusalWatch.
  void note_order(const pdu::EntityId& originator, std::string_view order,
                  const aoim::SourceAddress& from, Nanoseconds now) noexcept {
    refusal_watch_.note_order(originator, order, from, now);
  }
  /// Removes the force of silent peers' rows.  @param touched entities in contact with our hands
  /// @return whether a peer is received again
  bool doubt_silent(const aoim::Presence& presence, std::span<const Touched> touched,
                    RemoteEntities& remote, Nanoseconds now) noexcept {
    refusal_watch_.look(touched, remote, now);
    return silence_watch_.look(presence, touched, remote, now, notices_);
  }
  /// Makes the remaining reports; call it some twenty times a second.
  void look(RemoteEntities& remote, const aoim::PeerId& own, Nanoseconds now) noexcept {
    while (const MutedSender* sender = muted_ == nullptr ? nullptr : muted_->front()) {
      notice_gate_.report(*sender, now, notices_);
      muted_->pop();
    }
    while (const RefusedSender* sender = refused_ == nullptr ? nullptr : refused_->front()) {
      notice_gate_.report_refusal(notice_of(*sender, interop_), source_of(sender->who), now,
                                  notices_);
      refused_->pop();
    }
    notice_gate_.look(now, notices_);
    refusal_watch_.look(remote, own, now);
    refusal_watch_.look(silence_watch_, now);
  }

 private:
  haptics::SpscRing<MutedSender>* muted_;
  haptics::SpscRing<RefusedSender>* refused_;
  bool interop_;
  haptics::SpscRing<Notice> notices_;
  NoticeGate notice_gate_;
  SilenceWatch silence_watch_;
  RefusalWatch refusal_watch_{notice_gate_, notices_};
};

}  // namespace reckon::peer
