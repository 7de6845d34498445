// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The cost of 64 peers in a town, on a network without loss and with immediate joins: to arrive, to
// drive and to join the cells on their way.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <memory>
#include <vector>

#include "reckon/pdu/seconds.hpp"
#include "reckon/peer/federate.hpp"
#include "reckon/peer/joined_peer.hpp"
#include "reckon/peer/network/simulated_network.hpp"
#include "reckon/peer/scene/scene_file.hpp"

namespace reckon::test::join_cost_test {
namespace {

using namespace std::chrono_literals;
using std::chrono::nanoseconds;

constexpr std::size_t kPeers = 64, kEntities = 4;
constexpr nanoseconds kStep = 20ms;

peer::SceneFile town() {
  return peer::parse_scene_file(
      "[scene]\norigin = { latitude = \"47 deg\", longitude = \"8 deg\" }\n"
      "[aoim]\nscheme = \"square\"\ncell = 100\nradius = 150\n",
      "town.toml");
}

// A post, and three vehicles that drive back and forth along a street of 400 m.
peer::EntityTruth place(std::size_t number, std::size_t entity, nanoseconds now) {
  peer::EntityTruth truth;
  truth.time = now;
  const auto row = static_cast<double>(number % 8), column = static_cast<double>(number / 8);
  truth.position = {120 * row, 120 * column + 7 * static_cast<double>(entity), 0};
  if (entity == 0) return truth;
  const double pace = 6.0 + static_cast<double>((number + 5 * entity) % 9);
  const double way = std::fmod(pace * pdu::to_seconds(now), 800.0);
  truth.position.x() += way < 400 ? way : 800 - way;
  truth.velocity = {way < 400 ? pace : -pace, 0, 0};
  return truth;
}

struct Cost {
  std::uint64_t datagrams = 0, octets = 0, joins = 0, updates = 0;
};

Cost cost_of(nanoseconds span) {
  peer::ManualClock clock(1s, 1h);
  peer::SimulatedNetworkOptions options;
  options.links = kPeers;
  options.datagrams_in_flight = 4096;
  peer::SimulatedNetwork network(options, clock);
  const peer::SceneFile scene = town();
  std::vector<std::unique_ptr<peer::Federate>> peers;
  std::vector<peer::ObjectHandle> handles;
  for (std::size_t number = 0; number < kPeers; ++number) {
    peer::FederateOptions own;
    own.name = "town";
    own.scene = scene;
    own.site = 4;
    own.application = static_cast<std::uint16_t>(number + 1);
    peers.push_back(std::make_unique<peer::Federate>(own, network.link(number), clock,
                                                     static_cast<std::uint32_t>(number + 1)));
    peers.back()->publish(peer::EntityClass{});
    for (std::size_t entity = 0; entity < kEntities; ++entity) {
      peer::EntityDescription thing;
      thing.type = {pdu::EntityKind::platform, pdu::EntityDomain::land, 225, 1, 0, 0, 0};
      handles.push_back(peers.back()->register_object(thing, place(number, entity, clock.now())));
    }
  }
  for (const nanoseconds end = clock.now() + span; clock.now() < end;) {
    clock.advance(kStep);
    for (std::size_t number = 0; number < kPeers; ++number) {
      for (std::size_t entity = 1; entity < kEntities; ++entity)
        peers[number]->update_attributes(handles[number * kEntities + entity],
                                         place(number, entity, clock.now()));
      peers[number]->step();
    }
  }
  Cost cost;
  for (std::size_t number = 0; number < kPeers; ++number) {
    const peer::LinkStatistics link = network.link(number).statistics();
    cost.datagrams += link.sent;
    cost.octets += link.sent_bytes;
    cost.joins += link.joins;
    cost.updates += peers[number]->peer().counters().find("updates_out")->value();
  }
  return cost;
}

// If only changed states were repeated after 1 s, these would be 6,475 datagrams of 1,649,220
// octets, 4,943 updates.
TEST(JoinCost, RepeatedRequestsAndAnswersAddLittle) {
  const Cost cost = cost_of(20s);
  std::printf("  64 peers, 20 s: %lu joins, %lu datagrams of %lu octets, %lu updates\n", cost.joins,
              cost.datagrams, cost.octets, cost.updates);
  EXPECT_EQ(cost.joins, 2889U);
  EXPECT_LT(cost.datagrams, 6475U * 110 / 100);
  EXPECT_LT(cost.octets, 1'649'220U * 114 / 100);
  EXPECT_LT(cost.updates, 4943U * 113 / 100);
}

}  // namespace
}  // namespace reckon::test::join_cost_test
