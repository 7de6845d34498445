// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Energy of the hand from springs rendered by the device itself, by the ledger of its model.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "reckon/tests/haptics/support/plugged_events.hpp"
#include "reckon/tests/haptics/support/servo_bench.hpp"
#include "reckon/tests/support/soak.hpp"

namespace reckon::haptics::evdev_energy_test {
namespace {

using Eigen::Vector3d;
using std::chrono::microseconds;
using std::chrono::milliseconds;
using test::EvdevModel;
using test::EvdevModelOptions;
using test::settings_for;
using Plugged = test::PluggedWheel;
using Hand = Plugged::Hand;

// 30 mm from the centre of a hand of 20 mm, for a probe of 10 mm: the touch.
ContactSet hand_at(const Vector3d& centre, std::uint32_t version = 1) {
  return bench::only(bench::sphere(centre, 500, version));
}

struct Told {
  double least = 0, greatest = 0, fastest = 0;
  double lead = 0;  // [J], of the servo's meter over the device's own ledger, at the end
};

// From a run of 4 s, and a rest.
Told roam(unsigned seed, microseconds report, microseconds latency, double stiffness_of_hand) {
  EvdevModelOptions options;
  options.seed = seed;
  options.report = report;
  options.latency = latency;
  options.hand_stiffness = stiffness_of_hand;
  options.ends_effects = seed % 3 != 0;
  options.takes = seed % 2 == 0 ? milliseconds(1) : microseconds(125);
  options.misses_turns = seed > 3;
  test::RoamingHand hand(seed, 0.003, 0.014, 12, 5);
  Plugged plugged(test::room_with_post(), hand, options);
  for (std::uint32_t i = 0; i < 20; ++i) {
    const Vector3d other(hand.within(-0.06, 0.06), hand.within(-0.06, 0.06), 0);
    plugged.servo.contacts().write(i < 17 ? hand_at(other, i + 1) : ContactSet());
    plugged.run(microseconds(static_cast<int>(hand.within(50e3, 350e3))));
    if (i % 3 == 0) plugged.stop.press(StopCause::program);
    if (i % 3 == 1) plugged.stop.release(StopCause::program);
    if (i % 5 == 2) plugged.hang(microseconds(static_cast<int>(hand.within(5e3, 120e3))));
  }
  plugged.run(milliseconds(5500) - plugged.model.now());
  const EvdevModel& model = plugged.model;
  return {model.least_absorbed(), model.greatest_force(), model.fastest(),
          plugged.last().port_energy - model.absorbed()};
}

// RECKON_SOAK=1 draws 120 of each, a gate one or two.
TEST(EvdevLoop, NeverGivesUnpaidEnergy) {
  const unsigned seeds = test::tries(6U, 120U);
  test::Thinned thinned(5);
  Told all;
  for (const auto report : {microseconds(1000), microseconds(4000), microseconds(8000)}) {
    for (const auto latency : {microseconds(0), microseconds(2000), microseconds(8000)}) {
      for (unsigned seed = 1; seed <= seeds; ++seed) {
        if (thinned.skips()) continue;
        const Told one = roam(seed, report, latency, seed % 2 == 0 ? 300 : 900);
        ASSERT_LT(one.fastest, 1.0) << "the hand is faster than stated";
        ASSERT_GE(one.least, -1e-9) << "seed " << seed << ", report " << report.count()
                                    << " us, latency " << latency.count() << " us";
        ASSERT_LE(one.lead, 1e-9) << "seed " << seed;
        all.greatest = std::max(all.greatest, one.greatest);
        all.least = std::min(all.least, one.least);
      }
    }
  }
  RecordProperty("least_J", std::to_string(all.least));
  EXPECT_GT(all.greatest, 3.0) << "no wall was ever pressed";
}

/// The changes of one step, and the energy booked for them [J].
struct BookedStep {
  int changes;
  double cost;
};

/// Expects that the changes of a step gave the device's own springs no more than was booked. @param
/// rises [J], of each change
void expect_within_books(const std::vector<BookedStep>& steps, const std::vector<double>& rises) {
  std::size_t change = 0;
  for (const BookedStep& step : steps) {
    double rise = 0;
    for (int i = 0; i < step.changes; ++i) rise += rises.at(change++);
    ASSERT_LE(rise, step.cost + 1e-9) << "change " << change << " of " << rises.size();
  }
}

// Nearly always at the greatest declared speed, through walls and remote hands. The changes of each
// step give the device's own springs no more than was booked.
TEST(EvdevLoop, ChangesCostAtMostTheirBookedEnergy) {
  const unsigned seeds = test::tries(4U, 120U);
  constexpr double kSpeed = 0.4;  // [m/s]
  const Hand brisk = [](double t) {
    const double turn = std::numbers::pi / 0.06 * 0.9 * kSpeed / 0.95;
    const double begun = t < 1 ? t * t / 2 : t - 0.5;
    const double way = 0.06 / std::numbers::pi * std::asin(0.95 * std::sin(turn * begun));
    return EvdevModel::Places{way, -way};
  };
  double greatest = 0;
  for (const auto report : {milliseconds(1), milliseconds(4), milliseconds(8)}) {
    for (unsigned seed = 1; seed <= seeds; ++seed) {
      EvdevModelOptions options;
      options.seed = seed;
      options.report = report;
      options.takes = milliseconds(1);
      options.misses_turns = seed % 2 == 0;
      options.hand_stiffness = 20e3;
      options.hand_damping = 100;
      EvdevSettings settings = settings_for(options);
      settings.max_speed = kSpeed;
      settings.chain = 2 * report + 4 * options.takes + WallEffects::kReaction;
      Plugged plugged(test::room_with_post(), brisk, options, &settings);
      test::RoamingHand others(seed, 0.003, 0.014, 12, 5);
      const auto booked = [&] {
        plugged.exchange.reading.update();
        return plugged.exchange.reading.read().shown.energy;
      };
      std::vector<BookedStep> steps;
      std::uint32_t number = 0;
      for (int until = 0, i = 0; i < 4000; ++i) {
        if (i == until) {
          const Vector3d other(others.within(-0.06, 0.06), others.within(-0.06, 0.06), 0);
          plugged.servo.contacts().write(++number % 4 != 3 ? hand_at(other, number) : ContactSet());
          until += static_cast<int>(others.within(10, 100));
        }
        const int uploads = plugged.model.uploads();
        const double energy = booked();
        plugged.run(milliseconds(1));
        if (plugged.model.uploads() > uploads)
          steps.push_back({plugged.model.uploads() - uploads, energy - booked()});
      }
      plugged.model.pass(milliseconds(50));
      SCOPED_TRACE(testing::Message() << "seed " << seed << ", report " << report.count() << " ms");
      expect_within_books(steps, plugged.model.rises());
      ASSERT_LT(plugged.model.fastest(), kSpeed);
      greatest = std::max(greatest, plugged.model.greatest_force());
    }
  }
  EXPECT_GT(greatest, 3.0) << "no wall was ever pressed";
}

}  // namespace
}  // namespace reckon::haptics::evdev_energy_test
