// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/loops/notice.hpp"

#include "reckon/pdu/seconds.hpp"
#include "reckon/peer/loops/address_text.hpp"
#include "reckon/peer/loops/aoim_setup.hpp"
#include "reckon/peer/loops/notice_text.hpp"

namespace reckon::peer {
namespace {

// Sentences about addresses that claim a peer's name.
Notice sentence_of_addresses(const aoim::PresenceEvent& event) noexcept {
  const aoim::PeerId peer = event.peer();
  const AddressText source(event.source), other(event.other);
  if (event.kind == aoim::PresenceEventKind::disputed && event.source == aoim::SourceAddress{})
    return make_notice(NoticeKind::claimed_twice,
                       "the number of this peer, {}:{}, is also claimed by {}", peer.site,
                       peer.application, other.view());
  if (event.kind == aoim::PresenceEventKind::disputed)
    return make_notice(NoticeKind::claimed_twice, "peer {}:{} at {} is also claimed by {}",
                       peer.site, peer.application, source.view(), other.view());
  if (event.kind == aoim::PresenceEventKind::moved)
    return make_notice(NoticeKind::moved, "peer {}:{} moved to {} from {}", peer.site,
                       peer.application, source.view(), other.view());
  if (event.kind == aoim::PresenceEventKind::impostor && peer.site == aoim::kSceneSite)
    return make_notice(
        NoticeKind::impostor,
        "{} is ignored: it announces {}:{}, and site {} belongs to the scene's bodies",
        other.view(), peer.site, peer.application, peer.site);
  if (event.kind == aoim::PresenceEventKind::impostor)
    return make_notice(NoticeKind::impostor,
                       "{} is ignored: it uses the identity of peer {}:{}, which is at {}",
                       other.view(), peer.site, peer.application, source.view());
  return make_notice(NoticeKind::crowd,
                     "{} announces more peers than one host may: the excess is ignored",
                     source.view());
}

Notice sentence_of(const aoim::PresenceEvent& event) noexcept {
  const aoim::PeerId peer = event.peer();
  switch (event.kind) {
    case aoim::PresenceEventKind::newcomer:
      return make_notice(NoticeKind::joined, "peer {}:{} '{}' joined", peer.site, peer.application,
                         event.announced.name_view());
    case aoim::PresenceEventKind::restarted:
      return make_notice(NoticeKind::started_anew, "peer {}:{} restarted", peer.site,
                         peer.application);
    case aoim::PresenceEventKind::departed:
      return make_notice(NoticeKind::left, "peer {}:{} left", peer.site, peer.application);
    case aoim::PresenceEventKind::timed_out:
      return make_notice(NoticeKind::silent, "peer {}:{} is silent: its entities were dropped",
                         peer.site, peer.application);
    case aoim::PresenceEventKind::scene_mismatch:
      return make_notice(
          NoticeKind::other_scene,
          "peer {}:{} '{}' runs another scene and is not joined; start both with the same file",
          peer.site, peer.application, event.announced.name_view());
    case aoim::PresenceEventKind::renamed:
      return make_notice(NoticeKind::renamed, "peer {}:{} is {}:{} now", event.former.site,
                         event.former.application, peer.site, peer.application);
    case aoim::PresenceEventKind::disputed:
    case aoim::PresenceEventKind::moved:
    case aoim::PresenceEventKind::impostor:
    case aoim::PresenceEventKind::crowd:
      return sentence_of_addresses(event);
    case aoim::PresenceEventKind::quiet:
      return make_notice(NoticeKind::quiet, "peer {}:{} was silent for 2.5 s", peer.site,
                         peer.application);
    case aoim::PresenceEventKind::unheard:
      return make_notice(NoticeKind::unheard,
                         "peer {}:{} does not receive this one: see `reckon doctor` on both hosts",
                         peer.site, peer.application);
    case aoim::PresenceEventKind::heard_again:
      return make_notice(NoticeKind::heard_again,
                         "peer {}:{} and this one receive each other again", peer.site,
                         peer.application);
    case aoim::PresenceEventKind::slept:
      return make_notice(NoticeKind::slept, "this peer was suspended for {:.1f} s",
                         pdu::to_seconds(event.slept));
    case aoim::PresenceEventKind::settled:
    case aoim::PresenceEventKind::heard_late:
    case aoim::PresenceEventKind::identity_changed:
      break;
  }
  return make_notice(NoticeKind::number_taken,
                     "{}:{} is taken by another peer; this one is {}:{} now", event.former.site,
                     event.former.application, peer.site, peer.application);
}

}  // namespace

Notice notice_of(const MutedSender& sender) noexcept {
  const AddressText who(source_of(sender.who));
  if (sender.muted)
    return make_notice(
        NoticeKind::muted,
        "{} sends too many datagrams: they are dropped until it sends fewer than {} a second",
        who.view(), 10 * SenderBudget::kCalm);
  return make_end(NoticeKind::muted, "datagrams of {} are accepted again: {} were dropped",
                  who.view(), sender.dropped);
}

Notice notice_of(const RefusedSender& sender, bool interop) noexcept {
  constexpr auto kKind = NoticeKind::datagrams_refused;
  const AddressText who(source_of(sender.who));
  const char* const plural = sender.count == 1 ? "" : "s";
  if (sender.who.port == 0)
    return make_notice(kKind, "{} datagram{} of further senders refused", sender.count, plural);
  switch (sender.why) {
    case Refusal::exercise:
      return make_notice(kKind, "{}: {} datagram{} refused: exercise {}, see exercise in the scene",
                         who.view(), sender.count, plural, sender.octet);
    case Refusal::version:
      return make_notice(kKind, "{}: {} datagram{} refused: first octet {} is not a DIS version",
                         who.view(), sender.count, plural, sender.octet);
    case Refusal::no_length:
      return make_notice(kKind,
                         "{}: {} datagram{} refused: length field 0; to read them, set {}lenient "
                         "in the scene",
                         who.view(), sender.count, plural, interop ? "" : "interop and ");
    default:
      return make_notice(kKind, "{}: {} datagram{} refused: no PDU header", who.view(),
                         sender.count, plural);
  }
}

Notice notice_of(const aoim::PresenceEvent& event) noexcept {
  Notice notice = sentence_of(event);
  notice.about = event.peer();
  return notice;
}

}  // namespace reckon::peer
