// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "reckon/aoim/leader/beacon_book.hpp"
#include "reckon/pdu/reckon/cell_roles.hpp"
#include "reckon/peer/scene/scene_cells.hpp"
#include "reckon/tests/support/capture_builder.hpp"
#include "reckon/tests/support/scratch_folder.hpp"
#include "reckon/tests/tools/support/driven_trucks.hpp"
#include "reckon/tools/viewer/history/history.hpp"
#include "reckon/tools/viewer/scenery/drawn_groups.hpp"
#include "reckon/tools/viewer/scenery/shown_thresholds.hpp"
#include "reckon/tools/viewer/scenery/solid_shapes.hpp"
#include "reckon/tools/viewer/scenery/subscribed_cells.hpp"

namespace reckon::tools {
namespace {

peer::AoimConfig squares() {
  peer::AoimConfig config;
  config.scheme = aoim::CellScheme::square;
  config.cell = 10;
  config.radius = 12;
  return config;
}

EntityMark mark_at(std::uint16_t slot, double x, double y) {
  EntityMark mark;
  mark.slot = slot;
  mark.position = {x, y, 0};
  return mark;
}

TEST(SubscribedCells, NameTheSubscribersOfTheFollowedCell) {
  SubscribedCells cells(squares());
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
  EXPECT_EQ(heard, 9U);  // 12 m about the centre of a cell of 10 m
}

TEST(SubscribedCells, HaveNoNumberForAnInvalidPosition) {
  SubscribedCells cells(squares());
  std::vector<EntityMark> marks{mark_at(1, std::numeric_limits<float>::quiet_NaN(), 0)};
  cells.place(marks);
  EXPECT_EQ(marks[0].cell, kNoNumber);
  EXPECT_EQ(nlohmann::json::parse(cells.message(marks, 1))["cells"].size(), 0U);
}

constexpr const char* kGate = R"(
[aoim]
scheme = "square"
cell = "10 m"
radius = "12 m"
leaders = true
hand_out = true
follow = "ferry"
[[entity]]
marking = "gate"
type = "1.1"
beacon = "gate"
)";

/// Roles of peer 1:2 that carries a beacon in this cell.
test::Octets roles(std::string_view name, aoim::CellId cell) {
  pdu::CellRoles roles;
  test::Octets one(pdu::kFixedSize<pdu::CellRole>), octets;
  pdu::CellRole role;
  role.column = cell.q;
  role.row = cell.r;
  role.beacon = aoim::beacon_tag(name);
  EXPECT_GT(pdu::store_record(role, one), 0U);
  roles.roles = one;
  roles.simulation = {1, 2};
  test::append_pdu(octets, roles);
  return octets;
}

/// A distant cell with the same number.
aoim::CellId same_number(const aoim::CellPartition& cells, aoim::CellId cell) {
  aoim::CellId other = cell;
  do ++other.q;
  while (cells.group(other) != cells.group(cell));
  return other;
}

TEST(DrawnGroups, PutABeaconInItsOwnersCell) {
  const peer::SceneFile scene = peer::parse_scene_file(kGate, "gate.toml");
  ASSERT_TRUE(DrawnGroups::has_any(scene));
  using std::chrono::seconds;
  History history(HistoryOptions{});  // has truck 1:2:1 at slot 0
  trucks::Sent sent{{}, trucks::kStart};
  test::append_pdu(sent.octets, trucks::truck(1, 0));
  ASSERT_TRUE(history.take(trucks::datagram_of(sent)));
  const std::vector<EntityMark> marks{mark_at(7, 5, 5), mark_at(0, 23, -4)};
  const aoim::CellPartition cells = peer::cells_of(scene.aoim);
  ReceivedGroups received{GroupTiers(scene.network, scene.aoim)};
  received.take_roles(roles("gate", same_number(cells, {2, -1})), seconds(105));
  received.take_roles(roles("stranger", {2, -1}), seconds(104));
  received.take_roles(roles("ferry", {2, -1}), seconds(100));
  received.take_roles(roles("nowhere", {0, 0}), seconds(105));
  const auto message = nlohmann::json::parse(
      DrawnGroups(scene).message(received, history.roster(), marks, seconds(106), seconds(100)));
  EXPECT_EQ(message["type"], "groups");
  ASSERT_EQ(message["beacons"].size(), 2U) << "one is silent, one where its owner has nothing";
  for (const auto& beacon : message["beacons"]) {
    const bool is_ours = beacon["name"] == "gate";
    EXPECT_TRUE(is_ours || beacon["name"].get<std::string>().starts_with("beacon "));
    EXPECT_EQ(beacon["x"], 25);
    EXPECT_EQ(beacon["y"], -5);
    EXPECT_EQ(beacon["heard"], is_ours ? 5 : 4);
    EXPECT_EQ(beacon["peer"], "1:2");
  }
}

TEST(DrawnGroups, ListTheSendersOfAGroup) {
  const peer::SceneFile scene =
      peer::parse_scene_file("[aoim]\npool = 4\n[[aoim.tier]]\nto = \"touch\"\n", "touch.toml");
  ASSERT_TRUE(DrawnGroups::has_any(scene));
  ReceivedGroups received{GroupTiers(scene.network, scene.aoim)};
  for (const std::uint16_t slot : {std::uint16_t{3}, std::uint16_t{8}})
    received.note_update(slot, peer::IpEndpoint::v4(0xEFC00106, 3000), {});
  const History history(HistoryOptions{});
  const auto message =
      nlohmann::json::parse(DrawnGroups(scene).message(received, history.roster(), {}, {}, {}));
  EXPECT_EQ(message["groups"],
            nlohmann::json::parse(R"([{"tier":"contact","group":6,"slots":[3,8]}])"));
  EXPECT_FALSE(DrawnGroups::has_any(peer::parse_scene_file("[aoim]\npool = 4\n", "plain.toml")));
}

TEST(SolidShapes, DrawRegionsThatHaveAShape) {
  haptics::Scene scene;
  scene.regions.resize(3);
  scene.regions[0].name = "pool";
  scene.regions[0].shape = haptics::BoxShape{{1, 2, 3}};
  scene.regions[0].pose.position = {4, 5, 6};
  scene.regions[1].name = "wind";
  scene.regions[2].name = "magnet";
  scene.regions[2].shape = haptics::SphereShape{0.2};
  const auto regions = drawn_regions(scene);
  ASSERT_EQ(regions.size(), 2U);
  EXPECT_EQ(regions[0].name, "pool");
  EXPECT_EQ(regions[0].size, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(regions[0].pose.position, Eigen::Vector3d(4, 5, 6));
  EXPECT_EQ(regions[1].radius, 0.2);
}

TEST(SolidShapes, PlaneFacesItsNormal) {
  const std::array normals{Eigen::Vector3d(0, 0, 1), Eigen::Vector3d(0, 0, -1),
                           Eigen::Vector3d(1e-7, -1e-7, -1), Eigen::Vector3d(-1e-12, 0, 1),
                           Eigen::Vector3d(-1, 2, -2)};
  for (const Eigen::Vector3d& given : normals) {
    const Eigen::Vector3d normal = given.normalized();
    haptics::Scene scene;
    scene.objects.push_back({"plane", haptics::PlaneShape{normal}, {}, {}, {}});
    const Eigen::Quaterniond turn = drawn_solids(scene).at(0).pose.orientation;
    EXPECT_NEAR(turn.norm(), 1, 1e-12) << normal.transpose();
    EXPECT_LT((turn * Eigen::Vector3d::UnitZ() - normal).norm(), 1e-12) << normal.transpose();
  }
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

/// Two sides of a box, each with its material, and a third without.
constexpr const char* kPad = R"(
v 0 0 0
v 1 0 0
v 1 1 0
v 0 1 0
v 0 0 1
v 1 0 1
usemtl felt
f 1 2 3
usemtl steel
f 1 3 4
usemtl bare
f 1 2 6
)";

TEST(SolidShapes, NumberPatchesAndFindTheTouchedOne) {
  const std::string file = testing::TempDir() + "reckon_pad.obj";
  std::ofstream(file) << kPad;
  haptics::Scene scene;
  haptics::SceneObject object;
  object.shape = haptics::MeshShape{file, 0.1};
  object.patches = {{"steel", {}, {}}, {"felt", {}, {}}};
  scene.objects = {{"ball", haptics::SphereShape{}, {}, {}, {}}, object, object};
  scene.objects[2].pose.position.x() = 1;
  const auto solids = drawn_solids(scene);
  ASSERT_EQ(solids.size(), 3U);
  EXPECT_EQ(solids[0].first_patch, 0) << "no patches, no number";
  EXPECT_EQ(solids[1].patch_names, (std::vector<std::string>{"felt", "steel"})) << "of the file";
  EXPECT_EQ(solids[1].patches, (std::vector<std::uint16_t>{1, 2, 0}));
  EXPECT_EQ(solids[1].patches.size(), solids[1].triangles.size());
  EXPECT_EQ(solids[1].first_patch, 1);
  EXPECT_EQ(solids[2].first_patch, 4);
  EXPECT_EQ(touched_patch(solids, 2, {0.1, 0, 0}), 3) << "steel of the near one";
  EXPECT_EQ(touched_patch(solids, 2, {0.9, 0, 0}), 6);
  EXPECT_EQ(touched_patch(solids, 0, {0.9, 0, 0}), 0) << "in no patch";
  EXPECT_EQ(touched_patch(solids, 9, {0.9, 0, 0}), 0);
}

TEST(ShownThresholds, AreAtMostThreeOrTheEntitysOwn) {
  const auto scene = [](std::string_view more) {
    return peer::parse_scene_file(fmt::format("[dead_reckoning]\nposition = \"0.5 mm\"\n{}", more),
                                  "thresholds.toml");
  };
  EXPECT_EQ(ShownThresholds(scene("")).told(), (std::vector<double>{0.0005}));
  const auto entity = [](std::string_view marking, std::string_view position) {
    return fmt::format(
        "[[entity]]\nmarking = \"{}\"\ntype = \"1.1\"\ndead_reckoning = {{position = \"{}\"}}\n",
        marking, position);
  };
  const ShownThresholds one(scene(entity("A", "2 m") + entity("B", "2 m")));
  EXPECT_EQ(one.told(), (std::vector<double>{2})) << "there are no hands";
  const ShownThresholds many(scene("[[operator]]\npassive = true\n" + entity("A", "2 m") +
                                   entity("B", "5 m") + entity("B", "6 m") + entity("C", "9 m")));
  EXPECT_EQ(many.told(), (std::vector<double>{0.0005, 5, 9}));
  EXPECT_EQ(many.of("A", false), 2);
  EXPECT_EQ(many.of("B", false), std::nullopt) << "there are two of that name";
  EXPECT_EQ(many.of("HAND1", true), 0.0005);
  EXPECT_EQ(many.of("stranger", false), std::nullopt);
}

TEST(SolidShapes, SimplifyAPictureWithTooManyTriangles) {
  const test::ScratchFolder folder;
  std::ofstream(folder.file("land.pgm")) << "P5 200 100 255\n" << std::string(200 * 100, 'a');
  haptics::Scene scene;
  scene.objects.push_back(
      {"land", haptics::HeightsShape{folder.file("land.pgm"), 0.2, 0.0, 0.02, 0.01}, {}, {}, {}});
  const auto whole = drawn_solids(scene), coarse = drawn_solids(scene, 3000);
  EXPECT_EQ(whole[0].triangles.size(), 2U * 199 * 99 + 3 * 2 * 298);
  ASSERT_EQ(coarse[0].shape, "mesh");
  EXPECT_LE(coarse[0].triangles.size(), 3000U);
  EXPECT_GE(coarse[0].triangles.size(), 1000U);
  const auto extent = [](const DrawnSolid& solid) {
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3d& vertex : solid.vertices) box.extend(vertex);
    return Eigen::Vector3d(box.sizes());
  };
  EXPECT_LT((extent(whole[0]) - extent(coarse[0])).norm(), 1e-12);
  scene.objects[0].shape = haptics::HeightsShape{"/none.pgm"};
  EXPECT_EQ(drawn_solids(scene)[0].shape, "box");
}

TEST(SolidShapes, DrawTheBoxOfAnUnreadableMesh) {
  haptics::Scene scene;
  scene.objects.push_back({"lost", haptics::MeshShape{"/none.obj", 0.2}, {}, {}, {}});
  const auto solids = drawn_solids(scene);
  ASSERT_EQ(solids.size(), 1U);
  EXPECT_EQ(solids[0].shape, "box");
}

}  // namespace
}  // namespace reckon::tools
