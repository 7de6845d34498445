// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Effects of regions provided by a program: they feel like built-in effects; no result of their
// code takes energy out of the device or remains unreported.
#include "reckon/haptics/regions/region_custom.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <limits>
#include <random>
#include <thread>

#include "reckon/tests/support/effect_adversary.hpp"

namespace reckon::haptics {
namespace {

using adversary::Random;
using Eigen::Vector3d;

struct Strength {
  double level = 1.0;
};

/// Common parts of all effects of this file.
template <class Effect>
class OneStrength : public CountedEffect<Effect> {
 public:
  using Parameters = Strength;
  static constexpr std::string_view kName = "a region of the program";
  static constexpr std::string_view kKey = "own";
  static constexpr std::string_view kCost = "little";
  static constexpr std::array<EffectParameter<Strength>, 1> kParameters{
      {{"level", "", &Strength::level, 0.0, 1e6, 1.0, "How much of it."}}};
  explicit OneStrength(const Strength& strength) : strength_(strength) {
    check_parameters(kParameters, strength);
  }
  [[nodiscard]] const Strength& parameters() const noexcept { return strength_; }

 protected:
  [[nodiscard]] double level() const noexcept { return strength_.level; }

 private:
  Strength strength_;
};

/// As Viscosity.
class Air : public OneStrength<Air> {
 public:
  static constexpr bool kInsideOnly = true;
  using OneStrength::OneStrength;
  [[nodiscard]] Vector3d force(const RegionPoint& point) const noexcept {
    return -level() * point.velocity;
  }
};

/// As PointSpring.
class Tie : public OneStrength<Tie> {
 public:
  static constexpr bool kInsideOnly = true;
  using OneStrength::OneStrength;
  [[nodiscard]] RegionPotential potential(const RegionPoint& point) const noexcept {
    const double length = point.place.norm();
    return {0.5 * level() * length * length, -level() * point.place, level()};
  }
  [[nodiscard]] double stiffness() const noexcept { return level(); }
};

/// As BorderSpring: it acts outside.
class Fence : public OneStrength<Fence> {
 public:
  using OneStrength::OneStrength;
  [[nodiscard]] RegionPotential potential(const RegionPoint& point) const noexcept {
    return {0.5 * level() * point.beyond.squaredNorm(), -level() * point.beyond, level()};
  }
  [[nodiscard]] double stiffness() const noexcept { return level(); }
};

/// A force of NaN, or far beyond any device.
class Storm : public OneStrength<Storm> {
 public:
  using OneStrength::OneStrength;
  [[nodiscard]] Vector3d force(const RegionPoint&) const noexcept {
    const double wild = level() > 1.0 ? 1e300 : std::numeric_limits<double>::quiet_NaN();
    return Vector3d::Constant(wild);
  }
};

/// Behaviour of a false potential.
enum Lie : int {
  tenth_stiffness = 1,  ///< states a tenth of its stiffness
  tenth_energy,         ///< states a tenth of its energy
  tenth_both,           ///< both
  pushes_out,           ///< its force has the wrong sign
  free_push,            ///< a constant force with no stated energy and the greatest stiffness
  vortex,               ///< a force round the z axis, as strong as the force of its stated energy
  late_push,            ///< honest at first, then a free push
  grows,                ///< its stiffness and energy grow in time
  sawtooth,             ///< a constant force with an energy step every millimetre
  no_number,            ///< NaN
  drowns,               ///< an energy so large that sums lose all other digits
  kLies
};

/// A potential with inconsistent force, energy and stiffness.
class FalsePotential : public OneStrength<FalsePotential> {
 public:
  using OneStrength::OneStrength;
  [[nodiscard]] RegionPotential potential(const RegionPoint& point) noexcept {
    ++calls_;
    const Vector3d& p = point.place;
    const RegionPotential honest{0.5 * kK * p.squaredNorm(), -kK * p, kK};
    switch (static_cast<int>(level())) {
      case tenth_stiffness:
        return {honest.energy, honest.force, 0.1 * kK};
      case tenth_energy:
        return {0.1 * honest.energy, honest.force, kK};
      case tenth_both:
        return {0.1 * honest.energy, honest.force, 0.1 * kK};
      case pushes_out:
        return {honest.energy, -honest.force, kK};
      case free_push:
        return {0.0, Vector3d(2, 0, 0), kMost};
      case vortex:
        return {honest.energy, kK * Vector3d(-p.y(), p.x(), 0), kK};
      // More calls than the guard makes in its trial.
      case late_push:
        return calls_ > 1000 ? RegionPotential{0.0, {2, 0, 0}, kMost} : honest;
      case grows:
        return {(1 + 0.02 * calls_) * honest.energy, (1 + 0.02 * calls_) * honest.force, kK};
      case sawtooth: {
        const double left = 1e-3 - std::fmod(p.x() + 1.0, 1e-3);
        return {2.0 * left, Vector3d(2, 0, 0), kMost};
      }
      case no_number:
        return {std::nan(""), honest.force, kK};
      case drowns:
        return {1e300, 1e100 * honest.force, kMost};
      default:
        return honest;
    }
  }
  [[nodiscard]] double stiffness() const noexcept {
    switch (static_cast<int>(level())) {
      case tenth_stiffness:
      case tenth_both:
        return 0.1 * kK;
      case free_push:
      case late_push:
      case sawtooth:
      case drowns:
        return kMost;
      case grows:
        return 1e4;
      default:
        return kK;
    }
  }

 private:
  static constexpr double kK = 400.0, kMost = 1e6;
  int calls_ = 0;
};

/// Takes 2 ms per call.
class Sloth : public OneStrength<Sloth> {
 public:
  using OneStrength::OneStrength;
  [[nodiscard]] Vector3d force(const RegionPoint&) const noexcept {
    std::this_thread::sleep_for(std::chrono::milliseconds(2));  // must be detected by the guard
    return Vector3d::UnitX();
  }
};

template <class Effect>
DeclaredCustomRegionEffect declared(double level) {
  return {std::make_shared<const CustomRegionEffectOf<Effect>>(), {level}};
}

/// A turned box of 100 mm without a solid part.
Scene haze(std::vector<DeclaredCustomRegionEffect> effects = {}) {
  Scene scene;
  SceneRegion& region = scene.regions.emplace_back();
  region.name = "box";
  region.shape = BoxShape{{0.1, 0.1, 0.1}};
  region.pose.position = {0.02, 0.01, 0.0};
  region.pose.orientation = Eigen::Quaterniond(0.9, 0.2, -0.3, 0.1);
  region.custom_effects = std::move(effects);
  return scene;
}

/// Forces on a path from outside through the box and out again.
std::vector<Vector3d> wave(const EffectPlan& plan, int steps = 400) {
  StaticContact contact(plan, 1e9);
  PointTool tool;
  EnergyPort port(1.0);
  const auto at = [](double t) -> Vector3d {
    return {0.09 * std::cos(16 * t), 0.02 + 0.01 * std::sin(9 * t), 0.003};
  };
  std::vector<Vector3d> forces;
  tool.reset({at(0.0)});
  contact.reset(tool);
  for (int i = 0; i < steps; ++i) {
    const double t = 0.001 * i;
    port.borrow(10.0);
    tool.move({at(t)});
    contact.settle(tool, 0.001, port);
    PortLoad load;
    tool.set_velocity((at(t) - at(t - 0.001)) / 0.001);
    contact.load(tool, 0.001, load);
    forces.push_back(load.walls + load.extra);
  }
  return forces;
}

std::vector<Vector3d> wave_with(const DeclaredCustomRegionEffect& effect) {
  return wave(EffectPlan(haze({effect})));
}

TEST(CustomRegion, FeelsEqualToTheBuiltInEffect) {
  Scene viscosity = haze(), spring = haze(), border = haze();
  viscosity.regions[0].effects.declare<Viscosity>() = {3.0, 0.0};
  spring.regions[0].effects.declare<PointSpring>() = {150.0, 0.0, 100.0};
  border.regions[0].effects.declare<BorderSpring>() = {250.0};
  EXPECT_EQ(wave_with(declared<Air>(3.0)), wave(EffectPlan(viscosity)));
  EXPECT_EQ(wave_with(declared<Tie>(150.0)), wave(EffectPlan(spring)));
  EXPECT_EQ(wave_with(declared<Fence>(250.0)), wave(EffectPlan(border)));
  EXPECT_NE(wave(EffectPlan(spring)), wave(EffectPlan(border)));
  EXPECT_NE(wave(EffectPlan(spring)), wave(EffectPlan(haze())));
}

TEST(CustomRegion, CountsInThePlanAndIsNamed) {
  const EffectPlan plan(haze({declared<Tie>(150.0)}));
  EXPECT_EQ(plan.regions()[0].stiffness(), 150.0);
  EXPECT_EQ(plan.stages().back().name, "a region of the program");
  EXPECT_EQ(plan.stages().back().object, "box");
  EXPECT_EQ(plan.stages().back().parameters, "level 150");
  ASSERT_EQ(plan.custom_effects().size(), 1U);
  EXPECT_EQ(plan.custom_effects()[0]->key, "own");
  EXPECT_EQ(plan.custom_effects()[0]->object, "box");
  EXPECT_FALSE(plan.custom_effects()[0]->not_booked);
  EXPECT_THROW(EffectPlan(haze({declared<Tie>(-1.0)})), std::invalid_argument);
}

TEST(CustomRegion, ActsFarOutsideUnlessDeclaredOtherwise) {
  const Vector3d far(3.0, 0.0, 0.0);
  EXPECT_FALSE(EffectPlan(haze({declared<Tie>(150.0)})).has_within(far, 0.2));
  EXPECT_TRUE(EffectPlan(haze({declared<Tie>(150.0)})).has_within({0.02, 0.01, 0.0}, 0.2));
  EXPECT_TRUE(EffectPlan(haze({declared<Fence>(150.0)})).has_within(far, 0.2));
}

TEST(CustomRegion, HasItsOwnStateInEachServo) {
  const EffectPlan plan(haze({declared<FalsePotential>(grows)}));
  EXPECT_EQ(wave(plan), wave(plan));
}

TEST(CustomRegion, NonFiniteForcesAreDroppedAndReported) {
  for (const double level : {1.0, 2.0}) {
    const EffectPlan plan(haze({declared<Storm>(level)}));
    for (const Vector3d& force : wave(plan)) {
      ASSERT_TRUE(force.allFinite());
      ASSERT_LE(force.norm(), 1.000001 * CallGuard::kMostForce);
    }
    EXPECT_EQ(plan.custom_effects()[0]->too_strong > 0, level > 1.0);
    EXPECT_EQ(plan.custom_effects()[0]->not_finite > 0, level == 1.0);
  }
}

TEST(CustomRegion, FalsePotentialIsHeldInsteadOfBooked) {
  for (int lie = tenth_stiffness; lie < kLies; ++lie) {
    const EffectPlan plan(haze({declared<FalsePotential>(lie)}));
    EXPECT_EQ(plan.custom_effects()[0]->not_booked, lie != late_push) << lie;
    if (lie != late_push) {
      EXPECT_EQ(plan.regions()[0].stiffness(), 0.0) << lie;
    }
    (void)wave(plan, 1500);
    EXPECT_TRUE(plan.custom_effects()[0]->not_booked) << lie;
  }
  // Its force is still felt, as far as there is energy.
  EXPECT_GT(wave_with(declared<FalsePotential>(tenth_energy)).at(100).norm(), 1.0);
}

TEST(CustomRegion, SlowOneIsSwitchedOff) {
  const EffectPlan plan(haze({declared<Sloth>(1.0)}));
  int felt = 0;
  for (const Vector3d& force : wave(plan, 100)) felt += force.isZero(0.0) ? 0 : 1;
  EXPECT_EQ(felt, static_cast<int>(CallGuard::kSlowCalls));
  EXPECT_TRUE(plan.custom_effects()[0]->switched_off);
  EXPECT_GE(plan.custom_effects()[0]->slowest, 2'000'000);
}

std::vector<DeclaredCustomRegionEffect> all_effects() {
  std::vector<DeclaredCustomRegionEffect> all = {
      declared<Air>(3.0),   declared<Air>(300.0), declared<Tie>(150.0), declared<Tie>(1e6),
      declared<Fence>(1e3), declared<Storm>(1.0), declared<Storm>(2.0)};
  for (int lie = tenth_stiffness; lie < kLies; ++lie) all.push_back(declared<FalsePotential>(lie));
  return all;
}

TEST(CustomRegion, NoneGivesTheHandUnpaidEnergy) {
  for (const DeclaredCustomRegionEffect& effect : all_effects()) {
    for (unsigned seed = 1; seed <= 10; ++seed) {
      for (const double stray : {2e-4, 2e-5, 2e-6}) {
        Random random(seed);
        const adversary::Least least = adversary::run_gated(haze({effect}), random, stray);
        EXPECT_GE(least.books, -least.late - 1e-9)
            << typeid(*effect.effect).name() << ' ' << effect.values[0] << ", seed " << seed << ", "
            << stray;
      }
    }
  }
}

TEST(CustomRegion, NoneGivesEnergyAfterALightMove) {
  for (const DeclaredCustomRegionEffect& effect : all_effects()) {
    for (unsigned seed = 1; seed <= 10; ++seed) {
      Random random(seed);
      const Vector3d start =
          Vector3d(0.02, 0.01, 0.0) +
          0.03 * Vector3d(adversary::any(random, -1, 1), adversary::any(random, -1, 1), 0.2);
      EXPECT_GE(adversary::stray_and_let_go(EffectPlan(haze({effect})), start, random), -1e-9)
          << typeid(*effect.effect).name() << ' ' << effect.values[0] << ", seed " << seed;
    }
  }
}

// Without the gate they do give energy.
TEST(CustomRegion, WithoutTheGateTheyGiveEnergy) {
  for (const Lie lie : {tenth_energy, pushes_out, free_push, vortex, late_push, grows, sawtooth}) {
    double made = 0.0;
    for (unsigned seed = 1; seed <= 10; ++seed) {
      Random random(seed);
      made = std::max(made, adversary::made_open(haze({declared<FalsePotential>(lie)}), random));
    }
    EXPECT_GT(made, 1e-6) << lie;
  }
}

}  // namespace
}  // namespace reckon::haptics
