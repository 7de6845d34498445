// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/loops/limit_watch.hpp"

#include <algorithm>

#include "reckon/haptics/exchange/servo_types.hpp"
#include "reckon/haptics/servo/pressing_hands.hpp"
#include "reckon/peer/loops/address_text.hpp"
#include "reckon/peer/loops/notice_text.hpp"

namespace reckon::peer {

LimitWatch::LimitWatch(std::size_t capacity, Counters& counters)
    : capacity_(capacity),
      most_unfelt_(counters.make_level(
          "hands_unfelt",
          "greatest number of bodies near a hand at once that its full servo left out")),
      most_unpressed_(counters.make_level(
          "hands_unpressed",
          "greatest number of hands of other peers at once that were near bodies of this peer and "
          "did not press them")),
      table_full_{counters.make("table_full", "entities refused because the state table was full")},
      write_overflow_{counters.make("write_overflow", "dropped because the writer lags")},
      read_waits_{counters.make("read_waits",
                                "times that the read loop waited for a model loop that lags")},
      models_refused_{counters.make("models_refused", "force models with impossible values")},
      sealed_{counters.make("sealed_unread_in", "sealed datagrams received without a key")} {}

NoticeCondition::Turn LimitWatch::Growing::turn(std::chrono::nanoseconds now) noexcept {
  const std::uint64_t value = counter.value();
  const bool grew = value > before;
  before = value;
  return condition.turn(grew, now);
}

void LimitWatch::look(std::size_t unfelt, std::size_t unpressed, const aoim::SourceAddress& crowder,
                      const pdu::EntityId& refused, std::chrono::nanoseconds now,
                      haptics::SpscRing<Notice>& out) noexcept {
  using Turn = NoticeCondition::Turn;
  const auto report = [&](NoticeKind kind, Turn turn, const char* begins, const char* ends,
                          std::size_t number) {
    if (turn == Turn::none) return;
    static_cast<void>(out.push(turn == Turn::begins ? make_notice(kind, begins, number)
                                                    : make_end(kind, ends, number)));
  };
  most_unfelt_.set(std::max<std::uint64_t>(most_unfelt_.value(), unfelt));
  const Turn crowds = unfelt_.turn(unfelt > 0, now);
  if (crowds == Turn::begins)
    static_cast<void>(
        out.push(make_notice(NoticeKind::crowded,
                             "more than the {} bodies of a servo are near a hand, most of them "
                             "from {}: bodies beyond a host's share are not felt",
                             haptics::kMaxRemoteHands, AddressText(crowder).view())));
  if (crowds == Turn::ends)
    static_cast<void>(
        out.push(make_end(NoticeKind::crowded, "all bodies near a hand are felt again")));
  most_unpressed_.set(std::max<std::uint64_t>(most_unpressed_.value(), unpressed));
  report(NoticeKind::crowded, unpressed_.turn(unpressed > 0, now),
         "more than {} hands of other peers are near the bodies of this peer: the farthest ones do "
         "not press them",
         "all hands near the bodies of this peer press them again", haptics::PressingHands::kMost);
  report(NoticeKind::table_full, table_full_.turn(now),
         "the table of remote entities is full with {} rows: further ones are not shown; raise "
         "[network] entities",
         "the table of remote entities has room again", capacity_);
  report(NoticeKind::write_full, write_overflow_.turn(now),
         "the ring to the network is full: updates are dropped",
         "the ring to the network has room again", 0);
  report(NoticeKind::read_waits, read_waits_.turn(now),
         "the ring from the network is full: datagrams wait in the kernel's buffer",
         "the ring from the network has room again", 0);
  report(NoticeKind::sealed, sealed_.turn(now),
         "the exercise of this group is sealed: set [network] key, or --key FILE",
         "no sealed datagram was received since", 0);
  const Turn refuses = models_refused_.turn(now);
  if (refuses == Turn::begins)
    static_cast<void>(
        out.push(make_notice(NoticeKind::model_refused,
                             "the force model of {}:{}:{} has impossible values and is refused: "
                             "its last valid model applies until it expires",
                             refused.site, refused.application, refused.entity)));
  if (refuses == Turn::ends)
    static_cast<void>(
        out.push(make_end(NoticeKind::model_refused, "no force model was refused since")));
}

}  // namespace reckon::peer
