// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/loops/order_stage.hpp"

#include <optional>

#include "reckon/pdu/management/acknowledge.hpp"
#include "reckon/peer/loops/address_text.hpp"
#include "reckon/peer/loops/notice_text.hpp"
#include "reckon/peer/loops/send_pdu.hpp"
#include "reckon/peer/world/addressed.hpp"

namespace reckon::peer {

// Valid originators: a peer in its own name, or another sender in the name of no peer.
bool OrderStage::obeys(const Inbound& order, const Arrival& arrival, const Pass& pass) noexcept {
  if (!is_addressed(order.entity, owned_.simulation().simulation())) return true;
  const aoim::PeerId originator = order.originator.simulation();
  const auto epoch = aoim_.presence().epoch_of(originator);
  const bool unnamed = originator == aoim::PeerId() && arrival.epoch != 0;  // known by its epoch
  const bool member = unnamed || (epoch && *epoch == arrival.epoch);
  const bool genuine =
      member || (!epoch && arrival.epoch == 0 && !aoim_.presence().is_own(order.originator));
  if (genuine && network_.management.allows(originator, member)) return true;
  counted_.orders_refused.add();
  watches_.note_order(order.originator,
                      order.kind == Inbound::Kind::stop_freeze ? "freeze" : "resume", arrival.from,
                      pass.now);
  return false;
}

void OrderStage::carry_out(const Inbound& order, const Arrival& arrival, const pdu::EntityId& own,
                           const Pass& pass) noexcept {
  if (!is_addressed(order.entity, owned_.simulation().simulation())) return;
  const bool frozen = order.kind == Inbound::Kind::stop_freeze;
  if (is_whole(order.entity)) {
    owned_.for_each([&](OwnedEntity& entity, EntityNumber number) {
      entity.set_frozen(frozen);
      owned_.look_at(number);
    });
    acknowledge(order, arrival, own, pass);
  } else if (OwnedEntity* entity = owned_.find(order.entity.entity);
             entity != nullptr && !entity->is_body()) {
    entity->set_frozen(frozen);
    owned_.look_at(order.entity.entity);
    acknowledge(order, arrival, entity->id(), pass);
  }
}

void OrderStage::acknowledge(const Inbound& order, const Arrival& arrival, const pdu::EntityId& own,
                             const Pass& pass) noexcept {
  const bool frozen = order.kind == Inbound::Kind::stop_freeze;
  pdu::Acknowledge answer;
  answer.header.exercise_id = network_.exercise;
  answer.header.timestamp = time_.stamp(pass.utc);
  answer.originating_entity_id = own;
  answer.receiving_entity_id = order.originator;
  answer.acknowledge_flag =
      frozen ? pdu::AcknowledgeFlag::stop_freeze : pdu::AcknowledgeFlag::start_resume;
  answer.response_flag = pdu::ResponseFlag::able_to_comply;
  answer.request_id = order.request_id;
  send_pdu(aoim_, answer, std::nullopt, pass.now);
  static_cast<void>(watches_.notices().push(
      make_notice(NoticeKind::frozen, "{} by {}:{}:{} at {}", frozen ? "frozen" : "resumed",
                  order.originator.site, order.originator.application, order.originator.entity,
                  AddressText(arrival.from).view())));
}

}  // namespace reckon::peer
