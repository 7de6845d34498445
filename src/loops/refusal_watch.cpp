// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/loops/refusal_watch.hpp"

#include "reckon/peer/loops/address_text.hpp"
#include "reckon/peer/loops/notice_text.hpp"

namespace reckon::peer {

bool RefusalWatch::Growing::begins(std::uint64_t count, Nanoseconds now) noexcept {
  const bool grows = count > before;
  before = count;
  return condition.turn(grows, now) == NoticeCondition::Turn::begins;
}

void RefusalWatch::note_order(const pdu::EntityId& originator, std::string_view order,
                              const aoim::SourceAddress& from, Nanoseconds now) noexcept {
  if (orders_.turn(true, now) != NoticeCondition::Turn::begins) return;
  report(make_notice(NoticeKind::order_refused,
                     "refused the order of {}:{}:{} at {} to {}: see allow_management in the scene",
                     originator.site, originator.application, originator.entity,
                     AddressText(from).view(), order),
         from, now);
}

void RefusalWatch::report_dispute(const Dispute& dispute, const aoim::PeerId& own,
                                  Nanoseconds now) noexcept {
  const AddressText owner(dispute.owner), speaker(dispute.speaker);
  const auto [site, application] = dispute.name;
  report(dispute.name == own
             ? make_notice(NoticeKind::name_disputed,
                           "refused: {} sends entities of this peer, {}:{}; plain DIS programs "
                           "cannot tell them apart: give one another application number",
                           speaker.view(), site, application)
             : make_notice(NoticeKind::name_disputed,
                           "{}:{} at {}: refused entities under this number from {}", site,
                           application, owner.view(), speaker.view()),
         dispute.speaker, now);
}

void RefusalWatch::look(RemoteEntities& remote, const aoim::PeerId& own, Nanoseconds now) noexcept {
  static_cast<void>(orders_.turn(false, now));
  if (const auto dispute = remote.take_dispute(now)) report_dispute(*dispute, own, now);
  if (untouchable_.begins(remote.untouchable(), now)) {
    const Untouchable& last = remote.last_untouchable();
    report(make_notice(NoticeKind::touch_refused,
                       "{}:{}:{} at {} is not felt: see touch in the scene", last.id.site,
                       last.id.application, last.id.entity, AddressText(last.from).view()),
           last.from, now);
  }
  if (bodies_.begins(remote.bodies().disputed(), now)) {
    const Untouchable& last = remote.bodies().last_disputed();
    report(make_notice(NoticeKind::body_disputed,
                       "refused {}:{}:{} from {}: a body of the scene comes only from its owner",
                       last.id.site, last.id.application, last.id.entity,
                       AddressText(last.from).view()),
           last.from, now);
  }
  if (inside_.begins(remote.beginnings().held_back(), now)) {
    const pdu::EntityId id = remote.beginnings().last_held_back();
    const RemoteEntity* row = remote.find(id);
    const aoim::SourceAddress from = row == nullptr ? aoim::SourceAddress() : remote.owner(*row);
    report(make_notice(NoticeKind::inside_hand,
                       "{}:{}:{} at {} appeared inside a hand: it is not felt until it has left it",
                       id.site, id.application, id.entity, AddressText(from).view()),
           from, now);
  }
  if (evicted_.begins(remote.evicted(), now)) {
    const aoim::SourceAddress& by = remote.last_evicted();
    report(make_notice(NoticeKind::rows_evicted,
                       "{} fills the table of entities: its rows make room for other hosts; raise "
                       "[network] entities if all are wanted",
                       AddressText(by).view()),
           by, now);
  }
  if (strangers_.begins(remote.strangers_refused(), now)) {
    const aoim::SourceAddress& by = remote.last_stranger();
    report(make_notice(NoticeKind::strangers_full,
                       "{} fills [network] strangers_memory of plain DIS programs: its further "
                       "entities are not shown",
                       AddressText(by).view()),
           by, now);
  }
}

void RefusalWatch::look(std::span<const Touched> touched, RemoteEntities& remote,
                        Nanoseconds now) noexcept {
  for (const Touched& one : touched) {
    const RemoteEntity* row = remote.find(one.id);
    if (row == nullptr || !remote.touch().is_open()) continue;
    const aoim::SourceAddress& from = remote.owner(*row);
    if (from.boot == 0) pushers_.note({one.id.simulation(), {}, from}, now);
  }
  const auto pusher = pushers_.take_news(now);
  if (!pusher) return;
  report(make_notice(
             NoticeKind::presses, "{}:{} at {} presses a hand; touch in the scene decides who may",
             pusher->name.site, pusher->name.application, AddressText(pusher->speaker).view()),
         pusher->speaker, now);
}

void RefusalWatch::look(const SilenceWatch& silence, Nanoseconds now) noexcept {
  if (!silent_.begins(silence.faded(), now)) return;
  const Untouchable& last = silence.last_faded();
  report(
      make_notice(NoticeKind::body_silent,
                  "{}:{}:{} at {} was silent for 0.5 s in contact: it is not felt until it sends",
                  last.id.site, last.id.application, last.id.entity, AddressText(last.from).view()),
      last.from, now);
}

}  // namespace reckon::peer
