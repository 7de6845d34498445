// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// No effect, and no two of them, lets a hand take energy out of the device that it did not put in:
// an adversary moves half the time as takes most out of the held force, samples come late, and the
// force is cut now and then. Without the gate the same hands take energy from every effect that can
// give some.
//
// RECKON_SOAK=1 tries 1,000 seeds of each pair, otherwise a few.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "reckon/haptics/contact/static_contact.hpp"

namespace reckon::haptics {
namespace {

using Eigen::Vector3d;

constexpr double kSample = 0.001;
constexpr double kDamping = 1.0;  // [N s/m], of the device
constexpr int kSteps = 1500;

using Random = std::mt19937;

double any(Random& random, double from, double to) {
  return std::uniform_real_distribution<double>(from, to)(random);
}

/// Within the row's range, small values as likely as large ones.
template <class Parameters>
double drawn(Random& random, const EffectParameter<Parameters>& row) {
  if (!(row.maximum > 0.0)) return any(random, row.minimum, row.maximum);
  const double share = std::pow(10.0, any(random, -3.0, 0.0));
  const bool negative = row.minimum < 0.0 && random() % 2 == 0;
  return negative ? share * row.minimum : std::max(row.minimum, share * row.maximum);
}

/// Values that the effect takes; some pairs of values it refuses.
template <class Effect>
typename Effect::Parameters drawn_parameters(Random& random) {
  for (;;) {
    typename Effect::Parameters values{};
    for (const auto& row : Effect::kParameters) {
      const double value = drawn(random, row);
      values.*row.field = row.key == "seed" ? std::floor(value) : value;
    }
    try {
      static_cast<void>(Effect(values));
      return values;
    } catch (const std::invalid_argument&) {
    }
  }
}

/// A switch for each effect of both lists.
struct Switch {
  std::string_view name;
  bool holds;  ///< the contact point: one at a time
  void (*turn_on)(Random&, SceneObject&, SceneRegion&);
};

std::vector<Switch> all_switches() {
  std::vector<Switch> all;
  for_each_effect([&]<class Effect>(std::type_identity<Effect>) {
    all.push_back({Effect::kName, HoldsContactPoint<Effect>,
                   [](Random& random, SceneObject& object, SceneRegion&) {
                     object.effects.declare<Effect>() = drawn_parameters<Effect>(random);
                   }});
  });
  for_each_region_effect([&]<class Effect>(std::type_identity<Effect>) {
    all.push_back({Effect::kName, false, [](Random& random, SceneObject&, SceneRegion& region) {
                     region.effects.declare<Effect>() = drawn_parameters<Effect>(random);
                   }});
  });
  return all;
}

/// A turned ball or box in a region.
Scene scene_of(Random& random, const std::vector<Switch>& switches) {
  Scene scene;
  SceneObject& object = scene.objects.emplace_back();
  object.name = "thing";
  if (random() % 2 == 0)
    object.shape = SphereShape{0.02};
  else
    object.shape = BoxShape{{0.04, 0.04, 0.04}};
  object.pose.orientation = Eigen::Quaterniond(any(random, -1, 1), any(random, -1, 1),
                                               any(random, -1, 1), any(random, 0.1, 1));
  SceneRegion& region = scene.regions.emplace_back();
  region.name = "about it";
  region.shape = BoxShape{{0.07, 0.05, 0.06}};
  region.pose.position = {0.01, 0.0, 0.005};
  region.pose.orientation = object.pose.orientation;
  for (const Switch& one : switches) one.turn_on(random, object, region);
  return scene;
}

/// The device's own books, from the start [J].
struct Books {
  double energy = 0.0, least = 0.0;
  void settle(const Vector3d& force, const Vector3d& dx, double dt) {
    energy += -force.dot(dx) + kDamping * dx.squaredNorm() / dt;
    least = std::min(least, energy);
  }
};

/// The motion of the hand in a sample: that which takes most out of `force`, or any. @param stray
/// [m] of the latter
Vector3d motion(Random& random, int step, const Vector3d& force, const Vector3d& device, double dt,
                double stray) {
  std::normal_distribution<double> normal;
  Vector3d dx = stray * Vector3d(normal(random), normal(random), normal(random));
  if (step % 2 == 0) dx = 0.5 * dt / kDamping * force;
  if (dx.norm() > 0.002) dx *= 0.002 / dx.norm();
  return dx + 0.004 * (Vector3d(0.015, 0.012, 0.012) - device);
}

/// With the gate, or as the effects want it. @return the least of the books, and what late samples
/// account for
struct Least {
  double books, late;
};
Least run_gated(const Scene& scene, Random& random) {
  const EffectPlan plan(scene);
  EnergyPort port(kDamping);
  StaticContact contact(plan, 0.75 * 0.95 * 2.0 * kDamping / kSample);
  Vector3d device(0.03, 0.02, 0.025), velocity = Vector3d::Zero();
  contact.reset(device);
  Books books;
  for (int i = 0; i < kSteps; ++i) {
    PortLoad load;
    contact.load(velocity, kSample, load);
    const PortHold held = port.hold(load, kSample);
    if (held.walls < 1.0) contact.attenuate(held.walls, port);
    contact.shown(held.extra);
    Vector3d force = held.force;
    if (i % 97 == 0) {
      contact.attenuate(0.5, port);
      port.attenuate(0.5);
      force *= 0.5;
    }
    const double dt = random() % 20 == 0 ? any(random, 1.0, 4.0) * kSample : kSample;
    const Vector3d dx = motion(random, i, force, device, dt, 2e-4);
    device += dx;
    velocity = dx / dt;
    books.settle(force, dx, dt);
    port.settle(dx, dt);
    contact.settle(device, dt, port);
    EXPECT_TRUE(force.allFinite()) << i;
  }
  return {books.least, port.late_cost()};
}

/// The greatest fall of what the hand has put in beyond what springs hold [J]: what the effects
/// made. The hand goes for what they add to the surface, where there is any.
double made_open(const Scene& scene, Random& random) {
  const EffectPlan plan(scene);
  EnergyPort rich(1e12);  // for which everything is allowed
  StaticContact contact(plan, 1e12);
  Vector3d device(0.03, 0.02, 0.025), velocity = Vector3d::Zero();
  contact.reset(device);
  Books books;
  double most = 0.0, made = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    PortLoad load;
    rich.borrow(1.0);
    contact.load(velocity, kSample, load);
    Vector3d force = load.walls + load.extra;
    if (!(force.norm() < 1e3)) force *= 1e3 / force.norm();
    const Vector3d& prey = load.extra.isZero() ? force : load.extra;
    const Vector3d dx = motion(random, i, prey, device, kSample, 2e-5);
    device += dx;
    velocity = dx / kSample;
    books.settle(force, dx, kSample);
    contact.settle(device, kSample, rich);
    const double left = books.energy - contact.stored() - contact.regions().stored();
    most = std::max(most, left);
    made = std::max(made, most - left);
  }
  return made;
}

int seeds() { return std::getenv("RECKON_SOAK") != nullptr ? 1000 : 3; }

TEST(EffectEnergy, NoPairOfEffectsGivesTheHandWhatItDidNotPutIn) {
  const std::vector<Switch> all = all_switches();
  int runs = 0;
  for (std::size_t a = 0; a < all.size(); ++a) {
    for (std::size_t b = a; b < all.size(); ++b) {
      if (a != b && all[a].holds && all[b].holds) continue;
      for (int seed = 1; seed <= seeds(); ++seed) {
        Random random(static_cast<unsigned>(seed));
        const std::vector<Switch> both = a == b ? std::vector{all[a]} : std::vector{all[a], all[b]};
        const Least least = run_gated(scene_of(random, both), random);
        ASSERT_GE(least.books, -least.late - 1e-9)
            << all[a].name << " and " << all[b].name << ", seed " << seed;
        ++runs;
      }
    }
  }
  fmt::print("[ energy   ] {} runs\n", runs);
}

// Without the gate. Cones cannot fail beside a soft spring: they only hold the contact point back.
TEST(EffectEnergy, WithoutTheGateEveryEffectThatCanGiveEnergyDoes) {
  const std::set<std::string_view> kCannot{"stick_slip_friction", "place_friction",
                                           "stribeck_friction", "snags"};
  for (const Switch& one : all_switches()) {
    double made = 0.0;
    for (int seed = 1; seed <= 40; ++seed) {
      Random random(static_cast<unsigned>(seed));
      Scene scene = scene_of(random, {one});
      // A soft surface, so that the spring alone does not give any.
      if (one.name != "spring_damper") scene.objects[0].effects.of<SpringDamper>() = {100.0, 0.0};
      made = std::max(made, made_open(scene, random));
    }
    if (kCannot.contains(one.name)) {
      EXPECT_LT(made, 1e-6) << one.name;
    } else {
      EXPECT_GT(made, 1e-6) << one.name;
    }
  }
}

}  // namespace
}  // namespace reckon::haptics
