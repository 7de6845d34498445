// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A peer whose tiers defer updates sleeps until it may send them.
#include <gtest/gtest.h>

#include <cmath>

#include "reckon/peer/clocks/clock.hpp"
#include "reckon/peer/federate.hpp"
#include "reckon/peer/network/simulated_network.hpp"
#include "reckon/peer/peer.hpp"

namespace reckon::peer {
namespace {

using namespace std::chrono_literals;

TEST(DeferredUpdates, LetTheModelLoopSleep) {
  SceneFile scene = *dis_exercise(1, 0.3, 0.145);
  scene.network.interop = false;
  scene.aoim.tiers = distance_tiers(aoim::default_channels());
  ManualClock clock(1s, 1h);
  SimulatedNetworkOptions links;
  links.links = 1;
  SimulatedNetwork network(links, clock);
  PeerOptions options;
  options.epoch = 1;
  Peer peer(scene, options, network.link(0), {});
  const auto car = [&] {  // on a circle, as no prediction has it
    const double angle = 0.5 * pdu::to_seconds(clock.now());
    EntityTruth truth;
    truth.time = clock.now();
    truth.position = {20 * std::cos(angle), 20 * std::sin(angle), 0};
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
