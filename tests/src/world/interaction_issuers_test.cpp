// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The issuer of each PDU other than state PDUs.
#include "reckon/peer/world/interaction_issuers.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "reckon/pdu/pdu_types.hpp"
#include "reckon/pdu/type_names.hpp"

namespace reckon::peer {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr pdu::EntityId kOne{1, 2, 3}, kOther{4, 5, 6};

template <pdu::Pdu T>
std::vector<std::byte> octets_of(const T& message) {
  std::vector<std::byte> octets(pdu::wire_size(message));
  EXPECT_EQ(pdu::encode(message, octets), octets.size());
  return octets;
}

template <pdu::Pdu T>
std::vector<pdu::EntityId> issuers(const T& message) {
  const InteractionIssuers found = issuers_of(message.header, octets_of(message));
  return {found.ids().begin(), found.ids().end()};
}

TEST(InteractionIssuers, AreTheFirstIdOfMostTypes) {
  pdu::Fire fire;
  fire.firing_entity_id = kOne;
  fire.target_entity_id = kOther;
  EXPECT_THAT(issuers(fire), ElementsAre(kOne));
  pdu::Comment comment;
  comment.originating_entity_id = kOne;
  comment.receiving_entity_id = kOther;
  EXPECT_THAT(issuers(comment), ElementsAre(kOne));
  pdu::IntercomControl control;  // its first ID is not behind the header
  control.source_entity_id = kOne;
  control.master_intercom_reference_id = kOther;
  EXPECT_THAT(issuers(control), ElementsAre(kOne));
  pdu::LeFire shot;
  shot.firing_live_entity_id = {1, 2, 3};
  EXPECT_THAT(issuers(shot), ElementsAre(kOne));
}

TEST(InteractionIssuers, AreRespondersOrRequesters) {
  pdu::ResupplyOffer offer;
  offer.receiving_entity_id = kOther;
  offer.supplying_entity_id = kOne;
  EXPECT_THAT(issuers(offer), ElementsAre(kOne));
  pdu::RepairComplete repaired;
  repaired.receiving_entity_id = kOther;
  repaired.repairing_entity_id = kOne;
  EXPECT_THAT(issuers(repaired), ElementsAre(kOne));
  pdu::MinefieldQuery query;
  query.minefield_id = kOther;
  query.requesting_entity_id = kOne;
  EXPECT_THAT(issuers(query), ElementsAre(kOne));
  pdu::MinefieldResponseNack nack;
  nack.minefield_id = kOther;
  nack.requesting_entity_id = kOne;
  EXPECT_THAT(issuers(nack), ElementsAre(kOne));
}

TEST(InteractionIssuers, AreBothWhereEitherMaySend) {
  pdu::ResupplyCancel cancel;
  cancel.receiving_entity_id = kOne;
  cancel.supplying_entity_id = kOther;
  EXPECT_THAT(issuers(cancel), ElementsAre(kOne, kOther));
  pdu::PointObjectState object;
  object.object_id = kOne;
  object.referenced_object_id = {7, 8, 9};
  object.requester_simulation_address = {4, 5};
  EXPECT_THAT(issuers(object), ElementsAre(kOne, pdu::EntityId{4, 5, 0}));
}

template <typename T>
void expect_an_issuer() {
  if constexpr (!pdu::is_experimental(T::kPduType)) {
    EXPECT_FALSE(issuers(T{}).empty()) << pdu::name(T::kPduType);
  }
}
template <typename... T>
void expect_an_issuer_of_each(pdu::TypeList<T...>) {
  (expect_an_issuer<T>(), ...);
}

TEST(InteractionIssuers, AreKnownOfEachTypeOfTheStandard) {
  expect_an_issuer_of_each(pdu::PduTypes{});
}

TEST(InteractionIssuers, AreEmptyForShortOrUnknownPdus) {
  pdu::Fire fire;
  fire.firing_entity_id = kOne;
  const std::vector<std::byte> octets = octets_of(fire);
  for (std::size_t size = 0; size < 18; ++size)
    EXPECT_THAT(issuers_of(fire.header, std::span(octets).first(size)).ids(), IsEmpty()) << size;
  pdu::PduHeader header = fire.header;
  header.pdu_type = static_cast<pdu::PduType>(199);
  EXPECT_THAT(issuers_of(header, octets).ids(), IsEmpty());
}

}  // namespace
}  // namespace reckon::peer
