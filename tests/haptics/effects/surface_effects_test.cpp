// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Effects of a surface against their closed forms, on a turned box and on a turned mesh.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>
#include <random>

#include "reckon/haptics/contact/contact_solver.hpp"
#include "reckon/tests/support/scratch_folder.hpp"

namespace reckon::haptics {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr double kPi = std::numbers::pi;
constexpr double kPeriod = 0.001;
constexpr double kStiffness = 1000.0;

/// A slab of 200 x 200 x 40 mm, as a box or as the same mesh, turned and moved in S.
enum class As { box, mesh };

class Slab {
 public:
  explicit Slab(As as) {
    object_.name = "slab";
    object_.effects.of<SpringDamper>() = {kStiffness, 0.0};
    object_.pose.position = {0.3, -0.2, 1.1};
    object_.pose.orientation = Quaterniond(Eigen::AngleAxisd(0.7, Vector3d(1, 2, -1).normalized()));
    if (as == As::box) {
      object_.shape = BoxShape{{0.2, 0.2, 0.04}};
    } else {
      object_.shape = MeshShape{write_slab(), 0.0, false};
    }
  }
  DeclaredEffects& effects() { return object_.effects; }
  void declare(const DeclaredCustomEffect& effect) { object_.custom_effects.push_back(effect); }
  [[nodiscard]] Vector3d in_scene(const Vector3d& place) const {
    return object_.pose.orientation * place + object_.pose.position;
  }
  [[nodiscard]] Vector3d turned(const Vector3d& way) const {
    return object_.pose.orientation * way;
  }
  [[nodiscard]] EffectPlan plan() const { return EffectPlan(Scene{"", {object_}}); }

 private:
  std::filesystem::path write_slab() {
    const std::filesystem::path file = folder_.file("slab.off");
    std::ofstream out(file);
    out << "OFF\n8 12 0\n";
    for (int i = 0; i < 8; ++i)
      out << (i & 1 ? 0.1 : -0.1) << ' ' << (i & 2 ? 0.1 : -0.1) << ' ' << (i & 4 ? 0.02 : -0.02)
          << '\n';
    out << "3 0 2 1\n3 1 2 3\n3 4 5 6\n3 5 7 6\n3 0 1 4\n3 1 5 4\n"
           "3 2 6 3\n3 3 6 7\n3 0 4 2\n3 2 4 6\n3 1 3 5\n3 3 7 5\n";
    return file;
  }

  test::ScratchFolder folder_;
  SceneObject object_;
};

/// Presses at `at` (x, y of the slab's axes) by 2 mm, from above.
constexpr double kDepth = 0.002, kNormalForce = kStiffness * kDepth;
Vector3d pressed(double x, double y) { return {x, y, 0.02 - kDepth}; }

class SurfaceEffects : public testing::TestWithParam<As> {};
INSTANTIATE_TEST_SUITE_P(Slabs, SurfaceEffects, testing::Values(As::box, As::mesh),
                         [](const auto& slab) { return slab.param == As::box ? "box" : "mesh"; });

struct NoParameter {
  double none = 0.0;
};
/// Gives no force and keeps the contact data of effects.
struct Witness : CountedEffect<Witness> {
  using Parameters = NoParameter;
  static constexpr bool kInContactOnly = true;
  static constexpr std::string_view kName = "witness";
  static constexpr std::string_view kKey = "witness";
  static constexpr std::string_view kCost = "nothing";
  static constexpr std::array<EffectParameter<NoParameter>, 1> kParameters{
      {{"none", "", &NoParameter::none, 0.0, 0.0, 0.0, "Nothing."}}};
  explicit Witness(const NoParameter&) {}
  [[nodiscard]] Vector3d force(const EffectContact& contact) const noexcept {
    if (contact.in_contact) place = contact.object->place;
    normal_force = contact.normal_force();
    return Vector3d::Zero();
  }
  [[nodiscard]] double damping() const noexcept { return 0.0; }
  [[nodiscard]] const NoParameter& parameters() const noexcept { return parameters_; }

  inline static Vector3d place;
  inline static double normal_force;

 private:
  NoParameter parameters_;
};

TEST_P(SurfaceEffects, TextureIsTheSlopeTimesTheNormalForce) {
  Slab slab(GetParam());
  slab.effects().declare<Texture>() = {4e-5, 0.003, 0.005, 0.0};
  slab.declare({std::make_shared<const CustomEffectOf<Witness>>(), {0.0}});
  const EffectPlan plan = slab.plan();
  ContactSolver solver(plan);
  solver.reset(slab.in_scene({0, 0, 0.03}));
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-0.08, 0.08);
  for (int i = 0; i < 200; ++i) {
    const double x = any(random), y = any(random);
    solver.step(slab.in_scene({x, y, 0.03}));
    solver.step(slab.in_scene(pressed(x, y)));
    const Vector3d force = solver.effect_force(Vector3d::Zero(), kPeriod);
    const double kx = 2 * kPi / 0.003, ky = 2 * kPi / 0.005;
    const auto slope = [&](double at_x, double at_y) -> Vector3d {
      return {-4e-5 * kx * std::sin(kx * at_x) * std::cos(ky * at_y),
              -4e-5 * ky * std::cos(kx * at_x) * std::sin(ky * at_y), 0};
    };
    const Vector3d& place = Witness::place;
    const Vector3d here = slab.turned(-Witness::normal_force * slope(place.x(), place.y()));
    EXPECT_LT((force - here).norm(), 1e-6 * kNormalForce * 4e-5 * (kx + ky)) << i;
    // The contact point is below the hand within a clearance, 1e-7 of the size.
    EXPECT_LT((place - Vector3d(x, y, 0.02)).norm(), 2e-7) << i;
    EXPECT_LT((force - slab.turned(-kNormalForce * slope(x, y))).norm(),
              1e-6 + 1e-4 * slope(x, y).norm())
        << i;
  }
}

// Four samples in a wave render it whole, two or fewer nothing.
TEST_P(SurfaceEffects, TextureFadesAgainstAliasing) {
  Slab slab(GetParam());
  slab.effects().declare<Texture>() = {4e-5, 0.004, 0.0, 0.0};
  const EffectPlan plan = slab.plan();
  ContactSolver solver(plan);
  solver.reset(slab.in_scene({0.001, 0, 0.03}));
  solver.step(slab.in_scene(pressed(0.001, 0)));
  const auto size = [&](double speed) {
    return solver.effect_force(slab.turned({0, speed, 0}), kPeriod).norm();
  };
  const double whole = size(0.0);
  EXPECT_GT(whole, 0.05);
  EXPECT_NEAR(size(1.0), whole, 1e-12);
  EXPECT_NEAR(size(4.0 / 3.0), 0.5 * whole, 1e-9);
  EXPECT_EQ(size(2.0), 0.0);
  EXPECT_EQ(size(50.0), 0.0);
}

TEST_P(SurfaceEffects, DragOpposesMotionAlongTheSurfaceOnly) {
  Slab slab(GetParam());
  slab.effects().declare<SurfaceDrag>() = {3.0};
  const EffectPlan plan = slab.plan();
  ContactSolver solver(plan);
  solver.reset(slab.in_scene({0, 0, 0.03}));
  EXPECT_EQ(solver.effect_force(slab.turned({0.2, 0, 0}), kPeriod), Vector3d::Zero());
  solver.step(slab.in_scene(pressed(0, 0)));
  const Vector3d force = solver.effect_force(slab.turned({0.2, -0.1, 0.7}), kPeriod);
  EXPECT_LT((force - slab.turned({-0.6, 0.3, 0})).norm(), 1e-9);
  EXPECT_EQ(plan.objects()[0].damping(), 3.0);
}

// On a fixed object it is there at once.
TEST(SurfaceEffectsOf, DragOfABodyGrowsAndFades) {
  SurfaceDrag drag({2.0});
  ContactedObject object;
  EffectContact contact;
  contact.in_contact = true;
  contact.object = &object;
  contact.depth = 1e-3;
  contact.normal = Vector3d::UnitZ();
  contact.velocity = Vector3d(0.5, 0, 0);
  EXPECT_EQ(drag.force(contact).x(), -1.0);
  contact.most_viscosity = 5.0;
  object.began = true;
  EXPECT_NEAR(drag.force(contact).x(), -0.2, 1e-12);
  object.began = false;
  EXPECT_NEAR(drag.force(contact).x(), -0.36, 1e-12);
  for (int i = 0; i < 100; ++i) static_cast<void>(drag.force(contact));
  EXPECT_NEAR(drag.force(contact).x(), -1.0, 1e-9);
  // At 0.2 m/s they part within 5 ms.
  contact.velocity.z() = 0.2;
  EXPECT_NEAR(drag.force(contact).x(), -(1.0 - std::exp(-1.0)), 1e-9);
  contact.depth = 0.0;
  EXPECT_EQ(drag.force(contact).x(), 0.0);
  // Beyond an edge.
  contact.depth = 1e-3;
  contact.normal = Vector3d::UnitY();
  EXPECT_NEAR(drag.force(contact).x(), -0.2, 1e-9);
}

// For each contact again, by its initial speed.
TEST_P(SurfaceEffects, TapRingsAndDecays) {
  Slab slab(GetParam());
  const Ringing wood{8.0, 100.0, 80.0};
  slab.effects().declare<TapVibration>() = wood;
  const EffectPlan plan = slab.plan();
  ContactSolver solver(plan);
  solver.reset(slab.in_scene({0, 0, 0.03}));
  for (const double speed : {0.1, 0.25}) {
    solver.step(slab.in_scene({0, 0, 0.03}));
    EXPECT_EQ(solver.effect_force(slab.turned({0, 0, -speed}), kPeriod), Vector3d::Zero());
    for (int i = 1; i <= 60; ++i) {
      solver.step(slab.in_scene(pressed(0, 0)));
      const double velocity = i == 1 ? -speed : 0.01;  // later motion does not count
      const Vector3d force = solver.effect_force(slab.turned({0.3, 0, velocity}), kPeriod);
      const double t = kPeriod * i;
      const double expected = 8.0 * speed * std::exp(-80 * t) * std::sin(2 * kPi * 100 * t);
      EXPECT_LT((force - slab.turned({0, 0, expected})).norm(), 1e-9) << i;
    }
  }
}

/// Slides along x at `speed` until it is far from where it stuck. @return tangential over normal
/// force
double sliding_ratio(ContactSolver& solver, const Slab& slab, double from, double speed,
                     int steps) {
  solver.step(slab.in_scene({from, 0, 0.03}), kPeriod);
  ContactResult result{};
  for (int i = 0; i < steps; ++i)
    result = solver.step(slab.in_scene(pressed(from + speed * kPeriod * i, 0)), kPeriod);
  const double along = result.force.dot(slab.turned({-1, 0, 0}));
  return along / result.force.dot(slab.turned({0, 0, 1}));
}

// Sticks up to the static coefficient, and slides with the kinetic one, both of the present place.
TEST_P(SurfaceEffects, GrainUsesTheCoefficientOfThePlace) {
  Slab slab(GetParam());
  slab.effects().declare<PlaceFriction>() = {0.5, 0.5, 0.6, 0.02, 0.0, 0.0};
  const EffectPlan plan = slab.plan();
  ContactSolver solver(plan);
  solver.reset(slab.in_scene({0, 0, 0.03}));
  double least = 10, most = 0;
  solver.step(slab.in_scene({-0.05, 0, 0.03}));
  for (int i = 0; i < 1000; ++i) {
    const double x = -0.05 + 1e-4 * i;
    const ContactResult result = solver.step(slab.in_scene(pressed(x, 0)), kPeriod);
    if (i < 100) continue;
    const Vector3d place = plan.objects()[0].place_of(result.scp);
    const double ratio = result.force.dot(slab.turned({-1, 0, 0})) / kNormalForce;
    // The cone belongs to the place one step before.
    const double here = 0.5 * (1 + 0.6 * std::cos(2 * kPi * place.x() / 0.02));
    EXPECT_NEAR(ratio, here, 0.02) << i;
    least = std::min(least, ratio);
    most = std::max(most, ratio);
  }
  EXPECT_NEAR(least, 0.2, 0.01);
  EXPECT_NEAR(most, 0.8, 0.01);
}

TEST_P(SurfaceEffects, StribeckFrictionFallsAndGrowsWithSpeed) {
  Slab slab(GetParam());
  const Lubrication oil{0.6, 0.3, 0.02, 0.5};
  slab.effects().declare<StribeckFriction>() = oil;
  const EffectPlan plan = slab.plan();
  ContactSolver solver(plan);
  solver.reset(slab.in_scene({0, 0, 0.03}));
  // Below the speed of its steepest fall the contact is stick-slip.
  for (const double speed : {0.05, 0.1, 0.3}) {
    const double expected = 0.3 + 0.3 * std::exp(-std::pow(speed / 0.02, 2)) + 0.5 * speed;
    const int steps = static_cast<int>(0.15 / (speed * kPeriod));
    EXPECT_NEAR(sliding_ratio(solver, slab, -0.08, speed, steps), expected, 0.01 * expected)
        << speed;
  }
  // It breaks away at the static coefficient.
  solver.step(slab.in_scene({0, 0, 0.03}), kPeriod);
  double broke = 0;
  for (int i = 0; i < 400 && broke == 0; ++i) {
    const double x = 1e-5 * i;
    const ContactResult result = solver.step(slab.in_scene(pressed(x, 0)), kPeriod);
    if (plan.objects()[0].place_of(result.scp).x() > 1e-6) broke = x * kStiffness / kNormalForce;
  }
  EXPECT_NEAR(broke, 0.6, 0.012);
}

// Also deep in thick oil, where a step of viscosity holds the contact point back by more than it
// slides in a period.
TEST_P(SurfaceEffects, ViscousStribeckSlidesWithoutChatter) {
  Slab slab(GetParam());
  slab.effects().declare<StribeckFriction>() = {0.3, 0.2, 0.01, 10.0};
  const EffectPlan plan = slab.plan();
  ContactSolver solver(plan);
  solver.reset(slab.in_scene({0, 0, 0.03}));
  solver.step(slab.in_scene({-0.08, 0, 0.03}));
  double before = 0;
  for (int i = 0; i < 500; ++i) {
    const Vector3d device = slab.in_scene(pressed(-0.08 + 3e-4 * i, 0));
    const double along = solver.step(device, kPeriod).force.dot(slab.turned({-1, 0, 0}));
    EXPECT_GE(along, before - 1e-6) << i;
    before = along;
  }
  EXPECT_NEAR(before, (0.2 + 10.0 * 0.3) * kNormalForce, 0.01 * kNormalForce);
}

// Torn off at `force`, and caught again at the next place.
TEST_P(SurfaceEffects, SnagsHoldUntilTornOff) {
  Slab slab(GetParam());
  const Snagging velcro{1e5, 1.2, 5e-4, 0.1, 7};
  slab.effects().declare<Snags>() = velcro;
  const EffectPlan plan = slab.plan();
  ContactSolver solver(plan);
  solver.reset(slab.in_scene({0, 0, 0.03}));
  solver.step(slab.in_scene({-0.09, 0, 0.03}));
  const Snags snags(velcro);
  int caught = 0, crossed = 0;
  bool held = false;
  std::uint64_t below = 0;
  double most = 0;
  for (int i = 0; i < 9000; ++i) {
    const ContactResult result = solver.step(slab.in_scene(pressed(-0.09 + 2e-5 * i, 0)));
    const double force = result.force.dot(slab.turned({-1, 0, 0}));
    most = std::max(most, force);
    if (force > 1.1 && !held) ++caught;
    held = force > 1.1 || (held && force > 0.5);
    const std::uint64_t snag = snags.at(plan.objects()[0].place_of(result.scp));
    if (snag != 0 && snag != below) ++crossed;
    if (snag != 0) below = snag;
  }
  EXPECT_NEAR(most, 1.2, 0.024 + kStiffness * 2e-5);
  EXPECT_GT(caught, 5);
  // Snags just behind a torn-off one may be skipped.
  EXPECT_LE(caught, crossed);
  EXPECT_GE(2 * caught, crossed);
}

TEST(SurfaceEffectsOf, SnagsHaveTheConfiguredDensity) {
  const Snags snags({2e4, 1.0, 5e-4, 0.1, 3});
  std::mt19937 random(2);
  std::uniform_real_distribution<double> any(-5, 5);
  int hits = 0;
  constexpr int kTries = 200'000;
  for (int i = 0; i < kTries; ++i) hits += snags.at({any(random), any(random), 0.02}) != 0 ? 1 : 0;
  // One in 2 reach / density of space, within a ball of the reach.
  const double share = 4.0 / 3.0 * kPi * std::pow(5e-4, 3) * 2e4 / (2 * 5e-4);
  EXPECT_NEAR(hits, share * kTries, 5 * std::sqrt(share * kTries));
}

// Tight until pierced, then soft until the tip is out again.
TEST_P(SurfaceEffects, SkinBreaksAndHeals) {
  Slab slab(GetParam());
  slab.effects().declare<Skin>() = {500.0, 1.0};
  const EffectPlan plan = slab.plan();
  ContactSolver solver(plan);
  solver.reset(slab.in_scene({0, 0, 0.03}));
  const auto felt = [&](double depth) {
    const ContactResult result = solver.step(slab.in_scene({0.01, 0.01, 0.02 - depth}));
    static_cast<void>(solver.effect_force(Vector3d::Zero(), kPeriod));
    return result.force.norm();
  };
  for (int round = 0; round < 3; ++round) {
    EXPECT_EQ(felt(-0.01), 0);
    EXPECT_NEAR(felt(0.001), 1.5, 1e-3);
    EXPECT_NEAR(felt(0.0019), 2.85, 1e-3);
    EXPECT_NEAR(felt(0.0021), 3.15, 1e-3);  // it breaks in this step
    EXPECT_NEAR(felt(0.0021), 2.1, 1e-3);
    EXPECT_NEAR(felt(0.0005), 0.5, 1e-3);
  }
}

TEST(SurfaceEffectsOf, RefuseContradictoryParameters) {
  EXPECT_THROW(Snags({1e6, 1.0, 5e-4, 0.1, 1}), std::invalid_argument);
  EXPECT_THROW(Snags({1e4, 1.0, 5e-4, 0.1, 1.5}), std::invalid_argument);
  EXPECT_THROW(Texture({1e-3, 0.005, 0, 0}), std::invalid_argument);
  EXPECT_THROW(PlaceFriction({0.2, 0.3, 0.5, 0.01, 0, 0}), std::invalid_argument);
  EXPECT_THROW(StribeckFriction({0.2, 0.3, 0.01, 0}), std::invalid_argument);
  Slab slab(As::box);
  slab.effects().declare<PlaceFriction>();
  slab.effects().declare<StickSlipFriction>();
  try {
    static_cast<void>(slab.plan());
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("declare one of them"), std::string::npos);
  }
}

}  // namespace
}  // namespace reckon::haptics
