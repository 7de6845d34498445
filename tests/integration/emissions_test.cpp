// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The emissions of a remote entity as its peers know them.
#include <gtest/gtest.h>

#include <vector>

#include "reckon/pdu/emission/electromagnetic_emission.hpp"
#include "reckon/tests/integration/federates.hpp"
#include "reckon/tests/support/emission_samples.hpp"

namespace reckon::test::emissions_test {
namespace {

using namespace std::chrono_literals;

TEST(EmissionsOfAPeer, ArePresentUntilTheirHeartbeatsFail) {
  const peer::SceneFile scene = *peer::dis_exercise(1, 0.82, 0.145);
  Federates world(3, {});
  const auto pass = [&](std::chrono::nanoseconds span) {
    world.run(
        span, 10ms, [] {}, [] {});
  };
  peer::Federate& viewer = world.join(scene);
  peer::Federate& owner = world.join(scene);
  owner.publish<pdu::ElectromagneticEmission>();
  const auto handle = owner.register_object({}, {});
  pass(1s);
  const pdu::EntityId ship = owner.id_of(handle);

  // A stranger sends in its name, and is refused.
  const std::vector<std::byte> forged = emission_pdu(ship, {{7}});
  ASSERT_TRUE(world.link(2).send(scene.network.group, forged));
  const std::vector<std::byte> octets = emission_pdu(ship, kThreeSystems);
  pdu::ElectromagneticEmission emission;
  ASSERT_EQ(pdu::decode(octets, emission), pdu::DecodeError::none);
  owner.send(emission);
  pass(100ms);
  EXPECT_EQ(viewer.peer().model().emissions().rows().size(), 3U);
  ASSERT_TRUE(viewer.peer().views().update());
  const peer::PeerView& seen = viewer.peer().views().read();
  ASSERT_EQ(seen.count, 1U);
  EXPECT_EQ(seen.rows[0].id, ship);
  EXPECT_EQ(seen.rows[0].emits.emitters, 3);
  EXPECT_EQ(seen.rows[0].emits.beams, 3);
  EXPECT_EQ(world.count(0, "unused_in"), 0U);

  pass(25s);
  EXPECT_TRUE(viewer.peer().model().emissions().rows().empty());
  ASSERT_TRUE(viewer.peer().views().update());
  const peer::PeerView& later = viewer.peer().views().read();
  ASSERT_EQ(later.count, 1U);
  EXPECT_FALSE(later.rows[0].emits.any());
}

}  // namespace
}  // namespace reckon::test::emissions_test
