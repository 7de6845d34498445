// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// A servo step that is late while the hand leaves a contact: the device releases meanwhile.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>

#include "reckon/haptics/devices/simulated_device.hpp"
#include "reckon/haptics/servo/servo_loop.hpp"
#include "reckon/tests/support/soak.hpp"

namespace reckon::haptics {
namespace {

using std::chrono::nanoseconds;
using namespace std::chrono_literals;

struct Outcome {
  double port = 0;   // [J], least of the device's own ledger
  double meter = 0;  // [J], largest excess of the servo's meter over it
};

// Slowly into a remote sphere and a floor, quickly out of them, 5 % of the steps 1 to 9.8 ms late.
Outcome late(nanoseconds hold, unsigned seed) {
  SimulatedDeviceConfig config;
  config.hold = hold;
  config.hand_stiffness = 1000;
  config.hand_damping = 10;
  config.start.z() = 0.02;
  SimulatedDevice device(config, [](double t) {
    HandTarget hand;
    hand.position.z() = 0.02 - 0.03 * std::min(1.0, t) + 1.0 * std::clamp(t - 1.2, 0.0, 0.05);
    return hand;
  });
  Scene scene;
  SceneObject floor;
  floor.name = "floor";
  floor.shape = PlaneShape{};
  floor.effects.of<SpringDamper>() = {600, 0.0};
  scene.objects = {floor};
  ServoLoop servo(device, EffectPlan(scene), {});
  ContactSet set;
  RemoteHand& ball = set.hands[set.count++];
  ball.id = {1, 2, 3};
  ball.state.position.z() = -0.025;
  ball.model.kind = pdu::ForceModelKind::sphere;
  ball.model.k1 = 400;
  ball.model.radius = 0.02;
  ball.valid_until = 1000s;
  ball.version = 1;
  servo.contacts().write(set);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> u(0, 1);
  Outcome out;
  for (nanoseconds now{0}; now < 1400ms; now += 1ms) {
    if (u(random) < 0.05)
      now += nanoseconds(static_cast<std::int64_t>(1e6 * (1 + 8.8 * u(random))));
    servo.step(now);
    servo.snapshots().update();
    const double truth = device.port_work() + device.damping_loss();
    out.port = std::min(out.port, truth + servo.snapshots().read().loan);
    out.meter = std::max(out.meter, servo.snapshots().read().port_energy - truth);
  }
  return out;
}

TEST(LateStep, CostsLittleIfTheDeviceReleasesInTime) {
  Outcome kept, dropped;
  for (unsigned seed = 1; seed <= test::tries(100U, 300U); ++seed) {
    const Outcome whole = late(HapticDevice::kWatchdog, seed);
    const Outcome short_hold = late(1500us, seed);
    kept.port = std::min(kept.port, whole.port);
    dropped.port = std::min(dropped.port, short_hold.port);
    dropped.meter = std::max(dropped.meter, short_hold.meter);
  }
  std::printf(
      "least at the port: held for 10 ms %.2f mJ, for 1.5 ms %.2f mJ; meter too high by %.2g J\n",
      1e3 * kept.port, 1e3 * dropped.port, dropped.meter);
  EXPECT_LT(kept.port, -0.005) << "what it costs where the device holds on";
  EXPECT_GE(dropped.port, -1e-9) << "beside what was lent to a wall that lost its force";
  EXPECT_LE(dropped.meter, 1e-9);
}

struct Books {
  double least = 0;   // [J], least energy of the port, with loans
  double beyond = 0;  // [J], least of the same with the account of late steps
  double late_cost = 0;
};

// Light touches and hard ones of a ball that comes and goes: the ledger is empty again and again.
// @param most longest delay of a step [s]  @param often share of late steps
Books touches(double most, double often, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> u(0, 1);
  SimulatedDeviceConfig config;
  config.hold = 1500us;
  config.mass = 0.05 + 0.3 * u(random);
  config.damping = 0.2 + 2.0 * u(random);
  config.hand_stiffness = 100 + 900 * u(random);
  config.hand_damping = 4 * u(random);
  const double reach = 0.005 + 0.02 * u(random), pace = 2 + 20 * u(random);
  SimulatedDevice device(config, [=](double t) {
    HandTarget hand;
    hand.position.x() = reach * std::sin(pace * t);
    hand.velocity.x() = reach * pace * std::cos(pace * t);
    return hand;
  });
  ServoLoop servo(device, EffectPlan(Scene{}), {});
  const double stiffness = 100 + 1400 * u(random), way = 0.02 * u(random), beat = 9 * u(random);
  Books books;
  std::uint32_t version = 0;
  std::int64_t steps = 0;
  for (nanoseconds now{0}; now < 2s; now += 1ms, ++steps) {
    if (u(random) < often) now += nanoseconds(static_cast<std::int64_t>(1e9 * most * u(random)));
    if (steps % 20 == 0) {
      ContactSet set;
      RemoteHand& ball = set.hands[set.count++];
      ball.id = {1, 2, 3};
      ball.state.position.x() =
          0.02 + way * std::sin(beat * 1e-9 * static_cast<double>(now.count()));
      ball.model.kind = pdu::ForceModelKind::sphere;
      ball.model.k1 = stiffness;
      ball.model.radius = 0.02;
      ball.valid_until = 1000s;
      ball.version = ++version;
      servo.contacts().write(set);
    }
    servo.step(now);
    servo.snapshots().update();
    const ServoSnapshot& s = servo.snapshots().read();
    books.least = std::min(books.least, s.port_energy + s.loan);
    books.beyond = std::min(books.beyond, s.port_energy + s.loan + s.late_cost);
    books.late_cost = std::max(books.late_cost, s.late_cost);
  }
  return books;
}

// Half a period is shorter than the device's release time.
TEST(LateStep, AccountsForEnergyFromAnEmptyLedger) {
  Books worst;
  const unsigned seeds = test::tries(100U, 300U);
  int below = 0;
  for (unsigned seed = 1; seed <= seeds; ++seed) {
    const Books books = touches(seed % 2 == 0 ? 0.0005 : 0.009, 0.3, seed);
    below += books.least < -1e-9 ? 1 : 0;
    worst.least = std::min(worst.least, books.least);
    worst.late_cost = std::max(worst.late_cost, books.late_cost);
    worst.beyond = std::min(worst.beyond, books.beyond);
    EXPECT_GE(books.beyond, -1e-9) << seed;
    const Books punctual = touches(0.0005, 0.0, seed);
    EXPECT_GE(punctual.least, -1e-9) << seed;
    EXPECT_EQ(punctual.late_cost, 0.0) << seed;
  }
  std::printf("least %.2g J, below 0 in %d of %u runs; late steps account for %.2g J at most\n",
              worst.least, below, seeds, worst.late_cost);
  EXPECT_GT(below, 0) << "otherwise nothing was tried";
}

}  // namespace
}  // namespace reckon::haptics
