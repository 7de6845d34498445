// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The watchers of a peer and the lines that they report: peers that come, go and fall silent, what
// is refused, limits that are reached, the link.
#pragma once

#include <chrono>
#include <cstddef>
#include <span>
#include <string_view>

#include "reckon/aoim/area_of_interest_manager.hpp"
#include "reckon/peer/loops/channel_keeper.hpp"
#include "reckon/peer/loops/known_sources_publisher.hpp"
#include "reckon/peer/loops/limit_watch.hpp"
#include "reckon/peer/loops/link_watch.hpp"
#include "reckon/peer/loops/model_wiring.hpp"
#include "reckon/peer/loops/notice.hpp"
#include "reckon/peer/loops/notice_gate.hpp"
#include "reckon/peer/loops/refusal_watch.hpp"
#include "reckon/peer/loops/silence_watch.hpp"
#include "reckon/peer/world/remote_entities.hpp"

namespace reckon::peer {

/// Notices may be read by another thread; all else by one. No allocation after construction.
class PeerWatches {
 public:
  using Nanoseconds = std::chrono::nanoseconds;

  explicit PeerWatches(const ModelWiring& wiring);
  PeerWatches(const PeerWatches&) = delete;
  PeerWatches& operator=(const PeerWatches&) = delete;

  [[nodiscard]] haptics::SpscRing<Notice>& notices() noexcept { return notices_; }
  /// Something happened to a peer.
  void report(const aoim::PresenceEvent& event, Nanoseconds now) noexcept;
  /// An order was refused; see RefusalWatch.
  void note_order(const pdu::EntityId& originator, std::string_view order,
                  const aoim::SourceAddress& from, Nanoseconds now) noexcept {
    refusal_watch_.note_order(originator, order, from, now);
  }
  /// Rows of peers that are silent are not felt. @param touched by our hands
  /// @return whether one is heard again
  bool doubt_silent(const aoim::Presence& presence, std::span<const Touched> touched,
                    RemoteEntities& remote, Nanoseconds now) noexcept {
    return silence_watch_.look(presence, touched, remote, now, notices_);
  }
  /// Keeps the channels within what this peer can take; some twenty times a second, before look().
  void fit_channels(const RemoteEntities& remote, aoim::AreaOfInterestManager& aoim,
                    Nanoseconds now) noexcept;
  /// Reports what else there is; as often. @param unfelt most that a servo has left out
  /// @param crowder who had more near a hand than it takes
  void look(RemoteEntities& remote, aoim::AreaOfInterestManager& aoim, std::size_t unfelt,
            const aoim::SourceAddress& crowder, Nanoseconds now) noexcept;

 private:
  haptics::SpscRing<MutedSender>* muted_;
  haptics::SpscRing<Notice> notices_;
  NoticeGate notice_gate_;
  LimitWatch limit_watch_;
  SilenceWatch silence_watch_;
  RefusalWatch refusal_watch_{notice_gate_, notices_};
  ChannelKeeper channel_keeper_;
  LinkWatch link_watch_;
  KnownSourcesPublisher known_;
};

}  // namespace reckon::peer
