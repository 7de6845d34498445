// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Datagrams of others in the name of an entity's owner: they change nothing, and the user is
// informed.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <iterator>
#include <string>
#include <vector>

#include "reckon/pdu/entity/attribute.hpp"
#include "reckon/pdu/management/stop_freeze.hpp"
#include "reckon/pdu/timestamp.hpp"
#include "reckon/tests/support/in_process.hpp"

namespace reckon::test {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;

// Two peers that know each other, and two hosts without peers: links 2 and 3.
class Forgery : public testing::Test {
 protected:
  explicit Forgery(bool interop = false)
      : scene_(scene_of(
            interop ? with(kTwoHandsOnAWall, "[hand]", "[network]\ninterop = true\n\n[hand]")
                    : std::string(kTwoHandsOnAWall))),
        world_(4) {
    world_.listen(scene_);
    world_.start(0, scene_);
    world_.start(1, scene_);
    world_.run(500);
    EXPECT_EQ(world_.view(0).entities, 1U);
    static_cast<void>(world_.notices(0));
  }

  // The last state that a peer sent of its hand, with the current time.
  [[nodiscard]] pdu::EntityState state_of(std::size_t link) {
    pdu::EntityState last;
    for (const pdu::EntityState& state : world_.heard_pdus<pdu::EntityState>()) {
      if (state.entity_id == world_.peer(link).own_id()) last = state;
    }
    last.variable_parameters = {};
    last.header.timestamp = pdu::to_dis_timestamp(world_.clock().utc_now(), true);
    return last;
  }
  template <typename T>
  void say_from(std::size_t link, const T& message) {
    std::vector<std::byte> octets(pdu::wire_size(message));
    ASSERT_EQ(pdu::encode(message, octets), octets.size());
    ASSERT_TRUE(world_.network().link(link).send(scene_.network.group, octets));
  }
  // Link 2 sends the second peer's hand state ten times in half a second, changed by `change`.
  void forge(const std::function<void(pdu::EntityState&)>& change) {
    for (int i = 0; i < 10; ++i) {
      pdu::EntityState forged = state_of(1);
      change(forged);
      say_from(2, forged);
      world_.run(50);
    }
  }
  [[nodiscard]] std::string endpoint(std::size_t link) {
    return world_.network().link(link).local_endpoint().text();
  }
  [[nodiscard]] const peer::RemoteEntity* row(const pdu::EntityId& id) {
    return world_.peer(0).model().remote().find(id);
  }
  void expect_refused_and_told() {
    EXPECT_GE(world_.count(0, "disputed_in"), 9U);
    EXPECT_THAT(world_.notices(0),
                Contains("1:2 at " + endpoint(1) + ": refused entities under this number from " +
                         endpoint(2)));
  }

  peer::SceneFile scene_;
  InProcess world_;
};

TEST_F(Forgery, OfADeactivationIsRefused) {
  forge([](pdu::EntityState& state) { state.appearance |= pdu::kAppearanceDeactivated; });
  ASSERT_EQ(world_.view(0).entities, 1U);
  EXPECT_EQ(world_.count(0, "left"), 0U);
  expect_refused_and_told();
}

TEST_F(Forgery, OfAPlaceIsRefused) {
  const Eigen::Vector3d before = row(world_.peer(1).own_id())->state->position;
  forge([](pdu::EntityState& state) { state.location.x += 3.0; });
  ASSERT_NE(row(world_.peer(1).own_id()), nullptr);
  EXPECT_LT((row(world_.peer(1).own_id())->state->position - before).norm(), 0.1);
  EXPECT_NE(row(world_.peer(1).own_id())->epoch, 0U);
  expect_refused_and_told();
}

TEST_F(Forgery, OfAMarkingIsRefused) {
  forge([](pdu::EntityState& state) { state.marking.text[0] = 'X'; });
  ASSERT_NE(row(world_.peer(1).own_id()), nullptr);
  EXPECT_EQ(row(world_.peer(1).own_id())->marking[0], 'H');
}

TEST_F(Forgery, OfAnUnknownEntityIsRefused) {
  forge([](pdu::EntityState& state) { state.entity_id.entity = 77; });
  EXPECT_EQ(world_.view(0).entities, 1U);
  expect_refused_and_told();
}

TEST_F(Forgery, UnderALaterPeersNumberIsDropped) {
  pdu::EntityState squatter = state_of(1);
  squatter.entity_id = {1, 3, 9};
  say_from(3, squatter);
  world_.run(100);
  ASSERT_NE(row({1, 3, 9}), nullptr);
  world_.start(2, scene_);  // 1:3
  world_.run(300);
  EXPECT_EQ(row({1, 3, 9}), nullptr);
  EXPECT_NE(row(world_.peer(2).own_id()), nullptr);
}

TEST_F(Forgery, OfAnotherGuestIsRefusedUntilItsSilence) {
  pdu::EntityState guest = state_of(1);
  guest.entity_id = {5, 6, 7};
  guest.entity_type = {pdu::EntityKind::platform, pdu::EntityDomain::air};
  guest.dead_reckoning.algorithm = pdu::DeadReckoningAlgorithm::fpw;
  guest.linear_velocity.x = 0.01F;  // it moves: a heartbeat of 5 s
  const auto say = [&](std::size_t link, std::uint32_t appearance) {
    guest.header.timestamp = pdu::to_dis_timestamp(world_.clock().utc_now(), true);
    guest.appearance = appearance;
    say_from(link, guest);
    world_.run(100);
  };
  for (int i = 0; i < 60; ++i) {  // 12 s; the genuine one has a heartbeat of 5 s
    if (i % 25 == 0) say(3, 1);
    say(2, pdu::kAppearanceDeactivated);
    world_.run(100);
    ASSERT_NE(row({5, 6, 7}), nullptr) << i;
    ASSERT_EQ(row({5, 6, 7})->appearance, 1U);
  }
  world_.run(7000);
  say(2, 2);
  ASSERT_NE(row({5, 6, 7}), nullptr);
  EXPECT_EQ(row({5, 6, 7})->appearance, 2U);
  say(3, 1);
  EXPECT_EQ(row({5, 6, 7})->appearance, 2U);
}

TEST_F(Forgery, OfAnOrderIsRefusedAndReported) {
  pdu::StopFreeze order;
  order.receiving_entity_id = {0xFFFF, 0xFFFF, 0xFFFF};
  for (const pdu::EntityId& by : {pdu::EntityId{9, 9, 0}, world_.peer(1).own_id(),
                                  world_.peer(0).own_id(), pdu::EntityId{}}) {
    order.originating_entity_id = by;
    say_from(2, order);
    world_.run(100);
  }
  EXPECT_FALSE(world_.view(0).frozen);
  EXPECT_EQ(world_.count(0, "orders_refused"), 4U);
  EXPECT_THAT(world_.notices(0), Contains(HasSubstr("9:9:0 at " + endpoint(2) + " to freeze")));
}

TEST_F(Forgery, OfAPermittedPeersOrderIsRefused) {
  const peer::SceneFile allowing = managed_by("members", scene_);
  InProcess world(2);
  world.listen(allowing);
  world.start(0, allowing);
  world.start(1, allowing);
  world.run(300);
  pdu::StopFreeze order;
  order.receiving_entity_id = {0xFFFF, 0xFFFF, 0xFFFF};
  order.originating_entity_id = world.peer(1).own_id();
  world.say(order, allowing);
  world.run(100);
  EXPECT_FALSE(world.view(0).frozen);
}

TEST_F(Forgery, SentToOneHostAloneIsRefused) {
  pdu::EntityState guest = state_of(1);
  guest.entity_id = {5, 6, 7};
  std::vector<std::byte> octets(pdu::wire_size(guest));
  ASSERT_EQ(pdu::encode(guest, octets), octets.size());
  const peer::IpEndpoint victim = world_.network().link(0).local_endpoint();
  ASSERT_TRUE(world_.network().link(2).send(victim, octets));
  world_.run(100);
  EXPECT_EQ(row({5, 6, 7}), nullptr);
  EXPECT_EQ(world_.count(0, "unicast_refused"), 1U);
}

// Site, application or entity 0 is none, 65535 is all, and entity 65534 requests an ID.
TEST_F(Forgery, UnderAReservedIdCreatesNoEntity) {
  const pdu::EntityId reserved[] = {{0, 0, 0},     {0, 6, 7},     {5, 0, 7},
                                    {5, 6, 0},     {65535, 6, 7}, {5, 65535, 7},
                                    {5, 6, 65535}, {5, 6, 65534}, {65535, 65535, 65535}};
  pdu::EntityState guest = state_of(1);
  for (const pdu::EntityId& id : reserved) {
    guest.entity_id = id;
    say_from(2, guest);
  }
  world_.run(100);
  EXPECT_EQ(world_.view(0).entities, 1U);
  EXPECT_EQ(world_.count(0, "reserved_ids_in"), std::size(reserved));
  guest.entity_id = {65534, 65534, 65533};
  say_from(2, guest);
  world_.run(100);
  EXPECT_EQ(world_.view(0).entities, 2U);
}

// Without presence a sender is identified by its address and port alone.
class InteropForgery : public Forgery {
 protected:
  InteropForgery() : Forgery(true) {}
};

TEST_F(InteropForgery, OfADeactivationIsRefusedToo) {
  forge([](pdu::EntityState& state) { state.appearance |= pdu::kAppearanceDeactivated; });
  ASSERT_EQ(world_.view(0).entities, 1U);
  expect_refused_and_told();
}

// Plain DIS cannot resolve a conflict of IDs, but a shared ID must be reported.
TEST_F(InteropForgery, UnderOurIdIsReportedWithTheRemedy) {
  for (int i = 0; i < 10; ++i) {
    say_from(2, state_of(0));
    world_.run(50);
  }
  EXPECT_THAT(
      world_.notices(0),
      Contains(AllOf(StartsWith("refused: " + endpoint(2) + " sends entities of this peer, 1:1;"),
                     HasSubstr("give one another application"))));
  EXPECT_GE(world_.count(0, "disputed_in"), 9U);
  EXPECT_EQ(world_.peer(0).own_id(), (pdu::EntityId{1, 1, 1})) << "an ID was changed unasked";
}

TEST_F(InteropForgery, OneGatewayMaySpeakForManySimulations) {
  for (std::uint16_t application = 1; application <= 40; ++application) {
    pdu::EntityState guest = state_of(1);
    guest.entity_id = {5, application, 7};
    say_from(2, guest);
  }
  world_.run(100);
  EXPECT_EQ(world_.view(0).entities, 41U);
  EXPECT_EQ(world_.count(0, "disputed_in"), 0U);
}

}  // namespace
}  // namespace reckon::test
