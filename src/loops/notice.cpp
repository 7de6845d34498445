// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/loops/notice.hpp"

#include "reckon/pdu/seconds.hpp"
#include "reckon/peer/loops/address_text.hpp"
#include "reckon/peer/loops/aoim_setup.hpp"
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
    case aoim::PresenceEventKind::renamed:
      return make_notice("peer {}:{} is {}:{} now", event.former.site, event.former.application,
                         peer.site, peer.application);
    case aoim::PresenceEventKind::disputed:
      if (event.source == aoim::SourceAddress{}) {
        return make_notice("{}:{}, which is this peer, is claimed by another at {}, too", peer.site,
                           peer.application, AddressText(event.other).view());
      }
      return make_notice("peer {}:{} at {} is claimed by another at {}, too", peer.site,
                         peer.application, AddressText(event.source).view(),
                         AddressText(event.other).view());
    case aoim::PresenceEventKind::moved:
      return make_notice("peer {}:{} is at {} now, no more at {}", peer.site, peer.application,
                         AddressText(event.source).view(), AddressText(event.other).view());
    case aoim::PresenceEventKind::impostor:
      return make_notice("{} speaks in the name of peer {}:{}, which is at {}: not believed",
                         AddressText(event.other).view(), peer.site, peer.application,
                         AddressText(event.source).view());
    case aoim::PresenceEventKind::crowd:
      return make_notice("{} speaks for more peers than one host may: the rest are not believed",
                         AddressText(event.source).view());
    case aoim::PresenceEventKind::quiet:
      return make_notice("peer {}:{} has not been heard for 2.5 s", peer.site, peer.application);
    case aoim::PresenceEventKind::unheard:
      return make_notice("peer {}:{} does not hear this one: see `reckon doctor` on both hosts",
                         peer.site, peer.application);
    case aoim::PresenceEventKind::heard_again:
      return make_notice("peer {}:{} and this one hear each other again", peer.site,
                         peer.application);
    case aoim::PresenceEventKind::slept:
      return make_notice("this peer slept for {:.1f} s", pdu::to_seconds(event.slept));
    case aoim::PresenceEventKind::settled:
    case aoim::PresenceEventKind::heard_late:
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
    case aoim::PresenceEventKind::quiet:
      return NoticeKind::quiet;
    case aoim::PresenceEventKind::unheard:
      return NoticeKind::unheard;
    case aoim::PresenceEventKind::heard_again:
      return NoticeKind::heard_again;
    default:
      break;
  }
  return NoticeKind::other;
}

}  // namespace

Notice notice_of(const MutedSender& sender) noexcept {
  const AddressText who(source_of(sender.who));
  if (sender.muted)
    return make_notice(
        "{} sends too many datagrams: they are dropped unread until it sends fewer "
        "than {} a second",
        who.view(), 10 * SenderBudget::kCalm);
  return make_notice("{} is read again: {} of its datagrams were dropped", who.view(),
                     sender.dropped);
}

Notice notice_of(const aoim::PresenceEvent& event) noexcept {
  Notice notice = sentence_of(event);
  notice.kind = kind_of(event.kind);
  notice.about = event.peer();
  return notice;
}

}  // namespace reckon::peer
