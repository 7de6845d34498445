// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// [[node]] in scene files: poses, copies, switches, refusals and the hash.
#include "reckon/peer/scene/node_section.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <numbers>
#include <string>
#include <variant>
#include <vector>

#include "reckon/peer/scene_graph/scene_nodes.hpp"
#include "reckon/tests/src/support/refusal.hpp"

namespace reckon::peer::node_section_test {
namespace {

using test::refusal;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

SceneFile parsed(const std::string& text) { return parse_scene_file(text, "x.toml"); }

std::string node(const std::string& name, const std::string& lines = "") {
  return fmt::format("[[node]]\nname = \"{}\"\n{}", name, lines);
}

std::string ball(const std::string& name, const std::string& on, const std::string& lines = "") {
  return fmt::format("[[object]]\nname = \"{}\"\nsphere = \"1 cm\"\n{}{}", name,
                     on.empty() ? "" : fmt::format("node = \"{}\"\n", on), lines);
}

std::vector<std::string> names_of(const std::vector<haptics::SceneObject>& objects) {
  std::vector<std::string> names;
  for (const haptics::SceneObject& object : objects) names.push_back(object.name);
  return names;
}

std::vector<std::string> nodes_of(const SceneFile& file) {
  std::vector<std::string> names;
  for (NodeIndex one = 0; one < file.nodes.graph.size(); ++one)
    names.push_back(file.nodes.graph.name(one));
  return names;
}

TEST(NodeSection, PutsObjectsWhereTheirNodesAre) {
  const SceneFile file =
      parsed(node("arm", "position = \"1 0 0 m\"\norientation = [0, 0, \"90 deg\"]\n") +
             node("hand", "parent = \"arm\"\nposition = \"2 0 0 m\"\nscale = 3\n") +
             ball("tip", "hand", "position = \"10 0 0 cm\"\norientation = [0, 0, \"90 deg\"]\n") +
             ball("alone", "", "position = \"0 0 1 m\"\n"));
  const haptics::SceneObject& tip = file.scene.objects.at(0);
  EXPECT_LT((tip.pose.position - Eigen::Vector3d(1, 2.3, 0)).norm(), 1e-15)
      << "1, then 2 + .3 up y";
  EXPECT_LT((tip.pose.orientation * Eigen::Vector3d::UnitX() + Eigen::Vector3d::UnitX()).norm(),
            1e-15)
      << "half a turn";
  EXPECT_DOUBLE_EQ(std::get<haptics::SphereShape>(tip.shape).radius, 0.03);
  EXPECT_EQ(file.scene.objects.at(1).pose.position, Eigen::Vector3d(0, 0, 1));
  EXPECT_THAT(nodes_of(file), ElementsAre("", "arm", "hand", "tip"));
  ASSERT_EQ(file.nodes.hung.size(), 1U);
  EXPECT_EQ(file.nodes.hung[0].object, 0U);
  EXPECT_EQ(file.nodes.graph.content(file.nodes.hung[0].node).index, 0U);
  EXPECT_THAT(file.nodes.moved, IsEmpty());
}

TEST(NodeSection, ScaleEveryShapeThatHasASize) {
  const std::string frame = node("big", "scale = 2\n");
  const auto shape = [&](const std::string& line) {
    return parsed(frame + "[[object]]\nname = \"a\"\nnode = \"big\"\n" + line)
        .scene.objects.at(0)
        .shape;
  };
  EXPECT_EQ(std::get<haptics::BoxShape>(shape("box = [1, 2, 3]\n")).size, Eigen::Vector3d(2, 4, 6));
  EXPECT_EQ(
      std::get<haptics::ConeShape>(shape("cone = { radius = 1, top_radius = 0.5, height = 3 }\n"))
          .top_radius,
      1.0);
  EXPECT_EQ(
      std::get<haptics::CylinderShape>(shape("cylinder = { radius = 1, height = 3 }\n")).height,
      6.0);
  EXPECT_EQ(std::get<haptics::TorusShape>(shape("torus = { radius = 2, tube = 1 }\n")).tube, 2.0);
  EXPECT_EQ(std::get<haptics::EllipsoidShape>(shape("ellipsoid = [1, 2, 3]\n")).semi_axes.z(), 6.0);
  EXPECT_EQ(std::get<haptics::PlaneShape>(shape("plane = [0, 0, 1]\n")).normal.z(), 1.0);
  const auto solid = std::get<haptics::CsgShape>(
      shape("part = [{ sphere = 1 }, { box = [1, 1, 1], position = [0, 0, 0.5], rounding = 0.1, "
            "operation = \"subtract\" }]\n"));
  EXPECT_EQ(std::get<haptics::SphereShape>(solid.parts.at(0).shape).radius, 2.0);
  EXPECT_EQ(solid.parts.at(1).position.z(), 1.0);
  EXPECT_EQ(solid.parts.at(1).rounding, 0.2);
}

TEST(NodeSection, CopyASubtreeWithItsObjects) {
  const SceneFile file =
      parsed(ball("before", "") + node("arm", "position = \"1 0 0 m\"\n") +
             node("hand", "parent = \"arm\"\nposition = \"0 0 1 m\"\n") +
             node("arm2", "use = \"arm\"\nposition = \"0 5 0 m\"\nscale = 2\n") + node("pair") +
             node("left", "parent = \"pair\"\nuse = \"arm2\"\n") +
             ball("cube", "hand", "position = \"0 0 1 m\"\n") + ball("after", ""));
  EXPECT_THAT(nodes_of(file), ElementsAre("", "arm", "hand", "cube", "arm2", "arm2/hand",
                                          "arm2/cube", "pair", "left", "left/hand", "left/cube"));
  EXPECT_THAT(names_of(file.scene.objects),
              ElementsAre("before", "cube", "after", "arm2/cube", "left/cube"));
  EXPECT_EQ(file.scene.objects.at(1).pose.position, Eigen::Vector3d(1, 0, 2));
  EXPECT_EQ(file.scene.objects.at(3).pose.position, Eigen::Vector3d(0, 5, 4));
  EXPECT_EQ(file.scene.objects.at(4).pose.position, Eigen::Vector3d(0, 0, 2))
      << "a copy has its own place";
  EXPECT_EQ(std::get<haptics::SphereShape>(file.scene.objects.at(3).shape).radius, 0.02);
  for (const HungObject& hung : file.nodes.hung) {
    EXPECT_EQ(hung.table, 1U) << "one geometry";
    EXPECT_EQ(file.nodes.graph.content(hung.node).geometry, 1U);
    EXPECT_EQ(file.nodes.graph.name(hung.node), file.scene.objects.at(hung.object).name);
  }
}

TEST(NodeSection, CopyCopies) {
  std::string text = node("a") + ball("x", "a") + node("b");
  text += node("b1", "parent = \"b\"\nuse = \"a\"\n") + node("b2", "parent = \"b\"\nuse = \"a\"\n");
  text += node("c") + node("c1", "parent = \"c\"\nuse = \"b\"\n") +
          node("c2", "parent = \"c\"\nuse = \"b\"\n");
  EXPECT_THAT(names_of(parsed(text).scene.objects),
              ElementsAre("x", "b1/x", "b2/x", "c1/b1/x", "c1/b2/x", "c2/b1/x", "c2/b2/x"));
}

TEST(NodeSection, HandsFeelShownChildrenAndFinestLevels) {
  const std::string door =
      node("door", "kind = \"switch\"\nshows = \"shut\"\n") + node("open", "parent = \"door\"\n") +
      node("shut", "parent = \"door\"\n") + ball("gap", "open") + ball("leaf", "shut");
  const SceneFile shut = parsed(door + node("door2", "use = \"door\"\n"));
  EXPECT_THAT(names_of(shut.scene.objects), ElementsAre("leaf", "door2/leaf"));
  EXPECT_THAT(names_of(shut.nodes.unfelt), ElementsAre("gap", "door2/gap"));
  const SceneFile stone = parsed(node("stone", "kind = \"level_of_detail\"\n") +
                                 node("fine", "parent = \"stone\"\nfarthest = \"1 m\"\n") +
                                 node("coarse", "parent = \"stone\"\n") + ball("lump", "coarse") +
                                 ball("grain", "fine"));
  EXPECT_THAT(names_of(stone.scene.objects), ElementsAre("grain"));
  EXPECT_THAT(names_of(stone.nodes.unfelt), ElementsAre("lump"));
  EXPECT_EQ(stone.nodes.graph.farthest(stone.nodes.graph.find("fine").value()), 1.0);
  const SceneFile copied = parsed(
      node("pebble") + ball("grain", "pebble") + node("stone", "kind = \"level_of_detail\"\n") +
      node("fine", "parent = \"stone\"\nuse = \"pebble\"\nfarthest = \"1 m\"\n") +
      node("coarse", "parent = \"stone\"\n"));
  EXPECT_THAT(names_of(copied.scene.objects), ElementsAre("grain", "fine/grain"));
  EXPECT_EQ(copied.nodes.graph.farthest(copied.nodes.graph.find("fine").value()), 1.0);
}

TEST(NodeSection, CarryObjectsBelowATimeFunction) {
  const std::string wheel =
      node("wheel", "turn_rate = \"90 deg/s\"\n") + node("rim", "parent = \"wheel\"\n");
  EXPECT_EQ(refusal(wheel), "") << "without objects nothing is to be moved";
  const SceneFile file =
      parse_scene_file(wheel + ball("stone", "rim") + ball("still", ""), "x.toml");
  EXPECT_TRUE(file.scene.objects.at(0).carried);
  EXPECT_FALSE(file.scene.objects.at(1).carried);
  EXPECT_THAT(refusal(wheel + ball("stone", "rim", "mass = \"1 kg\"\n") +
                      "[[operator]]\npassive = true\n[[device]]\npeer = 1\noperator = 1\n"),
              HasSubstr("'stone' is a body (mass), which forces move"));
  EXPECT_THAT(refusal(wheel + "[[object]]\nname = \"floor\"\nplane = [0, 0, 1]\nnode = \"rim\"\n"),
              HasSubstr("'floor' is a plane, which cannot move"));
}

TEST(SceneNodes, ListTheNodesMovedByATimeFunction) {
  std::vector<NodeConfig> nodes(3);
  nodes[0].name = "table";
  nodes[1].name = "wheel";
  nodes[1].motion.turn_rate = std::numbers::pi / 2;
  nodes[2].name = "wheel2";
  nodes[2].use = "wheel";
  nodes[2].position = {0, 0, 1};
  std::vector<haptics::SceneObject> objects(2);
  objects[0].name = "cup";
  objects[1].name = "stone";
  objects[1].pose.position = {2, 0, 0};
  std::vector<NodeProblem> problems;
  SceneNodes made =
      make_nodes(nodes, std::vector<std::string>{"table", "wheel"}, objects, problems);
  ASSERT_THAT(problems, IsEmpty());
  ASSERT_EQ(made.moved.size(), 2U);
  EXPECT_EQ(objects.at(made.moved[0].object).name, "stone");
  EXPECT_EQ(objects.at(made.moved[1].object).name, "wheel2/stone");
  made.graph.evaluate(std::chrono::seconds(1));
  const NodeIndex stone = made.moved[1].node;
  EXPECT_LT((made.graph.world(stone).position - Eigen::Vector3d(0, 2, 1)).norm(), 1e-15);
  EXPECT_LT((made.graph.velocity(stone).linear - Eigen::Vector3d(-std::numbers::pi, 0, 0)).norm(),
            1e-15);
}

TEST(NodeSection, RefuseUnknownAndDuplicateNames) {
  EXPECT_EQ(refusal(node("arm", "parent = \"amr\"\n")),
            "x.toml:3:10: there is no node 'amr' (did you mean 'arm'?)");
  EXPECT_EQ(refusal(ball("a", "arm")),
            "x.toml:4:8: there is no node 'arm': write a [[node]] of that name, or name another");
  EXPECT_EQ(refusal(node("a", "use = \"elsewhere\"\n")),
            "x.toml:3:7: there is no node 'elsewhere': write a [[node]] of that name, or name "
            "another");
  EXPECT_THAT(refusal(node("a") + node("a")),
              HasSubstr("x.toml:4:8: there is another node 'a': rename one"));
  EXPECT_THAT(refusal("[[node]]\nscale = 2\n"), HasSubstr("[[node]] needs 'name'"));
  EXPECT_THAT(refusal(node("")), HasSubstr("a node needs a name"));
}

TEST(NodeSection, RefuseCircles) {
  EXPECT_EQ(refusal(node("a", "parent = \"b\"\n") + node("b", "parent = \"a\"\n")),
            "x.toml:3:10: a node is its own ancestor, 'a' on 'b' on 'a': give one of them another "
            "parent");
  EXPECT_EQ(refusal(node("a", "use = \"a\"\n")),
            "x.toml:3:7: 'a' copies its own ancestor 'a', which would not end: name another");
  EXPECT_THAT(refusal(node("a") + node("b", "parent = \"a\"\nuse = \"a\"\n")),
              HasSubstr("x.toml:6:7: 'b' copies its own ancestor 'a'"));
  // From d the circle is entered in its middle.
  EXPECT_THAT(refusal(node("b") + node("c", "parent = \"b\"\n") +
                      node("e", "parent = \"c\"\nuse = \"b\"\n") + node("d", "use = \"c\"\n")),
              HasSubstr("'e' copies its own ancestor 'b'"));
  EXPECT_THAT(refusal(node("a", "use = \"b\"\n") + node("b", "use = \"a\"\n")),
              HasSubstr("would not end"));
}

TEST(NodeSection, RefuseCopiesWithoutBound) {
  std::string text = node("n0") + ball("x", "n0");
  for (int i = 1; i < 40; ++i) {
    text += node(fmt::format("n{}", i));
    for (const char* half : {"a", "b"})
      text += node(fmt::format("{}{}", half, i),
                   fmt::format("parent = \"n{}\"\nuse = \"n{}\"\n", i, i - 1));
  }
  EXPECT_THAT(refusal(text), HasSubstr("more than 100000 nodes and objects"));
  std::string deep;
  for (int i = 0; i < 300; ++i)
    deep += node(fmt::format("n{}", i), i == 0 ? "" : fmt::format("parent = \"n{}\"\n", i - 1));
  EXPECT_THAT(refusal(deep), HasSubstr("nodes are nested more than 256 deep"));
}

TEST(NodeSection, BoundChainsOfCopies) {
  const auto chain = [](int copies) {
    std::string text = node("n0");
    for (int i = 1; i <= copies; ++i)
      text += node(fmt::format("n{}", i), fmt::format("use = \"n{}\"\n", i - 1));
    return text;
  };
  EXPECT_THAT(refusal(chain(255)), IsEmpty());
  EXPECT_THAT(refusal(chain(20'000)),
              HasSubstr("'n256' is a copy of a copy, more than 256 times: name 'n0' itself"));
}

TEST(NodeSection, RefuseKeysThatACopyCannotHave) {
  const std::string arm = node("arm") + ball("cube", "arm");
  EXPECT_THAT(refusal(arm + node("b", "use = \"arm\"\nturn_rate = 1\n")),
              HasSubstr("'turn_rate' comes from 'arm'"));
  EXPECT_THAT(refusal(arm + node("b", "use = \"arm\"\n") + node("c", "parent = \"b\"\n")),
              HasSubstr("'b' only copies 'arm': give 'c' another parent"));
  EXPECT_THAT(refusal(arm + node("b", "use = \"arm\"\n") + ball("d", "b")),
              HasSubstr("'b' only copies 'arm': use another node for the object"));
  EXPECT_THAT(refusal(arm + node("b", "use = \"arm\"\n") + ball("b/cube", "")),
              HasSubstr("x.toml:9:7: there are two objects 'b/cube', one of them in a copy"));
  EXPECT_THAT(refusal(arm + node("hand", "parent = \"arm\"\n") + node("b", "use = \"arm\"\n") +
                      node("b/hand")),
              HasSubstr("there are two nodes 'b/hand'"));
}

TEST(NodeSection, RefuseKeysOfAnotherKind) {
  const std::string door = node("door", "kind = \"switch\"\n");
  EXPECT_THAT(refusal(door + ball("a", "door")), HasSubstr("'door' chooses one of its children"));
  EXPECT_THAT(refusal(node("door", "kind = \"switch\"\nshows = \"shut\"\n")),
              HasSubstr("x.toml:4:9: 'door' shows 'shut', which is not its child"));
  EXPECT_THAT(refusal(node("a", "shows = \"b\"\n")), HasSubstr("'a' is not a switch"));
  EXPECT_THAT(refusal(node("a", "farthest = 1\n")), HasSubstr("not a child of a level of detail"));
  EXPECT_THAT(refusal(node("a", "kind = \"level_of_detail\"\n") +
                      node("b", "parent = \"a\"\nfarthest = 2\n") +
                      node("c", "parent = \"a\"\nfarthest = 2\n")),
              HasSubstr("x.toml:11:12: 'c' is never shown"));
  EXPECT_THAT(refusal(node("a", "swing = \"0 0 1 cm\"\n")),
              HasSubstr("needs a 'swing_rate' above 0"));
  EXPECT_THAT(refusal(node("a", "swing_rate = 1\n")), HasSubstr("needs 'swing': add it"));
  EXPECT_THAT(refusal(node("a", "turn_axis = [1, 0, 0]\n")), HasSubstr("needs a 'turn_rate'"));
  EXPECT_THAT(refusal(node("a", "turn_rate = 1\nturn_axis = [0, 0, 0]\n")),
              HasSubstr("x.toml:4:13: 'a': its axis of rotation has no direction"));
}

TEST(NodeSection, RefuseSizesThatCannotBe) {
  EXPECT_THAT(refusal(node("a", "scale = 100\n") + node("b", "parent = \"a\"\nscale = 100\n") +
                      ball("x", "b")),
              HasSubstr("the scales of the parents of 'x' multiply to 1e+04"));
  EXPECT_THAT(refusal(node("a", "scale = 1000\n") +
                      node("b", "parent = \"a\"\nposition = \"2 0 0 km\"\nscale = 0.001\n") +
                      ball("x", "b")),
              HasSubstr("x.toml:12:8: 'x' is farther than 1000 km from the origin of S"));
  std::string endless;  // beyond the range of a double, and back
  for (int i = 0; i < 220; ++i)
    endless += node(fmt::format("n{}", i),
                    fmt::format("scale = {}\nposition = [1e6, 0, 0]\n{}", i < 110 ? 1e3 : 1e-3,
                                i == 0 ? "" : fmt::format("parent = \"n{}\"\n", i - 1)));
  EXPECT_THAT(refusal(endless + ball("x", "n219")), HasSubstr("farther than 1000 km"));
}

TEST(NodeSection, AreInTheHashOfAScene) {
  const std::string cube = ball("cube", "");
  const auto hash = [](const std::string& text) { return parsed(text).hash; };
  const std::uint64_t bare = hash(cube);
  const std::uint64_t framed = hash(node("arm", "position = [1, 0, 0]\n") + ball("cube", "arm"));
  EXPECT_NE(hash(ball("cube", "", "position = [1, 0, 0]\n")), bare);
  EXPECT_NE(framed, hash(ball("cube", "", "position = [1, 0, 0]\n"))) << "the node is shared too";
  EXPECT_EQ(framed, hash(ball("cube", "arm") + node("arm", "position = [\"100 cm\", 0, 0]\n")));
  EXPECT_NE(hash(node("a") + cube), bare);
  const std::uint64_t turns = hash(node("a", "turn_rate = 1\n"));
  EXPECT_NE(turns, hash(node("a")));
  EXPECT_NE(turns, hash(node("a", "turn_rate = 2\n")));
  EXPECT_EQ(turns, hash(node("a", "turn_rate = 1\nturn_axis = [0, 0, 5]\n")));
  const std::string choice = node("b", "parent = \"a\"\n") + node("c", "parent = \"a\"\n");
  EXPECT_NE(hash(node("a", "kind = \"switch\"\n") + choice),
            hash(node("a", "kind = \"switch\"\nshows = \"c\"\n") + choice));
  EXPECT_NE(hash(node("a") + choice), hash(node("a", "kind = \"switch\"\n") + choice));
}

TEST(NodeSection, OfASceneWithoutThemChangeNothing) {
  const SceneFile file = parsed(ball("cube", ""));
  EXPECT_TRUE(file.nodes.graph.empty());
  EXPECT_THAT(file.nodes.hung, IsEmpty());
  EXPECT_EQ(file.hash, 0x1f5459f5cf224608U) << "as of scenes before there were nodes";
}

}  // namespace
}  // namespace reckon::peer::node_section_test
