// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Many objects: the objects skipped by the tree are free in a check of each one.
#include "reckon/haptics/contact/contact_solver.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <limits>
#include <memory>
#include <random>
#include <vector>

#include "reckon/tests/support/allocation_guard.hpp"
#include "reckon/tests/support/scratch_folder.hpp"

namespace reckon::haptics {
namespace {

using Eigen::Vector3d;

constexpr double kFar = 1e8;    // [m], of a single far object that degrades the tree's resolution
constexpr double kDeep = 0.02;  // [m]
constexpr double kLeap = 0.05;  // [m]
constexpr double kHall = 10.0;  // [m], beyond it all objects are along one path
constexpr double kSame = 1e-7;  // [m], twice the clearance of the largest object

class Dice {
 public:
  explicit Dice(unsigned seed) : random_(seed) {}
  double any(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  Vector3d point(double reach) {
    return {any(-reach, reach), any(-reach, reach), any(-reach, reach)};
  }
  bool chance(double share) { return any(0.0, 1.0) < share; }

 private:
  std::mt19937 random_;
};

// A tetrahedron, as a file named by a scene.
std::filesystem::path mesh_file(const test::ScratchFolder& folder) {
  const std::filesystem::path path = folder.file("tetrahedron.obj");
  std::ofstream(path) << "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
                         "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";
  return path;
}

Shape any_shape(Dice& dice, const std::filesystem::path& mesh) {
  const double draw = dice.any(0.0, 1.0);
  if (draw < 0.4) return SphereShape{dice.any(0.01, 0.1)};
  if (draw < 0.8) return BoxShape{Vector3d::Constant(0.01) + dice.point(0.05).cwiseAbs()};
  return MeshShape{mesh, dice.any(0.05, 0.2), true};
}

Scene any_scene(Dice& dice, std::size_t count, const std::filesystem::path& mesh) {
  Scene scene;
  for (std::size_t i = 0; i < count; ++i) {
    SceneObject object;
    object.name = "object";
    object.shape = any_shape(dice, mesh);
    // Each in a cell of its own, so that it feels the same as in a scene of its own.
    const auto cell = static_cast<int>(i);
    object.pose.position =
        0.25 * Vector3d(cell % 4, cell / 4 % 4, cell / 16) - Vector3d::Constant(0.4);
    object.pose.orientation.coeffs() << dice.point(1.0), 1.1;
    object.effects.of<SpringDamper>() = {dice.any(100.0, 900.0), dice.any(0.0, 2.0)};
    scene.objects.push_back(object);
  }
  if (dice.chance(0.3)) scene.objects.back().pose.position.setConstant(kFar);
  return scene;
}

// A solver for each object: with one object there is nothing to skip. The objects are separate
// here.
class OneByOne {
 public:
  explicit OneByOne(const Scene& scene) {
    for (const SceneObject& object : scene.objects) {
      plans_.push_back(std::make_unique<EffectPlan>(Scene{"alone", {object}}));
      solvers_.push_back(std::make_unique<ContactSolver>(*plans_.back()));
    }
  }

  /// @return false if one contact point may differ from many: if several objects are touched or on
  /// one path, if one is penetrated so deeply that the path there decides the side of the contact
  /// point, or if the hand jumped off or around the touched object: the single contact point
  /// continues from there.
  bool expect_same(const ContactResult& all, const Vector3d& device, bool reset) {
    std::vector<std::uint32_t> touched;
    bool inside = false;
    for (std::uint32_t i = 0; i < solvers_.size(); ++i) {
      const ContactResult result = reset ? solvers_[i]->reset(device) : solvers_[i]->step(device);
      inside |= result.objects[0].started_inside;
      if (result.objects[0].in_contact) touched.push_back(i);
    }
    const bool met_some = touching_ || !all.touched.empty();
    const bool leapt = met_some && (device - last_).norm() > kLeap;
    touching_ = !touched.empty();
    last_ = device;
    if (leapt || touched.size() > 1 || device.norm() > kHall) return false;
    if (!touched.empty() && solvers_[touched[0]]->step(device).objects[0].depth > kDeep)
      return false;
    EXPECT_EQ(std::vector(all.touched.begin(), all.touched.end()), touched);
    EXPECT_EQ(all.started_inside, inside);
    if (touched.empty() || testing::Test::HasFailure()) return true;
    const ContactResult& alone = solvers_[touched[0]]->step(device);
    EXPECT_LT((all.scp - alone.scp).norm(), kSame);
    EXPECT_LT((all.normal - alone.normal).norm(), 1e-5);
    EXPECT_LT((all.force - alone.force).norm(), 1e3 * kSame);
    ++met_;
    return true;
  }

  void reset(const Vector3d& device) {
    touching_ = false;
    for (const auto& solver : solvers_) solver->reset(device);
  }

  Vector3d effect_force(const Vector3d& velocity) {
    Vector3d sum = Vector3d::Zero();
    for (const auto& solver : solvers_) sum += solver->effect_force(velocity, 1e-3);
    return sum;
  }

  /// Contacts over all steps.
  [[nodiscard]] std::size_t met() const { return met_; }

 private:
  std::vector<std::unique_ptr<EffectPlan>> plans_;
  std::vector<std::unique_ptr<ContactSolver>> solvers_;
  std::size_t met_ = 0;
  bool touching_ = false;
  Vector3d last_ = Vector3d::Zero();
};

TEST(ContactSolver, MatchesACheckOfEveryObject) {
  const test::ScratchFolder folder;
  const auto mesh = mesh_file(folder);
  std::size_t met = 0;
  for (unsigned seed = 0; seed < 24; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Dice dice(seed);
    const Scene scene = any_scene(dice, seed % 4 == 0 ? 8 : 60, mesh);
    const EffectPlan plan(scene);
    ContactSolver solver(plan);
    OneByOne each(scene);
    Vector3d device = dice.point(0.5);
    Vector3d goal = device;
    const double reach = seed % 3 == 0 ? 1e-3 : 4e-3;  // [m] a step
    for (int i = 0; i < 2000; ++i) {
      if (i % 50 == 0) {
        const auto object = static_cast<std::size_t>(dice.any(0.0, 1.0) * 7.99);
        goal = scene.objects[object].pose.position + dice.point(0.1);
      }
      device += dice.point(reach) + 0.1 * (goal - device);
      if (dice.chance(0.02)) device = dice.point(0.6);         // a jump
      if (dice.chance(0.004)) device = dice.point(1.0) * 5e8;  // outside of any scene
      const Vector3d bad = Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
      if (dice.chance(0.01)) {
        EXPECT_FALSE(solver.step(bad).in_contact);
      }
      const bool anew = i == 0 || dice.chance(0.01);
      const ContactResult result = anew ? solver.reset(device) : solver.step(device);
      if (!each.expect_same(result, device, anew)) {
        device = dice.point(0.5);
        solver.reset(device);
        each.reset(device);
        continue;
      }
      if (testing::Test::HasFailure()) FAIL() << "step " << i;
      const Vector3d velocity = dice.point(0.3);
      const Vector3d force = solver.effect_force(velocity, 1e-3);
      ASSERT_LT((force - each.effect_force(velocity)).norm(), 1e-4);
    }
    met += each.met();
  }
  EXPECT_GT(met, 1'000u) << "the hand has to touch things for this to tell anything";
}

// 40 thin plates in a row, all crossed in one step: the first one stops the contact point.
TEST(ContactSolver, StopsAtTheFirstObjectOfAJump) {
  Scene scene;
  for (int i = 0; i < 40; ++i) {
    SceneObject plate;
    plate.name = "plate";
    plate.shape = BoxShape{{0.01, 0.2, 0.2}};
    plate.pose.position.x() = i;
    scene.objects.push_back(plate);
  }
  const EffectPlan plan(scene);
  ContactSolver solver(plan);
  solver.reset({-0.5, 0.01, 0.0});
  const ContactResult result = solver.step({38.5, 0.0, 0.0});
  ASSERT_EQ(result.touched.size(), 1u);
  EXPECT_EQ(result.touched[0], 0u);
  EXPECT_NEAR(result.scp.x(), -0.005, 1e-6);
}

// 40 balls in a row: the hand is in the first, jumps over all others, and returns.
TEST(ContactSolver, ReleasesAnObjectLeftInAJump) {
  Scene scene;
  for (int i = 0; i < 40; ++i) {
    SceneObject ball;
    ball.name = "ball";
    ball.shape = SphereShape{0.05};
    ball.pose.position.x() = i;
    scene.objects.push_back(ball);
  }
  const EffectPlan plan(scene);
  ContactSolver solver(plan);
  solver.step({0.0, 0.0, 0.1});
  ASSERT_TRUE(solver.step({0.0, 0.0, 0.04}).in_contact);
  ASSERT_TRUE(solver.step({0.0, 0.0, 0.03}).objects[0].in_contact);
  const ContactResult away = solver.step({0.5, 3.0, 5.0});
  EXPECT_FALSE(away.in_contact);
  EXPECT_FALSE(away.objects[0].in_contact);
  EXPECT_TRUE(away.touched.empty());
  EXPECT_EQ(away.scp, Vector3d(0.5, 3.0, 5.0));
  EXPECT_FALSE(solver.step({7.0, 0.0, 5.0}).in_contact);
  const ContactResult seventh = solver.step({7.0, 0.0, 0.04});
  ASSERT_EQ(seventh.touched.size(), 1u);
  EXPECT_EQ(seventh.touched[0], 7u);
}

TEST(ContactSolver, AllocatesNothingAmongManyObjects) {
  const test::ScratchFolder folder;
  Dice dice(5);
  const EffectPlan plan(any_scene(dice, 200, mesh_file(folder)));
  ContactSolver solver(plan);
  const test::AllocationGuard guard;
  solver.reset(Vector3d::Zero());
  for (int i = 0; i < 2000; ++i) {
    solver.step(dice.point(0.6));
    if (i % 500 == 0) solver.reset(dice.point(0.6));
  }
  EXPECT_EQ(guard.count(), 0u);
}

}  // namespace
}  // namespace reckon::haptics
