// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/scene/effect_plan.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "reckon/haptics/contact/contact_solver.hpp"
#include "reckon/haptics/geometry/surface_contact_point.hpp"
#include "reckon/tests/support/allocation_guard.hpp"
#include "reckon/tests/support/mesh_text.hpp"

namespace reckon::haptics {
namespace {

using Eigen::Vector3d;

SceneObject object(const std::string& name, Shape shape,
                   const Vector3d& position = Vector3d::Zero()) {
  SceneObject out;
  out.name = name;
  out.shape = std::move(shape);
  out.pose.position = position;
  return out;
}

Scene walls() {
  Scene scene;
  scene.objects.push_back(object("floor", PlaneShape{}));
  scene.objects.push_back(object("wall", PlaneShape{Vector3d::UnitX()}));
  scene.objects[1].effects.of<SpringDamper>() = {500.0, 2.0};
  return scene;
}

template <class F>
std::string message_of(F&& f) {
  try {
    f();
  } catch (const std::exception& error) {
    return error.what();
  }
  return {};
}

TEST(EffectPlan, SharesEqualMeshes) {
  const test::TemporaryMesh file(".obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  Scene scene;
  for (const double size : {0.1, 0.1, 0.2})
    scene.objects.push_back(object("o", MeshShape{file.path(), size, false}));
  const EffectPlan plan(scene);
  using Mesh = std::shared_ptr<const SurfaceMesh>;
  const auto mesh = [&](std::size_t i) { return std::get<Mesh>(plan.objects()[i].shape).get(); };
  EXPECT_EQ(mesh(0), mesh(1));
  EXPECT_NE(mesh(0), mesh(2));
}

TEST(EffectPlan, UndeclaredEffectsAreNeverConstructedOrCalled) {
  for_each_effect([]<class Effect>(std::type_identity<Effect>) {
    if constexpr (AlwaysThere<Effect>) return;
    const std::uint64_t before = CountedEffect<Effect>::constructed();
    const EffectPlan plan(walls());
    ContactSolver solver(plan);
    for (int i = 0; i < 1000; ++i) solver.step(Vector3d(0.001 * i - 0.5, 0.0, -0.001));
    EXPECT_EQ(CountedEffect<Effect>::constructed(), before) << Effect::kName;
    EXPECT_EQ(solver.friction_calls(), 0u);
    for (const PlanStage& stage : plan.stages()) EXPECT_NE(stage.name, Effect::kName);
  });
}

TEST(EffectPlan, CallsFrictionOnlyIfDeclared) {
  Scene scene = walls();
  scene.objects[0].effects.of<StickSlipFriction>() = Friction{0.5, 0.4};
  const EffectPlan plan(scene);
  ContactSolver solver(plan);
  solver.step(Vector3d(1.0, 0.0, 1.0));
  EXPECT_EQ(solver.friction_calls(), 0u) << "nothing is touched";
  solver.step(Vector3d(-0.01, 0.0, 1.0));
  EXPECT_EQ(solver.friction_calls(), 0u) << "the wall has none";
  solver.step(Vector3d(1.0, 0.0, -0.01));
  EXPECT_GT(solver.friction_calls(), 0u);
}

TEST(EffectPlan, ListsItsStagesWithParametersAndCost) {
  Scene scene = walls();
  scene.objects[0].effects.of<StickSlipFriction>() = Friction{0.5, 0.25};
  const std::vector<PlanStage> stages = EffectPlan(scene).stages();
  ASSERT_EQ(stages.size(), 5u);
  EXPECT_EQ(stages[0].name, "contact");
  EXPECT_EQ(stages[0].cost, "closed form");
  EXPECT_EQ(stages[1].name, "stick_slip_friction");
  EXPECT_EQ(stages[1].parameters, "static 0.5, kinetic 0.25");
  EXPECT_EQ(stages[4].name, "spring_damper");
  EXPECT_EQ(stages[4].object, "wall");
  EXPECT_EQ(stages[4].parameters, "stiffness 500 N/m, damping 2 N s/m");
  EXPECT_EQ(EffectPlan(scene).max_stiffness(), 800.0);
}

TEST(EffectPlan, NamesTheObjectTheValueAndTheRemedy) {
  Scene scene = walls();
  scene.objects[1].effects.of<SpringDamper>().stiffness = -3.0;
  EXPECT_THAT(message_of([&] { EffectPlan plan(scene); }),
              testing::AllOf(testing::HasSubstr("\"wall\""), testing::HasSubstr("stiffness = -3"),
                             testing::HasSubstr("N/m")));
  scene = walls();
  scene.objects[0].effects.of<StickSlipFriction>() = Friction{0.2, 0.4};
  EXPECT_THAT(message_of([&] { EffectPlan plan(scene); }), testing::HasSubstr("kinetic"));
  scene.objects[0] = object("stone", MeshShape{"none.obj", 0.2, true});
  EXPECT_THAT(message_of([&] { EffectPlan plan(scene); }), testing::HasSubstr("none.obj"));
}

// Twenty boxes, so that a tree of bounds is searched; each turned about its middle.
TEST(EffectPlan, FindsObjectsWithinReachInAnyDirection) {
  Scene scene;
  for (int i = 0; i < 20; ++i) {
    scene.objects.push_back(object("box " + std::to_string(i), BoxShape{Vector3d(0.1, 0.1, 0.1)}));
    scene.objects.back().pose.position = Vector3d(i, 0, 0);
    scene.objects.back().pose.orientation = Eigen::Quaterniond(0.9, 0.1 * i, 0.3, -0.2);
  }
  const EffectPlan plan(scene);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> x(-1, 1);
  for (int i = 0; i < 2000; ++i) {
    const Vector3d at(10 + 10 * x(random), x(random), x(random));
    double nearest = std::numeric_limits<double>::infinity();
    for (const PlannedObject& box : plan.objects()) {
      const Vector3d beyond = (box.to_object(at).cwiseAbs() - Vector3d::Constant(0.05)).cwiseMax(0);
      nearest = std::min(nearest, beyond.norm());
    }
    EXPECT_TRUE(plan.has_within(at, nearest + 1e-6));
    EXPECT_EQ(plan.has_within(at, 0.3), nearest <= 0.3) << nearest;
  }
}

TEST(ContactSolver, SumsTheForcesOfAllTouchedObjects) {
  const EffectPlan plan(walls());
  ContactSolver solver(plan);
  solver.step(Vector3d(0.1, 0.0, 0.1));
  const ContactResult result = solver.step(Vector3d(-0.002, 0.3, -0.001));
  ASSERT_EQ(result.objects.size(), 2u);
  EXPECT_LT((result.force - Vector3d(1.0, 0.0, 0.8)).norm(), 1e-12);
  EXPECT_NEAR(result.stored_energy, 0.5 * 500.0 * 4e-6 + 0.5 * 800.0 * 1e-6, 1e-15);
  EXPECT_EQ(result.deepest, 1u);
  EXPECT_LT((result.scp - Vector3d(0.0, 0.3, 0.0)).norm(), 1e-15) << "outside both";
  EXPECT_EQ(result.normal, Vector3d::UnitX());
}

TEST(ContactSolver, DamperOnlyDissipatesAndNeverPulls) {
  const EffectPlan plan(walls());
  ContactSolver solver(plan);
  solver.step(Vector3d(0.1, 0.0, 0.1));
  const ContactResult result = solver.step(Vector3d(-0.002, 0.0, 0.1));
  ASSERT_TRUE(result.in_contact);
  for (const double v : {-1.0, -0.01, 0.0, 0.01, 1.0}) {
    const Vector3d force = solver.effect_force(Vector3d(v, 0.3, 0.0), 0.001);
    EXPECT_LE(force.x() * v, 0.0);
    EXPECT_GE(force.x() + result.force.x(), 0.0);
    EXPECT_EQ(force.y(), 0.0);
  }
}

TEST(ContactSolver, IsIndependentOfPlaceAndOrientation) {
  // A box turned and moved gives the force of the original box, turned.
  Scene home;
  home.objects.push_back(object("box", BoxShape{Vector3d(0.1, 0.2, 0.3)}));
  Scene away = home;
  away.objects[0].pose.position = Vector3d(30.0, -20.0, 5.0);
  away.objects[0].pose.orientation = Eigen::Quaterniond(0.3, -0.2, 0.7, 0.4);
  const Eigen::Quaterniond turn = away.objects[0].pose.orientation.normalized();
  const EffectPlan home_plan(home);
  const EffectPlan away_plan(away);
  ContactSolver a(home_plan);
  ContactSolver b(away_plan);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> x(-0.1, 0.1);
  Vector3d device(0.2, 0.0, 0.0);
  int contacts = 0;
  for (int i = 0; i < 2000; ++i) {
    device = 0.95 * device + 0.15 * Vector3d(x(random), x(random), x(random));
    const ContactResult ra = a.step(device);
    const ContactResult rb = b.step(turn * device + away.objects[0].pose.position);
    ASSERT_LT((turn * ra.force - rb.force).norm(), 1e-8) << "tick " << i;
    contacts += ra.in_contact ? 1 : 0;
  }
  EXPECT_GT(contacts, 100);
}

TEST(ContactSolver, ReportsAnInsideStartUntilItIsLeft) {
  Scene scene;
  scene.objects.push_back(object("ball", SphereShape{0.05}));
  const EffectPlan plan(scene);
  ContactSolver solver(plan);
  ContactResult result = solver.step(Vector3d(0.0, 0.02, 0.0));
  EXPECT_TRUE(result.started_inside);
  EXPECT_TRUE(result.in_contact);
  EXPECT_LT((result.scp - Vector3d(0.0, 0.05, 0.0)).norm(), 1e-12);
  result = solver.step(Vector3d(0.0, 0.03, 0.0));
  EXPECT_TRUE(result.started_inside);
  solver.step(Vector3d(0.0, 0.06, 0.0));
  result = solver.step(Vector3d(0.0, 0.04, 0.0));
  EXPECT_TRUE(result.in_contact);
  EXPECT_FALSE(result.started_inside);
  EXPECT_TRUE(solver.reset(Vector3d(0.0, 0.04, 0.0)).started_inside);
}

TEST(ContactSolver, CatchesADeviceThatJumpsPastAnObject) {
  Scene scene;
  scene.objects.push_back(
      object("box", BoxShape{Vector3d(0.01, 1.0, 1.0)}, Vector3d(5.0, 0.0, 0.0)));
  const EffectPlan plan(scene);
  ContactSolver solver(plan);
  solver.step(Vector3d::Zero());
  solver.step(Vector3d(4.0, 0.0, 0.0));
  const ContactResult result = solver.step(Vector3d(6.0, 0.1, 0.0));
  EXPECT_TRUE(result.in_contact);
  EXPECT_NEAR(result.scp.x(), 4.995, 1e-6);
}

TEST(ContactSolver, HasItsOwnStateOnASharedPlan) {
  Scene scene = walls();
  scene.objects[0].effects.of<StickSlipFriction>() = Friction{0.5, 0.1};
  const EffectPlan plan(scene);
  ContactSolver sliding(plan);
  ContactSolver resting(plan);
  for (ContactSolver* solver : {&sliding, &resting}) solver->reset(Vector3d(1.0, 0.0, 0.01));
  sliding.step(Vector3d(1.0, 0.0, -0.01));
  sliding.step(Vector3d(1.01, 0.0, -0.01));
  EXPECT_EQ(resting.friction_calls(), 0u);
  resting.step(Vector3d(1.0, 0.0, -0.01));
  EXPECT_EQ(resting.step(Vector3d(1.004, 0.0, -0.01)).scp.x(), 1.0) << "sticks";
  EXPECT_GT(sliding.step(Vector3d(1.014, 0.0, -0.01)).scp.x(), 1.012) << "slides on";
}

TEST(ContactSolver, IgnoresANonFinitePosition) {
  const EffectPlan plan(walls());
  ContactSolver solver(plan);
  solver.step(Vector3d(0.1, 0.0, 0.1));
  const Vector3d held = solver.step(Vector3d(0.1, 0.0, -0.01)).scp;
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), 1e300,
                           -std::numeric_limits<double>::infinity()}) {
    const ContactResult result = solver.step(Vector3d(0.0, bad, -0.01));
    EXPECT_FALSE(result.in_contact);
    EXPECT_EQ(result.force, Vector3d::Zero());
    EXPECT_TRUE(result.scp.allFinite());
  }
  EXPECT_LT((solver.step(Vector3d(0.1, 0.0, -0.01)).scp - held).norm(), 1e-15);
}

TEST(ContactSolver, AllocatesNothingInAStepOrReset) {
  Scene scene = walls();
  scene.objects[0].effects.of<StickSlipFriction>() = Friction{};
  scene.objects.push_back(object("ball", SphereShape{0.05}));
  const EffectPlan plan(scene);
  ContactSolver solver(plan);
  const test::AllocationGuard guard;
  solver.reset(Vector3d(0.0, 0.0, 0.01));
  for (int i = 0; i < 1000; ++i) solver.step(Vector3d(0.0, 0.0, 0.1 * std::sin(0.1 * i)));
  EXPECT_EQ(guard.count(), 0u);
}

// A cube of 0.1 m, drawn at national coordinates and turned; its position brings it back.
TEST(EffectPlan, PlacesAMeshDrawnFarFromItsOrigin) {
  const Vector3d drawn(4321012.5, 678901.25, 432.0);
  test::MeshData cube = test::cube();
  for (Vector3d& v : cube.vertices) v *= 0.1;
  const test::TemporaryMesh file(".obj", test::obj_text(cube, drawn));
  SceneObject far = object("far", MeshShape{file.path(), 0.0, false});
  far.pose.orientation = Eigen::AngleAxisd(0.5, Vector3d::UnitZ());
  far.pose.position = -(far.pose.orientation * drawn);
  Scene scene;
  scene.objects.push_back(far);
  const EffectPlan plan(scene);

  const PlannedObject& planned = plan.objects().front();
  const Vector3d inside = far.pose.orientation * Vector3d(0.05, 0.05, 0.098);
  EXPECT_TRUE(planned.bounds.contains(inside));
  SurfaceContactPoint point;
  ASSERT_TRUE(point.reset(planned.shape, planned.to_object(inside)));
  const Vector3d expected = far.pose.orientation * Vector3d(0.05, 0.05, 0.1);
  // Clearance 17 nm; drawn and placed to 1 nm at 4321 km.
  EXPECT_LT((planned.to_scene(point.scp()) - expected).norm(), 25e-9);
}

}  // namespace
}  // namespace reckon::haptics
