// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A program with an effect of its own: a simulated hand strokes a table with this effect for two
// seconds of simulated time. Exit status 0 if the drag on the hand follows the effect.
#include "honey.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>

#include "reckon/haptics/devices/simulated_device.hpp"
#include "reckon/peer/clocks/clock.hpp"
#include "reckon/peer/network/simulated_network.hpp"
#include "reckon/peer/peer.hpp"
#include "reckon/peer/scene/scene_file.hpp"

using namespace reckon;
using namespace std::chrono_literals;

int main() {
  const auto scene = peer::parse_scene_file(
      "[[object]]\n"
      "name = \"table\"\n"
      "plane = [0, 0, 1]\n"
      "surface = { stiffness = \"400 N/m\" }\n"
      "honey = { strength = 4 }\n",
      "table.toml", ".", haptics::custom_effects<Honey>());
  haptics::SimulatedDeviceConfig config;
  config.start = {0, 0, 0.01};
  // Presses, and moves back and forth by 30 mm once a second.
  haptics::SimulatedDevice hand(config, [](double t) {
    haptics::HandTarget target;
    target.position = {0.03 * std::sin(6.28 * t), 0.0, -0.01};
    return target;
  });
  peer::ManualClock clock(1s, 0s);
  peer::SimulatedNetwork network({}, clock);
  peer::Peer peer(scene, {}, network.link(0), hand);
  peer.start(clock.now());
  double least = 0.0, most = 0.0;
  for (int millisecond = 0; millisecond < 2000; ++millisecond, clock.advance(1ms)) {
    peer.servo_step(clock.now());
    peer.read_step(clock.now());
    peer.model_step(clock.now(), clock.utc_now());
    peer.write_step();
    const double slip = hand.velocity().x(), pressure = hand.force().z();
    if (millisecond < 1000 || std::abs(slip) < 0.05) continue;
    const double drag = -hand.force().x() / (pressure * slip);
    least = least == 0.0 ? drag : std::min(least, drag);
    most = std::max(most, drag);
  }
  std::printf("dragged by %.2f to %.2f s/m\n", least, most);
  return least > 3.0 && most < 5.0 ? 0 : 1;
}
