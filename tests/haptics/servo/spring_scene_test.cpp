// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/haptics/servo/spring_scene.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>

#include "reckon/haptics/effects/stick_slip_friction.hpp"

namespace reckon::haptics {
namespace {

using Eigen::Vector3d;
using ::testing::HasSubstr;

SceneObject solid(const std::string& name, const Shape& shape, const Vector3d& at) {
  SceneObject object;
  object.name = name;
  object.shape = shape;
  object.pose.position = at;
  object.effects.of<SpringDamper>().stiffness = 500;
  return object;
}

Scene scene_of(SceneObject object) {
  Scene scene;
  scene.objects.push_back(std::move(object));
  return scene;
}

SpringScene felt(const Scene& scene, int axes = 2, const ServoConfig& config = {}) {
  return SpringScene(EffectPlan(scene), config, axes, 1000);
}

const SpringWall kNone{};

TEST(SpringScene, PlaneIsAWallForAnyHandPosition) {
  SpringScene scene = felt(scene_of(solid("wall", PlaneShape{Vector3d::UnitX()}, {-0.02, 0, 0})));
  for (const double x : {0.05, -0.01, -0.03, -0.5}) {
    const SpringModel model = scene.walls_at({x, 0, 0}, 7);
    EXPECT_EQ(model.wall(0, WallSide::below), (SpringWall{-0.02, 500, 7})) << x;
    EXPECT_EQ(model.wall(0, WallSide::above), kNone);
    EXPECT_EQ(model.wall(1, WallSide::below), kNone);
  }
}

TEST(SpringScene, NearerOfTwoWallsApplies) {
  Scene scene = scene_of(solid("far", PlaneShape{-Vector3d::UnitY()}, {0, 0.04, 0}));
  scene.objects.push_back(solid("near", PlaneShape{-Vector3d::UnitY()}, {0, 0.03, 0}));
  SpringScene walls = felt(scene);
  EXPECT_EQ(walls.walls_at({0, 0, 0}, 1).wall(1, WallSide::above).at, 0.03);
}

TEST(SpringScene, BoxHasTheFaceAhead) {
  const Scene scene = scene_of(solid("box", BoxShape{{0.02, 0.04, 0.02}}, {0.05, 0, 0}));
  SpringScene walls = felt(scene);
  SpringModel model = walls.walls_at({0, 0.01, 0}, 1);
  EXPECT_NEAR(model.wall(0, WallSide::above).at, 0.04, 1e-15);
  EXPECT_EQ(model.wall(1, WallSide::below), kNone);
  model = walls.walls_at({0.05, 0.05, 0}, 1);
  EXPECT_NEAR(model.wall(1, WallSide::below).at, 0.02, 1e-15);
  EXPECT_EQ(model.wall(0, WallSide::above), kNone);
  EXPECT_EQ(walls.walls_at({0, 0.05, 0}, 1), SpringModel()) << "beside an edge";
}

TEST(SpringScene, HandInsideABoxStaysAtEntryFace) {
  const Scene scene = scene_of(solid("box", BoxShape{{0.02, 0.04, 0.02}}, {0.05, 0, 0}));
  SpringScene walls = felt(scene);
  static_cast<void>(walls.walls_at({0.039, 0, 0}, 1));
  const SpringModel model = walls.walls_at({0.058, 0, 0}, 1);  // the far face is nearer
  EXPECT_NEAR(model.wall(0, WallSide::above).at, 0.04, 1e-15);
  EXPECT_EQ(model.wall(0, WallSide::below), kNone);
}

TEST(SpringScene, AxesOutsideTheDeviceSelectObstacles) {
  const Shape box = BoxShape{Vector3d::Constant(0.02)};
  EXPECT_EQ(felt(scene_of(solid("high", box, {0, 0, 0.03}))).walls_at({0.02, 0, 0}, 1),
            SpringModel());
  EXPECT_NE(felt(scene_of(solid("level", box, {0, 0, 0.005}))).walls_at({0.02, 0, 0}, 1),
            SpringModel());
  EXPECT_EQ(felt(scene_of(solid("aside", box, {0, 0.03, 0})), 1).walls_at({0.02, 0, 0}, 1),
            SpringModel());
}

TEST(SpringScene, DeviceMayBeTurnedAndMoved) {
  ServoConfig config;
  config.device_origin = {1, 2, 3};
  // x of the device is z of the scene.
  config.device_orientation =
      Eigen::Quaterniond(Eigen::AngleAxisd(-std::numbers::pi / 2, Vector3d::UnitY()));
  SpringScene walls =
      felt(scene_of(solid("floor", PlaneShape{Vector3d::UnitZ()}, {0, 0, 2.98})), 1, config);
  const SpringModel model = walls.walls_at({0, 0, 0}, 1);
  EXPECT_NEAR(model.wall(0, WallSide::below).at, -0.02, 1e-12);
}

TEST(SpringScene, StiffSurfacesHaveTheDevicesStiffness) {
  SceneObject object = solid("hard", PlaneShape{Vector3d::UnitX()}, {-0.02, 0, 0});
  object.effects.of<SpringDamper>().stiffness = 5000;
  SpringScene walls = felt(scene_of(object));
  EXPECT_EQ(walls.walls_at({0, 0, 0}, 1).wall(0, WallSide::below).stiffness, 1000);
}

TEST(SpringScene, UnsupportedObjectsAreRefusedByName) {
  const Shape plane = PlaneShape{Vector3d::UnitX()};
  const Vector3d at{-0.02, 0, 0};
  const auto refused = [](const Scene& scene) -> std::string {
    try {
      static_cast<void>(felt(scene));
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "nothing is refused";
  };
  EXPECT_THAT(refused(scene_of(solid("ramp", PlaneShape{{1, 1, 0}}, at))),
              HasSubstr("'ramp' has faces that are not perpendicular"));
  EXPECT_THAT(refused(scene_of(solid("ball", SphereShape{0.01}, at))),
              HasSubstr("'ball' is neither a plane nor a box"));
  EXPECT_THAT(refused(scene_of(solid("table", PlaneShape{Vector3d::UnitZ()}, {0, 0, 0.01}))),
              HasSubstr("'table' encloses the handle"));
  EXPECT_EQ(refused(scene_of(solid("table", PlaneShape{Vector3d::UnitZ()}, {0, 0, -0.01}))),
            "nothing is refused");
  SceneObject rough = solid("rough", plane, at);
  rough.effects.of<StickSlipFriction>() = Friction{0.5, 0.4};
  EXPECT_THAT(refused(scene_of(rough)), HasSubstr("'rough' has an effect besides its surface"));
  SceneObject damped = solid("damped", plane, at);
  damped.effects.of<SpringDamper>().damping = 1;
  EXPECT_THAT(refused(scene_of(damped)), HasSubstr("'damped' has damping"));
  SceneObject body = solid("body", BoxShape{}, at);
  body.matter.mass = 1;
  EXPECT_THAT(refused(scene_of(body)), HasSubstr("'body' moves"));
  Scene wind;
  wind.regions.push_back({});
  wind.regions.back().name = "wind";
  EXPECT_THAT(refused(wind), HasSubstr("'wind' is a region"));
}

}  // namespace
}  // namespace reckon::haptics
