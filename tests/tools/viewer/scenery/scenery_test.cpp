// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "reckon/tools/viewer/scenery/heard_cells.hpp"
#include "reckon/tools/viewer/scenery/solid_shapes.hpp"

namespace reckon::tools {
namespace {

peer::AoimConfig squares() {
  peer::AoimConfig config;
  config.scheme = aoim::CellScheme::square;
  config.cell = 10;
  config.radius = 12;
  return config;
}

EntityMark mark_at(std::uint16_t slot, float x, float y) {
  EntityMark mark;
  mark.slot = slot;
  mark.position = {x, y, 0};
  return mark;
}

TEST(HeardCells, SayWhoHearsTheCellOfTheOneThatIsFollowed) {
  HeardCells cells(squares());
  std::vector<EntityMark> marks{mark_at(1, 5, 5), mark_at(2, 16, 5), mark_at(3, 95, 5)};
  cells.place(marks);
  EXPECT_NE(marks[0].cell, marks[1].cell);
  const auto message = nlohmann::json::parse(cells.message(marks, 1));
  EXPECT_EQ(message["type"], "cells");
  EXPECT_EQ(message["shape"], "square");
  EXPECT_EQ(message["size"], 10);
  std::size_t heard = 0;
  bool is_there = false;
  for (const auto& cell : message["cells"]) {
    const auto& by = cell["heard_by"];
    if (std::find(by.begin(), by.end(), 1) != by.end()) ++heard;
    if (cell["cell"] != marks[0].cell) continue;
    is_there = true;
    EXPECT_EQ(by, nlohmann::json({1, 2}));
    EXPECT_NEAR(cell["x"].get<double>(), 5, 1e-9);
  }
  EXPECT_TRUE(is_there);
  EXPECT_EQ(heard, 9U);  // 12 m about the middle of a cell of 10 m
}

TEST(HeardCells, HaveNoNumberForAPlaceThatIsNone) {
  HeardCells cells(squares());
  std::vector<EntityMark> marks{mark_at(1, std::numeric_limits<float>::quiet_NaN(), 0)};
  cells.place(marks);
  EXPECT_EQ(marks[0].cell, kNoNumber);
  EXPECT_EQ(nlohmann::json::parse(cells.message(marks, 1))["cells"].size(), 0U);
}

TEST(SolidShapes, DrawEveryKindOfSolid) {
  haptics::Scene scene;
  const auto add = [&](const haptics::Shape& shape) {
    scene.objects.push_back({"solid", shape, {}, {}, {}});
  };
  add(haptics::SphereShape{});
  add(haptics::BoxShape{});
  add(haptics::PlaneShape{Eigen::Vector3d::UnitX()});
  add(haptics::CylinderShape{0.03, 0.1});
  add(haptics::ConeShape{});
  add(haptics::TorusShape{0.04, 0.01});
  add(haptics::EllipsoidShape{Eigen::Vector3d(0.06, 0.04, 0.03)});
  add(haptics::CsgShape{{{haptics::CsgOperation::add, haptics::SphereShape{}},
                         {haptics::CsgOperation::subtract, haptics::BoxShape{}}}});
  const auto solids = drawn_solids(scene);
  ASSERT_EQ(solids.size(), 8U);
  EXPECT_EQ(solids[0].shape, "sphere");
  EXPECT_EQ(solids[1].shape, "box");
  EXPECT_EQ(solids[2].shape, "plane");
  const Eigen::Vector3d up = solids[2].pose.orientation * Eigen::Vector3d::UnitZ();
  EXPECT_LT((up - Eigen::Vector3d::UnitX()).norm(), 1e-12);
  for (const std::size_t i : {3U, 4U, 5U, 6U}) {
    EXPECT_EQ(solids[i].shape, "mesh");
    for (const auto& triangle : solids[i].triangles)
      for (const std::uint32_t corner : triangle) EXPECT_LT(corner, solids[i].vertices.size());
  }
  for (const Eigen::Vector3d& p : solids[5].vertices)
    EXPECT_NEAR(std::hypot(std::hypot(p.x(), p.y()) - 0.04, p.z()), 0.01, 1e-12);
  for (const Eigen::Vector3d& p : solids[6].vertices)
    EXPECT_NEAR(p.cwiseQuotient(Eigen::Vector3d(0.06, 0.04, 0.03)).norm(), 1, 1e-12);
  EXPECT_EQ(solids[7].shape, "sphere") << "a part that is taken away is not drawn";
}

TEST(SolidShapes, DrawTheBoxOfAMeshThatCannotBeRead) {
  haptics::Scene scene;
  scene.objects.push_back({"lost", haptics::MeshShape{"/none.obj", 0.2}, {}, {}, {}});
  const auto solids = drawn_solids(scene);
  ASSERT_EQ(solids.size(), 1U);
  EXPECT_EQ(solids[0].shape, "box");
}

}  // namespace
}  // namespace reckon::tools
