// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/aoim/area_of_interest_manager.hpp"

#include <gtest/gtest.h>

#include <random>

#include "reckon/tests/aoim/support/world.hpp"

namespace reckon::aoim {
namespace {

using namespace test;

TEST(AreaOfInterestManager, RoutesEveryPduToItsCellsGroup) {
  AreaOfInterestManager manager(config(), presence_of(1, 11));
  std::mt19937_64 random(1);
  std::normal_distribution<double> move(0.0, 20.0);
  Position position;
  constexpr std::uint32_t kMoves = 1'000'000;
  std::vector<GroupIndex> expected(kMoves);
  std::size_t seen = 0;
  const auto sink = [&](GroupIndex group, std::span<const std::byte> datagram) {
    for (const pdu::BundledPdu& bundled : pdu::BundleReader(datagram)) {
      pdu::EntityState state;
      if (pdu::decode(bundled.bytes, state) != pdu::DecodeError::none) continue;
      ++seen;
      ASSERT_EQ(expected[state.appearance], group);
    }
  };
  for (std::uint32_t i = 0; i < kMoves; ++i) {
    position.x += move(random);
    position.y += move(random);
    const CellId cell = manager.cells().cell(position);
    expected[i] = manager.cells().group(cell);
    manager.send(kCellTier, StatePayload{entity_state(static_cast<std::uint16_t>(i), i)}, position,
                 nanoseconds(0));
    if (i % 7 == 0) manager.step(nanoseconds(0), sink);
  }
  manager.flush(nanoseconds(0), sink);
  EXPECT_EQ(seen, kMoves) << "orphans";
}

TEST(AreaOfInterestManager, ReceivesNeighboursButNotDistantPeers) {
  World world;
  world.add(presence_of(1, 11), {0, 0, 0});
  world.add(presence_of(2, 22), {150, 0, 0});
  world.add(presence_of(3, 33), {1000, 0, 0});  // within the same tile, so no group is shared
  world.run(milliseconds(200));
  world.let_speak(3);
  world.run(milliseconds(5));
  EXPECT_EQ(world.members[0].used, (std::vector<pdu::EntityId>{{7, 2, 1}}));
  EXPECT_EQ(world.members[1].used, (std::vector<pdu::EntityId>{{7, 1, 1}}));
  EXPECT_TRUE(world.members[2].used.empty());
  EXPECT_GT(world.members[0].manager->incoming(IncomingVerdict::own), 0u);
  EXPECT_EQ(world.members[0].manager->sequences().counts().lost, 0u);
}

TEST(AreaOfInterestManager, DemandsAnIntroductionForANewcomer) {
  World world;
  AreaOfInterestManager& first = world.add(presence_of(1, 11), {0, 0, 0});
  world.run(milliseconds(3500));  // between two announcements
  const GroupIndex group = first.route({0, 0, 0});
  nanoseconds last_sent = world.now;
  world.run(seconds(1));
  EXPECT_FALSE(first.must_send(kCellTier, {7, 1, 1}, {0, 0, 0}, {last_sent, group}, world.now));

  world.add(presence_of(2, 22), {50, 0, 0});
  const nanoseconds heard = world.now;
  int times = 0;
  for (int ms = 0; ms < 1000; ++ms) {
    world.step();
    if (!first.must_send(kCellTier, {7, 1, 1}, {0, 0, 0}, {last_sent, group}, world.now)) continue;
    last_sent = world.now;
    ++times;
    EXPECT_LE(world.now - heard, milliseconds(103));
  }
  EXPECT_EQ(times, 1);
  const auto events = first.take_events();
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].kind, PresenceEventKind::newcomer);
}

TEST(AreaOfInterestManager, DemandsIntroductionWhenAPeerEntersTheCell) {
  World world;
  AreaOfInterestManager& first = world.add(presence_of(1, 11), {0, 0, 0});
  world.add(presence_of(2, 22), {1000, 0, 0});
  world.run(seconds(3));
  const GroupIndex group = first.route({0, 0, 0});
  ASSERT_FALSE(world.members[1].joined.contains(group));
  const nanoseconds last_sent = world.now;
  EXPECT_FALSE(first.must_send(kCellTier, {7, 1, 1}, {0, 0, 0}, {last_sent, group}, world.now));
  world.members[1].place = {150, 0, 0};
  world.run(milliseconds(110));
  EXPECT_TRUE(world.members[1].joined.contains(group));
  EXPECT_TRUE(first.must_send(kCellTier, {7, 1, 1}, {0, 0, 0}, {last_sent, group}, world.now));
}

TEST(AreaOfInterestManager, DemandsNoSecondIntroductionForARepeatedRequest) {
  World world;
  AreaOfInterestManager& first = world.add(presence_of(1, 11), {0, 0, 0});
  world.add(presence_of(2, 22), {1000, 0, 0});
  world.run(seconds(3));
  const GroupIndex group = first.route({0, 0, 0});
  world.members[1].place = {150, 0, 0};
  world.run(milliseconds(110));
  ASSERT_TRUE(first.must_send(kCellTier, {7, 1, 1}, {0, 0, 0}, {seconds(0), group}, world.now));
  world.let_speak(1);
  const nanoseconds last_sent = world.now;
  for (int ms = 0; ms < 2500; ++ms) {
    world.run(milliseconds(1));
    ASSERT_FALSE(first.must_send(kCellTier, {7, 1, 1}, {0, 0, 0}, {last_sent, group}, world.now))
        << ms;
  }
}

TEST(AreaOfInterestManager, DemandsAnotherIntroductionAfterALostOne) {
  World world;
  AreaOfInterestManager& first = world.add(presence_of(1, 11), {0, 0, 0});
  world.add(presence_of(2, 22), {1000, 0, 0});
  world.run(seconds(3));
  const GroupIndex group = first.route({0, 0, 0});
  world.members[1].place = {150, 0, 0};
  world.run(milliseconds(110));
  const nanoseconds last_sent = world.now;  // this update is lost
  ASSERT_FALSE(first.must_send(kCellTier, {7, 1, 1}, {0, 0, 0}, {last_sent, group}, world.now));
  world.run(milliseconds(750));
  EXPECT_TRUE(first.must_send(kCellTier, {7, 1, 1}, {0, 0, 0}, {last_sent, group}, world.now));
}

TEST(AreaOfInterestManager, DemandsUpdatesInNewCellsWithoutBorderFlood) {
  AreaOfInterestManager manager(config(), presence_of(1, 11));
  GroupIndex last_group = manager.route({0, 0, 0});
  nanoseconds last_sent{0};
  int sent = 0;
  for (int ms = 0; ms < 1000; ++ms) {
    // Crosses the border at x = 108.25 every millisecond.
    const Position position{108.25 + (ms % 2 == 0 ? 0.1 : -0.1), 0, 0};
    if (!manager.must_send(kCellTier, {7, 1, 1}, position, {last_sent, last_group},
                           milliseconds(ms)))
      continue;
    last_group = manager.route(position);
    last_sent = milliseconds(ms);
    ++sent;
  }
  EXPECT_GT(sent, 5);
  EXPECT_LE(sent, 10);
}

TEST(AreaOfInterestManager, SendsWithItsNewAddressAfterADispute) {
  World world;
  world.add(presence_of(1, 11, 100), {0, 0, 0});
  world.run(milliseconds(2300));  // between two announcements
  AreaOfInterestManager& late = world.add(presence_of(1, 5, 200), {10, 0, 0});
  world.run(milliseconds(150));
  const PeerId own = late.presence().id();
  EXPECT_NE(own, (PeerId{7, 1}));
  EXPECT_TRUE(late.presence().is_own({7, own.application, 9}));
  EXPECT_FALSE(late.presence().is_own({7, 1, 9}));
  bool told = false;
  for (const PresenceEvent& event : late.take_events()) {
    told = told || event.kind == PresenceEventKind::identity_changed;
  }
  EXPECT_TRUE(told);
}

TEST(AreaOfInterestManager, SendsPlainDisInInteropMode) {
  AreaOfInterestConfig plain = config();
  plain.interop = true;
  AreaOfInterestManager manager(plain, presence_of(1, 11));
  manager.start(nanoseconds(0));
  const Focus focus{{0, 0, 0}, 0.0, 200.0};
  EXPECT_TRUE(manager.listen(kCellTier, {&focus, 1}, nanoseconds(0)).join.empty());
  EXPECT_EQ(manager.next_step(), nanoseconds::max());
  manager.send(kCellTier, StatePayload{entity_state(1), haptic_record(1.0F)}, {900, 0, 0},
               nanoseconds(0));
  Collector wire;
  manager.step(nanoseconds(0), wire);
  ASSERT_EQ(wire.datagrams.size(), 1u);
  EXPECT_EQ(wire.datagrams[0].group, kBaseGroup);
  for (const pdu::BundledPdu& bundled : pdu::BundleReader(wire.datagrams[0].octets)) {
    EXPECT_FALSE(pdu::is_experimental(bundled.header.pdu_type));
  }
}

TEST(AreaOfInterestManager, SendsPendingUpdatesAndDepartsOnStop) {
  World world;
  AreaOfInterestManager& leaving = world.add(presence_of(1, 11), {0, 0, 0});
  AreaOfInterestManager& staying = world.add(presence_of(2, 22), {0, 0, 0});
  world.run(seconds(1));
  (void)staying.take_events();
  leaving.send(kCellTier, StatePayload{entity_state(1)}, {0, 0, 0}, world.now + seconds(1));
  leaving.stop();
  Collector wire;
  leaving.step(world.now, wire);
  leaving.flush(world.now, wire);
  ASSERT_EQ(wire.datagrams.size(), 2u);
  for (const Datagram& datagram : wire.datagrams) {
    staying.receive(datagram.group, datagram.octets, world.now);
  }
  const auto events = staying.take_events();
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].kind, PresenceEventKind::departed);
}

TEST(AreaOfInterestManager, SpreadsIntroductionsOfManyEntities) {
  AreaOfInterestManager me(config(), presence_of(1, 11));
  me.start(nanoseconds(0));
  me.introductions().set_owned(100'000);
  const auto nothing = [](GroupIndex, std::span<const std::byte>) {};
  me.step(milliseconds(500), nothing);
  EXPECT_FALSE(me.introductions().is_pending());
  me.receive(kBaseGroup, encoded(presence_of(2, 22)), seconds(1) - milliseconds(100));
  EXPECT_FALSE(me.introductions().is_pending())
      << "who does not know us yet would drop our entities";
  me.step(seconds(1), nothing);
  ASSERT_TRUE(me.introductions().is_pending());
  const auto due = [&](nanoseconds now) {
    int count = 0;
    for (std::uint16_t i = 1; i <= 1000; ++i) {
      count += me.must_send(kCellTier, {7, 1, i}, {}, {nanoseconds(0), me.route({})}, now) ? 1 : 0;
    }
    return count;
  };
  EXPECT_NEAR(due(seconds(1) + milliseconds(30 + 417)), 500, 80);
  EXPECT_EQ(due(seconds(1) + milliseconds(864)), 1000);
  me.step(seconds(3), nothing);
  EXPECT_FALSE(me.introductions().is_pending());
}

// The epoch of a peer that has not announced itself must not spoil its later sequence numbers.
TEST(AreaOfInterestManager, ListsThePeersThatItReceives) {
  World world;
  AreaOfInterestManager& first = world.add(presence_of(1, 11), {0, 0, 0});
  world.add(presence_of(2, 22), {0, 0, 0});
  world.run(seconds(1));
  Collector wire;
  std::vector<std::uint32_t> told;
  for (int ms = 0; ms < 1000; ++ms) first.step(world.now + milliseconds(ms), wire);
  for (const Datagram& datagram : wire.datagrams) {
    for (const pdu::BundledPdu& bundled : pdu::BundleReader(datagram.octets)) {
      pdu::PeersHeard list;
      if (pdu::decode(bundled.bytes, list) != pdu::DecodeError::none) continue;
      EXPECT_EQ(list.epoch, 11u);
      for (const auto& heard : pdu::records_of<pdu::PeerEpoch>(list.epochs)) {
        told.push_back(heard.epoch);
      }
    }
  }
  EXPECT_EQ(told, (std::vector<std::uint32_t>{22}));
}

}  // namespace
}  // namespace reckon::aoim
