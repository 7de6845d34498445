// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A peer whose tiers defer updates sleeps until it may send them.
#include <gtest/gtest.h>

#include <cmath>

#include "reckon/peer/clocks/clock.hpp"
#include "reckon/peer/network/simulated_network.hpp"
#include "reckon/peer/peer.hpp"
#include "reckon/peer/scene/scene_file.hpp"

namespace reckon::peer {
namespace {

using namespace std::chrono_literals;

TEST(DeferredUpdates, LetTheModelLoopSleep) {
  const SceneFile scene = parse_scene_file(R"(
[aoim]
cell = "100 m"
radius = "200 m"

[[aoim.tier]]
farthest = "50 m"
active = "30 Hz"
passive = "0.2 Hz"
octets = "232 B"
own_group = true

[[aoim.tier]]
body = "rigid"
active = "1 Hz"
passive = "0.2 Hz"
octets = "144 B"
)",
                                           "tiers.toml");
  ManualClock clock(1s, 1h);
  SimulatedNetworkOptions links;
  links.links = 1;
  SimulatedNetwork network(links, clock);
  PeerOptions options;
  options.epoch = 1;
  Peer peer(scene, options, network.link(0), {});
  const auto car = [&] {  // on a circle, as no prediction has it
    const double angle = 2.0 * pdu::to_seconds(clock.now());
    EntityTruth truth;
    truth.time = clock.now();
    truth.position = {5 * std::cos(angle), 5 * std::sin(angle), 0};
    truth.velocity = {-10 * std::sin(angle), 10 * std::cos(angle), 0};
    return truth;
  };
  EntityDescription vehicle;
  vehicle.type = {pdu::EntityKind::platform, pdu::EntityDomain::land, 225, 1, 0, 0, 0};
  peer.model().add(1, vehicle, car());
  peer.start(clock.now());
  int awake = 0;
  for (int pass = 0; pass < 500; ++pass) {
    clock.advance(20ms);
    peer.model().move(1, car());
    peer.model_step(clock.now(), clock.utc_now());
    peer.write_step();
    if (peer.next_step() <= clock.now()) ++awake;
  }
  EXPECT_GT(peer.counters().find("updates_held_back")->value(), 0u);
  EXPECT_LE(awake, 5);
}

}  // namespace
}  // namespace reckon::peer
