// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// What holds for every PDU type in the list, checked for each of them.
#include "pdu/pdu_types.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <random>
#include <string>
#include <vector>

#include "pdu/print.hpp"
#include "tests/pdu/guarded_buffer.hpp"
#include "tests/pdu/random_pdu.hpp"
#include "tests/pdu/wire_samples.hpp"
#include "tests/support/allocation_guard.hpp"

namespace reckon::pdu {
namespace {

using test::GuardedBuffer;
using test::RandomFields;

template <typename... T>
testing::Types<T...> as_gtest_types(TypeList<T...>);

class PduNames {
 public:
  template <typename T>
  static std::string GetName(int) {
    return std::string(snake_name(T::kPduType));
  }
};

template <typename T>
class EveryPdu : public testing::Test {
 protected:
  static std::vector<std::byte> sample() { return test::sample_octets(snake_name(T::kPduType)); }
  static std::string json(const T& pdu) {
    std::string text;
    TextSink sink(text);
    print_json(pdu, sink);
    return text;
  }
};
TYPED_TEST_SUITE(EveryPdu, decltype(as_gtest_types(PduTypes{})), PduNames);

std::vector<std::byte> encoded(const auto& pdu) {
  std::vector<std::byte> octets(wire_size(pdu));
  EXPECT_EQ(encode(pdu, octets), octets.size());
  return octets;
}

TYPED_TEST(EveryPdu, DecodesTheGoldenSampleToTheValuesThatAnIndependentWriterPutIn) {
  const auto octets = this->sample();
  TypeParam pdu;
  ASSERT_EQ(decode(octets, pdu), DecodeError::none);
  EXPECT_EQ(nlohmann::json::parse(this->json(pdu)),
            test::sample_values(snake_name(TypeParam::kPduType)));
}

TYPED_TEST(EveryPdu, EncodesTheGoldenSampleToTheSameOctets) {
  const auto octets = this->sample();
  TypeParam pdu;
  ASSERT_EQ(decode(octets, pdu), DecodeError::none);
  EXPECT_EQ(encoded(pdu), octets);
}

TYPED_TEST(EveryPdu, ComesBackFromTheWireWithEveryFieldAsItWas) {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    RandomFields random(seed);
    TypeParam pdu;
    fields(random, pdu);
    const auto octets = encoded(pdu);
    TypeParam back;
    ASSERT_EQ(decode(octets, back), DecodeError::none) << "seed " << seed;

    pdu.header.pdu_type = TypeParam::kPduType;
    pdu.header.protocol_family = TypeParam::kProtocolFamily;
    pdu.header.length = static_cast<std::uint16_t>(octets.size());
    EXPECT_EQ(this->json(back), this->json(pdu)) << "seed " << seed;
    EXPECT_EQ(encoded(back), octets) << "seed " << seed;
  }
}

TYPED_TEST(EveryPdu, RejectsEveryTruncationWithoutReadingBeyondIt) {
  const auto octets = this->sample();
  GuardedBuffer buffer;
  for (std::size_t size = 0; size < octets.size(); ++size) {
    TypeParam pdu;
    EXPECT_EQ(decode(buffer.hold(std::span(octets).first(size)), pdu), DecodeError::truncated)
        << size << " octets";
  }
}

TYPED_TEST(EveryPdu, RejectsEveryLengthFieldBelowTheFixedPart) {
  const auto octets = this->sample();
  GuardedBuffer buffer;
  for (std::uint16_t length = 0; length < kFixedSize<TypeParam>; ++length) {
    auto lying = buffer.hold(std::span(octets).first(std::max<std::size_t>(length, kHeaderSize)));
    store_big_endian(lying.data() + 8, length);
    TypeParam pdu;
    EXPECT_EQ(decode(lying, pdu), DecodeError::length) << length;
  }
}

TYPED_TEST(EveryPdu, NeverReadsBeyondALengthFieldThatCutsItsVariablePart) {
  const auto octets = this->sample();
  GuardedBuffer buffer;
  for (auto length = static_cast<std::uint16_t>(kFixedSize<TypeParam>); length < octets.size();
       ++length) {
    auto lying = buffer.hold(std::span(octets).first(length));
    store_big_endian(lying.data() + 8, length);
    TypeParam pdu;
    // Only the padding of the last variable datum may be missing.
    const bool accepted = decode(lying, pdu) == DecodeError::none;
    EXPECT_TRUE(!accepted || length + 8U > octets.size()) << length;
  }
}

TYPED_TEST(EveryPdu, KeepsWhateverItAcceptsFromDamagedOctetsAndNeverReadsBeyondThem) {
  const auto octets = this->sample();
  GuardedBuffer buffer;
  std::mt19937_64 random(7);
  std::size_t accepted = 0;
  for (int i = 0; i < 20000; ++i) {
    auto damaged = buffer.hold(octets);
    for (std::uint64_t n = 1 + random() % 4; n > 0; --n)
      damaged[random() % damaged.size()] =
          static_cast<std::byte>(random() % 4 == 0 ? 255 : random());
    TypeParam pdu;
    if (decode(damaged, pdu) != DecodeError::none) continue;
    ++accepted;
    const auto back = encoded(pdu);
    ASSERT_LE(back.size(), damaged.size());
    // The family and the length are ours to write; all other octets are as they came.
    EXPECT_TRUE(std::equal(back.begin(), back.begin() + 3, damaged.begin()));
    EXPECT_TRUE(std::equal(back.begin() + 4, back.begin() + 8, damaged.begin() + 4));
    EXPECT_TRUE(std::equal(back.begin() + 10, back.end(), damaged.begin() + 10));
  }
  EXPECT_GT(accepted, 1000U);
}

TYPED_TEST(EveryPdu, LeavesTheOutputAsNewlyMadeAfterAnError) {
  auto octets = this->sample();
  octets[0] = std::byte{99};
  RandomFields random(1);
  TypeParam pdu;
  fields(random, pdu);
  ASSERT_EQ(decode(octets, pdu), DecodeError::version);
  EXPECT_EQ(this->json(pdu), this->json(TypeParam{}));
}

TYPED_TEST(EveryPdu, RefusesOctetsOfAnotherType) {
  auto octets = this->sample();
  octets[2] = std::byte{200};
  TypeParam pdu;
  EXPECT_EQ(decode(octets, pdu), DecodeError::pdu_type);
}

TYPED_TEST(EveryPdu, PassesOverOctetsThatALaterRevisionAddedAtTheEnd) {
  auto octets = this->sample();
  const auto whole = octets;
  octets.resize(octets.size() + 24, std::byte{0xEE});
  store_big_endian(octets.data() + 8, static_cast<std::uint16_t>(octets.size()));
  TypeParam pdu;
  ASSERT_EQ(decode(octets, pdu), DecodeError::none);
  EXPECT_EQ(encoded(pdu), whole);
}

TYPED_TEST(EveryPdu, WritesNothingWhenItDoesNotFit) {
  const auto octets = this->sample();
  TypeParam pdu;
  ASSERT_EQ(decode(octets, pdu), DecodeError::none);
  std::vector<std::byte> out(octets.size() - 1, std::byte{0xAA});
  EXPECT_EQ(encode(pdu, out), 0U);
  EXPECT_EQ(out, std::vector<std::byte>(octets.size() - 1, std::byte{0xAA}));
}

TYPED_TEST(EveryPdu, AllocatesNothingWhileDecodingAndEncoding) {
  const auto octets = this->sample();
  std::array<std::byte, 512> out;
  const test::AllocationGuard guard;
  TypeParam pdu;
  const DecodeError error = decode(octets, pdu);
  const std::size_t written = encode(pdu, out);
  const std::size_t allocations = guard.count();
  EXPECT_EQ(error, DecodeError::none);
  EXPECT_EQ(written, octets.size());
  EXPECT_EQ(allocations, 0U);
}

TYPED_TEST(EveryPdu, IsFoundByTheTypeInItsHeader) {
  const auto octets = this->sample();
  PduHeader header;
  ASSERT_EQ(decode_header(octets, header), DecodeError::none);
  bool found = false;
  const DecodeError error = visit(octets, header, [&](const auto& pdu) {
    found = std::is_same_v<std::decay_t<decltype(pdu)>, TypeParam>;
  });
  EXPECT_EQ(error, DecodeError::none);
  EXPECT_TRUE(found);
}

TEST(PduTypes, HoldEachTypeOnce) {
  EXPECT_EQ(PduTypes::kSize, 14U);
  std::size_t listed = 0;
  for (int type = 0; type < 256; ++type) listed += is_listed(static_cast<PduType>(type)) ? 1U : 0U;
  EXPECT_EQ(listed, PduTypes::kSize);
}

TEST(PduTypes, SayUnknownForATypeWithoutAFieldTable) {
  std::array<std::byte, 12> octets{std::byte{7}, std::byte{1}, std::byte{2}};
  store_big_endian(octets.data() + 8, std::uint16_t{12});
  PduHeader header;
  ASSERT_EQ(decode_header(octets, header), DecodeError::none);
  EXPECT_EQ(visit(octets, header, [](const auto&) { FAIL(); }), DecodeError::unknown_type);
}

TEST(Encode, RefusesABlockThatIsNotAWholeNumberOfRecords) {
  const std::array<std::byte, 4096> octets{};
  std::array<std::byte, 8192> out;
  EntityState pdu;
  pdu.variable_parameters = std::span(octets).first(17);
  EXPECT_EQ(encode(pdu, out), 0U);
}

TEST(Encode, RefusesMoreRecordsThanTheCountFieldCanSay) {
  const std::array<std::byte, 4096> octets{};
  std::array<std::byte, 8192> out;
  EntityState pdu;
  pdu.variable_parameters = std::span(octets).first(16 * 255);
  EXPECT_EQ(encode(pdu, out), 144U + 16 * 255);
  pdu.variable_parameters = std::span(octets).first(16 * 256);
  EXPECT_EQ(encode(pdu, out), 0U);
}

TEST(Encode, RefusesAPduLongerThanTheLengthFieldCanSay) {
  const std::vector<std::byte> octets(65536);
  std::vector<std::byte> out(70000);
  Data pdu;
  pdu.fixed_datums = std::span(octets).first(65488);
  EXPECT_EQ(encode(pdu, out), 65528U);
  pdu.fixed_datums = std::span(octets).first(65496);
  EXPECT_EQ(encode(pdu, out), 0U);
}

}  // namespace
}  // namespace reckon::pdu
