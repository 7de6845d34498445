// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// No effect and no pair of effects lets a hand take energy out of the device that it did not put
// in. Half of the time an adversary makes the move that takes most energy out of the held force.
// Samples come late, and the force is cut now and then. Without the gate the same hands take energy
// from every effect that can give some.
//
// RECKON_SOAK=1 tries 1,000 seeds of each pair, otherwise a few.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "reckon/haptics/contact/static_contact.hpp"
#include "reckon/tests/support/effect_adversary.hpp"
#include "reckon/tests/support/soak.hpp"

namespace reckon::haptics {
namespace {

using adversary::any;
using adversary::Least;
using adversary::made_open;
using adversary::Random;
using adversary::run_gated;

/// Within the row's range, with a logarithmic distribution.
template <class Parameters>
double drawn(Random& random, const EffectParameter<Parameters>& row) {
  if (!(row.maximum > 0.0)) return any(random, row.minimum, row.maximum);
  const double share = std::pow(10.0, any(random, -3.0, 0.0));
  const bool negative = row.minimum < 0.0 && random() % 2 == 0;
  return negative ? share * row.minimum : std::max(row.minimum, share * row.maximum);
}

/// Values accepted by the effect, which refuses some combinations.
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
  bool holds;  ///< the contact point: only one at a time
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

int seeds() { return test::tries(3, 1000); }

TEST(EffectEnergy, NoPairGivesTheHandUnpaidEnergy) {
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

TEST(EffectEnergy, NoEffectGivesEnergyAfterALightPress) {
  for (const Switch& one : all_switches()) {
    for (int seed = 1; seed <= 10 * seeds(); ++seed) {
      Random random(static_cast<unsigned>(seed));
      Scene scene = scene_of(random, {one});
      scene.objects[0].shape = BoxShape{{0.04, 0.04, 0.04}};
      EXPECT_GE(adversary::press_and_let_go(EffectPlan(scene), random), -1e-9)
          << one.name << ", seed " << seed;
    }
  }
}

// Without the gate. Cones cannot fail beside a soft spring: they only hold the contact point back.
TEST(EffectEnergy, WithoutTheGateActiveEffectsGiveEnergy) {
  const std::set<std::string_view> kCannot{"stick_slip_friction", "place_friction",
                                           "stribeck_friction", "snags"};
  for (const Switch& one : all_switches()) {
    double made = 0.0;
    for (int seed = 1; seed <= 40; ++seed) {
      Random random(static_cast<unsigned>(seed));
      Scene scene = scene_of(random, {one});
      // A soft surface, so that the spring itself gives no energy.
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
