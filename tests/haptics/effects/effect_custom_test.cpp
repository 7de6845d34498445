// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Effects provided by a program: they feel like built-in effects; no result of their code takes
// energy out of the device or remains unreported.
#include "reckon/haptics/effects/effect_custom.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <thread>

#include "reckon/haptics/contact/contact_solver.hpp"
#include "reckon/tests/support/effect_adversary.hpp"

namespace reckon::haptics {
namespace {

using adversary::Random;
using Eigen::Vector3d;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

struct Level {
  double level = 1.0;
};

/// Common parts of all effects of this file.
template <class Effect>
class OneLevel : public CountedEffect<Effect> {
 public:
  using Parameters = Level;
  static constexpr bool kInContactOnly = true;
  static constexpr std::string_view kName = "an effect of the program";
  static constexpr std::string_view kKey = "own";
  static constexpr std::string_view kCost = "little";
  static constexpr std::array<EffectParameter<Level>, 1> kParameters{
      {{"level", "", &Level::level, 0.0, 1e6, 1.0, "How much of it."}}};
  explicit OneLevel(const Level& level) : level_(level) { check_parameters(kParameters, level); }
  [[nodiscard]] const Level& parameters() const noexcept { return level_; }

 protected:
  [[nodiscard]] double level() const noexcept { return level_.level; }

 private:
  Level level_;
};

/// As SurfaceDrag.
class Honey : public OneLevel<Honey> {
 public:
  using OneLevel::OneLevel;
  [[nodiscard]] Vector3d force(const EffectContact& contact) const noexcept {
    if (!contact.in_contact) return Vector3d::Zero();
    return -level() * contact.slip();
  }
  [[nodiscard]] double damping() const noexcept { return level(); }
};

/// As Skin that never breaks.
class Rubber : public OneLevel<Rubber> {
 public:
  using OneLevel::OneLevel;
  [[nodiscard]] Vector3d spring_force(const Vector3d& scp, const Vector3d& device) const noexcept {
    return level() * (scp - device);
  }
  [[nodiscard]] double stored_energy(const Vector3d& scp, const Vector3d& device) const noexcept {
    return 0.5 * level() * (scp - device).squaredNorm();
  }
  [[nodiscard]] double stiffness() const noexcept { return level(); }
};

/// As StickSlipFriction with one coefficient.
class Sandpaper : public OneLevel<Sandpaper> {
 public:
  explicit Sandpaper(const Level& level) : OneLevel(level), cone_(level.level, level.level) {}
  [[nodiscard]] FrictionCone& cone() noexcept { return cone_; }

 private:
  FrictionCone cone_;
};

/// A coefficient of NaN.
class Lost : public OneLevel<Lost> {
 public:
  using OneLevel::OneLevel;
  [[nodiscard]] FrictionCone& cone() noexcept { return cone_; }
  void follow(const SlidingPlace&) noexcept { cone_.adjust(kNaN, kNaN); }

 private:
  FrictionCone cone_{0.5, 0.4};
};

/// A force of NaN, or far beyond any device.
class Wild : public OneLevel<Wild> {
 public:
  using OneLevel::OneLevel;
  [[nodiscard]] Vector3d force(const EffectContact& contact) const noexcept {
    if (level() > 1.0) return Vector3d::Constant(1e300);
    return kNaN * contact.normal;
  }
  [[nodiscard]] double damping() const noexcept { return 0.0; }
};

/// A spring with inconsistent force, energy and stiffness. `level` 1: states a tenth of its
/// stiffness; 2: states a tenth of its energy; 3: pushes in; 4: ends its force after some steps; 5:
/// grows in time without declaring it; 6: states a tenth of both its stiffness and its energy; 7:
/// pushes with 2 N at no energy and any stiffness.
class Liar : public OneLevel<Liar> {
 public:
  using OneLevel::OneLevel;
  [[nodiscard]] Vector3d spring_force(const Vector3d& scp, const Vector3d& device) const noexcept {
    if (level() == 7.0) return 2.0 * (scp - device).stableNormalized();
    const double sign = level() == 3.0 ? -1.0 : 1.0;
    const double scale = level() == 5.0 ? 1.0 + 0.02 * steps_ : (late() ? 0.2 : 1.0);
    return sign * scale * kStiffness * (scp - device);
  }
  [[nodiscard]] double stored_energy(const Vector3d& scp, const Vector3d& device) const noexcept {
    if (level() == 7.0) return 0.0;
    const double share = level() == 2.0 || level() == 6.0 || late() ? 0.1 : 1.0;
    return 0.5 * share * kStiffness * (scp - device).squaredNorm();
  }
  [[nodiscard]] double stiffness() const noexcept {
    if (level() == 7.0) return 1e6;
    return level() == 1.0 || level() == 6.0 ? 0.1 * kStiffness : kStiffness;
  }
  [[nodiscard]] Vector3d force(const EffectContact&) noexcept {
    ++steps_;
    return Vector3d::Zero();
  }
  [[nodiscard]] double damping() const noexcept { return 0.0; }

 private:
  static constexpr double kStiffness = 4000.0;
  [[nodiscard]] bool late() const noexcept { return level() == 4.0 && steps_ > 20; }
  int steps_ = 0;
};

/// Takes 2 ms per call.
class Sleeper : public OneLevel<Sleeper> {
 public:
  using OneLevel::OneLevel;
  [[nodiscard]] Vector3d force(const EffectContact& contact) const noexcept {
    std::this_thread::sleep_for(std::chrono::milliseconds(2));  // must be detected by the guard
    return contact.normal;
  }
  [[nodiscard]] double damping() const noexcept { return 0.0; }
};

template <class Effect>
DeclaredCustomEffect declare(double level) {
  return {std::make_shared<const CustomEffectOf<Effect>>(), {level}};
}

/// A turned box, with at most one custom effect.
Scene box(std::vector<DeclaredCustomEffect> effects = {}) {
  Scene scene;
  SceneObject& object = scene.objects.emplace_back();
  object.name = "box";
  object.shape = BoxShape{{0.04, 0.04, 0.04}};
  object.pose.orientation = Eigen::Quaterniond(0.9, 0.2, -0.3, 0.1);
  object.custom_effects = std::move(effects);
  return scene;
}

/// Forces of springs and effects on a stroke into and over the box.
std::vector<Vector3d> stroke(const EffectPlan& plan, int steps = 400) {
  ContactSolver solver(plan);
  const PlannedObject& object = plan.objects()[0];
  std::vector<Vector3d> forces;
  Vector3d before = object.to_scene({0.0, 0.0, 0.025});
  (void)solver.reset(before);
  for (int i = 0; i < steps; ++i) {
    const double t = 0.001 * i;
    const Vector3d device =
        object.to_scene({0.01 * std::sin(9 * t), 0.004 * std::cos(7 * t), 0.025 - 0.02 * t});
    const ContactResult result = solver.step(device);
    forces.push_back(result.force + solver.effect_force((device - before) / 0.001, 0.001));
    before = device;
  }
  return forces;
}

std::vector<Vector3d> stroke_with(const DeclaredCustomEffect& effect) {
  return stroke(EffectPlan(box({effect})));
}

TEST(CustomEffect, FeelsEqualToTheBuiltInEffect) {
  Scene drag = box(), skin = box(), friction = box();
  drag.objects[0].effects.declare<SurfaceDrag>() = {3.0};
  skin.objects[0].effects.declare<Skin>() = {250.0, 20.0};
  friction.objects[0].effects.declare<StickSlipFriction>() = {0.4, 0.4};
  EXPECT_EQ(stroke_with(declare<Honey>(3.0)), stroke(EffectPlan(drag)));
  EXPECT_EQ(stroke_with(declare<Rubber>(250.0)), stroke(EffectPlan(skin)));
  EXPECT_EQ(stroke_with(declare<Sandpaper>(0.4)), stroke(EffectPlan(friction)));
  EXPECT_NE(stroke(EffectPlan(drag)), stroke(EffectPlan(box())));
}

TEST(CustomEffect, CountsInThePlanLikeBuiltInEffects) {
  Scene skin = box();
  skin.objects[0].effects.declare<Skin>() = {250.0, 20.0};
  const EffectPlan own(box({declare<Rubber>(250.0)})), listed(skin);
  EXPECT_EQ(own.max_stiffness(), listed.max_stiffness());
  EXPECT_EQ(EffectPlan(box({declare<Honey>(3.0)})).objects()[0].damping(), 3.0);
  const PlanStage stage = own.stages().back();
  EXPECT_EQ(stage.name, "an effect of the program");
  EXPECT_EQ(stage.parameters, "level 250");
  ASSERT_EQ(own.custom_effects().size(), 1U);
  EXPECT_FALSE(own.custom_effects()[0]->not_booked);
}

TEST(CustomEffect, HasItsOwnStateInEachServo) {
  const EffectPlan plan(box({declare<Liar>(5.0)}));
  EXPECT_EQ(stroke(plan), stroke(plan));
}

TEST(CustomEffect, RefusesASecondHoldOfTheContactPoint) {
  EXPECT_THROW(EffectPlan(box({declare<Sandpaper>(0.4), declare<Sandpaper>(0.5)})),
               std::invalid_argument);
  EXPECT_THROW(EffectPlan(box({declare<Honey>(kNaN)})), std::invalid_argument);
}

TEST(CustomEffect, NonFiniteForcesAreDroppedAndReported) {
  for (const auto& [effect, strong] :
       {std::pair{declare<Wild>(1.0), false}, std::pair{declare<Wild>(2.0), true},
        std::pair{declare<Lost>(1.0), false}}) {
    const EffectPlan plan(box({effect}));
    const std::vector<Vector3d> with = stroke(plan), without = stroke(EffectPlan(box()));
    for (std::size_t i = 0; i < with.size(); ++i) {
      ASSERT_TRUE(with[i].allFinite());
      ASSERT_LE((with[i] - without[i]).norm(), 1.000001 * CallGuard::kMostForce);
    }
    const GuardReport& report = *plan.custom_effects()[0];
    EXPECT_EQ(report.too_strong > 0, strong);
    EXPECT_EQ(report.not_finite > 0, !strong);
    EXPECT_EQ(report.key, "own");
    EXPECT_EQ(report.object, "box");
  }
}

TEST(CustomEffect, InconsistentSpringIsHeldInsteadOfBooked) {
  for (const double lie : {1.0, 2.0, 3.0, 4.0, 6.0, 7.0}) {
    const EffectPlan plan(box({declare<Liar>(lie)}));
    const bool at_once = plan.custom_effects()[0]->not_booked;
    EXPECT_EQ(at_once, lie != 4.0) << lie;
    if (at_once) {
      EXPECT_EQ(plan.max_stiffness(), EffectPlan(box()).max_stiffness()) << lie;
    }
    (void)stroke(plan);
    EXPECT_TRUE(plan.custom_effects()[0]->not_booked) << lie;
  }
}

TEST(CustomEffect, SlowOneIsSwitchedOff) {
  const EffectPlan plan(box({declare<Sleeper>(1.0)}));
  const std::vector<Vector3d> with = stroke(plan, 330), without = stroke(EffectPlan(box()), 330);
  const GuardReport& report = *plan.custom_effects()[0];
  EXPECT_TRUE(report.switched_off);
  EXPECT_GE(report.slowest, 2'000'000);
  int felt = 0;
  for (std::size_t i = 0; i < with.size(); ++i) felt += with[i] != without[i] ? 1 : 0;
  EXPECT_LE(felt, static_cast<int>(CallGuard::kSlowCalls));
  EXPECT_EQ(with.back(), without.back());
}

// 4 and 5 are springs until they change while pressed.
TEST(CustomEffect, NoneGivesTheHandUnpaidEnergy) {
  std::vector<std::function<DeclaredCustomEffect()>> all = {
      [] { return declare<Honey>(3.0); },     [] { return declare<Honey>(300.0); },
      [] { return declare<Rubber>(250.0); },  [] { return declare<Rubber>(1e6); },
      [] { return declare<Sandpaper>(0.6); }, [] { return declare<Wild>(1.0); },
      [] { return declare<Wild>(2.0); },      [] { return declare<Lost>(1.0); }};
  for (const double lie : {1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0})
    all.emplace_back([lie] { return declare<Liar>(lie); });
  for (std::size_t which = 0; which < all.size(); ++which) {
    for (unsigned seed = 1; seed <= 20; ++seed) {
      for (const double stray : {2e-4, 2e-5, 2e-6}) {
        Random random(seed);
        const adversary::Least least = adversary::run_gated(box({all[which]()}), random, stray);
        EXPECT_GE(least.books, -least.late - 1e-9) << which << ", seed " << seed << ", " << stray;
      }
    }
  }
}

TEST(CustomEffect, NoneGivesEnergyAfterALightPress) {
  for (double lie = 1.0; lie <= 7.0; lie += 1.0) {
    for (unsigned seed = 1; seed <= 20; ++seed) {
      Random random(seed);
      EXPECT_GE(adversary::press_and_let_go(EffectPlan(box({declare<Liar>(lie)})), random), -1e-9)
          << lie << ", seed " << seed;
    }
  }
}

// 4 only ends its force, which takes no energy.
TEST(CustomEffect, WithoutTheGateTheyGiveEnergy) {
  for (const double lie : {1.0, 2.0, 3.0, 5.0, 6.0, 7.0}) {
    double made = 0.0;
    for (unsigned seed = 1; seed <= 20; ++seed) {
      Random random(seed);
      Scene scene = box({declare<Liar>(lie)});
      scene.objects[0].effects.of<SpringDamper>() = {100.0, 0.0};
      made = std::max(made, adversary::made_open(scene, random));
    }
    EXPECT_GT(made, 1e-6) << lie;
  }
}

}  // namespace
}  // namespace reckon::haptics
