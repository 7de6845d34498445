// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/pdu/management/datum.hpp"

#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <vector>

#include "reckon/pdu/management/comment.hpp"
#include "reckon/pdu/management/data.hpp"
#include "reckon/tests/pdu/support/guarded_buffer.hpp"
#include "reckon/tests/support/allocation_guard.hpp"
#include "reckon/tests/support/wire_samples.hpp"

namespace reckon::pdu::datum_test {
namespace {

std::array<std::byte, 56> datum_bomb() {
  std::array<std::byte, 56> octets;
  Data pdu;
  const std::array<std::byte, 16> datum{};
  pdu.variable_datums = {1, datum};
  EXPECT_EQ(encode(pdu, octets), 56U);
  store_big_endian(octets.data() + 44, 0xFFFFFFFFU);
  return octets;
}

TEST(Data, RefusesADatumOfMaximumLengthAtOnce) {
  const auto octets = datum_bomb();
  test::GuardedBuffer buffer;
  const auto guarded = buffer.hold(octets);
  const test::AllocationGuard guard;
  Data pdu;
  const DecodeError error = decode(guarded, pdu);
  const std::size_t allocations = guard.count();
  EXPECT_EQ(error, DecodeError::record);
  EXPECT_EQ(allocations, 0U);
  EXPECT_EQ(pdu.variable_datums.count, 0U);
}

TEST(Data, RefusesMoreRecordsThanOctets) {
  test::GuardedBuffer buffer;
  for (const std::uint32_t count : {3U, 1U << 29, 0xFFFFFFFFU}) {
    auto octets = test::sample_octets("data");
    store_big_endian(octets.data() + 36, count);  // variable datums
    Data pdu;
    EXPECT_EQ(decode(buffer.hold(octets), pdu), DecodeError::count) << count;
  }
  for (const std::uint32_t count : {8U, 1U << 29, 0xFFFFFFFFU}) {
    auto octets = test::sample_octets("data");
    store_big_endian(octets.data() + 32, count);  // fixed datums
    Data pdu;
    EXPECT_EQ(decode(buffer.hold(octets), pdu), DecodeError::count) << count;
  }
}

TEST(Data, GivesFixedDatumsInOrder) {
  const auto octets = test::sample_octets("data");
  Data pdu;
  ASSERT_EQ(decode(octets, pdu), DecodeError::none);
  std::vector<FixedDatum> datums;
  for (const FixedDatum& datum : records_of<FixedDatum>(pdu.fixed_datums)) datums.push_back(datum);
  EXPECT_EQ(datums, (std::vector<FixedDatum>{{1000, 7}, {1001, 0xFFFFFFFF}}));
}

TEST(VariableDatums, GiveTheValueWithoutPadding) {
  const auto octets = test::sample_octets("data");
  Data pdu;
  ASSERT_EQ(decode(octets, pdu), DecodeError::none);
  std::vector<std::size_t> sizes;
  for (const VariableDatum& datum : pdu.variable_datums.records())
    sizes.push_back(datum.value.size());
  EXPECT_EQ(sizes, (std::vector<std::size_t>{8, 9}));
}

TEST(VariableDatums, MayLackThePaddingOfTheLastRecord) {
  const auto whole = test::sample_octets("data");
  auto octets = whole;
  octets.resize(octets.size() - 7);
  store_big_endian(octets.data() + 8, static_cast<std::uint16_t>(octets.size()));
  test::GuardedBuffer buffer;
  Data pdu;
  ASSERT_EQ(decode(buffer.hold(octets), pdu), DecodeError::none);
  EXPECT_EQ(pdu.variable_datums.bytes.size(), 16U + 17U);
}

TEST(VariableDatumWriter, MakesABlockThatReadsBack) {
  std::array<std::byte, 64> buffer;
  VariableDatumWriter writer(buffer);
  const std::array<std::byte, 13> value{std::byte{1}, std::byte{2}};
  ASSERT_TRUE(writer.add(9, value));
  ASSERT_TRUE(writer.add(10, {}));
  const VariableDatums datums = writer.datums();
  EXPECT_EQ(datums.count, 2U);
  EXPECT_EQ(datums.bytes.size(), 8U + 16U + 8U);

  const VariableDatum first = *datums.records().begin();
  EXPECT_EQ(first.datum_id, 9U);
  EXPECT_EQ(first.length_bits, 104U);
  EXPECT_TRUE(std::equal(first.value.begin(), first.value.end(), value.begin(), value.end()));
}

TEST(VariableDatumWriter, ChangesNothingWhenADatumDoesNotFit) {
  std::array<std::byte, 31> buffer;
  VariableDatumWriter writer(buffer);
  const std::array<std::byte, 9> value{};
  EXPECT_TRUE(writer.add(1, value));
  EXPECT_FALSE(writer.add(1, {}));
  EXPECT_EQ(writer.datums().count, 1U);
}

}  // namespace
}  // namespace reckon::pdu::datum_test
