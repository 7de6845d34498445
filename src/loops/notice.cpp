// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/loops/notice.hpp"

#include "reckon/peer/loops/notice_text.hpp"

namespace reckon::peer {
namespace {

Notice sentence_of(const aoim::PresenceEvent& event) noexcept {
  const aoim::PeerId peer = event.peer();
  switch (event.kind) {
    case aoim::PresenceEventKind::newcomer:
      return make_notice("peer {}:{} '{}' joined", peer.site, peer.application,
                         event.announced.name_view());
    case aoim::PresenceEventKind::restarted:
      return make_notice("peer {}:{} started anew", peer.site, peer.application);
    case aoim::PresenceEventKind::departed:
      return make_notice("peer {}:{} left", peer.site, peer.application);
    case aoim::PresenceEventKind::timed_out:
      return make_notice("peer {}:{} is silent: its entities were dropped", peer.site,
                         peer.application);
    case aoim::PresenceEventKind::scene_mismatch:
      return make_notice(
          "peer {}:{} '{}' runs another scene and is not joined; start both with the same file",
          peer.site, peer.application, event.announced.name_view());
    case aoim::PresenceEventKind::identity_changed:
      break;
  }
  return make_notice("{}:{} is taken by another peer; this one is {}:{} now", event.former.site,
                     event.former.application, peer.site, peer.application);
}

NoticeKind kind_of(aoim::PresenceEventKind kind) noexcept {
  switch (kind) {
    case aoim::PresenceEventKind::newcomer:
      return NoticeKind::joined;
    case aoim::PresenceEventKind::restarted:
      return NoticeKind::started_anew;
    case aoim::PresenceEventKind::departed:
      return NoticeKind::left;
    case aoim::PresenceEventKind::timed_out:
      return NoticeKind::silent;
    case aoim::PresenceEventKind::scene_mismatch:
      return NoticeKind::other_scene;
    case aoim::PresenceEventKind::identity_changed:
      break;
  }
  return NoticeKind::other;
}

}  // namespace

Notice notice_of(const aoim::PresenceEvent& event) noexcept {
  Notice notice = sentence_of(event);
  notice.kind = kind_of(event.kind);
  notice.about = event.peer();
  return notice;
}

}  // namespace reckon::peer
