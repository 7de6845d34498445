// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The force has no steps: over the edge of a region, when a record changes during contact, and when
// friction breaks away.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <random>
#include <string>

#include "reckon/tests/haptics/support/servo_bench.hpp"
#include "reckon/tests/support/climb.hpp"
#include "reckon/tests/support/soak.hpp"

namespace reckon::haptics::force_steps_test {
namespace {

using namespace bench;
using test::any_choice;
using test::climb;
using test::within;
using Choice = test::Choice<16>;
using Kind = pdu::ForceModelKind;

constexpr double kMostStep = 0.5;   // [N], in 1 ms
constexpr double kMostSpeed = 0.2;  // [m/s], of a hand in contact

struct Felt {
  double step = 0;  // [N], the largest in 1 ms
  double peak = 0;  // [N]
  double end = 0;   // [N]
  double least = 0;
};

// A hand that presses a record which is sent again every `period` [s]; forces from `from` on.
template <class Record>
Felt feel(Bench& bench, double from, double end, double period, Record record) {
  Felt felt;
  Vector3d last = Vector3d::Zero();
  double next = 0, speed = 0;
  for (std::uint32_t i = 0; 1e-3 * i < end; ++i) {
    const double t = 1e-3 * i;
    if (t >= next) {
      RemoteHand hand = record(t);
      hand.version = i + 1;
      hand.state_time = bench.now;
      bench.servo.contacts().write(only(hand));
      next += period;
    }
    bench.run(1ms);
    const Vector3d force = bench.device.force();
    const double fastest = std::max(speed, bench.device.velocity().norm());
    speed = bench.device.velocity().norm();
    if (t > from) {
      if (fastest <= kMostSpeed) felt.step = std::max(felt.step, (force - last).norm());
      felt.peak = std::max(felt.peak, force.norm());
    }
    last = force;
  }
  felt.end = last.norm();
  felt.least = bench.least;
  return felt;
}

RemoteHand record_of(const Choice& c, std::size_t first, Kind kind) {
  RemoteHand hand = sphere({0, 0, 0}, within(c[first], 50, 475));
  hand.model.kind = kind;
  hand.model.radius = within(c[first + 1], 0.01, 0.03);
  hand.model.k3 = c[first + 2] < 0.5 ? 0.0 : within(c[first + 2], 0, 1e6);
  hand.model.normal = Vector3d::UnitZ();
  return hand;
}

SimulatedDeviceConfig gripped(double stiffness) {
  SimulatedDeviceConfig config = at(0.04);
  config.hand_stiffness = stiffness;
  return config;
}

// Down onto the face, then across the edge.
Felt slides_over_an_edge(const Choice& c) {
  const double depth = within(c[4], 0.001, 0.015), angle = within(c[5], 0, 6.2832);
  const double speed = within(c[6], 0.02, kMostSpeed);
  Bench bench({}, gripped(within(c[7], 100, 600)), [=](double t) {
    HandTarget hand;
    const double way = std::min(0.08, speed * std::max(0.0, t - 1.3));
    hand.position = {way * std::cos(angle), way * std::sin(angle),
                     std::max(-depth, 0.04 - 0.05 * t)};
    return hand;
  });
  const RemoteHand region = record_of(c, 0, Kind::spring_damper_region);
  return feel(bench, 1.3, 1.4 + 0.06 / speed, within(c[8], 0.001, 0.1),
              [&](double) { return region; });
}

// The property of a record that changes at kChange.
enum class Change { stiffness, hardening, friction, radius, normal, place, nothing };
constexpr double kChange = 2.5;  // [s]

RemoteHand changed(const Choice& c, Change change, RemoteHand hand) {
  const double share = c[9];
  switch (change) {
    case Change::stiffness:
      hand.model.k1 = within(share, 50, 475);
      break;
    case Change::hardening:
      hand.model.k3 = within(share, 0, 1e7);
      break;
    case Change::friction:
      hand.model.static_friction = hand.model.kinetic_friction = share;
      break;
    case Change::radius:
      hand.model.radius *= within(share, 0.5, 1.5);
      break;
    case Change::normal: {
      const double turn = within(share, 0, 1.5);
      hand.model.normal = {std::sin(turn), 0, std::cos(turn)};
      break;
    }
    case Change::place:
      hand.state.position.z() += within(share, -0.02, 0.02);
      break;
    case Change::nothing:
      break;
  }
  return hand;
}

// Presses a remote hand or a body and moves sideways over it while its record changes.
Felt presses_what_changes(const Choice& c, Change change) {
  const bool turns = change == Change::normal, held = !turns && c[10] < 0.5;
  const bool plane = turns || (!held && c[11] < 0.5);
  RemoteHand hand = record_of(c, 0, plane ? Kind::plane : Kind::sphere);
  hand.has_device = held;
  if (change == Change::nothing) {
    hand.model.static_friction = 1.2 * c[12];
    hand.model.kinetic_friction = c[13] * hand.model.static_friction;
  }
  const double reach = 0.02 + (plane ? 0.0 : hand.model.radius);  // with the probe's radius
  const double aim = reach - within(c[4], 0.001, 0.5 * reach);
  const double sideways = within(c[5], 0, change == Change::nothing ? kMostSpeed : 0.05);
  SimulatedDeviceConfig device = at(0.06);
  device.hand_stiffness = within(c[7], 100, 600);
  device.hand_damping = within(c[6], 0.3, 5);
  Bench bench({}, device, [=](double t) {
    HandTarget target;
    const double way = std::min(0.05, sideways * std::max(0.0, t - 2));
    target.position = {way, 0, std::max(aim, 0.06 - 0.05 * t)};
    return target;
  });
  return feel(bench, 2, 4, within(c[8], 0.001, 0.1),
              [&](double t) { return t < kChange ? hand : changed(c, change, hand); });
}

class ForceStepsOfSeeds : public ::testing::TestWithParam<unsigned> {};

TEST_P(ForceStepsOfSeeds, EdgeTurnsTheForceGradually) {
  std::mt19937_64 random(GetParam());
  for (int i = 0; i < 20; ++i) {
    const Felt felt = slides_over_an_edge(any_choice<16>(random));
    EXPECT_LE(felt.step, kMostStep) << i;
    EXPECT_GE(felt.least, kPassive) << i;
  }
}

TEST_P(ForceStepsOfSeeds, ChangesDuringContactAreBlended) {
  std::mt19937_64 random(100 + GetParam());
  for (const Change change : {Change::stiffness, Change::hardening, Change::friction,
                              Change::radius, Change::normal, Change::place}) {
    for (int i = 0; i < 20; ++i) {
      const Felt felt = presses_what_changes(any_choice<16>(random), change);
      EXPECT_LE(felt.step, kMostStep) << static_cast<int>(change) << ", " << i;
      EXPECT_GE(felt.least, kPassive) << static_cast<int>(change) << ", " << i;
    }
  }
}

TEST_P(ForceStepsOfSeeds, FrictionBreaksAwaySmoothly) {
  std::mt19937_64 random(200 + GetParam());
  for (int i = 0; i < 20; ++i) {
    const Felt felt = presses_what_changes(any_choice<16>(random), Change::nothing);
    EXPECT_LE(felt.step, kMostStep) << i;
    EXPECT_GE(felt.least, kPassive) << i;
  }
}

struct Scene {
  const char* name;
  Felt (*felt)(const Choice&);
};
template <Change kWhat>
Felt change(const Choice& c) {
  return presses_what_changes(c, kWhat);
}
const Scene kScenes[] = {
    {"edge", slides_over_an_edge},
    {"stiffness", change<Change::stiffness>},
    {"hardening", change<Change::hardening>},
    {"friction", change<Change::friction>},
    {"radius", change<Change::radius>},
    {"normal", change<Change::normal>},
    {"place", change<Change::place>},
    {"break_away", change<Change::nothing>},
};

class ForceSteps : public ::testing::TestWithParam<Scene> {};

TEST_P(ForceSteps, AreNotFoundByAClimb) {
  const auto climbed =
      climb<16>([](const Choice& c) { return GetParam().felt(c).step / kMostStep; });
  EXPECT_LE(climbed.badness, 1.0) << testing::PrintToString(climbed.worst) << ", climb "
                                  << climbed.seed;
  std::cout << climbed.tries << " tries, worst " << climbed.badness << " of the bar\n";
}

INSTANTIATE_TEST_SUITE_P(Scenes, ForceSteps, ::testing::ValuesIn(kScenes),
                         [](const auto& scene) { return std::string(scene.param.name); });

// 100 to 500 N/m, 5 mm beyond the first touch.
TEST(AHandThatGetsStiffer, NeverExceedsItsFinalForceMuch) {
  for (const double grip : {100.0, 300.0, 600.0}) {
    SimulatedDeviceConfig device = at(0.06);
    device.hand_stiffness = grip;
    Bench bench({}, device, [](double t) {
      HandTarget target;
      target.position.z() = std::max(0.025, 0.06 - 0.05 * t);
      return target;
    });
    const Felt felt = feel(bench, 2, 20, 0.02, [](double t) {
      return sphere({0, 0, 0}, t < kChange ? 100.0 : 500.0);
    });
    EXPECT_LE(felt.step, 0.1) << grip;
    EXPECT_LE(felt.peak, 1.2 * felt.end) << grip;  // the lightest grip oscillates
    const double right = 0.005 / (1 / 500.0 + 1 / grip);
    EXPECT_NEAR(felt.end, right, 0.01 * right) << grip;
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, ForceStepsOfSeeds, ::testing::Range(1U, test::tries(3U, 6U)));

}  // namespace
}  // namespace reckon::haptics::force_steps_test
