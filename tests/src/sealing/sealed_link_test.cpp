// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/sealing/sealed_link.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "reckon/peer/network/simulated_network.hpp"
#include "reckon/peer/sealing/greeter.hpp"
#include "reckon/tests/src/sealing/sealed_members.hpp"
#include "reckon/tests/src/sealing/sealing_samples.hpp"
#include "reckon/tests/support/allocation_guard.hpp"

namespace reckon::peer::sealed_link_test {
namespace {

using namespace samples;
using members::kBase;
using members::Member;
using members::Network;
using members::options_of;
using members::run;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(SealedLink, ReturnsHeldDatagramsInOrderAfterTheAnswer) {
  Network network(2);
  const GroupKey key = group_key();
  Member one(network, 0, key), other(network, 1, key);
  one.say(1);
  one.say(2);
  run(network, 3ms, one, other);
  EXPECT_THAT(other.heard, IsEmpty()) << "before one round trip";
  run(network, 60ms, one, other);
  EXPECT_EQ(other.heard, (std::vector<std::uint8_t>{1, 2}));
  one.say(3);
  run(network, 3ms, one, other);
  EXPECT_EQ(other.heard.back(), 3);
  EXPECT_EQ(other.count("sealed_trusted"), 1U);
}

/// Sums of the tap's events by stream (0: the contents of envelopes) and fate.
using Told = std::map<std::pair<int, DatagramFate>, std::uint64_t>;
Told told(DatagramTap& tap) {
  Told sums;
  for (DatagramEvent event; tap.pop(event);) sums[{event.stream, event.fate}] += event.count;
  return sums;
}

// The tap counts below the seal by envelope numbers and above it by trailers. Each arriving
// envelope is a greeting, opened, held or refused; returned contents count as arrived above.
TEST(SealedLink, TapCountsEnvelopesAndTheirContents) {
  constexpr int kContents = 0, kSaid = 1, kGreetings = 2;
  Network network(3);
  const GroupKey key = group_key();
  DatagramTap one_tap, other_tap;
  Member one(network, 0, key, &one_tap), other(network, 1, key, &other_tap);
  for (std::uint8_t word = 0; word < 12; ++word) {
    one.say(word);
    run(network, 10ms, one, other);
  }
  for (const Octets& recorded : std::vector<Octets>(network.tape))
    network.hub.link(2).send(kBase, recorded);  // replays its datagrams
  run(network, 10ms, one, other);
  ASSERT_EQ(other.heard.size(), 12U);

  Told out = told(one_tap), in = told(other_tap);
  EXPECT_EQ((out[{kContents, DatagramFate::sealed}]), 12U);
  EXPECT_EQ((out[{kSaid, DatagramFate::numbered}]), 12U);
  EXPECT_EQ((out[{kGreetings, DatagramFate::numbered}]), one.count("sealed_hellos_out"));
  EXPECT_EQ((in[{kContents, DatagramFate::arrived}]), 12U);
  EXPECT_EQ((in[{kSaid, DatagramFate::opened}] + in[{kSaid, DatagramFate::held}]), 12U);
  EXPECT_GT((in[{kSaid, DatagramFate::held}]), 0U);
  EXPECT_EQ((in[{kSaid, DatagramFate::not_opened}]), 12U);
  EXPECT_EQ((in[{kGreetings, DatagramFate::greeting}]), other.count("sealed_hellos_in"));
}

TEST(SealedLink, KnowsSendersByBootAtAnyAddress) {
  const GroupKey key = group_key();
  Network network(3);
  Member one(network, 0, key), other(network, 1, key);
  run(network, 100ms, one, other);
  one.say(1);
  run(network, 10ms, one, other);
  const std::uint64_t boot = other.from.boot;
  EXPECT_NE(boot, 0U);
  Octets elsewhere;  // the envelope of `one`, which arrives by another path
  {
    ImpairmentLaw law;
    law.loss = 1.0;
    network.hub.impair(0, 1, law);
    one.say(2);
    run(network, 10ms, one);
    elsewhere = network.tape.back();
  }
  network.hub.link(2).send(kBase, elsewhere);
  run(network, 10ms, other);
  EXPECT_EQ(other.heard, (std::vector<std::uint8_t>{1, 2}));
  EXPECT_EQ(other.from.boot, boot);
  EXPECT_EQ(other.from.sender, network.hub.link(2).local_endpoint());
}

// The sender acts as a suspended host: its steady clock stood still meanwhile.
TEST(SealedLink, ReceivesASuspendedSenderAfterARoundTrip) {
  const GroupKey key = group_key();
  Network network(2);
  ManualClock slow{1s};
  Member one(network, 0, key, nullptr, &slow), other(network, 1, key);
  const auto talk = [&](nanoseconds span) {
    for (nanoseconds passed{0}; passed < span; passed += 10ms) {
      one.say(1);
      slow.advance(10ms);
      run(network, 10ms, one, other);
    }
  };
  talk(1s);
  run(network, 5s);
  other.heard.clear();
  talk(100ms);
  EXPECT_GE(other.heard.size(), 5U);
  EXPECT_GT(other.count("sealed_outdated_in"), 0U);
}

// A relay is the address from which its senders are first received.
TEST(SealedLink, NewSendersNeverEvictTrustedOnes) {
  const GroupKey key = group_key();
  Network network(3);
  Member other(network, 1, key);
  std::vector<Octets> tape;
  Link& port = network.hub.link(0);
  std::vector<std::unique_ptr<SealedLink>> boots;
  for (std::uint16_t boot = 0; boot < 6; ++boot) {
    boots.push_back(std::make_unique<SealedLink>(port, options_of(key, boot), network.clock));
    EXPECT_FALSE(boots.back()->join(kBase));
    const std::array<std::byte, 50> octets{std::byte{static_cast<std::uint8_t>(100 + boot)}};
    boots.back()->send(kBase, octets);
    for (int i = 0; i < 100; ++i) {
      std::array<Datagram, 8> batch;
      boots.back()->receive(batch);
      run(network, 1ms, other);
    }
    if (boot == 0) tape = network.tape;
  }
  ASSERT_EQ(other.heard, (std::vector<std::uint8_t>{100, 101, 102, 103, 104, 105}));
  boots.clear();
  for (int round = 0; round < 20; ++round) {
    for (const Octets& recorded : tape) port.send(kBase, recorded);
    run(network, 50ms, other);
  }
  EXPECT_EQ(other.heard.size(), 6U);
}

// Its windows are forgotten with it; old answers must not restore it.
TEST(Greeter, AsksAgainAfterATrustedSenderWasEvicted) {
  const GroupKey key = group_key();
  EnvelopeOpener opener(key, {});
  Octets room(kMaxDatagram), hello(Greeter::kLongest);
  Greeter greeter(1, 100);
  const auto nonce = [&] {
    Hello said;
    EXPECT_TRUE(said.read(greeter.write(opener.senders(), hello, 1s)));
    return said.nonce();
  };
  const auto meet = [&](std::uint32_t host) {
    EnvelopeSealer sealer(key, 1, 1);
    const Octets datagram = sealed(sealer, Octets(8));
    const auto opened =
        opener.open(arrived(datagram, address(host), 1s), nanoseconds::min(), 1s, room);
    opened.sender->trusted = true;
    greeter.meet(opener.senders(), 1s);
  };
  for (std::uint32_t i = 0; i < SealedSenders::kMost; ++i) meet(i);
  EXPECT_EQ(nonce(), 100U);
  meet(SealedSenders::kMost);
  EXPECT_NE(nonce(), 100U);
}

TEST(SealedLink, FindsEachOtherAtHeavyLoss) {
  const GroupKey key = group_key();
  Network network(2);
  ImpairmentLaw law;
  law.delay = 1ms;
  law.loss = 0.3;
  network.hub.impair(law);
  Member one(network, 0, key), other(network, 1, key);
  for (std::uint8_t i = 0; i < 40; ++i) {
    one.say(i);
    other.say(i);
    run(network, 50ms, one, other);
  }
  EXPECT_GT(one.heard.size(), 20U);
  EXPECT_GT(other.heard.size(), 20U);
}

// Each member's datagram reaches all others within one way, one round trip and 50 ms. Members send
// at most four greetings each on average, far fewer than there are others.
TEST(SealedLink, BringsSixtyFourTogetherInOneRoundTrip) {
  constexpr std::size_t kMembers = 64;
  constexpr nanoseconds kOneWay = 10ms;
  Network network(kMembers, kOneWay);
  const GroupKey key = group_key();
  std::vector<std::unique_ptr<Member>> members;
  for (std::size_t i = 0; i < kMembers; ++i)
    members.push_back(std::make_unique<Member>(network, i, key));
  for (auto& member : members) member->say(1);
  const nanoseconds begin = network.clock.now();
  const auto all_heard = [&] {
    return std::ranges::all_of(members,
                               [](const auto& one) { return one->heard.size() == kMembers - 1; });
  };
  while (!all_heard() && network.clock.now() - begin < 2s) {
    for (auto& member : members) member->read();
    network.clock.advance(1ms);
  }
  const nanoseconds took = network.clock.now() - begin;
  EXPECT_LE(took, kOneWay + 2 * kOneWay + 50ms);
  std::uint64_t hellos = 0;
  for (const auto& member : members) hellos += member->count("sealed_hellos_out");
  EXPECT_LE(hellos, 4 * kMembers);
  RecordProperty("milliseconds", static_cast<int>(took / 1ms));
  RecordProperty("greetings", static_cast<int>(hellos));
}

TEST(SealedLink, ReportsRefusedDatagrams) {
  const GroupKey key = group_key();
  Network network(3);
  Member listener(network, 0, key);
  Member stranger(network, 1, group_key(1, key.suite, 9));
  Link& attacker = network.hub.link(2);
  const Octets plain(80, std::byte{7});
  for (int i = 0; i < 40; ++i) {
    stranger.say(1);
    attacker.send(kBase, plain);
    run(network, 100ms, listener, stranger);
  }
  std::vector<std::string> news = listener.sealed.take_news();
  EXPECT_THAT(news, Contains(HasSubstr("198.18.0.2:3000 are sealed with another key")));
  EXPECT_THAT(news, Contains(HasSubstr("198.18.0.3:3000 are not sealed")));
  Octets forged = network.tape.front();
  for (int i = 0; i < 300; ++i) {
    forged[30] = static_cast<std::byte>(i);
    attacker.send(kBase, forged);
    run(network, 5ms, listener);
  }
  news = listener.sealed.take_news();
  EXPECT_THAT(news, Contains(HasSubstr("with a wrong tag in one second")));
  EXPECT_LE(news.size(), 3U);
  EXPECT_THAT(listener.heard, IsEmpty());
}

TEST(SealedLink, ReportsAnEpochMissingInItsFile) {
  Network network(2);
  network.clock.set(3h);
  Member old(network, 0, group_key(1));
  Member renewed(network, 1, group_key(2));
  for (int i = 0; i < 40; ++i) {
    renewed.say(1);
    run(network, 100ms, old, renewed);
  }
  EXPECT_THAT(old.sealed.take_news(),
              Contains(HasSubstr("have epoch 2, which the key file lacks")));
}

TEST(SealedLink, GoesOnThroughAChangeOfEpoch) {
  Network network(2);
  network.clock.set(1h - 500ms);
  const GroupKey key = group_key(2);
  Member one(network, 0, key), other(network, 1, key);
  for (std::uint8_t i = 0; i < 20; ++i) {
    one.say(i);
    run(network, 50ms, one, other);
  }
  ASSERT_EQ(other.heard.size(), 20U);
  EXPECT_EQ(read_envelope(network.tape.front())->epoch, 1U);
  EXPECT_EQ(read_envelope(network.tape.back())->epoch, 2U);
}

TEST(SealedLink, CarriesAnEnvelopeLessAndTakesNoHeap) {
  Network network(2);
  const GroupKey key = group_key();
  Member one(network, 0, key), other(network, 1, key);
  EXPECT_EQ(one.sealed.max_payload(), 1372 - kEnvelope);
  EXPECT_FALSE(one.sealed.send(kBase, Octets(1372 - kEnvelope + 1)));
  std::array<Datagram, 16> batch;
  const std::array<std::byte, 64> octets{};
  const test::AllocationGuard guard;
  for (int i = 0; i < 100; ++i) {
    one.sealed.send(kBase, octets);
    one.sealed.receive(batch);
    other.sealed.receive(batch);
    network.clock.advance(1ms);
  }
  EXPECT_EQ(guard.count(), 0U);
  EXPECT_GT(other.count("sealed_in"), 50U);
}

TEST(SealedGroup, IsThePortAbove) {
  EXPECT_EQ(sealed_group(GroupAddress::v4(0xEFC00100, 3000)).port, 3001);
  EXPECT_THROW(static_cast<void>(sealed_group(GroupAddress::v4(0xEFC00100, 65535))),
               std::invalid_argument);
}

}  // namespace
}  // namespace reckon::peer::sealed_link_test
