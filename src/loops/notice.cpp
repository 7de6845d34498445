// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/loops/notice.hpp"

#include <arpa/inet.h>

#include <algorithm>
#include <array>

#include "reckon/pdu/seconds.hpp"
#include "reckon/peer/loops/notice_text.hpp"

namespace reckon::peer {
namespace {

// "10.77.0.1:3000" or "[fd00::1]:3000"; "an unknown address" where there is none.
std::array<char, 64> text_of(const aoim::SourceAddress& source) noexcept {
  constexpr std::array<std::uint8_t, 12> kMapped{0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0xFF, 0xFF};
  const bool is_v4 = std::equal(kMapped.begin(), kMapped.end(), source.octets.begin());
  std::array<char, INET6_ADDRSTRLEN> address{};
  if (is_v4) {
    inet_ntop(AF_INET, source.octets.data() + kMapped.size(), address.data(), address.size());
  } else {
    inet_ntop(AF_INET6, source.octets.data(), address.data(), address.size());
  }
  std::array<char, 64> text{};
  if (source.port == 0) {
    fmt::format_to_n(text.data(), text.size() - 1, "an unknown address");
  } else {
    fmt::format_to_n(text.data(), text.size() - 1, fmt::runtime(is_v4 ? "{}:{}" : "[{}]:{}"),
                     address.data(), source.port);
  }
  return text;
}

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
      return make_notice("peer {}:{} at {} is claimed by another at {}, too", peer.site,
                         peer.application, text_of(event.source).data(),
                         text_of(event.other).data());
    case aoim::PresenceEventKind::impostor:
      return make_notice("{} speaks in the name of peer {}:{}, which is at {}: not believed",
                         text_of(event.other).data(), peer.site, peer.application,
                         text_of(event.source).data());
    case aoim::PresenceEventKind::crowd:
      return make_notice("{} speaks for more peers than one host may: the rest are not believed",
                         text_of(event.source).data());
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

Notice notice_of(const aoim::PresenceEvent& event) noexcept {
  Notice notice = sentence_of(event);
  // Names of others may hold any octets, and sentences go to terminals.
  std::replace_if(
      notice.text.begin(), notice.text.end(),
      [](char letter) { return letter != '\0' && (letter < ' ' || letter > '~'); }, '?');
  notice.kind = kind_of(event.kind);
  notice.about = event.peer();
  return notice;
}

}  // namespace reckon::peer
