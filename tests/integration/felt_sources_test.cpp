// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Datagrams of peers whose bodies are in reach of a hand are read at once; others may wait.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "reckon/pdu/timestamp.hpp"
#include "reckon/tests/support/in_process.hpp"

namespace reckon::test::felt_sources_test {
namespace {

TEST(FeltSources, AreOwnersOfBodiesWithinAHandsReach) {
  const peer::SceneFile scene = scene_of(kTwoHandsOnAWall);
  InProcess world(2);
  world.listen(scene);
  world.start(0, scene);
  world.start(1, scene);
  world.run(2000);  // they know each other, and touch from time to time

  // A truck a kilometre away sends each millisecond.
  pdu::EntityState truck = world.heard_pdus<pdu::EntityState>().back();
  truck.variable_parameters = {};
  truck.entity_id = {7, 7, 1};
  truck.entity_type = {pdu::EntityKind::platform, pdu::EntityDomain::land};
  truck.location.x += 1000;
  std::size_t felt = 0, from_other = 0, before = 0;
  const peer::IpEndpoint other = world.network().link(1).local_endpoint();
  for (int i = 0; i < 1000; ++i) {
    truck.header.timestamp = pdu::to_dis_timestamp(world.clock().utc_now(), true);
    world.say(truck, scene);
    before = world.heard().size();
    world.run(1);
    felt += world.peer(0).has_taken_felt() ? 1 : 0;
    bool came = false;
    for (std::size_t at = before; at < world.heard().size(); ++at)
      came = came || world.heard()[at].sender == other;
    from_other += came ? 1 : 0;
  }
  EXPECT_GT(from_other, 10u);
  EXPECT_EQ(felt, from_other);

  world.kill(1);  // its hand stays until its presence expires, then nothing is felt
  world.run(7000);
  world.say(truck, scene);
  world.run(1);
  EXPECT_FALSE(world.peer(0).has_taken_felt());
}

}  // namespace
}  // namespace reckon::test::felt_sources_test
