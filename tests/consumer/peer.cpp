// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// An external program of some thirty lines: two peers with simulated hands in one process, two
// seconds of simulated time. Exit status 0 if each has received the other's hand.
#include "reckon/peer/peer.hpp"

#include <chrono>
#include <cstdio>

#include "reckon/haptics/devices/simulated_device.hpp"
#include "reckon/peer/clocks/clock.hpp"
#include "reckon/peer/network/simulated_network.hpp"
#include "reckon/peer/scene/scene_file.hpp"

using namespace reckon;
using namespace std::chrono_literals;

int main() {
  const auto scene = peer::parse_scene_file(
      "[[object]]\nname = \"table\"\nplane = [0, 0, 1]\nsurface = { stiffness = \"800 N/m\" }\n",
      "table.toml");
  peer::ManualClock clock(1s, 0s);
  peer::SimulatedNetwork network({}, clock);
  haptics::SimulatedDevice left({}), right({});
  peer::PeerOptions options;
  peer::Peer one(scene, options, network.link(0), left);
  options.application = 2;
  options.epoch = 2;  // differs for each start of a process
  peer::Peer two(scene, options, network.link(1), right);
  one.start(clock.now());
  two.start(clock.now());
  for (int millisecond = 0; millisecond < 2000; ++millisecond, clock.advance(1ms)) {
    for (peer::Peer* peer : {&one, &two}) {
      peer->servo_step(clock.now());
      peer->read_step(clock.now());
      peer->model_step(clock.now(), clock.utc_now());
      peer->write_step();
    }
  }
  one.views().update();
  two.views().update();
  const std::size_t seen_by_one = one.views().read().entities;
  const std::size_t seen_by_two = two.views().read().entities;
  std::printf("one sees %zu hand, two sees %zu hand\n", seen_by_one, seen_by_two);
  return seen_by_one == 1 && seen_by_two == 1 ? 0 : 1;
}
