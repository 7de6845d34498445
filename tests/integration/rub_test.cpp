// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Traffic of rubbing hands: over an unheld entity of another peer, and over each other.
#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>
#include <string>
#include <vector>

#include "reckon/pdu/seconds.hpp"
#include "reckon/tests/support/arriving_hand.hpp"
#include "reckon/tests/support/climb.hpp"
#include "reckon/tests/support/in_process.hpp"

namespace reckon::test {
namespace {

const std::string kRubbing = R"(
[scene]
name = "rub"
origin = {latitude = "47.05 deg", longitude = "8.31 deg", height = "430 m"}

[aoim]
pool = 16
)";

// A hand moves back and forth by 40 mm each way once a second, 3 mm deep in a peg of the first
// peer.
const std::string kPeg = kRubbing + R"(
[hand]
radius = "10 mm"
k1 = "800 N/m"

[[entity]]
peer = 1
marking = "PEG"
type = "Cultural feature Land"
force_model = {kind = "plane", k1 = "800 N/m"}

[[operator]]
sweep = {from = "-40 0 7 mm", to = "40 0 7 mm", period = "1 s"}

[[device]]
peer = 2
operator = 1
)";

// One hand over another that gives way, 3 mm deep.
const std::string kHands = kRubbing + R"(
[hand]
radius = "10 mm"
k1 = "500 N/m"

[[operator]]
sweep = {from = "-8 0 17 mm", to = "8 0 17 mm", period = "1 s"}

[[operator]]
passive = true
position = "0 0 0 mm"
stiffness = "300 N/m"
)";

// Over a hand that gives way too, so much that they part four times a second.
const std::string kParting = kRubbing + R"(
[hand]
radius = "40 mm"
k1 = "500 N/m"

[[operator]]
sweep = {from = "-40 0 74 mm", to = "40 0 74 mm", period = "1 s"}

[[operator]]
passive = true
position = "0 0 0 mm"
stiffness = "300 N/m"
)";

// The hand rubs a shaped body, 6 mm deep, and is thrown off its edges.
std::string over(const std::string& model, const std::string& height) {
  const std::string peg = with(kPeg, R"({kind = "plane", k1 = "800 N/m"})", model);
  const std::string from = with(peg, R"("-40 0 7 mm")", "\"-40 0 " + height + " mm\"");
  return with(from, R"("40 0 7 mm")", "\"40 0 " + height + " mm\"");
}

// Two hands move back and forth over each other by `way` [mm], in opposite directions.
std::string both_sweep(const std::string& radius, const std::string& height,
                       const std::string& way) {
  return kRubbing + "[hand]\nradius = \"" + radius + " mm\"\nk1 = \"500 N/m\"\n" +
         "[[operator]]\nsweep = {from = \"-" + way + " 0 " + height + " mm\", to = \"" + way +
         " 0 " + height + " mm\", period = \"1 s\"}\n" + "[[operator]]\nsweep = {from = \"" + way +
         " 0 0 mm\", to = \"-" + way + " 0 0 mm\", period = \"1 s\"}\n";
}

// The cost of ten seconds, and the second peer's hand as shown to the first.
struct Rub {
  double packets = 0.0;         // [1/s], of both
  double p50 = 0.0, max = 0.0;  // [m], shown relative to true
  double least_energy = 0.0;    // [J]
  bool touched = false;
};

Rub rub(const std::string& text, std::size_t shower, std::uint64_t seed,
        nanoseconds delay = milliseconds(2), nanoseconds jitter = milliseconds(2)) {
  const peer::SceneFile scene = scene_of(text);
  InProcess world(2, seed);
  peer::ImpairmentLaw law;
  law.delay = delay;
  law.jitter = jitter;
  world.network().impair(law);
  world.move_by(scene.devices.empty() ? 0 : 1, arriving(scene.operators[0], {0, 0, 0.1}));
  world.start(0, scene);
  world.start(1, scene);
  world.run(3000);
  haptics::TraceRing steps(64);
  world.peer(shower).trace(&steps);
  const auto sent = [&] {
    return world.count(0, "datagrams_out") + world.count(1, "datagrams_out");
  };
  const std::uint64_t before = sent();
  Rub result;
  std::vector<double> errors;
  Eigen::Vector3d truth = Eigen::Vector3d::Zero();
  for (int ms = 0; ms < 10'000; ++ms) {
    world.run(1);
    for (; const haptics::ServoSnapshot* servo = steps.front(); steps.pop()) {
      truth = servo->scp;
      result.least_energy = std::min(result.least_energy, servo->port_energy_min);
      result.touched = result.touched || servo->force.norm() > 0.3;
    }
    for (const peer::RemoteEntity& row : world.peer(1 - shower).model().remote().rows())
      errors.push_back((row.shown(world.clock().now()).position - truth).norm());
  }
  std::sort(errors.begin(), errors.end());
  result.packets = 0.1 * static_cast<double>(sent() - before);
  result.p50 = errors[errors.size() / 2];
  result.max = errors.back();
  return result;
}

TEST(Rubbing, UnheldEntitiesCostNoMoreThanTheMotion) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    SCOPED_TRACE(seed);
    const Rub peg = rub(kPeg, 1, seed);
    EXPECT_TRUE(peg.touched);
    EXPECT_LT(peg.packets, 50.0);
    EXPECT_LT(peg.p50, 0.6e-3);
    EXPECT_LT(peg.max, 1.0e-3);
    EXPECT_GE(peg.least_energy, -1e-9);
  }
}

TEST(Rubbing, AHandCostsLittleMoreThanTheMotion) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    SCOPED_TRACE(seed);
    const Rub hands = rub(kHands, 0, seed);
    EXPECT_TRUE(hands.touched);
    EXPECT_LT(hands.packets, 60.0);
    EXPECT_LT(hands.p50, 0.4e-3);
    EXPECT_LT(hands.max, 1.0e-3);
    EXPECT_GE(hands.least_energy, -1e-9);
  }
}

TEST(Rubbing, HandThrownOffEdgesCostsUnderFiftyPackets) {
  const struct {
    const char* kind;
    std::string model, height;
    double max;  // [m]
  } rubs[] = {
      {"sphere", R"({kind = "sphere", k1 = "800 N/m", radius = "30 mm"})", "34", 1.6e-3},
      {"field", R"({kind = "field", k1 = "800 N/m", radius = "30 mm"})", "24", 1.6e-3},
      {"region", R"({kind = "region", k1 = "800 N/m", radius = "20 mm"})", "4", 2.0e-3},
  };
  for (const auto& shape : rubs) {
    SCOPED_TRACE(shape.kind);
    const Rub peg = rub(over(shape.model, shape.height), 1, 1);
    EXPECT_TRUE(peg.touched);
    EXPECT_LT(peg.packets, 50.0);
    EXPECT_LT(peg.p50, 0.65e-3);
    EXPECT_LT(peg.max, shape.max);
    EXPECT_GE(peg.least_energy, -1e-9);
  }
}

TEST(Rubbing, SweepingOrPartingHandsCostUnderSixtyPackets) {
  const struct {
    const char* what;
    std::string scene;
    double max;  // [m]
  } rubs[] = {
      {"both sweep", both_sweep("20", "37", "15"), 0.9e-3},
      {"both sweep and part four times a second", both_sweep("40", "74", "40"), 1.2e-3},
      {"parting from one that rests", kParting, 1.1e-3},
  };
  for (const auto& hands : rubs) {
    SCOPED_TRACE(hands.what);
    const Rub result = rub(hands.scene, 0, 1);
    EXPECT_TRUE(result.touched);
    EXPECT_LT(result.packets, 60.0);
    EXPECT_LT(result.p50, 0.4e-3);
    EXPECT_LT(result.max, hands.max);
    EXPECT_GE(result.least_energy, -1e-9);
  }
}

// A hand sweeps over one that gives way, at most as fast as in the scenes above.
std::string any_rub(const Choice<7>& c) {
  const auto text = [](double value, const char* unit) {
    return std::to_string(value) + ' ' + unit + '"';
  };
  const std::string way = std::to_string(within(c[0], 5, 40));
  const std::string height = std::to_string(within(c[1], 34, 39));
  const double friction = within(c[4], 0, 0.5);
  return kRubbing + "[hand]\nradius = \"20 mm\"\nk1 = \"" + text(within(c[2], 200, 800), "N/m") +
         "\nstatic_friction = " + std::to_string(friction) +
         "\nkinetic_friction = " + std::to_string(0.8 * friction) +
         "\n[[operator]]\nsweep = {from = \"-" + way + " 0 " + height + " mm\", to = \"" + way +
         " 0 " + height + " mm\", period = \"" + text(within(c[3], 1, 2), "s") +
         "}\n[[operator]]\npassive = true\nposition = \"0 0 0 mm\"\nstiffness = \"" +
         text(within(c[5], 150, 600), "N/m") + "\n";
}

// Not met: climbs find 85 packets/s, and so fail: stiff hands that bounce off each other 4 to 8
// times a second. docs/haptic_stability.md explains the number.
TEST(Rubbing, NoClimbExceedsSixtyPackets) {
  const auto climbed = climb<7>([](const Choice<7>& choice) {
    const auto delay = pdu::from_seconds(within(choice[6], 0, 0.02));
    const Rub result = rub(any_rub(choice), 0, 1, delay, delay / 4);
    EXPECT_GE(result.least_energy, -1e-9);
    return result.packets / 60.0;
  });
  EXPECT_LT(climbed.badness, 1.0) << any_rub(climbed.worst) << "delay "
                                  << within(climbed.worst[6], 0, 20) << " ms, climb "
                                  << climbed.seed;
  std::cout << climbed.tries << " tries, at most " << 60.0 * climbed.badness << " packets/s\n";
}

}  // namespace
}  // namespace reckon::test
