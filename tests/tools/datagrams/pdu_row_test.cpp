// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The content of the inspector's rows, compared with the decoder alone.
#include "reckon/tools/datagrams/pdu_row.hpp"

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
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

/// A good Entity State, a Fire, one with a NaN, one with a false count, and a good one again.
Octets mixed_bundle() {
  Octets octets;
  append_pdu(octets, entity(1));
  append_pdu(octets, pdu::Fire{});
  pdu::EntityState not_finite = entity(3);
  not_finite.location.x = std::numeric_limits<double>::quiet_NaN();
  append_pdu(octets, not_finite);
  const std::size_t broken = octets.size();
  append_pdu(octets, entity(4));
  octets[broken + 19] = std::byte{200};  // count of absent records
  append_pdu(octets, entity(5));
  return octets;
}

/// The rows of a datagram: type, rule and reason.
using Row = std::tuple<std::string, std::string, std::string>;
std::vector<Row> rows_of(const Octets& octets, bool lenient) {
  peer::SourceDatagram datagram;
  datagram.bytes = octets;
  std::vector<Row> rows;
  DatagramInspector inspector(lenient);
  (void)inspector.inspect(datagram, [&](const PduRow& row) {
    rows.emplace_back(row.type(), row.rule, row.reason);
    return true;
  });
  return rows;
}

TEST(DatagramInspector, TakesLengthZeroAsTheRestIfLenient) {
  Octets octets;
  append_pdu(octets, entity(1));
  append_pdu(octets, entity(2));
  octets[144 + 8] = octets[144 + 9] = std::byte{0};
  EXPECT_EQ(std::get<1>(rows_of(octets, false).at(1)), "E-LENGTH");
  const Octets before = octets;
  const auto rows = rows_of(octets, true);
  EXPECT_EQ(octets, before);
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[0], Row("entity_state", "", ""));
  EXPECT_EQ(rows[1],
            Row("entity_state", "I-NO-LENGTH",
                "the length field is 0: the 144 octets to the end of the datagram are used"));
  octets.resize(288 + 5, std::byte{0xAB});
  EXPECT_EQ(std::get<2>(rows_of(octets, true).at(1)),
            "the length field is 0: the 149 octets to the end of the datagram are used; 5 octets "
            "after the last field are kept: ababababab");
  octets.resize(144 + 20);  // too short for its fields, whatever the length field
  EXPECT_EQ(
      rows_of(octets, true).at(1),
      Row("entity_state", "E-LENGTH", "20 octets available, entity_state needs at least 144"));
  EXPECT_EQ(std::get<2>(rows_of(octets, false).at(1)),
            "length field: 0 octets, 20 available, entity_state needs at least 144");
}

TEST(DatagramInspector, NamesALittleEndianLength) {
  const auto exchange = [](Octets& octets, std::size_t pdu) {
    std::swap(octets[pdu + 8], octets[pdu + 9]);
  };
  Octets octets;
  append_pdu(octets, entity(1));
  exchange(octets, 0);
  EXPECT_EQ(rows_of(octets, false).at(0),
            Row("entity_state", "E-BYTE-ORDER",
                "length field: 36864 octets, 144 remain; 36864 is 144 with its octets swapped"));
  append_pdu(octets, entity(2));  // the next one begins at the false length
  EXPECT_EQ(std::get<1>(rows_of(octets, false).at(0)), "E-BYTE-ORDER");
  octets.resize(octets.size() - 1);
  octets[144] = std::byte{9};
  EXPECT_EQ(std::get<1>(rows_of(octets, false).at(0)), "E-TRUNCATED") << "it leads nowhere";
  Octets large;
  std::array<std::byte, 16 * 23> parameters{};
  pdu::EntityState state = entity(3);
  state.variable_parameters = parameters;
  append_pdu(large, state);  // 512 octets: 2 when exchanged
  ASSERT_EQ(large.size(), 512U);
  exchange(large, 0);
  EXPECT_EQ(rows_of(large, false).at(0), Row("entity_state", "E-BYTE-ORDER",
                                             "length field: 2 octets, entity_state needs at least "
                                             "144; 2 is 512 with its octets swapped"));
}

TEST(DatagramInspector, KeepsAndNotesTrailingOctetsIfLenient) {
  const auto expect_trailing = [](const Octets& trailing, std::string_view in_hex) {
    Octets octets;
    append_pdu(octets, pdu::Fire{});
    octets.insert(octets.end(), trailing.begin(), trailing.end());
    EXPECT_EQ(std::get<1>(rows_of(octets, false).at(1)).substr(0, 2), "E-");
    const auto rows = rows_of(octets, true);
    ASSERT_EQ(rows.size(), 2U);
    EXPECT_EQ(rows[0], Row("fire", "", ""));
    EXPECT_EQ(rows[1], Row("trailing", "I-TRAILING",
                           std::to_string(trailing.size()) +
                               " octets after the last PDU are kept: " + std::string(in_hex)));
  };
  expect_trailing(Octets(3, std::byte{0x55}), "555555");
  expect_trailing(Octets(40, std::byte{0xFF}), "ffffffffffffffffffffffffffffffff...");
  expect_trailing(Octets(11, std::byte{7}), "0707070707070707070707");  // begins like a PDU
  expect_trailing(Octets(12, std::byte{0}), "000000000000000000000000");
}

TEST(DatagramInspector, WarnsOfOctetsBehindTheLastField) {
  Octets octets;
  append_pdu(octets, entity(1));
  octets.resize(152, std::byte{0x11});
  octets[9] = std::byte{152};
  EXPECT_EQ(rows_of(octets, false),
            std::vector<Row>({Row("entity_state", "W-TRAILING",
                                  "8 octets after the last field: 1111111111111111")}));
  EXPECT_EQ(rows_of(octets, true),
            std::vector<Row>({Row("entity_state", "I-TRAILING",
                                  "8 octets after the last field are kept: 1111111111111111")}));
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

TEST(DatagramInspector, ReturnsTheBodyOfDecodedEntityStatesOnly) {
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

Octets octets_of(std::string_view text) {
  const auto octets = std::as_bytes(std::span(text));
  return {octets.begin(), octets.end()};
}

/// A DNS message with this identifier: a question for one name.
Octets dns(unsigned identifier, bool is_answer) {
  Octets out{static_cast<std::byte>(identifier >> 8),
             static_cast<std::byte>(identifier),
             std::byte{is_answer ? std::uint8_t{0x81} : std::uint8_t{0x01}},
             std::byte{is_answer ? std::uint8_t{0x80} : std::uint8_t{0}},
             std::byte{0},
             std::byte{1},
             std::byte{0},
             std::byte{is_answer}};
  const Octets rest = octets_of(std::string_view("\0\0\0\0\7example\3com\0\0\1\0\1", 21));
  out.insert(out.end(), rest.begin(), rest.end());
  return out;
}

/// The only row of a datagram.
PduRow only_row(const Octets& octets, std::uint16_t port = 3000,
                peer::Portion portion = peer::Portion::whole) {
  peer::SourceDatagram datagram;
  datagram.bytes = octets;
  datagram.group.port = port;
  datagram.portion = portion;
  DatagramInspector inspector;
  std::vector<PduRow> rows;
  (void)inspector.inspect(datagram, [&](const PduRow& row) {
    rows.push_back(row);
    return true;
  });
  EXPECT_EQ(rows.size(), 1U);
  EXPECT_EQ(inspector.tally().foreign, rows.front().rule == "I-FOREIGN" ? 1U : 0U);
  return rows.front();
}

TEST(DatagramInspector, NotesDatagramsOfOtherProtocols) {
  Octets ntp(48, std::byte{0});
  ntp[0] = std::byte{0x23};
  const Octets ssdp = octets_of("M-SEARCH * HTTP/1.1\r\nHOST: 239.255.255.250:1900\r\n\r\n");
  const std::vector<std::tuple<Octets, std::uint16_t, std::string>> foreign{
      {dns(0, false), 5353, "no DIS PDU in 29 octets; port 5353 is registered for mDNS"},
      {ntp, 123, "no DIS PDU in 48 octets; port 123 is registered for NTP"},
      {ssdp, 1900, "no DIS PDU in 51 octets; port 1900 is registered for SSDP"},
      {ssdp, 3000, "no DIS PDU in 51 octets"},
      {octets_of("ping"), 3000, "no DIS PDU in 4 octets"}};
  for (const auto& [octets, port, reason] : foreign) {
    const PduRow row = only_row(octets, port);
    EXPECT_EQ(row.rule, "I-FOREIGN");
    EXPECT_EQ(row.status, PduStatus::note);
    EXPECT_EQ(row.type(), "foreign");
    EXPECT_EQ(row.reason, reason);
  }
}

TEST(DatagramInspector, TakesDnsWithAnyIdentifierForForeign) {
  for (unsigned identifier = 0; identifier < 0x10000; ++identifier)
    for (const bool is_answer : {false, true})
      ASSERT_EQ(only_row(dns(identifier, is_answer)).rule, "I-FOREIGN") << identifier;
}

TEST(DatagramInspector, KeepsDamagedPdusApartFromOtherProtocols) {
  Octets octets;
  append_pdu(octets, entity(1));
  Octets cut(octets.begin(), octets.end() - 4);
  EXPECT_EQ(only_row(cut).rule, "E-TRUNCATED");
  cut.resize(5);
  EXPECT_EQ(only_row(cut).rule, "E-TRUNCATED");
  EXPECT_EQ(only_row({}).rule, "E-TRUNCATED");
  Octets of_length_0 = octets;
  of_length_0[8] = of_length_0[9] = std::byte{0};
  EXPECT_EQ(only_row(of_length_0).rule, "E-LENGTH");
  Octets newer = octets;
  newer[0] = std::byte{8};
  EXPECT_EQ(only_row(newer).rule, "E-VERSION");
  // Nothing is known about a part of a datagram.
  const Octets rest(40, std::byte{0x55});
  EXPECT_EQ(only_row(rest).rule, "I-FOREIGN");
  EXPECT_EQ(only_row(rest, 3000, peer::Portion::cut).status, PduStatus::error);
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
