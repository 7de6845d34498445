// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Shared records of peers that lose datagrams, are cut off, join and leave.
#include "reckon/peer/reliable/shared_records.hpp"

#include <gtest/gtest.h>

#include <array>
#include <map>
#include <random>
#include <string>

#include "reckon/tests/src/support/record_peers.hpp"
#include "reckon/tests/support/soak.hpp"

namespace reckon::test {
namespace {

TEST(SharedRecords, ReachEachPeerWithTheLatestValue) {
  RecordPeers peers(3, 1, 0.0);
  peers.write(0, "colour", "red");
  peers.run(50ms);
  peers.write(1, "colour", "green");
  peers.run(50ms);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(peers.value(i, "colour"), "green");
  ASSERT_EQ(peers.peer(2).take_changes().size(), 1u);
  EXPECT_TRUE(peers.peer(2).take_changes().empty());
  peers.write(0, "colour", "");
  peers.run(50ms);
  EXPECT_EQ(peers.value(2, "colour"), "");
  EXPECT_TRUE(peers.peer(2).find("colour"));
  EXPECT_FALSE(peers.peer(2).find("size"));
}

TEST(SharedRecords, WrittenAtOnceByTwoAreEqual) {
  RecordPeers peers(4, 1, 0.2);
  for (std::size_t i = 0; i < 4; ++i) peers.write(i, "colour", std::to_string(i));
  peers.run(2s);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(peers.value(i, "colour"), "3") << "highest epoch";
}

// Half of the writes are replaced during the cut: the octets are of the values that are left.
TEST(SharedRecords, AreEqualSoonAfterACut) {
  for (const bool one_way : {false, true}) {
    RecordPeers peers(4, 7, 0.05);
    const auto keys = keys_of(40);
    for (const auto& key : keys) peers.write(0, key, std::string(500, 'a'));
    peers.run(5s);
    ASSERT_TRUE(peers.are_equal(keys));
    for (std::size_t i = 0; i < 2; ++i)
      for (std::size_t k = 2; k < 4; ++k) {
        peers.cut(i, k, true);
        if (!one_way) peers.cut(k, i, true);
      }
    for (int second = 0; second < 60; ++second) {
      peers.write(second % 4, keys[second % 10], std::string(500, 'b'));
      peers.run(1s);
    }
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t k = 0; k < 4; ++k) peers.cut(i, k, false);
    const std::uint64_t before = peers.octets();
    peers.run(2s);
    EXPECT_TRUE(peers.are_equal(keys)) << one_way;
    EXPECT_EQ(peers.sum(&peer::SharedRecordCounts::missed), 0u);
    EXPECT_LT(peers.octets() - before, 4u * 10 * 600) << "in proportion to the change";
  }
}

TEST(SharedRecords, AreEqualSoonAfterASecondWithoutNetwork) {
  RecordPeers peers(5, 3, 1.0);
  const auto keys = keys_of(20);
  for (const auto& key : keys) peers.write(key.size() % 5, key, "a");
  peers.run(1s);
  peers.set_loss(0.1);
  peers.run(2s);
  EXPECT_TRUE(peers.are_equal(keys));
  EXPECT_EQ(peers.peer(4).size(), 20u);
}

TEST(SharedRecords, OutliveTheirWriter) {
  RecordPeers peers(3, 3, 0.1);
  const auto keys = keys_of(100);
  for (const auto& key : keys) peers.write(0, key, key);
  for (const auto& key : keys) peers.write(0, key, key + " again");
  peers.run(3s);
  peers.remove(0);
  const std::size_t late = peers.add();
  peers.run(1s);
  EXPECT_TRUE(peers.are_equal(keys));
  EXPECT_EQ(peers.value(late, keys[99]), "key 99 again");
}

TEST(SharedRecords, AtRestCostFewListsASecond) {
  RecordPeers peers(16, 3, 0.0);
  peers.write(0, "colour", "red");
  peers.run(5s);
  const std::uint64_t before = peers.octets();
  peers.run(20s);
  // 16 octets for the one writer; without suppression 16 peers send 640 lists, with it at least
  // every fourth.
  EXPECT_LT(peers.octets() - before, 240u * 16);
}

TEST(SharedRecords, AreRefusedIfTooLongOrTooMany) {
  SharedRecords records(1, 1);
  const std::string value(1025, 'a');
  const auto octets = std::as_bytes(std::span(value));
  EXPECT_EQ(records.write("", octets.first(1), 0s), WriteResult::invalid);
  EXPECT_EQ(records.write(std::string(64, 'k'), octets.first(1), 0s), WriteResult::invalid);
  EXPECT_EQ(records.write("line\nfeed", octets.first(1), 0s), WriteResult::invalid);
  EXPECT_EQ(records.write("key", octets, 0s), WriteResult::invalid);
  EXPECT_EQ(records.write(std::string(63, 'k'), octets.first(1024), 0s), WriteResult::written);
  for (std::size_t i = 1; i < SharedRecords::kMostRecords; ++i)
    EXPECT_EQ(records.write(std::to_string(i), octets.first(1), 0s), WriteResult::written);
  EXPECT_EQ(records.write("one more", octets.first(1), 0s), WriteResult::full);
  EXPECT_EQ(records.write("5", octets.first(1), 0s), WriteResult::written) << "an old key";
}

TEST(SharedRecords, OutliveTheirWriterBehindACut) {
  RecordPeers peers(3, 1, 0.0);
  for (std::size_t i = 0; i < 2; ++i) peers.cut(i, 2, true);
  peers.write(0, "key", "first");
  peers.run(1s);
  peers.remove(0);
  peers.cut(1, 2, false);
  peers.run(2s);
  EXPECT_EQ(peers.value(2, "key"), "first");
}

TEST(SharedRecords, ReplacedInACutAreNotRequestedAgain) {
  RecordPeers peers(3, 1, 0.0);
  for (std::size_t i = 0; i < 2; ++i) peers.cut(i, 2, true);
  peers.write(0, "key", "first");
  peers.run(1s);
  peers.write(1, "key", "second");
  peers.run(1s);
  for (std::size_t i = 0; i < 2; ++i) peers.cut(i, 2, false);
  peers.run(2s);
  EXPECT_EQ(peers.value(2, "key"), "second");
  const std::uint64_t before = peers.sum(&peer::SharedRecordCounts::requests);
  peers.run(5s);
  EXPECT_EQ(peers.sum(&peer::SharedRecordCounts::requests), before);
}

// A peer learns that a record was replaced, but the one that replaced it is lost with its writer.
TEST(SharedRecords, OfALostSuccessorComeBack) {
  RecordPeers peers(3, 1, 0.0);
  for (std::size_t i = 0; i < 2; ++i) peers.cut(i, 2, true);
  peers.write(0, "key", "first");
  peers.run(1s);
  const pdu::SharedRecordHead replaced{0, 10, 1, 0, 0, 0, 0};
  std::array<std::byte, 20> octets;
  ASSERT_EQ(pdu::store_record(replaced, octets), 20u);
  ASSERT_TRUE(peers.peer(2).take(pdu::AssuredKind::shared_record, octets, peers.now()));
  for (std::size_t i = 0; i < 2; ++i) peers.cut(i, 2, false);
  peers.run(2s);
  EXPECT_EQ(peers.value(2, "key"), "first");
}

// Each writes its last key before it receives the other's.
TEST(SharedRecords, TooManyKeysAreTheSameEverywhere) {
  RecordPeers peers(3, 1, 0.1);
  for (int i = 0; i < 1023; ++i) peers.write(0, "b" + std::to_string(i), "x");
  peers.run(3s);
  peers.write(0, "d", "x");
  peers.write(1, "c", "x");
  peers.write(2, "a", "x");
  peers.run(3s);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(peers.peer(i).size(), SharedRecords::kMostRecords);
    EXPECT_TRUE(peers.peer(i).find("a"));
    EXPECT_FALSE(peers.peer(i).find("c"));
    EXPECT_FALSE(peers.peer(i).find("d"));
    static_cast<void>(peers.peer(i).take_changes());
  }
  const std::uint64_t before = peers.octets();
  peers.run(5s);
  EXPECT_LT(peers.octets() - before, 5000u) << "no repair without end";
}

// Restarts of a peer are new writers: a list of what is known needs several messages.
TEST(SharedRecords, OfManyWritersAreEqual) {
  RecordPeers peers(3, 1, 0.1);
  std::array<std::byte, SharedRecords::kMostOctets> room;
  for (std::uint32_t writer = 1000; writer < 1200; ++writer) {
    SharedRecords gone(writer, writer);
    const std::string key = "of " + std::to_string(writer);
    ASSERT_EQ(gone.write(key, std::as_bytes(std::span(key)), peers.now()), WriteResult::written);
    pdu::AssuredKind kind = pdu::AssuredKind::none;
    const std::size_t size = gone.take_due(peers.now(), kind, room);
    EXPECT_TRUE(peers.peer(writer % 3).take(kind, std::span(room).first(size), peers.now()));
  }
  for (std::size_t i = 0; i < 3; ++i) peers.peer(i).meet(peers.now());
  peers.run(3s);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(peers.peer(i).size(), 200u);
}

TEST(SharedRecords, KeepTheirNumbersInRange) {
  SharedRecords records(1, 1);
  pdu::SharedRecordHead head;
  head.counter = 0xFFFFFFFF;
  head.writer = 9;
  head.serial = 1;
  head.key_length = 1;
  std::array<std::byte, 21> octets{};
  octets[20] = std::byte{'k'};
  ASSERT_EQ(pdu::store_record(head, octets), 20u);
  EXPECT_FALSE(records.take(pdu::AssuredKind::shared_record, octets, 0s));
  head.counter = 1;
  head.serial = 0xFFFFFFFF;
  ASSERT_EQ(pdu::store_record(head, octets), 20u);
  EXPECT_FALSE(records.take(pdu::AssuredKind::shared_record, octets, 0s));
  EXPECT_EQ(records.write("k", {}, 0s), WriteResult::written);
  EXPECT_EQ(records.find("k")->version.counter, 1u);
}

TEST(SharedRecords, SurviveHostileMessages) {
  SharedRecords records(1, 1);
  records.write("key", {}, 0s);
  std::mt19937_64 random(5);
  for (int i = 0; i < 200'000; ++i) {
    std::array<std::byte, 200> octets;
    for (std::byte& octet : octets)
      octet = static_cast<std::byte>(random() % 4 == 0 ? random() : 0);
    const auto kind = static_cast<pdu::AssuredKind>(23 + random() % 5);
    records.take(kind, std::span(octets).first(random() % octets.size()), nanoseconds(i));
    std::array<std::byte, SharedRecords::kMostOctets> room;
    pdu::AssuredKind sent = pdu::AssuredKind::none;
    for (int k = 0; k < 3; ++k)
      EXPECT_LE(records.take_due(nanoseconds(i), sent, room), room.size());
  }
  EXPECT_LE(records.size(), SharedRecords::kMostRecords);
}

TEST(SharedRecords, NobodyHasAreGivenUp) {
  SharedRecords records(1, 1);
  const pdu::KnownSerial invented{99, 1'000'000, 1'000'000, 0};
  std::array<std::byte, 16> octets;
  ASSERT_EQ(pdu::store_record(invented, octets), 16u);
  records.take(pdu::AssuredKind::record_serials, octets, 0s);
  std::array<std::byte, SharedRecords::kMostOctets> room;
  std::uint64_t requests = 0;
  for (nanoseconds now = 0s; now < 60s; now += 1ms) {
    pdu::AssuredKind kind = pdu::AssuredKind::none;
    while (records.take_due(now, kind, room) > 0)
      requests += kind == pdu::AssuredKind::record_request ? 1 : 0;
  }
  EXPECT_GT(requests, 10u);
  EXPECT_LT(requests, 80u);
  EXPECT_EQ(records.counts().missed, 1u);
}

// Peers write the same keys, are cut from each other at random, join and leave. Two seconds after
// the last cut all tables are equal, and what was written last and received is not lost.
TEST(SharedRecords, AreEqualAfterAnyFaults) {
  const std::uint64_t seeds = tries(400, 10'000);
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    std::mt19937_64 random(seed);
    const auto draw = [&](std::uint64_t most) { return random() % most; };
    RecordPeers peers(2 + draw(6), seed, 0.1 * static_cast<double>(draw(5)));
    const auto keys = keys_of(1 + draw(30));
    std::map<std::string, std::size_t> written;
    for (int event = 0; event < 60; ++event) {
      const std::size_t one = draw(peers.size()), other = draw(peers.size());
      const std::uint64_t what = draw(20);
      if (what < 12 && peers.lives(one)) {
        peers.write(one, keys[draw(keys.size())],
                    std::string(draw(100), static_cast<char>('a' + event % 26)));
      } else if (what < 15) {
        peers.cut(one, other, draw(2) == 0);
      } else if (what == 15 && peers.size() < 12) {
        peers.add();
      } else if (what == 16 && one > 1 && peers.lives(one)) {
        peers.remove(one);
      }
      peers.run(nanoseconds(static_cast<std::int64_t>(draw(400'000'000))));
    }
    for (std::size_t i = 0; i < peers.size(); ++i)
      for (std::size_t k = 0; k < peers.size(); ++k) peers.cut(i, k, false);
    peers.set_loss(std::min(0.2, 0.1 * static_cast<double>(draw(5))));
    peers.run(2s);
    ASSERT_TRUE(peers.are_equal(keys)) << "seed " << seed;
    ASSERT_EQ(peers.sum(&peer::SharedRecordCounts::refused), 0u) << "seed " << seed;
  }
}

}  // namespace
}  // namespace reckon::test
