// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/ownership/message_codec.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "reckon/pdu/reckon/assured_record.hpp"
#include "reckon/pdu/reckon/datagram_trailer.hpp"

namespace reckon::peer {
namespace message_codec_test {

constexpr TransferNames kNames{3, {1, 2}, {65535, 65535}, {65534, 1}};

std::vector<std::byte> octets_of(const OwnershipMessage& message, EncodedMessage& encoded,
                                 std::uint32_t half = 0) {
  std::vector<std::byte> octets(pdu::kMostAssured);
  encoded = encode_message(message, kNames, half, octets);
  octets.resize(encoded.size);
  return octets;
}

// Encodes, decodes and encodes again. The fields of a message have no comparison; their octets do.
void expect_same_again(const OwnershipMessage& message) {
  EncodedMessage encoded;
  const std::vector<std::byte> octets = octets_of(message, encoded);
  ASSERT_GT(octets.size(), 0U);
  const auto decoded = decode_message(encoded.kind, octets);
  ASSERT_TRUE(decoded.has_value());
  EXPECT_EQ(decoded->index(), message.index());
  EncodedMessage again;
  EXPECT_EQ(octets_of(*decoded, again), octets);
}

Round round_of(std::size_t voters) {
  Round round;
  round.world = {100, 7};
  round.act = 5;
  round.hash = 6;
  round.table = 7;
  round.round = 8;
  round.is_active = round.has_lease = true;
  round.yields_to = 6;
  round.is_decided = true;
  for (std::size_t i = 0; i < voters; ++i) round.heard[i] = static_cast<std::uint8_t>(i + 1);
  return round;
}

Proposal proposal_of(std::size_t voters, std::size_t removed) {
  Proposal proposal;
  proposal.world = {100, 7};
  proposal.act.number = 9;
  proposal.act.chair = 1;
  for (std::size_t i = 0; i < voters; ++i)
    proposal.act.roll.add({static_cast<std::uint32_t>(i + 1), static_cast<std::uint8_t>(i % 64)});
  for (std::size_t i = 0; i < removed; ++i)
    proposal.act.remove(static_cast<std::uint32_t>(1000 + i));
  proposal.act.given.set(3);
  proposal.act.given.set(255);
  proposal.ballot = {4, 2};
  proposal.accepted = {3, 1};
  proposal.phase = DecisionPhase::promise;
  proposal.digest = 77;
  return proposal;
}

Grant grant_of(std::size_t count) {
  Grant grant;
  grant.world = {100, 7};
  grant.transaction = 12;
  grant.to = 5;
  grant.round = 200;
  grant.lease_ms = 1500;
  for (std::size_t i = 0; i < count; ++i) {
    grant.objects.set(i);
    grant.part[i] = {static_cast<std::uint16_t>(i), {version_of(2, 3), 5}};
    grant.states[i].utc = std::chrono::seconds(1'700'000'000);
    grant.states[i].position = {0.1 * static_cast<double>(i), -2.0, 3.0};
    grant.states[i].velocity = {0.5, 0.0, -0.25};
  }
  grant.count = count;
  return grant;
}

TEST(OwnershipCodec, KeepsEveryMessage) {
  expect_same_again(round_of(3));
  expect_same_again(proposal_of(64, 64));
  expect_same_again(Vote{{100, 7}, 9, {4, 2}});
  TableExtract table;
  table.world = {100, 7};
  table.serial = 3;
  table.asks = true;
  for (std::size_t i = 0; i < kMostHoldings; ++i) table.holdings.add(i, {version_of(1, 2), 9});
  expect_same_again(table);
  Agreement agreement{{100, 7}, 3, {}};
  agreement.objects.set(17);
  expect_same_again(agreement);
  Request request{{100, 7}, {}, true};
  request.objects.set(200);
  expect_same_again(request);
  expect_same_again(grant_of(kMostGranted));
  expect_same_again(GrantRefusal{{}, 12});
}

TEST(OwnershipCodec, KeepsTheStateOfAGrantedObject) {
  EncodedMessage encoded;
  const std::vector<std::byte> octets = octets_of(grant_of(2), encoded);
  const auto decoded = decode_message(encoded.kind, octets);
  ASSERT_TRUE(decoded.has_value());
  const Grant& grant = std::get<Grant>(*decoded);
  EXPECT_EQ(grant.states[1].position, (std::array<double, 3>{0.1, -2.0, 3.0}));
  EXPECT_EQ(grant.states[1].velocity, (std::array<double, 3>{0.5, 0.0, -0.25}));
  EXPECT_EQ(grant.states[1].utc, std::chrono::seconds(1'700'000'000));
  EXPECT_EQ(grant.part[1].tenure, (Tenure{version_of(2, 3), 5}));
}

// Ten rounds a second take at most 1 kB/s of payload each peer.
TEST(OwnershipCodec, ARoundOf32VotersHas100Octets) {
  for (std::uint32_t half = 0; half < 2; ++half) {
    EncodedMessage encoded;
    const std::vector<std::byte> octets = octets_of(round_of(32), encoded, half);
    EXPECT_LE(pdu::kAssuredRecordSize + octets.size() + pdu::kFixedSize<pdu::DatagramTrailer>,
              100U);
  }
}

TEST(OwnershipCodec, TwoRoundsNameAllVotersOfLargeRolls) {
  std::array<std::uint8_t, Roll::kMost> heard{};
  for (std::uint32_t half = 0; half < 2; ++half) {
    EncodedMessage encoded;
    const auto decoded =
        decode_message(pdu::AssuredKind::ownership_round, octets_of(round_of(63), encoded, half));
    ASSERT_TRUE(decoded.has_value());
    for (std::size_t i = 0; i < heard.size(); ++i)
      heard[i] = std::max(heard[i], std::get<Round>(*decoded).heard[i]);
  }
  EXPECT_EQ(heard, round_of(63).heard);
}

TEST(OwnershipCodec, RefusesImpossibleStates) {
  Grant grant = grant_of(1);
  grant.states[0].velocity[1] = std::numeric_limits<double>::quiet_NaN();
  EncodedMessage encoded;
  EXPECT_FALSE(decode_message(pdu::AssuredKind::record, octets_of(grant, encoded)).has_value());
  grant = grant_of(1);
  grant.states[0].orientation = {0.5, 0.0, 0.0, 0.0};
  EXPECT_FALSE(decode_message(pdu::AssuredKind::record, octets_of(grant, encoded)).has_value())
      << "no unit quaternion";
  for (const auto utc : {std::chrono::nanoseconds::min(), std::chrono::nanoseconds(-1),
                         std::chrono::nanoseconds::max()}) {
    grant = grant_of(1);
    grant.states[0].utc = utc;
    EXPECT_FALSE(decode_message(pdu::AssuredKind::record, octets_of(grant, encoded)).has_value())
        << utc.count();
  }
}

TEST(OwnershipCodec, RefusesOctetsThatAreCutShort) {
  const std::array<OwnershipMessage, 6> messages{
      round_of(5),    proposal_of(5, 2), Vote{{1, 2}, 3, {4, 5}},
      TableExtract{}, Agreement{},       OwnershipMessage(grant_of(3))};
  for (const OwnershipMessage& message : messages) {
    EncodedMessage encoded;
    const std::vector<std::byte> octets = octets_of(message, encoded);
    for (std::size_t size = 0; size < octets.size(); ++size)
      EXPECT_FALSE(decode_message(encoded.kind, std::span(octets).first(size)).has_value())
          << message.index() << " of " << size;
  }
}

TEST(OwnershipCodec, ReadsAnyOctetsWithoutFault) {
  std::mt19937 draw(3);
  const std::array<OwnershipMessage, 4> messages{round_of(40), proposal_of(9, 4), TableExtract{},
                                                 OwnershipMessage(grant_of(kMostGranted))};
  for (int i = 0; i < 20'000; ++i) {
    EncodedMessage encoded;
    std::vector<std::byte> octets = octets_of(messages[draw() % messages.size()], encoded);
    for (std::size_t k = 0; k < 1 + draw() % 4; ++k)
      octets[draw() % octets.size()] = static_cast<std::byte>(draw());
    octets.resize(draw() % (octets.size() + 1));
    const auto kind = static_cast<pdu::AssuredKind>(draw() % 24);
    const auto decoded = decode_message(i % 2 == 0 ? encoded.kind : kind, octets);
    if (!decoded || !std::holds_alternative<TableExtract>(*decoded)) continue;
    EXPECT_LE(std::get<TableExtract>(*decoded).holdings.count, kMostHoldings);
  }
}

}  // namespace message_codec_test
}  // namespace reckon::peer
