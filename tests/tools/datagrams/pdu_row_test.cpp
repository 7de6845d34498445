// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What the inspector's rows hold, beside the decoder by itself.
#include "reckon/tools/datagrams/pdu_row.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <optional>
#include <vector>

#include "reckon/pdu/live_entity/le_fire.hpp"
#include "reckon/pdu/warfare/fire.hpp"
#include "reckon/tests/support/allocation_guard.hpp"
#include "reckon/tests/support/capture_builder.hpp"

namespace reckon::tools {
namespace {

using test::append_pdu;
using test::Octets;

pdu::EntityState entity(std::uint16_t number) {
  pdu::EntityState pdu;
  pdu.entity_id = {1, 2, number};
  pdu.location = {4e6 + number, 1e6, 4e6};
  return pdu;
}

/// A good Entity State, a Fire, one with a NaN, one whose count lies, and a good one again.
Octets mixed_bundle() {
  Octets octets;
  append_pdu(octets, entity(1));
  append_pdu(octets, pdu::Fire{});
  pdu::EntityState not_finite = entity(3);
  not_finite.location.x = std::numeric_limits<double>::quiet_NaN();
  append_pdu(octets, not_finite);
  const std::size_t broken = octets.size();
  append_pdu(octets, entity(4));
  octets[broken + 19] = std::byte{200};  // records that are not there
  append_pdu(octets, entity(5));
  return octets;
}

TEST(DatagramInspector, NamesLiveEntitiesByTheirShorterIds) {
  pdu::LeFire fire;
  fire.firing_live_entity_id = {7, 8, 900};
  Octets octets;
  append_pdu(octets, fire);
  append_pdu(octets, fire);
  octets.pop_back();  // the second is cut
  peer::SourceDatagram datagram;
  datagram.bytes = octets;
  std::vector<std::optional<pdu::EntityId>> ids;
  DatagramInspector inspector;
  (void)inspector.inspect(datagram, [&](const PduRow& row) {
    ids.push_back(row.id);
    return true;
  });
  ASSERT_EQ(ids.size(), 2U);
  EXPECT_EQ(ids[0], (pdu::EntityId{7, 8, 900}));
  EXPECT_FALSE(ids[1].has_value()) << "six octets were read where there are four";
}

TEST(DatagramInspector, GivesTheBodyOfEachEntityStateThatDecodesAndOfNothingElse) {
  const Octets octets = mixed_bundle();
  peer::SourceDatagram datagram;
  datagram.bytes = octets;
  DatagramInspector inspector;
  std::vector<PduStatus> statuses;
  (void)inspector.inspect(datagram, [&](const PduRow& row) {
    statuses.push_back(row.status);
    const bool has_body = row.pdu == 1 || row.pdu == 3 || row.pdu == 5;
    EXPECT_EQ(row.entity_state != nullptr, has_body) << row.pdu;
    if (row.entity_state == nullptr) return true;
    pdu::EntityState decoded;
    EXPECT_EQ(decode(row.bytes, decoded), pdu::DecodeError::none);
    EXPECT_EQ(row.entity_state->entity_id, decoded.entity_id);
    EXPECT_EQ(row.entity_state->entity_id.entity, row.pdu);
    Octets again;
    append_pdu(again, *row.entity_state);
    EXPECT_EQ(again, Octets(row.bytes.begin(), row.bytes.end()));
    return true;
  });
  EXPECT_EQ(statuses, (std::vector{PduStatus::ok, PduStatus::ok, PduStatus::warning,
                                   PduStatus::error, PduStatus::ok}));
}

TEST(DatagramInspector, TakesNothingFromTheHeapForGoodPdus) {
  Octets octets;
  for (std::uint16_t number = 1; number <= 9; ++number) append_pdu(octets, entity(number));
  peer::SourceDatagram datagram;
  datagram.bytes = octets;
  DatagramInspector inspector;
  const test::AllocationGuard guard;
  (void)inspector.inspect(datagram, [](const PduRow&) { return true; });
  EXPECT_EQ(guard.count(), 0U);
  EXPECT_EQ(inspector.tally().of(PduStatus::ok), 9U);
}

}  // namespace
}  // namespace reckon::tools
