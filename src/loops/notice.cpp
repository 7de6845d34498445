// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/loops/notice.hpp"

#include <algorithm>

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

// As IpEndpoint::text() has it, but for the zeros of IPv6, and without an allocation.
std::array<char, 64> text_of(const IpEndpoint& who) noexcept {
  std::array<char, 64> text{};
  char* out = text.data();
  const auto& octets = who.octets;
  if (who.is_v6) out = fmt::format_to(out, "[");
  for (std::size_t i = 0; i < (who.is_v6 ? 8u : 4u); ++i) {
    if (i > 0) *out++ = who.is_v6 ? ':' : '.';
    out = who.is_v6 ? fmt::format_to(out, "{:x}", octets[2 * i] << 8 | octets[2 * i + 1])
                    : fmt::format_to(out, "{}", octets[i]);
  }
  if (who.is_v6) out = fmt::format_to(out, "]");
  if (who.port != 0) fmt::format_to(out, ":{}", who.port);
  return text;
}

}  // namespace

Notice notice_of(const MutedSender& sender) noexcept {
  const std::array<char, 64> who = text_of(sender.who);
  if (sender.muted)
    return make_notice(
        "{} sends too many datagrams: they are dropped unread until it sends fewer "
        "than {} a second",
        who.data(), 10 * SenderBudget::kCalm);
  return make_notice("{} is read again: {} of its datagrams were dropped", who.data(),
                     sender.dropped);
}

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
