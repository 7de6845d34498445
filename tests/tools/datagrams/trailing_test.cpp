// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Octets behind the last field, as some senders leave them: each injected error is named.
#include "reckon/tools/datagrams/trailing.hpp"

#include <gmock/gmock.h>

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "reckon/pdu/entity/variable_parameter.hpp"
#include "reckon/pdu/management/data.hpp"
#include "reckon/pdu/management/start_resume.hpp"
#include "reckon/pdu/radio/signal.hpp"
#include "reckon/pdu/radio/transmitter.hpp"
#include "reckon/tests/support/capture_builder.hpp"
#include "reckon/tools/datagrams/pdu_row.hpp"

namespace reckon::tools {
namespace {

using test::append_pdu;
using test::Octets;
using ::testing::EndsWith;
using ::testing::StartsWith;

/// Rule, place and reason of a datagram's only PDU.
PduRow row_of(const Octets& octets) {
  peer::SourceDatagram datagram;
  datagram.bytes = octets;
  PduRow only;
  DatagramInspector inspector;
  (void)inspector.inspect(datagram, [&](const PduRow& row) {
    only = row;
    return true;
  });
  EXPECT_EQ(inspector.tally().all_pdus(), 1U);
  return only;
}

template <typename Pdu>
Octets encoded(const Pdu& pdu) {
  Octets octets;
  append_pdu(octets, pdu);
  return octets;
}

void put16(Octets& octets, std::size_t at, std::size_t value) {
  pdu::store_big_endian(octets.data() + at, static_cast<std::uint16_t>(value));
}

/// Octets that contain their own index.
Octets numbered(std::size_t count) {
  Octets octets(count);
  for (std::size_t i = 0; i < count; ++i) octets[i] = static_cast<std::byte>(i + 1);
  return octets;
}

void expect_trailing(const Octets& octets, std::size_t behind, const std::string& cause) {
  const PduRow row = row_of(octets);
  EXPECT_EQ(row.rule, "W-TRAILING");
  EXPECT_EQ(row.status, PduStatus::warning);
  EXPECT_TRUE(row.decoded);
  EXPECT_EQ(row.fault_offset, octets.size() - behind);
  EXPECT_THAT(row.reason, StartsWith(std::to_string(behind) + " octet"));
  if (cause.empty())
    EXPECT_EQ(row.reason.find(';'), std::string::npos) << row.reason;
  else
    EXPECT_THAT(row.reason, EndsWith("; " + cause));
}

TEST(Trailing, GivesPlaceNumberAndFirstOctets) {
  Octets octets = encoded(pdu::EntityState{});
  const Octets more = numbered(20);
  octets.insert(octets.end(), more.begin(), more.end());
  put16(octets, 8, octets.size());
  const PduRow row = row_of(octets);
  EXPECT_EQ(row.fault_offset, 144U);
  EXPECT_EQ(row.reason, "20 octets after the last field: 0102030405060708090a0b0c0d0e0f10...");
}

TEST(Trailing, NamesACountThatLeavesRecordsOut) {
  const Octets records = numbered(32);
  pdu::EntityState state;
  state.variable_parameters = records;
  Octets octets = encoded(state);
  octets[19] = std::byte{0};
  expect_trailing(octets, 32,
                  "number_of_variable_parameter_records is 0, and 2 more records are present");
  octets[19] = std::byte{1};
  expect_trailing(octets, 16,
                  "number_of_variable_parameter_records is 1, and 1 more record is present");
}

TEST(Trailing, NamesALengthInOctetsOfASignal) {
  pdu::Signal signal;
  const Octets sound = numbered(160);
  signal.data = {1280, sound};
  Octets octets = encoded(signal);
  ASSERT_EQ(row_of(octets).rule, "");
  put16(octets, 28, 160);
  expect_trailing(octets, 140,
                  "data_length is 160 bits, 140 octets fewer than are present: given in octets?");
  put16(octets, 28, 0);
  expect_trailing(octets, 160, "data_length is 0 bits, 160 octets fewer than are present");
  put16(octets, 28, 800);  // neither
  expect_trailing(octets, 60, "");
}

TEST(Trailing, NamesACountOfAntennaPatterns) {
  pdu::Transmitter transmitter;
  const Octets pattern = numbered(40);
  transmitter.antenna_pattern_type = pdu::BeamAntennaPattern::kBeam;
  transmitter.antenna_pattern = decltype(transmitter.antenna_pattern)::of(pattern);
  Octets octets = encoded(transmitter);
  ASSERT_EQ(octets.size(), 144U);
  ASSERT_EQ(row_of(octets).rule, "");
  put16(octets, 70, 1);
  expect_trailing(octets, 39,
                  "length_of_antenna_pattern is 1 octet, 39 fewer than are present: a count in "
                  "place of a length?");
}

TEST(Trailing, NamesALengthInOctetsOfADatum) {
  std::array<std::byte, 64> room{};
  pdu::VariableDatumWriter writer(room);
  const Octets text = numbered(16);
  ASSERT_TRUE(writer.add(10001, text));
  pdu::Data data;
  data.variable_datums = writer.datums();
  Octets octets = encoded(data);
  ASSERT_EQ(octets.size(), 64U);
  octets[46] = octets[47] = std::byte{0};
  octets[47] = std::byte{16};  // bits, but there are 128
  expect_trailing(
      octets, 8,
      "variable_datum_length is 16 bits, 14 octets fewer than are present: given in octets?");
  octets = encoded(data);
  octets[39] = std::byte{0};
  expect_trailing(octets, 24,
                  "number_of_variable_datum_records is 0, and 1 more record is present");
}

TEST(Trailing, KnowsPaddingWithinTheLength) {
  Octets octets = encoded(pdu::StartResume{});  // 44 octets
  octets.resize(48);
  put16(octets, 8, 48);
  expect_trailing(octets, 4, "padding: the length field must not count it");
}

}  // namespace
}  // namespace reckon::tools
