// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Where objects meet, one contact point stays outside all of them. Distances are computed here,
// independent of the library.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <random>

#include "reckon/haptics/contact/contact_shares.hpp"
#include "reckon/haptics/contact/contact_solver.hpp"
#include "reckon/haptics/contact/static_contact.hpp"
#include "reckon/tests/support/allocation_guard.hpp"
#include "reckon/tests/support/scratch_folder.hpp"

namespace reckon::haptics {
namespace {

using Eigen::Vector3d;

constexpr double kOutside = 1e-6;  // [m]

/// Depth of p inside an object; negative outside.
using Depth = std::function<double(const Vector3d& p)>;

struct World {
  Scene scene;
  std::vector<Depth> depths;

  SceneObject& add(const Shape& shape, const ObjectPose& pose, Depth depth) {
    SceneObject object;
    object.name = "object " + std::to_string(scene.objects.size());
    object.shape = shape;
    object.pose = pose;
    object.effects.of<SpringDamper>() = {800.0, 0.0};
    scene.objects.push_back(object);
    depths.push_back([pose, depth](const Vector3d& p) {
      return depth(pose.orientation.normalized().inverse() * (p - pose.position));
    });
    return scene.objects.back();
  }
  SceneObject& box(const Vector3d& size, const ObjectPose& pose) {
    return add(BoxShape{size}, pose,
               [size](const Vector3d& p) { return (0.5 * size - p.cwiseAbs()).minCoeff(); });
  }
  SceneObject& ball(double radius, const ObjectPose& pose) {
    return add(SphereShape{radius}, pose,
               [radius](const Vector3d& p) { return radius - p.norm(); });
  }
  SceneObject& plane(const Vector3d& normal, const ObjectPose& pose) {
    return add(PlaneShape{normal}, pose,
               [normal](const Vector3d& p) { return -normal.normalized().dot(p); });
  }
  /// A mesh of a box of edge lengths 0.1 m.
  SceneObject& mesh(const std::filesystem::path& file, const ObjectPose& pose) {
    return add(MeshShape{file, 0.1 * std::sqrt(3.0), true}, pose, [](const Vector3d& p) {
      return (Vector3d::Constant(0.05) - p.cwiseAbs()).minCoeff();
    });
  }
  [[nodiscard]] double deepest(const Vector3d& p) const {
    double most = -1e9;
    for (const Depth& depth : depths) most = std::max(most, depth(p));
    return most;
  }
  void make_rough() {
    for (SceneObject& object : scene.objects) object.effects.declare<StickSlipFriction>();
  }
};

ObjectPose at(const Vector3d& p, double turn = 0.0, const Vector3d& axis = Vector3d::UnitZ()) {
  return {p, Eigen::Quaterniond(Eigen::AngleAxisd(turn, axis.normalized()))};
}

std::filesystem::path cube_file(const test::ScratchFolder& folder) {
  const std::filesystem::path path = folder.file("cube.obj");
  std::ofstream(path) << "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
                         "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
  return path;
}

// A room's corner about the origin, open towards +x +y +z, of three objects of each kind.
std::vector<World> corners(const test::ScratchFolder& folder) {
  std::vector<World> all(6);
  const Vector3d slab(0.2, 0.2, 0.2);
  // Boxes that overlap behind the corner.
  all[0].box(slab, at({-0.1, 0.0, 0.0}));
  all[0].box(slab, at({0.0, -0.1, 0.0}));
  all[0].box(slab, at({0.0, 0.0, -0.1}));
  // Turned boxes: no right angle between any two faces.
  all[1].box(slab, at({-0.1, 0.02, 0.01}, 0.2, {0.3, 1.0, 0.5}));
  all[1].box(slab, at({0.01, -0.1, 0.0}, 0.3, {1.0, 0.2, 0.4}));
  all[1].box(slab, at({0.0, 0.01, -0.1}, 0.25, {0.2, 0.6, 1.0}));
  all[2].plane({1.0, 0.1, 0.0}, at(Vector3d::Zero()));
  all[2].mesh(cube_file(folder), at({0.0, -0.05, 0.0}, 0.3));
  all[2].box(slab, at({0.0, 0.0, -0.1}));
  all[3].ball(0.1, at({-0.1, 0.01, 0.0}));
  all[3].ball(0.1, at({0.0, -0.1, 0.01}));
  all[3].plane(Vector3d::UnitZ(), at(Vector3d::Zero()));
  all[4].mesh(cube_file(folder), at({-0.05, 0.0, 0.0}));
  all[4].mesh(cube_file(folder), at({0.0, -0.05, 0.0}, 0.4, {1.0, 0.3, 0.2}));
  all[4].mesh(cube_file(folder), at({0.0, 0.0, -0.05}, 0.2));
  // An acute wedge, and boxes with flush faces.
  all[5].plane({-0.9, 0.0, 1.0}, at(Vector3d::Zero()));
  all[5].box(slab, at({-0.1, 0.0, -0.1}));
  all[5].box(slab, at({0.1, 0.0, -0.1}));
  return all;
}

/// A hand that moves about a place, in and out, at the speed of a hand.
class Wander {
 public:
  Wander(unsigned seed, double reach) : random_(seed), reach_(reach) {}
  Vector3d next() {
    std::normal_distribution<double> any;
    velocity_ += 0.2 * Vector3d(any(random_), any(random_), any(random_)) - 0.1 * velocity_;
    place_ += 1e-4 * velocity_ - 0.003 * place_;
    return reach_ * place_ / 0.005;
  }

 private:
  std::mt19937 random_;
  double reach_;
  Vector3d velocity_ = Vector3d::Zero();
  Vector3d place_ = Vector3d::Constant(0.01);
};

TEST(SharedContactPoint, StaysOutsideAllObjectsOfACorner) {
  const test::ScratchFolder folder;
  for (const bool rough : {false, true}) {
    std::size_t number = 0;
    for (World& world : corners(folder)) {
      SCOPED_TRACE(testing::Message() << "corner " << number++ << " rough " << rough);
      if (rough) world.make_rough();
      const EffectPlan plan(world.scene);
      ContactSolver solver(plan);
      Wander hand(5, 0.01);
      solver.reset({0.05, 0.04, 0.06});
      ASSERT_LT(world.deepest({0.05, 0.04, 0.06}), 0.0);
      int together = 0;
      for (int i = 0; i < 4000; ++i) {
        const Vector3d device = hand.next();
        const ContactResult moved = solver.step(device);
        ASSERT_LE(world.deepest(moved.scp), kOutside) << "tick " << i;
        together += moved.touched.size() > 1 ? 1 : 0;
        if (i % 10 != 0) continue;
        Vector3d rest = moved.scp;
        double energy = moved.stored_energy;
        for (int hold = 0; hold < 5; ++hold) {
          const ContactResult held = solver.step(device);
          ASSERT_LE((held.scp - rest).norm(), kOutside) << "tick " << i << " vibrates";
          ASSERT_LE(held.stored_energy, energy + 1e-15) << "tick " << i;
          ASSERT_LE((held.scp - device).norm(), (rest - device).norm() + 1e-15) << "tick " << i;
          rest = held.scp;
          energy = held.stored_energy;
        }
      }
      EXPECT_GT(together, 200) << "the hand has to lean on several at once";
    }
  }
}

TEST(SharedContactPoint, ReachesACornerOfBoxesWithinTheirClearance) {
  const test::ScratchFolder folder;
  const World world = corners(folder)[0];
  const EffectPlan plan(world.scene);
  ContactSolver solver(plan);
  solver.reset({0.02, 0.03, 0.04});
  const ContactResult result = solver.step({-0.004, -0.005, -0.006});
  ASSERT_EQ(result.touched.size(), 3u);
  EXPECT_LT(result.scp.cwiseAbs().maxCoeff(), 1e-7);
  EXPECT_LT((result.force - 800.0 * Vector3d(0.004, 0.005, 0.006)).norm(), 1e-3);
}

// A floor of two boxes side by side: a hand above does not feel the wall between them.
TEST(SharedContactPoint, SlidesOverASeamBetweenTwoBoxes) {
  World world;
  world.box({0.1, 0.1, 0.1}, at({-0.05, 0.0, -0.05}));
  world.box({0.1, 0.1, 0.1}, at({0.05, 0.0, -0.05}));
  const EffectPlan plan(world.scene);
  ContactSolver solver(plan);
  solver.reset({-0.02, 0.0, 0.01});
  for (int i = -200; i <= 200; ++i) {
    const double x = 1e-4 * i;
    const ContactResult result = solver.step({x, 0.001, -0.003});
    ASSERT_NEAR(result.force.x(), 0.0, 1e-4) << "x " << x;
    ASSERT_NEAR(result.force.z(), 2.4, 1e-3) << "x " << x;
  }
}

// The inner box is out of reach: a hand that presses on the outer one must not feel it.
TEST(SharedContactPoint, DoesNotFeelAnEnclosedObject) {
  World world;
  world.box({0.2, 0.2, 0.2}, at(Vector3d::Zero()));
  world.box({0.19, 0.19, 0.19}, at(Vector3d::Zero()));
  const EffectPlan plan(world.scene);
  ContactSolver solver(plan);
  solver.reset({0.0, 0.0, 0.2});
  const ContactResult result = solver.step({0.0, 0.0, 0.09});
  ASSERT_EQ(result.touched.size(), 1u);
  EXPECT_EQ(result.touched[0], 0u);
  EXPECT_NEAR(result.force.z(), 8.0, 1e-3);
}

TEST(SharedContactPoint, KeepsEachStiffnessAtARightAngle) {
  World world;
  world.plane(Vector3d::UnitZ(), at(Vector3d::Zero())).effects.of<SpringDamper>().stiffness = 100.0;
  world.plane(Vector3d::UnitX(), at(Vector3d::Zero())).effects.of<SpringDamper>().stiffness = 900.0;
  const EffectPlan plan(world.scene);
  ContactSolver solver(plan);
  solver.reset({0.01, 0.0, 0.01});
  const ContactResult result = solver.step({-0.001, 0.0, -0.01});
  ASSERT_EQ(result.touched.size(), 2u);
  EXPECT_NEAR(result.force.z(), 1.0, 1e-6);
  EXPECT_NEAR(result.force.x(), 0.9, 1e-6);
  EXPECT_NEAR(result.stored_energy, 0.5 * 100.0 * 1e-4 + 0.5 * 900.0 * 1e-6, 1e-9);
}

// S(x + dx) <= S(x) - f.dx + K |dx|^2 / 2, the assumption of the port's ledger.
TEST(SharedContactPoint, StoresNoMoreThanTheStiffestSpring) {
  const test::ScratchFolder folder;
  for (const bool rough : {false, true}) {
    std::size_t number = 0;
    for (World& world : corners(folder)) {
      SCOPED_TRACE(testing::Message() << "corner " << number++ << " rough " << rough);
      if (rough) world.make_rough();
      const EffectPlan plan(world.scene);
      ContactSolver solver(plan);
      Wander hand(8, 0.01);
      Vector3d device(0.05, 0.04, 0.06);
      ContactResult before = solver.reset(device);
      for (int i = 0; i < 4000; ++i) {
        const Vector3d next = hand.next();
        const Vector3d dx = next - device;
        const double bound =
            before.stored_energy - before.force.dot(dx) + 0.5 * 800.0 * dx.squaredNorm();
        before = solver.step(next);
        ASSERT_LE(before.stored_energy, bound + 1e-13) << "tick " << i;
        device = next;
      }
    }
  }
}

// Walls of 200 and 800 N/m in contact with each other: the cost of a changed share is booked.
TEST(SharedContactPoint, DifferentStiffnessesMakeNoEnergy) {
  const test::ScratchFolder folder;
  constexpr double kPeriod = 1e-3;
  constexpr double kDamping = 1.0;
  for (World& world : corners(folder)) {
    world.make_rough();
    world.scene.objects[1].effects.of<SpringDamper>().stiffness = 200.0;
    const EffectPlan plan(world.scene);
    EnergyPort port(kDamping);
    StaticContact contact(plan, 0.75 * 0.95 * 2.0 * kDamping / kPeriod);
    PointTool tool;
    Wander hand(3, 0.01);
    Vector3d device(0.05, 0.04, 0.06);
    tool.reset({device});
    contact.reset(tool);
    double energy = 0.0;
    double felt = 0.0;
    for (int i = 0; i < 6000; ++i) {
      PortLoad load;
      tool.set_velocity(Vector3d::Zero());
      contact.load(tool, kPeriod, load);
      const PortHold held = port.hold(load, kPeriod);
      contact.shown(held.extra);
      const Vector3d next = hand.next();
      const Vector3d dx = next - device;
      device = next;
      energy += -held.force.dot(dx) + kDamping * dx.squaredNorm() / kPeriod;
      ASSERT_GE(energy, -1e-9) << "tick " << i;
      felt = std::max(felt, held.force.norm());
      port.settle(dx, kPeriod);
      tool.move({device});
      contact.settle(tool, kPeriod, port);
    }
    EXPECT_GT(felt, 1.0);
  }
}

TEST(SharedContactPoint, StartsOutsideAllObjectsAroundTheHand) {
  const test::ScratchFolder folder;
  std::size_t number = 0;
  for (const World& world : corners(folder)) {
    SCOPED_TRACE(testing::Message() << "corner " << number++);
    const EffectPlan plan(world.scene);
    ContactSolver solver(plan);
    std::mt19937 random(3);
    std::uniform_real_distribution<double> any(-0.03, 0.01);
    for (int i = 0; i < 300; ++i) {
      const Vector3d device(any(random), any(random), any(random));
      const ContactResult result = solver.reset(device);
      ASSERT_EQ(result.started_inside, world.deepest(device) > 0.0);
      ASSERT_LE(world.deepest(result.scp), kOutside)
          << "start " << i << " at " << device.transpose() << " scp " << result.scp.transpose();
    }
  }
}

TEST(ContactShares, AreAtRightAnglesAndAddUp) {
  std::mt19937 random(1);
  std::normal_distribution<double> any;
  const auto vector = [&] { return Vector3d(any(random), any(random), any(random)); };
  for (int i = 0; i < 1000; ++i) {
    ContactShares shares;
    for (std::uint32_t k = 0; k < 3; ++k) shares[k] = {k, vector(), Vector3d::Zero()};
    const std::size_t count = 1 + static_cast<std::size_t>(i) % 3;
    const Vector3d way = vector();
    share_way(way, std::span(shares).first(count));
    Vector3d sum = Vector3d::Zero();
    double squares = 0.0;
    for (std::size_t k = 0; k < count; ++k) {
      sum += shares[k].way;
      squares += shares[k].way.squaredNorm();
    }
    ASSERT_LT((sum - way).norm(), 1e-12);
    ASSERT_NEAR(squares, way.squaredNorm(), 1e-9 * (1.0 + squares));
  }
  // Orthogonal pushes keep their own parts.
  ContactShares right{{{0, 2.0 * Vector3d::UnitX(), {}}, {1, 3.0 * Vector3d::UnitZ(), {}}, {}}};
  share_way({2.0, 0.0, 3.0}, std::span(right).first(2));
  EXPECT_LT((right[0].way - 3.0 * Vector3d::UnitZ()).norm(), 1e-12);
  EXPECT_LT((right[1].way - 2.0 * Vector3d::UnitX()).norm(), 1e-12);
}

TEST(SharedContactPoint, AllocatesNothing) {
  const test::ScratchFolder folder;
  const World world = corners(folder)[4];
  const EffectPlan plan(world.scene);
  ContactSolver solver(plan);
  Wander hand(2, 0.01);
  const test::AllocationGuard guard;
  solver.reset({0.05, 0.04, 0.06});
  for (int i = 0; i < 1000; ++i) solver.step(hand.next());
  solver.reset({-0.01, -0.01, -0.01});
  EXPECT_EQ(guard.count(), 0u);
}

}  // namespace
}  // namespace reckon::haptics
