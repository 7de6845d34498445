// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/loops/notice_gate.hpp"

#include <algorithm>

#include "reckon/peer/loops/address_text.hpp"
#include "reckon/peer/loops/aoim_setup.hpp"
#include "reckon/peer/loops/notice_text.hpp"

namespace reckon::peer {
namespace {

using aoim::PresenceEventKind;
using std::chrono::nanoseconds;

// Whether one more line may be reported, with a burst of `at_once` lines (virtual scheduling
// algorithm, ITU-T I.371 A: `free_at` is the time when the whole burst is available again).
bool take_line(nanoseconds& free_at, int at_once, nanoseconds now) noexcept {
  if (free_at > now + (at_once - 1) * NoticeGate::kGap) return false;
  free_at = std::max(free_at, now) + NoticeGate::kGap;
  return true;
}

// Whether the event is about a member: a peer that joined earlier and was received for long.
bool is_of_member(const aoim::PresenceEvent& event) noexcept {
  switch (event.kind) {
    case PresenceEventKind::newcomer:
    case PresenceEventKind::restarted:
    case PresenceEventKind::scene_mismatch:
    case PresenceEventKind::disputed:
    case PresenceEventKind::impostor:
    case PresenceEventKind::crowd:
      return false;
    default:
      return event.heard_for >= NoticeGate::kMember;
  }
}

}  // namespace

// The host that has been inactive longest is replaced.
NoticeGate::Host& NoticeGate::host_of(const Octets& address) noexcept {
  const auto end = hosts_.begin() + static_cast<std::ptrdiff_t>(count_);
  const auto known =
      std::find_if(hosts_.begin(), end, [&](const Host& host) { return host.address == address; });
  if (known != end) return *known;
  if (count_ + 1 < kHosts) {
    hosts_[count_].address = address;
    return hosts_[count_++];
  }
  const auto oldest = std::min_element(
      hosts_.begin(), end, [](const Host& a, const Host& b) { return a.last < b.last; });
  const bool is_quiet = oldest->left_out == 0 && hosts_.back().last - oldest->last > kAtOnce * kGap;
  if (!is_quiet) return hosts_.back();
  *oldest = {};
  oldest->address = address;
  return *oldest;
}

void NoticeGate::report(const Notice& notice, const aoim::SourceAddress& cause, bool member,
                        nanoseconds now, haptics::SpscRing<Notice>& out) noexcept {
  hosts_.back().last = now;
  Host& host = host_of(cause.octets);
  host.last = now;
  const bool passes = member ? take_line(host.members, kAtOnceOfMembers, now)
                             : host.left_out == 0 && take_line(host.strangers, kAtOnce, now);
  if (passes) return static_cast<void>(out.push(notice));
  ++host.left_out;
  host.latest = notice;
}

void NoticeGate::report(const aoim::PresenceEvent& event, nanoseconds now,
                        haptics::SpscRing<Notice>& out) noexcept {
  const bool own =
      event.kind == PresenceEventKind::identity_changed || event.kind == PresenceEventKind::slept;
  if (own) return static_cast<void>(out.push(notice_of(event)));
  const bool by_another =
      event.kind == PresenceEventKind::disputed || event.kind == PresenceEventKind::impostor;
  report(notice_of(event), by_another ? event.other : event.source, is_of_member(event), now, out);
}

void NoticeGate::report(const MutedSender& sender, nanoseconds now,
                        haptics::SpscRing<Notice>& out) noexcept {
  report(notice_of(sender), source_of(sender.who), false, now, out);
}

void NoticeGate::look(nanoseconds now, haptics::SpscRing<Notice>& out) noexcept {
  for (std::size_t i = 0; i < kHosts; ++i) {
    Host& host = hosts_[i];
    if (host.left_out == 0 || !take_line(host.strangers, kAtOnce, now)) continue;
    const AddressText address({host.address, 0});
    static_cast<void>(out.push(make_notice(
        NoticeKind::left_out, "omitted {} more lines about unknown senders at {}, the last: {}",
        host.left_out, i + 1 < kHosts ? address.view() : "other addresses",
        host.latest.text.data())));
    host.left_out = 0;
  }
}

}  // namespace reckon::peer
