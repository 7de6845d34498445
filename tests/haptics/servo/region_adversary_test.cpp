// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// No one gets more energy out of regions than the loan of the port and the power of its
// oscillations: an adversary by the port's own ledger.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <numbers>
#include <random>

#include "reckon/tests/haptics/support/region_scenes.hpp"
#include "reckon/tests/support/effect_adversary.hpp"

namespace reckon::haptics::region_adversary_test {
namespace {

using adversary::BookedPort;
using adversary::kSample;
using bench::region;
using bench::weight;
using Eigen::Vector3d;

constexpr double kRoundOff = 1e-9;  // [J]

/// Energy taken out of a port [J], by its own ledger.
struct Loot {
  double least = 0.0;   // of the ledger
  double beyond = 0.0;  // <= 0, relative to the stated bound
  double spent = -1.0;  // by oscillations beyond their limit
  double owed = 0.0;    // most
};

/// A hand in regions, with a port that has a loan.
class Thief {
 public:
  Thief(const Scene& scene, double loan, const Vector3d& place, int delay = 0)
      : plan_(scene), port(plan_, place, delay) {
    port.port().region_loan().limit(loan);
    port.port().oscillations().limit(bench::kOscillationPower, bench::kOscillationEnergy);
  }
  void move(const Vector3d& dx) {
    port.move(dx);
    note();
  }
  void move_unread(const Vector3d& dx) {
    port.move_unread(dx);
    note();
  }
  [[nodiscard]] const Loot& loot() const { return loot_; }

 private:
  void note() {
    EnergyPort& its = port.port();
    its.wait(kSample);
    time_ += kSample;
    loot_.least = port.least();
    const double owed = its.region_loan().owed(), spent = its.oscillations().spent();
    if (port.is_read()) loot_.beyond = std::min(loot_.beyond, port.energy() + owed + spent);
    loot_.spent =
        std::max(loot_.spent, spent - bench::kOscillationEnergy - bench::kOscillationPower * time_);
    loot_.owed = std::max(loot_.owed, owed);
  }

  EffectPlan plan_;
  double time_ = 0.0;
  Loot loot_;

 public:
  BookedPort port;
};

// In at the top and out at the bottom: nothing pays for the second round.
TEST(RegionAdversary, ReentryGrantsNothingNew) {
  Thief thief(weight(2.0, BoxShape{{0.04, 0.04, 0.08}}), 0.12, {0.03, 0, 0.039});
  const Vector3d corners[] = {
      {0.0, 0, 0.039}, {0.0, 0, -0.039}, {0.03, 0, -0.039}, {0.03, 0, 0.039}};
  double first = 0.0;
  for (int round = 0; round < 40; ++round) {
    for (const Vector3d& corner : corners) {
      while ((corner - thief.port.place()).norm() > 1e-9) {
        Vector3d way = corner - thief.port.place();
        if (way.norm() > 1e-4) way *= 1e-4 / way.norm();
        thief.port.hold();
        thief.move(way);
      }
    }
    if (round == 0) first = thief.loot().least;
  }
  EXPECT_LT(first, -0.05) << "the first fall is a gift of the region";
  EXPECT_GE(thief.loot().least, -0.12 - kRoundOff);
  EXPECT_GE(thief.loot().beyond, -kRoundOff);
  EXPECT_LE(thief.loot().owed, 0.12 + kRoundOff);
}

/// The choices of an adversary, each in [0, 1].
struct Genes {
  static constexpr int kCount = 16;
  double value[kCount] = {};
  double operator[](int i) const { return value[i]; }
};

Scene drawn(const Genes& g) {
  Scene scene;
  const int count = 1 + static_cast<int>(2.99 * g[0]);
  for (int i = 0; i < count; ++i) {
    const double size = 0.01 + 0.06 * g[1];
    SceneRegion one = g[2] < 0.4   ? region(BoxShape{{size, size, size}})
                      : g[2] < 0.8 ? region(SphereShape{0.5 * size})
                                   : region(PlaneShape{Vector3d(1, 0, g[3]).normalized()});
    one.pose.position = Vector3d(0.02 * i * g[3], 0, 0.01 * i * g[4]);
    one.pose.orientation =
        Eigen::Quaterniond(Eigen::AngleAxisd(3.0 * g[4] * i, Vector3d(0.3, 1, 0.2).normalized()));
    if (g[5] < 0.6) one.effects.declare<ConstantForce>() = {2.0 * g[6], 0.0, -4.0 * g[7]};
    if (g[6] > 0.5) one.effects.declare<PointSpring>() = {10.0 + 200.0 * g[7], 0.0, 3.0};
    if (g[8] > 0.5) one.effects.declare<Attraction>() = {3.0 * g[8], 0.01 + 0.03 * g[9]};
    if (g[9] > 0.6) one.effects.declare<Oscillation>() = {g[7], 0.0, 4.0 * g[8], 2.0 + 60.0 * g[6]};
    if (g[5] > 0.8) one.effects.declare<DryFriction>() = {g[7], 50.0 + 200.0 * g[6]};
    if (g[1] > 0.7 && g[2] < 0.8) one.effects.declare<BorderSpring>() = {200.0 * g[3]};
    scene.regions.push_back(one);
  }
  return scene;
}

/// Circles over the edge, follows the force for some of the time, and is cut now and then.
Loot played(const Genes& g, std::uint32_t seed) {
  constexpr double kLoan = 0.05;
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> any(0.0, 1.0);
  const Vector3d middle(0.06 * (g[10] - 0.5), 0, 0.06 * (g[11] - 0.5));
  const double radius = 0.002 + 0.04 * g[12], rate = 0.2 + 20.0 * g[13] * g[13];
  const auto on_circle = [&](double t) -> Vector3d {
    const double angle = 2.0 * std::numbers::pi * rate * t;
    return middle + radius * Vector3d(std::cos(angle), 0, std::sin(angle));
  };
  Thief thief(drawn(g), kLoan, on_circle(0), static_cast<int>(3.99 * g[15] * g[15]));
  double falls = 0.0;
  for (int i = 0; i < 3000; ++i) {
    if (any(random) < 0.001) thief.port.contact().attenuate(0.0, thief.port.port());
    const Vector3d force = thief.port.hold();
    Vector3d way = on_circle(kSample * (i + 1)) - thief.port.place();
    if (falls > 0) way = 0.5 * kSample * (g[15] > 0.5 ? thief.port.at_handle() : force);
    if (falls < -0.3 * (1.0 - g[14])) falls = 0.1 * any(random);
    falls -= kSample;
    if (way.norm() > 0.003) way *= 0.003 / way.norm();
    if (any(random) < 0.002 * g[3]) {
      thief.move_unread(way);
      thief.move(Vector3d::Zero());
    } else {
      thief.move(way);
    }
  }
  return thief.loot();
}

// A climb of 250 tries by the energy taken, and by the energy beyond the stated bound.
TEST(RegionAdversary, GetsNoMoreByMotion) {
  std::mt19937 random(20261128);
  std::uniform_real_distribution<double> any(0.0, 1.0);
  std::normal_distribution<double> normal;
  Genes best;
  double score = 1e9, most_taken = 0.0, worst = 0.0;
  for (int i = 0; i < 250; ++i) {
    Genes next = best;
    for (double& value : next.value) {
      if (i < 60) value = any(random);
      if (i >= 60 && any(random) < 0.3) value = std::clamp(value + 0.2 * normal(random), 0.0, 1.0);
    }
    const Loot loot = played(next, static_cast<std::uint32_t>(i));
    const double beyond = std::min(loot.beyond, -std::max(0.0, loot.spent));
    EXPECT_GE(beyond, -kRoundOff) << "try " << i;
    EXPECT_LE(loot.owed, 0.05 + kRoundOff) << "try " << i;
    most_taken = std::max(most_taken, -loot.least);
    worst = std::min(worst, beyond);
    if (loot.least + 1e6 * beyond >= score) continue;
    score = loot.least + 1e6 * beyond;
    best = next;
  }
  std::printf("250 tries took at most %.1f mJ, beyond the bound %.2g J\n", 1e3 * most_taken,
              -worst);
  EXPECT_GT(most_taken, 0.05) << "the adversary is one";
}

}  // namespace
}  // namespace reckon::haptics::region_adversary_test
