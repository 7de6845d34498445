// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/loops/ownership_watch.hpp"

#include "reckon/peer/loops/notice_text.hpp"

namespace reckon::peer {
namespace {

// A lease may be late for this time without a notice.
constexpr std::chrono::nanoseconds kPatience = std::chrono::milliseconds(400);

}  // namespace

void OwnershipWatch::note(const OwnershipEvent& event) noexcept {
  if (event.kind == OwnershipEvent::Kind::merged) {
    static_cast<void>(out_.push(make_notice(
        NoticeKind::worlds_met,
        "peers that were separated own the bodies again together: the older group's bodies stand "
        "where it has them")));
  } else if (event.kind == OwnershipEvent::Kind::gained && event.cause == OwnerChange::adopted) {
    static_cast<void>(out_.push(make_notice(
        NoticeKind::bodies_adopted, "this peer owns {} bodies now: their owner failed or left",
        event.objects.count())));
  }
}

void OwnershipWatch::look(const Ownership& protocol, Nanoseconds now) noexcept {
  const bool is_settled = !protocol.acts().exists() || !protocol.is_voter();
  if (is_settled || protocol.has_lease(now) || leased_ < Nanoseconds(0)) leased_ = now;
  rests_ = now - leased_ > kPatience;
  const NoticeCondition::Turn turn = condition_.turn(rests_, now);
  if (turn == NoticeCondition::Turn::begins) {
    static_cast<void>(out_.push(make_notice(
        NoticeKind::bodies_rest,
        "bodies rest: {} of the {} peers that share them are received, and more than half are "
        "needed. Go on alone by the button of the page, or Federate::go_alone()",
        protocol.received_voters(now), protocol.acts().decided().roll.size())));
  } else if (turn == NoticeCondition::Turn::ends) {
    static_cast<void>(out_.push(make_end(NoticeKind::bodies_rest, "bodies move again")));
  }
}

}  // namespace reckon::peer
