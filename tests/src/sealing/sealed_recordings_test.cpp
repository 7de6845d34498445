// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A sealed link accepts no replayed recording.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "reckon/peer/network/simulated_network.hpp"
#include "reckon/peer/sealing/greeter.hpp"
#include "reckon/peer/sealing/sealed_link.hpp"
#include "reckon/tests/src/sealing/sealed_members.hpp"
#include "reckon/tests/src/sealing/sealing_samples.hpp"
#include "reckon/tests/support/allocation_guard.hpp"

namespace reckon::peer::sealed_recordings_test {
namespace {

using namespace samples;
using members::kBase;
using members::Member;
using members::Network;
using members::run;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(SealedLink, TakesNothingOfYesterdaysRecording) {
  const GroupKey key = group_key();
  std::vector<Octets> tape;
  {
    Network yesterday(2);
    Member one(yesterday, 0, key), other(yesterday, 1, key);
    for (int i = 0; i < 60; ++i) {
      one.say(66);
      run(yesterday, 10ms, one, other);
    }
    ASSERT_EQ(other.heard.size(), 60U);
    tape = yesterday.tape;
  }
  Network today(3);
  Member one(today, 0, key), other(today, 1, key);
  run(today, 100ms, one, other);
  Link& attacker = today.hub.link(2);
  for (const Octets& recorded : tape) {
    for (int twice = 0; twice < 2; ++twice) attacker.send(kBase, recorded);
    run(today, 100ms, one, other);
  }
  EXPECT_THAT(one.heard, IsEmpty());
  EXPECT_THAT(other.heard, IsEmpty());
  EXPECT_LT(other.count("sealed_hellos_out"), 20U) << "it asks once a second";
  EXPECT_THAT(other.sealed.take_news(), Contains(HasSubstr("does not answer")));
  one.say(1);
  run(today, 50ms, one, other);
  EXPECT_EQ(other.heard, std::vector<std::uint8_t>{1});
}

TEST(SealedLink, RefusesTodaysRecordingAndItsOwnEcho) {
  const GroupKey key = group_key();
  Network network(3);
  Member one(network, 0, key), other(network, 1, key);
  one.say(7);
  run(network, 100ms, one, other);
  ASSERT_EQ(other.heard.size(), 1U);
  const std::vector<Octets> tape = network.tape;
  for (const Octets& recorded : tape) network.hub.link(2).send(kBase, recorded);
  run(network, 100ms, one, other);
  EXPECT_EQ(other.heard.size(), 1U);
  EXPECT_THAT(one.heard, IsEmpty());
  EXPECT_GT(one.count("sealed_own_in"), 0U);
  EXPECT_GT(other.count("sealed_replayed_in"), 0U);
}

// The recorded datagrams are genuine, but were sent before the newcomer came.
TEST(SealedLink, NewcomerRefusesOlderDatagramsOfALiveSender) {
  const GroupKey key = group_key();
  Network network(3);
  Member one(network, 0, key);
  for (std::uint8_t word = 1; word <= 200; ++word) one.say(word);
  run(network, 10ms, one);
  const std::vector<Octets> tape = network.tape;
  ASSERT_GE(tape.size(), 200U);
  Member newcomer(network, 1, key);
  for (int round = 0; round < 20; ++round) {
    for (const Octets& recorded : tape) network.hub.link(2).send(kBase, recorded);
    run(network, 10ms, one, newcomer);
  }
  EXPECT_EQ(newcomer.count("sealed_trusted"), 1U);
  EXPECT_THAT(newcomer.heard, IsEmpty());
  one.say(255);
  run(network, 10ms, one, newcomer);
  EXPECT_EQ(newcomer.heard, std::vector<std::uint8_t>{255});
}

// The recordings arrive first and fill the room for held datagrams of the sender.
TEST(SealedLink, HoldsTheLatestDatagramDespiteEarlierReplays) {
  const GroupKey key = group_key();
  Network network(3);
  Member one(network, 0, key);
  for (std::uint8_t word = 1; word <= 100; ++word) one.say(word);
  run(network, 10ms, one);
  const std::vector<Octets> tape = network.tape;
  Member newcomer(network, 1, key);
  for (const Octets& recorded : tape) network.hub.link(2).send(kBase, recorded);
  one.say(255);
  run(network, 60ms, one, newcomer);
  EXPECT_EQ(newcomer.heard, std::vector<std::uint8_t>{255});
}

// Boots of other days, each received for the first time over and over.
TEST(SealedLink, RecordingsCauseAtMostEightGreetingsASecond) {
  const GroupKey key = group_key();
  Network network(3);
  Member listener(network, 0, key);
  std::vector<std::unique_ptr<EnvelopeSealer>> boots;
  for (std::uint16_t i = 0; i < 200; ++i)
    boots.push_back(std::make_unique<EnvelopeSealer>(key, 1, i));
  Octets hello(HelloWriter::kHead);
  static_cast<void>(HelloWriter(7, hello).finish());
  for (int i = 0; i < 2000; ++i) {
    const auto stream = i % 2 == 0 ? SealingStream::control : SealingStream::datagrams;
    network.hub.link(1 + i % 2).send(
        kBase, sealed(*boots[static_cast<std::size_t>(i) % boots.size()], hello, stream, 0, kBase));
    run(network, 5ms, listener);
  }
  const double seconds = 10.0;
  EXPECT_LE(listener.count("sealed_hellos_out"), 1.0 + Greeter::kStrangersAtOnce + 8.0 * seconds);
}

}  // namespace
}  // namespace reckon::peer::sealed_recordings_test
