// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/pdu/bundle.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <vector>

#include "reckon/pdu/pdu_types.hpp"
#include "reckon/tests/pdu/support/guarded_buffer.hpp"
#include "reckon/tests/support/allocation_guard.hpp"
#include "reckon/tests/support/wire_samples.hpp"

namespace reckon::pdu {
namespace {

using Octets = std::vector<std::byte>;

Octets header_only(PduType type, std::uint16_t length = 12) {
  Octets octets(length);
  PduHeader header;
  header.pdu_type = type;
  header.length = length;
  EXPECT_EQ(store_record(header, octets), kHeaderSize);
  return octets;
}

Octets operator+(Octets left, const Octets& right) {
  left.insert(left.end(), right.begin(), right.end());
  return left;
}

std::vector<BundledPdu> read(std::span<const std::byte> datagram) {
  std::vector<BundledPdu> pdus;
  for (const BundledPdu& pdu : BundleReader(datagram)) pdus.push_back(pdu);
  return pdus;
}

TEST(BundleRank, PutsEntityStatesFirstAndTheTrailerLast) {
  const std::vector<PduType> in_order{PduType::entity_state, PduType::collision, PduType::attribute,
                                      PduType::presence, PduType::datagram_trailer};
  for (std::size_t i = 0; i < in_order.size(); ++i) EXPECT_EQ(bundle_rank(in_order[i]), i);
  EXPECT_EQ(bundle_rank(PduType{100}), 1);
  EXPECT_EQ(bundle_rank(PduType{255}), 3);
}

TEST(BundleWriter, AcceptsOnlySequencesOfNonDecreasingRank) {
  std::mt19937 random(11);
  for (int round = 0; round < 5000; ++round) {
    std::array<std::byte, 400> buffer;
    BundleWriter writer(buffer);
    int last = 0;
    std::vector<PduType> taken;
    for (int i = 0; i < 12; ++i) {
      const auto type = static_cast<PduType>(random() % 4 == 0 ? 141 : random() % 256);
      const auto pdu = header_only(type, static_cast<std::uint16_t>(12 + 4 * (random() % 8)));
      const bool fits = pdu.size() <= buffer.size() - writer.size();
      const bool ordered = last < 4 && bundle_rank(type) >= last;
      ASSERT_EQ(writer.append_raw(pdu), fits && ordered) << "round " << round;
      if (!fits || !ordered) continue;
      last = bundle_rank(type);
      taken.push_back(type);
    }
    if (taken.empty()) continue;
    const auto pdus = read(writer.bytes());
    ASSERT_EQ(pdus.size(), taken.size());
    for (std::size_t i = 0; i < pdus.size(); ++i) {
      EXPECT_EQ(pdus[i].header.pdu_type, taken[i]);
      EXPECT_EQ(pdus[i].error, DecodeError::none);
    }
  }
}

TEST(BundleWriter, EncodesInPlaceUpToItsLimit) {
  std::array<std::byte, 1352> buffer;
  BundleWriter writer(buffer);
  EntityState state;
  while (writer.append(state)) ++state.entity_id.entity;
  EXPECT_EQ(writer.count(), 9U);
  EXPECT_EQ(writer.size(), 9U * 144U);
  EXPECT_TRUE(writer.accepts(PduType::datagram_trailer, 24));
  EXPECT_TRUE(writer.append(DatagramTrailer{}));
  EXPECT_FALSE(writer.append(DatagramTrailer{}));

  std::uint16_t entity = 0;
  for (const BundledPdu& pdu : read(writer.bytes().first(9U * 144U))) {
    EntityState back;
    ASSERT_EQ(decode(pdu.bytes, back), DecodeError::none);
    EXPECT_EQ(back.entity_id.entity, entity++);
  }
}

TEST(BundleWriter, RefusesOctetsThatAreNotExactlyOnePdu) {
  std::array<std::byte, 256> buffer;
  BundleWriter writer(buffer);
  auto octets = header_only(PduType::fire, 20);
  EXPECT_FALSE(writer.append_raw(std::span(octets).first(19)));
  octets.push_back(std::byte{0});
  EXPECT_FALSE(writer.append_raw(octets));
  EXPECT_FALSE(writer.append_raw({}));
  EXPECT_TRUE(writer.empty());
}

TEST(BundleWriter, StartsAgainAfterClear) {
  std::array<std::byte, 256> buffer;
  BundleWriter writer(buffer);
  ASSERT_TRUE(writer.append(DatagramTrailer{}));
  writer.clear();
  EXPECT_TRUE(writer.append(EntityState{}));
  EXPECT_EQ(writer.size(), 144U);
}

TEST(BundleReader, AcceptsZeroPaddingToAMultipleOfEight) {
  const auto first = header_only(PduType::fire, 29);
  const auto second = header_only(PduType::collision, 60);
  const auto datagram = first + Octets(3) + second + Octets(4);
  const auto pdus = read(datagram);
  ASSERT_EQ(pdus.size(), 2U);
  EXPECT_EQ(pdus[1].offset, 32U);
  EXPECT_EQ(pdus[1].header.pdu_type, PduType::collision);
  EXPECT_EQ(pdus[1].error, DecodeError::none);
}

TEST(BundleReader, TakesPdusOfAnyLengthWithoutPadding) {
  Octets datagram;
  for (std::uint16_t length = 12; length < 40; ++length)
    datagram = datagram + header_only(PduType::fire, length);
  const auto pdus = read(datagram);
  ASSERT_EQ(pdus.size(), 28U);
  for (const BundledPdu& pdu : pdus) EXPECT_EQ(pdu.error, DecodeError::none);
}

TEST(BundleReader, KeepsUnknownTypesAndContinues) {
  const auto datagram =
      header_only(PduType::fire) + header_only(PduType{222}, 40) + header_only(PduType::data, 40);
  const auto pdus = read(datagram);
  ASSERT_EQ(pdus.size(), 3U);
  EXPECT_EQ(pdus[1].bytes.size(), 40U);
  EXPECT_EQ(visit(pdus[1].bytes, pdus[1].header, [](const auto&) { FAIL(); }),
            DecodeError::unknown_type);
  EXPECT_EQ(pdus[2].header.pdu_type, PduType::data);
}

TEST(BundleReader, SkipsAForeignVersionByItsLength) {
  auto foreign = header_only(PduType::entity_state, 144);
  foreign[0] = std::byte{99};
  const auto pdus = read(foreign + header_only(PduType::fire));
  ASSERT_EQ(pdus.size(), 2U);
  EXPECT_EQ(pdus[0].error, DecodeError::version);
  EXPECT_EQ(pdus[1].error, DecodeError::none);
}

TEST(BundleReader, SkipsConsecutiveForeignPdusWithPadding) {
  auto foreign = header_only(PduType::entity_state, 45);
  foreign[0] = std::byte{8};
  const auto pdus = read(foreign + Octets(3) + foreign + Octets(3) + header_only(PduType::fire));
  ASSERT_EQ(pdus.size(), 3U);
  EXPECT_EQ(pdus[0].error, DecodeError::version);
  EXPECT_EQ(pdus[1].error, DecodeError::version);
  EXPECT_EQ(pdus[1].offset, 48U);
  EXPECT_EQ(pdus[2].error, DecodeError::none);
}

// Otherwise the reader would follow lengths that are payload of something else.
TEST(BundleReader, TakesOctetsWithoutAFollowingPduAsStray) {
  Octets noise(60, std::byte{0xEE});
  store_big_endian(noise.data() + 8, std::uint16_t{20});
  noise[20] = std::byte{0xDD};
  const auto pdus = read(header_only(PduType::fire, 24) + noise);
  ASSERT_EQ(pdus.size(), 2U);
  EXPECT_EQ(pdus[0].error, DecodeError::none);
  EXPECT_EQ(pdus[1].error, DecodeError::stray);
  EXPECT_EQ(pdus[1].bytes.size(), 60U);
}

TEST(BundleReader, KeepsOtherPdusBesideOneWithShortLength) {
  // The length of the second PDU is too small for its type, but it leads to the third.
  auto second = header_only(PduType::entity_state, 20);
  const auto datagram = test::sample_octets("collision") + second + test::sample_octets("fire");
  const auto pdus = read(datagram);
  ASSERT_EQ(pdus.size(), 3U);
  EntityState state;
  Fire fire;
  EXPECT_EQ(decode(pdus[1].bytes, state), DecodeError::length);
  EXPECT_EQ(decode(pdus[2].bytes, fire), DecodeError::none);
}

TEST(BundleReader, ReturnsPdusWithBrokenBodyAndTheNext) {
  auto broken = test::sample_octets("entity_state");
  broken[19] = std::byte{255};
  const auto datagram = broken + test::sample_octets("collision");
  const auto pdus = read(datagram);
  ASSERT_EQ(pdus.size(), 2U);
  EntityState state;
  Collision collision;
  EXPECT_EQ(decode(pdus[0].bytes, state), DecodeError::count);
  EXPECT_EQ(decode(pdus[1].bytes, collision), DecodeError::none);
}

TEST(BundleReader, ReportsATruncatedPduAndStops) {
  const auto datagram = header_only(PduType::fire, 24) + header_only(PduType::collision, 60);
  const auto pdus = read(std::span(datagram).first(70));
  ASSERT_EQ(pdus.size(), 2U);
  EXPECT_EQ(pdus[1].error, DecodeError::truncated);
  EXPECT_EQ(pdus[1].offset, 24U);
  EXPECT_EQ(pdus[1].index, 1U);
  EXPECT_EQ(pdus[1].bytes.size(), 46U);
}

TEST(BundleReader, ReportsALengthOfZeroOnce) {
  const auto datagram = header_only(PduType::fire, 24) + header_only(PduType::collision, 60);
  auto trap = datagram;
  store_big_endian(trap.data() + 24 + 8, std::uint16_t{0});
  const auto pdus = read(trap);
  ASSERT_EQ(pdus.size(), 2U);
  EXPECT_EQ(pdus[1].error, DecodeError::length);
}

TEST(BundleReader, ReportsOctetsThatBeginNoPduAsStray) {
  for (const std::size_t size : {1U, 7U, 11U, 12U, 30U}) {
    const auto pdus = read(header_only(PduType::fire, 24) + Octets(size, std::byte{0xEE}));
    ASSERT_EQ(pdus.size(), 2U);
    EXPECT_EQ(pdus[1].error, DecodeError::stray) << size;
    EXPECT_EQ(pdus[1].offset, 24U);
  }
}

TEST(BundleReader, ReportsZeroOctetsBeyondThePaddingAsStray) {
  const auto pdus = read(header_only(PduType::fire, 20) + Octets(4 + 8));
  ASSERT_EQ(pdus.size(), 2U);
  EXPECT_EQ(pdus[1].error, DecodeError::stray);
  EXPECT_EQ(pdus[1].offset, 24U);
}

TEST(BundleReader, ReportsAnEmptyDatagramAsTruncated) {
  const auto pdus = read({});
  ASSERT_EQ(pdus.size(), 1U);
  EXPECT_EQ(pdus[0].error, DecodeError::truncated);
}

TEST(BundleReader, CoversEveryOctetOfAnyDatagramOnce) {
  std::mt19937 random(5);
  test::GuardedBuffer buffer;
  const Octets pieces[] = {test::sample_octets("entity_state"), test::sample_octets("attribute"),
                           test::sample_octets("data"), header_only(PduType{222}, 29), Octets(5)};
  for (int round = 0; round < 5000; ++round) {
    Octets datagram;
    for (auto n = random() % 6; n > 0; --n) datagram = datagram + pieces[random() % 5];
    for (auto n = random() % 4; n > 0 && !datagram.empty(); --n)
      datagram[random() % datagram.size()] = static_cast<std::byte>(random());
    datagram.resize(datagram.size() -
                    (datagram.empty() ? 0 : random() % 3 * random() % datagram.size()));

    std::size_t at = 0;
    std::size_t index = 0;
    for (const BundledPdu& pdu : BundleReader(buffer.hold(datagram))) {
      ASSERT_EQ(pdu.index, index++);
      ASSERT_GE(pdu.offset, at);
      ASSERT_LT(pdu.offset - at, 8U);
      at = pdu.offset + pdu.bytes.size();
      static_cast<void>(visit(pdu.bytes, pdu.header, [](const auto&) {}));
    }
    ASSERT_LE(at, datagram.size());
    ASSERT_LT(datagram.size() - at, 8U) << "round " << round;
  }
}

TEST(Bundle, AllocatesNothingWhenWrittenAndRead) {
  std::array<std::byte, 1352> buffer;
  const test::AllocationGuard guard;
  BundleWriter writer(buffer);
  bool good = writer.append(EntityState{}) && writer.append(Collision{});
  good = good && writer.append(DatagramTrailer{});
  std::size_t decoded = 0;
  for (const BundledPdu& pdu : BundleReader(writer.bytes()))
    good =
        good && visit(pdu.bytes, pdu.header, [&](const auto&) { ++decoded; }) == DecodeError::none;
  const std::size_t allocations = guard.count();
  EXPECT_TRUE(good);
  EXPECT_EQ(decoded, 3U);
  EXPECT_EQ(allocations, 0U);
}

}  // namespace
}  // namespace reckon::pdu
