// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/pdu/codec/records.hpp"

#include <gtest/gtest.h>

#include <unordered_set>

#include "reckon/pdu/codec/byte_order.hpp"
#include "reckon/pdu/codec/codec.hpp"
#include "reckon/pdu/reckon/datagram_trailer.hpp"
#include "reckon/pdu/reckon/presence_pdu.hpp"

namespace reckon::pdu {
namespace {

using namespace std::chrono_literals;

TEST(ByteOrder, PutsTheHighestOctetFirst) {
  std::array<std::byte, 8> octets;
  store_big_endian(octets.data(), 0x0102030405060708ULL);
  for (std::size_t i = 0; i < 8; ++i) EXPECT_EQ(octets[i], static_cast<std::byte>(i + 1));
  EXPECT_EQ(load_big_endian<std::uint16_t>(octets.data() + 1), 0x0203);
  store_big_endian(octets.data(), 1.0F);
  EXPECT_EQ(octets[0], std::byte{0x3F});
  EXPECT_EQ(octets[1], std::byte{0x80});
}

TEST(EntityId, OrdersBySiteThenApplicationThenEntity) {
  EXPECT_LT((EntityId{1, 9, 9}), (EntityId{2, 0, 0}));
  EXPECT_LT((EntityId{1, 1, 9}), (EntityId{1, 2, 0}));
  EXPECT_LT((EntityId{1, 1, 1}), (EntityId{1, 1, 2}));
}

TEST(EntityId, HashesOfNeighboursDiffer) {
  std::unordered_set<std::size_t> hashes;
  for (std::uint16_t application = 0; application < 16; ++application)
    for (std::uint16_t entity = 0; entity < 256; ++entity)
      hashes.insert(std::hash<EntityId>{}(EntityId{1, application, entity}) % 65536);
  // 4096 ids in 65536 random buckets occupy 3970 of them on average.
  EXPECT_GT(hashes.size(), 3900U);
}

TEST(Presence, CutsALongName) {
  Presence presence;
  presence.set_name("a name that is much too long");
  EXPECT_EQ(presence.name_view(), "a name that is m");
  presence.set_name("b");
  EXPECT_EQ(presence.name_view(), "b");
}

TEST(DatagramTrailer, GivesTheAgeAcrossAClockWrap) {
  const std::chrono::nanoseconds wrap = std::chrono::microseconds(1ULL << 32);
  for (const auto age : {0ns, 3000ns, -5000ns, 1'500'000'000ns}) {
    const auto sent = 400'000 * wrap - 2us;
    EXPECT_EQ(trailer_age(trailer_time(sent), sent + age), age);
  }
}

TEST(Header, ReadsTwelveOctetsAndReportsErrors) {
  std::array<std::byte, 16> octets{std::byte{7}, std::byte{1}, std::byte{72}, std::byte{1}};
  PduHeader header;
  store_big_endian(octets.data() + 8, std::uint16_t{16});
  EXPECT_EQ(decode_header(octets, header), DecodeError::none);
  EXPECT_EQ(header.pdu_type, PduType::attribute);
  EXPECT_EQ(decode_header(std::span(octets).first(11), header), DecodeError::truncated);
  store_big_endian(octets.data() + 8, std::uint16_t{11});
  EXPECT_EQ(decode_header(octets, header), DecodeError::length);
  store_big_endian(octets.data() + 8, std::uint16_t{17});
  EXPECT_EQ(decode_header(octets, header), DecodeError::truncated);
  octets[0] = std::byte{99};
  EXPECT_EQ(decode_header(octets, header), DecodeError::version);
}

TEST(DecodeErrors, EachHaveARuleAndASentence) {
  std::unordered_set<std::string_view> rules;
  std::unordered_set<std::string_view> sentences;
  for (std::size_t i = 0; i < kDecodeErrors; ++i) {
    const auto error = static_cast<DecodeError>(i);
    rules.insert(rule(error));
    sentences.insert(sentence(error));
    EXPECT_NE(rule(error), "E-INTERNAL");
    EXPECT_EQ(sentence(error).back(), '.');
  }
  EXPECT_EQ(rules.size(), kDecodeErrors);
  EXPECT_EQ(sentences.size(), kDecodeErrors);
  EXPECT_EQ(rule(DecodeError::truncated), "E-TRUNCATED");
}

}  // namespace
}  // namespace reckon::pdu
