// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Datagrams that the manager refuses, and state that it must not change for them.
#include <gtest/gtest.h>

#include <random>

#include "reckon/aoim/area_of_interest_manager.hpp"
#include "reckon/tests/aoim/support/world.hpp"

namespace reckon::aoim {
namespace {

using namespace test;

TEST(AreaOfInterestManager, DropsAndCountsUnusableDatagrams) {
  World world;
  AreaOfInterestManager& me = world.add(presence_of(1, 11), {0, 0, 0});
  world.run(milliseconds(10));
  AggregatorConfig sender;
  sender.epoch = 22;
  Aggregator other(sender);
  Collector wire;
  const GroupIndex near = me.route({0, 0, 0}), far = me.route({1000, 0, 0});
  other.add(near, entity_state(1), {}, nanoseconds(0));
  other.add(far, entity_state(1), {}, nanoseconds(0));
  other.flush_due(nanoseconds(0), wire);
  ASSERT_EQ(wire.datagrams.size(), 2u);
  const Octets& here = wire.datagrams[0].octets;
  me.receive(kBaseGroup, encoded(presence_of(2, 22)), world.now);
  ASSERT_EQ(me.take_events().size(), 1u);
  EXPECT_EQ(me.receive(near, here, world.now).verdict, IncomingVerdict::use);
  EXPECT_EQ(me.receive(near, here, world.now).verdict, IncomingVerdict::duplicate);
  EXPECT_EQ(me.receive(far, wire.datagrams[1].octets, world.now).verdict,
            IncomingVerdict::not_joined);
  EXPECT_EQ(me.receive(near, encoded(entity_state(4)), world.now).verdict, IncomingVerdict::plain);

  // Its announcement names another scene.
  pdu::Presence mismatch = presence_of(2, 22);
  mismatch.scene_hash = 5;
  me.receive(kBaseGroup, encoded(mismatch), world.now);
  EXPECT_EQ(me.receive(near, here, world.now).verdict, IncomingVerdict::other_scene);
  ASSERT_EQ(me.take_events().size(), 1u);

  // It restarts with our scene: datagrams of its former epoch are refused.
  me.receive(kBaseGroup, encoded(presence_of(2, 23)), world.now);
  world.run(seconds(1));
  EXPECT_EQ(me.receive(near, here, world.now).verdict, IncomingVerdict::former_life);
  EXPECT_EQ(me.incoming(IncomingVerdict::duplicate), 1u);
  EXPECT_EQ(me.incoming(IncomingVerdict::former_life), 1u);
}

TEST(AreaOfInterestManager, SurvivesAnyOctets) {
  AreaOfInterestManager manager(config(), presence_of(1, 11));
  manager.start(nanoseconds(0));
  std::mt19937_64 random(99);
  Collector wire;
  manager.step(nanoseconds(0), wire);
  ASSERT_FALSE(wire.datagrams.empty());
  AggregatorConfig sender;
  sender.epoch = 22;
  Aggregator other(sender);
  other.add(kBaseGroup, encoded(presence_of(2, 22)), nanoseconds(0));
  other.add(kBaseGroup, entity_state(1), haptic_record(1.0F), nanoseconds(0));
  other.flush_due(nanoseconds(0), wire);
  for (int i = 0; i < 100000; ++i) {
    Octets octets = wire.datagrams[random() % wire.datagrams.size()].octets;
    for (std::uint64_t flips = random() % 6; flips > 0; --flips) {
      octets[random() % octets.size()] = static_cast<std::byte>(random());
    }
    if (random() % 4 == 0) octets.resize(random() % octets.size());
    const GroupIndex group{static_cast<std::uint16_t>(random() % 3 == 0 ? random() : 0)};
    manager.receive(group, octets, milliseconds(i));
    if (i % 100 == 0) {
      manager.step(milliseconds(i), [](GroupIndex, std::span<const std::byte>) {});
      (void)manager.take_events();
    }
  }
  EXPECT_LE(manager.presence().peers().size(), 256u);
}

TEST(AreaOfInterestManager, IgnoresPeersOfAnotherExercise) {
  World world;
  AreaOfInterestManager& me = world.add(presence_of(1, 11, 100), {0, 0, 0});
  // One would be a newcomer. The other is older and would win our address. Both send entities here.
  pdu::Presence beside = presence_of(2, 22, 100), older = presence_of(1, 33, 50);
  beside.header.exercise_id = older.header.exercise_id = 9;
  AreaOfInterestManager& other = world.add(beside, {0, 0, 0});
  AreaOfInterestManager& disputing = world.add(older, {0, 0, 0});
  for (int i = 0; i < 300; ++i) {
    other.send(kCellTier, StatePayload{entity_state(1)}, {0, 0, 0}, world.now);
    world.run(milliseconds(10));
  }
  EXPECT_EQ(me.presence().id(), (PeerId{7, 1}));
  EXPECT_TRUE(me.presence().peers().empty());
  EXPECT_TRUE(me.take_events().empty());
  EXPECT_EQ(me.presence().counts().conflicts, 0u);
  EXPECT_TRUE(world.members[0].used.empty());
  EXPECT_GT(me.incoming(IncomingVerdict::other_exercise), 300u);
  EXPECT_EQ(me.sequences().counts().lost, 0u);
  // The two peers of exercise 9 have found each other.
  EXPECT_EQ(other.presence().peers().size(), 1u);
  EXPECT_EQ(disputing.presence().peers().size(), 1u);
}

TEST(AreaOfInterestManager, IgnoresForeignPresenceDatagramWithoutTrailer) {
  AreaOfInterestManager me(config(), presence_of(1, 11));
  me.start(nanoseconds(0));
  pdu::Presence foreign = presence_of(2, 22);
  foreign.header.exercise_id = 9;
  const Octets mixed = encoded(presence_of(3, 33)) + encoded(foreign);
  EXPECT_EQ(me.receive(kBaseGroup, mixed, seconds(1)).verdict, IncomingVerdict::other_exercise);
  EXPECT_TRUE(me.presence().peers().empty());
  me.receive(kBaseGroup, encoded(presence_of(3, 33)), seconds(1));
  EXPECT_EQ(me.presence().peers().size(), 1u);
}

TEST(AreaOfInterestManager, IgnoresSequenceNumbersBeforeAnAnnouncement) {
  AreaOfInterestManager me(config(), presence_of(1, 11));
  me.start(nanoseconds(0));
  const auto with_trailer = [](std::uint32_t sequence) {
    pdu::DatagramTrailer trailer;
    trailer.epoch = 22;
    trailer.sequence = sequence;
    return encoded(trailer);
  };
  EXPECT_EQ(me.receive(kBaseGroup, with_trailer(1u << 30), seconds(1)).verdict,
            IncomingVerdict::stranger);
  const Octets first = encoded(presence_of(2, 22)) + with_trailer(1);
  me.receive(kBaseGroup, first, seconds(1));
  EXPECT_EQ(me.presence().peers().size(), 1u);
  EXPECT_EQ(me.receive(kBaseGroup, with_trailer(2), seconds(1)).verdict, IncomingVerdict::use);
  EXPECT_EQ(me.sequences().counts().lost, 0u);
}

TEST(AreaOfInterestManager, RefusesDatagramsOfAMemberFromAnotherAddress) {
  World world;
  AreaOfInterestManager& me = world.add(presence_of(1, 11), {0, 0, 0});
  world.run(milliseconds(10));
  me.receive(kBaseGroup, encoded(presence_of(2, 22)), world.now, source(2));
  AggregatorConfig sender;
  sender.epoch = 22;
  Aggregator other(sender);
  Collector wire;
  const GroupIndex near = me.route({0, 0, 0});
  other.add(near, entity_state(1), {}, nanoseconds(0));
  other.add(kBaseGroup, entity_state(2), {}, nanoseconds(0));
  other.flush_due(nanoseconds(0), wire);
  (void)me.take_events();
  for (const Datagram& datagram : wire.datagrams) {
    for (const SourceAddress& from : {source(3), source(2, 4001), SourceAddress{}}) {
      EXPECT_EQ(me.receive(datagram.group, datagram.octets, world.now, from).verdict,
                IncomingVerdict::impostor);
    }
  }
  const auto events = me.take_events();
  ASSERT_EQ(events.size(), 1u) << "told once";
  EXPECT_EQ(events[0].kind, PresenceEventKind::impostor);
  for (const Datagram& datagram : wire.datagrams) {
    EXPECT_EQ(me.receive(datagram.group, datagram.octets, world.now, source(2)).verdict,
              IncomingVerdict::use)
        << "the numbering is as if nothing had come from elsewhere";
  }
}

}  // namespace
}  // namespace reckon::aoim
