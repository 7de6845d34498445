// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Cylinders, cones, rings, ellipsoids and solids of parts in scene files.
#include "reckon/peer/scene/solid_section.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <variant>

#include "reckon/peer/scene/scene_file.hpp"
#include "reckon/tests/src/support/refusal.hpp"

namespace reckon::peer {
namespace {

using test::refusal;
using testing::HasSubstr;

SceneFile scene(const std::string& text) { return parse_scene_file(text, "x.toml"); }

TEST(SolidSection, ReadsEachPrimitive) {
  const SceneFile file = scene(R"(
[[object]]
name = "a"
cylinder = {radius = "20 mm", height = "5 cm"}
[[object]]
name = "b"
cone = {radius = "20 mm", top_radius = "1 cm", height = "5 cm"}
[[object]]
name = "c"
torus = {radius = "30 mm", tube = "1 cm"}
[[object]]
name = "d"
ellipsoid = "30 20 10 mm"
)");
  const auto& objects = file.scene.objects;
  EXPECT_EQ(std::get<haptics::CylinderShape>(objects.at(0).shape).radius, 0.02);
  EXPECT_EQ(std::get<haptics::CylinderShape>(objects.at(0).shape).height, 0.05);
  EXPECT_EQ(std::get<haptics::ConeShape>(objects.at(1).shape).top_radius, 0.01);
  EXPECT_EQ(std::get<haptics::TorusShape>(objects.at(2).shape).tube, 0.01);
  EXPECT_EQ(std::get<haptics::EllipsoidShape>(objects.at(3).shape).semi_axes,
            Eigen::Vector3d(0.03, 0.02, 0.01));
}

TEST(SolidSection, ReadsTheStepsOfASolidInOrder) {
  const SceneFile file = scene(R"(
[[object]]
name = "plate"
part = [
  {box = "100 60 10 mm"},
  {operation = "subtract", cylinder = {radius = "1 cm", height = "5 cm"}, position = "20 0 0 mm", orientation = ["90 deg", 0, 0], rounding = "2 mm"},
  {operation = "intersect", plane = [0, 0, 1]},
]
)");
  const auto& parts = std::get<haptics::CsgShape>(file.scene.objects.at(0).shape).parts;
  ASSERT_EQ(parts.size(), 3u);
  EXPECT_EQ(parts[0].operation, haptics::CsgOperation::add);
  EXPECT_EQ(std::get<haptics::BoxShape>(parts[0].shape).size, Eigen::Vector3d(0.1, 0.06, 0.01));
  EXPECT_EQ(parts[1].operation, haptics::CsgOperation::subtract);
  EXPECT_EQ(parts[1].position, Eigen::Vector3d(0.02, 0.0, 0.0));
  EXPECT_EQ(parts[1].rounding, 0.002);
  EXPECT_LT((parts[1].orientation * Eigen::Vector3d::UnitY() - Eigen::Vector3d::UnitZ()).norm(),
            1e-15);
  EXPECT_TRUE(std::holds_alternative<haptics::PlaneShape>(parts[2].shape));
}

TEST(SolidSection, HashDependsOnEveryNumberOfASolid) {
  const auto hash = [](const std::string& part) {
    return scene("[[object]]\nname = \"a\"\npart = [{box = \"10 10 10 cm\"}, {" + part + "}]\n")
        .hash;
  };
  const auto first = hash("sphere = \"6 cm\"");
  EXPECT_NE(hash("sphere = \"7 cm\""), first);
  EXPECT_NE(hash("sphere = \"6 cm\", operation = \"intersect\""), first);
  EXPECT_NE(hash("sphere = \"6 cm\", rounding = \"1 mm\""), first);
  EXPECT_NE(hash("sphere = \"6 cm\", position = \"1 0 0 mm\""), first);
  EXPECT_EQ(hash("sphere = \"60 mm\", operation = \"add\""), first);
}

TEST(SolidSection, RefusesInvalidSolidsAtTheirPlace) {
  const std::string object = "[[object]]\nname = \"a\"\n";
  EXPECT_THAT(refusal(object + "torus = {radius = \"4 mm\", tube = \"10 mm\"}\n"),
              HasSubstr("x.toml:3:9: torus: tube must be above 0 m"));
  EXPECT_THAT(refusal(object + "cylinder = {radius = \"4 mm\"}\n"), HasSubstr("needs 'height'"));
  EXPECT_THAT(refusal(object + "ellipsoid = \"10 -2 3 mm\"\n"), HasSubstr("x.toml:3:"));
  EXPECT_THAT(refusal(object + "part = [{operation = \"subtract\", sphere = \"1 cm\"}]\n"),
              HasSubstr("the first part has no previous part"));
  EXPECT_THAT(refusal(object + "part = []\n"), HasSubstr("a solid needs parts"));
  EXPECT_THAT(refusal(object + "part = [{}]\n"), HasSubstr("its shape is missing"));
  EXPECT_THAT(refusal(object + "sphere = \"1 cm\"\npart = [{sphere = \"1 cm\"}]\n"),
              HasSubstr("is given twice, by sphere and part"));
  EXPECT_THAT(refusal(object + "part = [{sphere = \"1 cm\"}, {operation = \"intersect\", "
                               "sphere = \"1 cm\", position = \"1 0 0 m\"}]\n"),
              HasSubstr("leave no volume"));
  std::string many;
  for (int i = 0; i < 33; ++i) many += "{sphere = \"1 cm\"},";
  EXPECT_THAT(refusal(object + "part = [" + many + "]\n"), HasSubstr("more than 32 parts"));
}

}  // namespace
}  // namespace reckon::peer
