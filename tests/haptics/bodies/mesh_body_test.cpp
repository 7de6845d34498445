// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Moving meshes and solids: their inertia against formulas, at rest on everything that bodies meet,
// and in a hand as a box of the same size and mass.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "reckon/haptics/bodies/body_world.hpp"
#include "reckon/haptics/devices/simulated_device.hpp"
#include "reckon/haptics/geometry/solid_moments.hpp"
#include "reckon/haptics/servo/servo_loop.hpp"
#include "reckon/tests/support/scratch_folder.hpp"
#include "reckon/tests/support/touch_meshes.hpp"

namespace reckon::haptics::mesh_body_test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using std::chrono::nanoseconds;

constexpr nanoseconds kStep{1'000'000};

/// A box about `middle`, each side of n x n squares.
test::MeshData box_mesh(const Vector3d& size, const Vector3d& middle = Vector3d::Zero(),
                        int n = 1) {
  test::MeshData out;
  for (int side = 0; side < 6; ++side) {
    const int axis = side / 2, u = (axis + 1) % 3, v = (axis + 2) % 3;
    const double way = side % 2 == 0 ? -1.0 : 1.0;
    for (int i = 0; i < n; ++i) {
      for (int k = 0; k < n; ++k) {
        const auto first = static_cast<std::uint32_t>(out.vertices.size());
        for (int corner = 0; corner < 4; ++corner) {
          Vector3d p;
          p[axis] = way;
          p[u] = -1 + 2.0 * (i + (corner == 1 || corner == 2 ? 1 : 0)) / n;
          p[v] = -1 + 2.0 * (k + (corner > 1 ? 1 : 0)) / n;
          out.vertices.push_back(middle + 0.5 * p.cwiseProduct(size));
        }
        if (way > 0) {
          out.quad(first, first + 1, first + 2, first + 3);
        } else {
          out.quad(first, first + 3, first + 2, first + 1);
        }
      }
    }
  }
  return out;
}

SurfaceMesh as_drawn(const test::MeshData& data) {
  const test::ScratchFolder folder;
  test::write_obj(data, folder.file("mesh.obj"));
  MeshShape shape;
  shape.file = folder.file("mesh.obj");
  return SurfaceMesh::load(shape);
}

/// Objects of a scene, including meshes, and their world.
class Bench {
 public:
  explicit Bench(const Vector3d& gravity = {0, 0, -9.81}) { scene.gravity = gravity; }

  SceneObject& add(const std::string& name, const Shape& shape, const Vector3d& at, double mass) {
    SceneObject& object = scene.objects.emplace_back();
    object.name = name;
    object.shape = shape;
    object.pose.position = at;
    object.matter.mass = mass;
    object.effects.of<SpringDamper>() = {400.0, 0.0};
    return object;
  }
  SceneObject& mesh(const std::string& name, const test::MeshData& data, const Vector3d& at,
                    double mass) {
    test::write_obj(data, folder_.file(name + ".obj"));
    MeshShape shape;
    shape.file = folder_.file(name + ".obj");
    return add(name, shape, at, mass);
  }
  void floor() { add("floor", PlaneShape{Vector3d::UnitZ()}, Vector3d::Zero(), 0.0); }
  BodyWorld& begin() {
    plan = std::make_shared<const EffectPlan>(scene);
    world = std::make_shared<BodyWorld>(*plan, scene.gravity);
    world->advance_to(now);
    return *world;
  }
  void run(double seconds) {
    for (long i = 0; i < std::lround(1e3 * seconds); ++i) world->advance_to(now += kStep);
  }
  const BodyState& state(std::size_t body = 0) const { return world->states()[body]; }

  Scene scene;
  std::shared_ptr<const EffectPlan> plan;
  std::shared_ptr<BodyWorld> world;
  nanoseconds now{1'000'000'000};

 private:
  test::ScratchFolder folder_;
};

TEST(SolidMoments, OfABoxMatchTheFormulaAnywhere) {
  const Vector3d size(0.1, 0.06, 0.03), at(0.4, -0.2, 0.7);
  const test::MeshData data = box_mesh(size, at, 3);
  const SolidMoments moments = moments_of(as_drawn(data));
  EXPECT_NEAR(moments.volume, size.prod(), 1e-12);
  EXPECT_LT((moments.middle - at).norm(), 1e-12);
  Matrix3d right = Matrix3d::Zero();
  for (int k = 0; k < 3; ++k) right(k, k) = (size.squaredNorm() - size[k] * size[k]) / 12.0;
  EXPECT_LT((moments.inertia - right).norm(), 1e-12);
}

// A tetrahedron on the axes: its middle at a quarter, its products of inertia by formula.
TEST(SolidMoments, OfATetrahedronHaveItsProducts) {
  const test::MeshData data{{Vector3d::Zero(), {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                            {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
  const SolidMoments moments = moments_of(as_drawn(data));
  EXPECT_NEAR(moments.volume, 1.0 / 6, 1e-12);
  EXPECT_LT((moments.middle - Vector3d::Constant(0.25)).norm(), 1e-12);
  // For a mass of 1: the integral of x^2 is 1/10, of x y 1/20, both about the corner.
  const double square = 0.1 - 1.0 / 16, product = 0.05 - 1.0 / 16;
  EXPECT_NEAR(moments.inertia(0, 0), 2 * square, 1e-12);
  EXPECT_NEAR(moments.inertia(0, 1), -product, 1e-12);
}

TEST(MeshBody, RestsOnPlaneBoxMeshAndAnotherBody) {
  Bench bench;
  bench.floor();
  bench.add("table", BoxShape{{0.2, 0.2, 0.1}}, {0.5, 0, 0.05}, 0.0);
  bench.mesh("desk", box_mesh({0.2, 0.2, 0.1}), {1, 0, 0.05}, 0.0);
  const test::MeshData cube = box_mesh(Vector3d::Constant(0.04), Vector3d::Zero(), 2);
  bench.mesh("on the floor", cube, {0, 0, 0.0205}, 0.1);
  bench.mesh("on it", cube, {0.003, 0.002, 0.061}, 0.1);
  bench.mesh("on the table", cube, {0.5, 0, 0.1205}, 0.1);
  bench.mesh("on the desk", cube, {1, 0, 0.1205}, 0.1);
  bench.add("ball", SphereShape{0.02}, {1, 0.05, 0.1205}, 0.1);
  const BodyWorld& world = bench.begin();
  bench.run(3.0);
  const std::vector<double> heights{0.02, 0.06, 0.12, 0.12, 0.12};
  for (std::size_t i = 0; i < heights.size(); ++i) {
    EXPECT_NEAR(bench.state(i).position.z(), heights[i], 1e-4) << i;
    EXPECT_FALSE(bench.state(i).awake) << i;
  }
  EXPECT_EQ(world.states().size(), 5U);
}

TEST(SolidBody, RestsAtItsFormulasHeight) {
  Bench bench;
  bench.floor();
  const CylinderShape can{0.02, 0.06};
  bench.add("table", BoxShape{{0.2, 0.2, 0.1}}, {0.5, 0, 0.05}, 0.0);
  bench.add("drum", CylinderShape{0.1, 0.1}, {1, 0, 0.05}, 0.0);
  bench.add("standing", can, {0, 0, 0.0305}, 0.1);
  bench.add("on it", can, {0.002, 0.001, 0.0912}, 0.1);
  bench.add("lying", can, {0.2, 0, 0.0205}, 0.1).pose.orientation =
      Eigen::AngleAxisd(0.5 * std::numbers::pi, Vector3d::UnitX());
  bench.add("ring", TorusShape{0.03, 0.01}, {0.5, 0, 0.1105}, 0.1);
  bench.add("cone", ConeShape{0.03, 0.0, 0.05}, {1, 0, 0.1255}, 0.1);
  const BodyWorld& world = bench.begin();
  bench.run(3.0);
  const std::vector<double> heights{0.03, 0.09, 0.02, 0.11, 0.125};
  ASSERT_EQ(world.states().size(), heights.size());
  for (std::size_t i = 0; i < heights.size(); ++i) {
    EXPECT_NEAR(bench.state(i).position.z(), heights[i], 1e-4) << i;
    EXPECT_FALSE(bench.state(i).awake) << i;
  }
}

// Down a slope without slipping: two thirds of the acceleration of a sliding body.
TEST(SolidBody, CylinderRollsAsItsInertiaRequires) {
  const double angle = 0.15;
  Bench bench(9.81 * Vector3d(std::sin(angle), 0, -std::cos(angle)));
  bench.floor();
  SceneObject& can = bench.add("can", CylinderShape{0.03, 0.06}, {0, 0, 0.03}, 0.2);
  can.pose.orientation = Eigen::AngleAxisd(0.5 * std::numbers::pi, Vector3d::UnitX());
  can.matter.friction = bench.scene.objects[0].matter.friction = 0.8;
  bench.begin();
  bench.run(1.0);
  const double right = 2.0 / 3.0 * 9.81 * std::sin(angle);
  EXPECT_NEAR(bench.state().velocity.x(), right, 0.03 * right);
  EXPECT_NEAR(bench.state().turn_rate.norm() * 0.03, right, 0.03 * right);
  EXPECT_NEAR(bench.state().position.x(), 0.5 * right, 0.03 * right);
}

TEST(SolidBody, IsRefusedIfInfiniteOrTooThin) {
  for (const auto& [size, word] :
       {std::pair{Vector3d(0.5, 0.5, 1e-4), "thicker"}, {Vector3d::Constant(0.05), ""}}) {
    Bench bench;
    CsgShape shape;
    shape.parts.emplace_back().shape = BoxShape{size};
    bench.add("plate", shape, Vector3d::Zero(), 0.1);
    std::string told;
    try {
      bench.begin();
    } catch (const std::invalid_argument& error) {
      told = error.what();
    }
    EXPECT_EQ(told.empty(), *word == 0) << told;
    EXPECT_NE(told.find(word), std::string::npos) << told;
    EXPECT_EQ(told.find("'plate'") == std::string::npos, told.empty()) << told;
  }
  Bench bench;
  CsgShape half;
  half.parts.emplace_back().shape = PlaneShape{Vector3d::UnitX()};
  bench.add("half", half, Vector3d::Zero(), 0.1);
  EXPECT_THROW(bench.begin(), std::invalid_argument);
}

// Its origin is not its centre of mass: it turns about the latter, and falls with it.
TEST(MeshBody, TurnsAboutItsCentreOfMass) {
  const Vector3d middle(0.03, -0.01, 0.02);
  Bench bench(Vector3d::Zero());
  bench.mesh("bar", box_mesh({0.1, 0.03, 0.02}, middle), {0.2, 0, 0}, 0.2);
  BodyWorld& world = bench.begin();
  world.push(0, Vector3d(0.2, 0, 0) + middle + Vector3d(0, 0.015, 0), {20, 0, 0});
  bench.run(0.001);
  const auto middle_now = [&] {
    return Vector3d(bench.state().position + bench.state().orientation * middle);
  };
  const Vector3d from = middle_now();
  EXPECT_NEAR(bench.state().turn_rate.z(), -20e-3 * 0.015 / (0.2 * (0.01 + 0.0009) / 12), 1e-6);
  bench.run(0.5);
  EXPECT_LT((middle_now() - from - 0.5 * Vector3d(0.1, 0, 0)).norm(), 1e-6);
  EXPECT_NEAR(
      world.energy(),
      0.5 * 0.2 * 0.01 + 0.5 * 0.2 * (0.0109) / 12 * std::pow(bench.state().turn_rate.z(), 2),
      1e-9);
}

// Crossed bars; no corner of either is in the other.
TEST(MeshBody, RestsAcrossAnother) {
  Bench bench;
  bench.floor();
  bench.mesh("lower", box_mesh({0.2, 0.03, 0.03}), {0, 0, 0.0151}, 0.2);
  bench.mesh("upper", box_mesh({0.03, 0.2, 0.03}), {0, 0, 0.0455}, 0.2);
  bench.begin();
  bench.run(3.0);
  EXPECT_NEAR(bench.state(1).position.z(), 0.045, 2e-4);
  EXPECT_FALSE(bench.state(1).awake);
}

// Thrown into a heap: none is lost, none gains energy.
TEST(MeshBody, HeapNeverGainsEnergy) {
  Bench bench;
  bench.floor();
  std::mt19937 random(5);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  for (int i = 0; i < 9; ++i) {
    SceneObject& one = bench.mesh("m" + std::to_string(i), box_mesh({0.04, 0.03, 0.05}),
                                  {0.05 * (i % 3), 0.05 * (i / 3), 0.06 + 0.01 * any(random)}, 0.1);
    one.pose.orientation = Eigen::Quaterniond::UnitRandom();
  }
  std::srand(1);
  const BodyWorld& world = bench.begin();
  double least = world.energy();
  for (int i = 0; i < 4'000; ++i) {
    bench.run(0.001);
    ASSERT_LE(world.energy(), least + 1e-4) << i;
    least = std::min(least, world.energy());
  }
  for (const BodyState& state : world.states()) {
    EXPECT_GT(state.position.z(), 0.01);
    EXPECT_LT(state.position.z(), 0.2);
  }
}

// Squeezed by two hands, compared with a box of its size and mass.
TEST(MeshBody, FeelsLikeABoxOfEqualMass) {
  std::vector<std::vector<double>> felt;
  for (const bool is_mesh : {false, true}) {
    Bench bench(Vector3d::Zero());
    if (is_mesh) {
      bench.mesh("cube", box_mesh(Vector3d::Constant(0.04)), Vector3d::Zero(), 0.05);
    } else {
      bench.add("cube", BoxShape{Vector3d::Constant(0.04)}, Vector3d::Zero(), 0.05);
    }
    bench.begin();
    std::vector<std::unique_ptr<SimulatedDevice>> devices;
    std::vector<std::unique_ptr<ServoLoop>> servos;
    for (const double side : {-1.0, 1.0}) {
      SimulatedDeviceConfig config;
      config.start.x() = 0.03 * side;
      devices.push_back(std::make_unique<SimulatedDevice>(config, [side](double t) {
        HandTarget target;
        target.position.x() = side * (0.03 - 0.02 * std::min(1.0, t)) +
                              (t > 1.5 ? 0.02 * std::sin(9.0 * (t - 1.5)) : 0.0);
        return target;
      }));
      servos.push_back(
          std::make_unique<ServoLoop>(*devices.back(), bench.plan, ServoConfig{}, bench.world));
    }
    std::vector<double>& forces = felt.emplace_back();
    for (int i = 0; i < 4'000; ++i) {
      bench.now += kStep;
      for (auto& servo : servos) servo->step(bench.now);
      ASSERT_TRUE(servos[0]->snapshots().update());
      const ServoSnapshot& step = servos[0]->snapshots().read();
      EXPECT_GE(step.port_energy_min, -1e-9);
      forces.push_back(step.force.x());
    }
  }
  double error = 0.0, size = 0.0;
  for (std::size_t i = 0; i < felt[0].size(); ++i) {
    error += std::pow(felt[0][i] - felt[1][i], 2);
    size += std::pow(felt[0][i], 2);
  }
  EXPECT_GT(std::sqrt(size / 4'000), 0.5);
  EXPECT_LT(std::sqrt(error / size), 0.01);
}

TEST(MeshBody, OpenMeshIsRefusedByName) {
  Bench bench;
  test::MeshData open = box_mesh(Vector3d::Constant(0.04));
  open.triangles.pop_back();
  bench.mesh("bowl", open, Vector3d::Zero(), 0.1);
  try {
    bench.begin();
    FAIL() << "an open mesh has no mass";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("'bowl'"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("close it"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace reckon::haptics::mesh_body_test
