// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/loops/contact_publisher.hpp"

#include <algorithm>

#include "reckon/pdu/seconds.hpp"

namespace reckon::peer {
namespace {

using haptics::RemoteHand;
using std::chrono::nanoseconds;

// Plain DIS programs have no hands: their life forms neither feel ours nor keep energy accounts.
void fill_remote(const RemoteEntity& row, const ReceivedAccount* account, bool interop,
                 RemoteHand& hand) {
  hand = predictors_of(row);
  hand.given_to_us = account == nullptr ? 0.0 : account->given;
  hand.need = account == nullptr ? 0.0 : account->need;
  hand.spring_need = account == nullptr ? 0.0 : account->spring_need;
  hand.neighbours = row.neighbours;
  hand.has_device = row.type.kind == pdu::EntityKind::life_form && (row.epoch != 0 || interop);
}

// A body of ours: its state is at most one pass old, and no update is lost.
void fill_own(const NearBody& body, nanoseconds at, const ContactSources& sources,
              RemoteHand& hand) {
  hand.id = body.own->id();
  hand.state = body.own->motion_at(at);
  hand.state_time = at;
  hand.model = body.model();
  hand.valid_until = sources.now + pdu::from_seconds(hand.model.validity);
  hand.given_to_us = hand.need = hand.spring_need = 0.0;
  hand.epoch = sources.epoch;
}

// Another hand of ours: both servos keep accounts, as across the network.
void fill_accounts(const HandPort& other, const pdu::EntityId& hand, RemoteHand& out) {
  const haptics::ServoSnapshot& servo = other.servo();
  out.neighbours = 0;
  out.version = static_cast<std::uint32_t>(servo.step);
  for (std::size_t i = 0; i < servo.count; ++i) {
    const haptics::ContactAccount& one = servo.contacts[i];
    if (one.given > 0 || one.need > 0 || one.spring_need > 0) ++out.neighbours;
    if (one.id != hand) continue;
    out.given_to_us = servo.contacts[i].given;
    out.need = servo.contacts[i].need;
    out.spring_need = servo.contacts[i].spring_need;
  }
}

void fill_body_accounts(const NearBody& body, const pdu::EntityId& hand,
                        const ContactSources& sources, RemoteHand& out) {
  const auto keeper = std::find_if(
      sources.bodies.begin(), sources.bodies.end(),
      [&](const PortlessBody& candidate) { return candidate.number() == body.number; });
  if (keeper != sources.bodies.end()) out.version = keeper->version();
  const ReceivedAccount* account = sources.books.find(body.number, hand);
  if (account != nullptr) out.given_to_us = account->we_gave;
}

}  // namespace

haptics::RemoteHand predictors_of(const RemoteEntity& row) noexcept {
  RemoteHand hand;
  hand.id = row.id;
  hand.state = *row.state;
  hand.state_time = row.state_time;
  hand.model = row.model;
  hand.valid_until = std::min(row.valid_until, row.felt_until);
  hand.version = row.version;
  hand.epoch = row.epoch;
  return hand;
}

void publish_contacts(HandPort& port, const pdu::EntityId& hand, const NearBodies& near,
                      bool frozen, const ContactSources& sources) noexcept {
  haptics::ContactSet& set = port.contact_slot();
  set.count = 0;
  set.frozen = frozen;
  set.left_out = near.left_out();
  for (const NearBody& body : near.bodies()) {
    if (!body.may_press) continue;
    RemoteHand& out = set.hands[set.count++];
    if (body.row != nullptr) {
      fill_remote(*body.row, sources.books.find(port.hand(), body.row->id), sources.interop, out);
      continue;
    }
    const auto other =
        std::find_if(sources.hands.begin(), sources.hands.end(),
                     [&](const HandPort& candidate) { return candidate.hand() == body.number; });
    if (other != sources.hands.end()) {
      fill_own(body, body.own->truth().time, sources, out);
      fill_accounts(*other, hand, out);
      out.has_device = true;
    } else {
      fill_own(body, sources.now, sources, out);
      fill_body_accounts(body, hand, sources, out);
      out.has_device = false;
    }
  }
  port.publish_contacts(sources.now);
}

}  // namespace reckon::peer
