// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The walk of thesis fig 5.2: its order, and the state that it modifies on the way.
#include "reckon/peer/scene_graph/graph_walk.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "reckon/tests/src/support/random_graph.hpp"
#include "reckon/tests/support/allocation_guard.hpp"

namespace reckon::peer {
namespace {

using test::GraphOracle;
using test::RandomGraph;
using testing::ElementsAre;
using testing::IsEmpty;

GraphNode leaf(std::string name, std::string parent, NodeContent::Kind kind) {
  GraphNode made;
  made.name = std::move(name);
  made.parent = std::move(parent);
  made.kind = NodeKind::content;
  made.content.kind = kind;
  return made;
}

GraphNode group(std::string name, std::optional<std::string> parent) {
  GraphNode made;
  made.name = std::move(name);
  made.parent = std::move(parent);
  return made;
}

TEST(DrawWalk, DrawsGeometryWithTheLightsBeforeIt) {
  using enum NodeContent::Kind;
  const std::vector<GraphNode> nodes = {
      group("root", {}),           leaf("dark", "root", geometry), leaf("sun", "root", light),
      group("room", "root"),       leaf("lamp", "room", light),    leaf("table", "room", geometry),
      leaf("late", "room", light), leaf("tree", "root", geometry)};
  const SceneGraph graph(nodes);
  std::vector<std::string> drawn;
  DrawWalk(graph).run([&](const DrawnNode& node) {
    std::string text = graph.name(node.node);
    for (const NodeIndex light : node.lights) text += " " + graph.name(light);
    drawn.push_back(text);
  });
  EXPECT_THAT(drawn, ElementsAre("dark", "table sun lamp", "tree sun"));
}

TEST(DrawWalk, MatchesARecursionOverATree) {
  std::size_t drawn = 0;
  for (unsigned seed = 1; seed <= 8; ++seed) {
    RandomGraph random(seed);
    const auto nodes =
        random.nodes({.nodes = 1000, .up = seed % 2 + 0.5, .procedural = 0.05, .light = 0.3});
    SceneGraph graph(nodes);
    const Eigen::Vector3d eye = random.vector(0.5);
    graph.look_from(eye);
    graph.update();
    auto visits = GraphOracle(nodes).visits({}, eye, false);
    std::erase_if(visits, [&](const auto& visit) {
      const NodeIndex node = graph.find(visit.name).value();
      return graph.kind(node) != NodeKind::content ||
             graph.content(node).kind != NodeContent::Kind::geometry;
    });
    drawn += visits.size();
    auto visit = visits.begin();
    DrawWalk(graph).run([&](const DrawnNode& node) {
      ASSERT_NE(visit, visits.end());
      ASSERT_EQ(graph.name(node.node), visit->name) << "seed " << seed;
      std::vector<std::string> lights;
      for (const NodeIndex light : node.lights) lights.push_back(graph.name(light));
      ASSERT_EQ(lights, visit->lights) << visit->name;
      ASSERT_LT((GraphOracle::matrix(node.pose) - visit->world).cwiseAbs().maxCoeff(), 1e-11);
      ASSERT_EQ(node.pose.position, graph.world(node.node).position) << "bit by bit";
      ++visit;
    });
    EXPECT_EQ(visit, visits.end());
  }
  EXPECT_GT(drawn, 500U);
}

TEST(GraphWalk, RestoresStateAndSkipsBelowARefusedNode) {
  const std::vector<GraphNode> nodes = {group("a", {}),  group("b", "a"), group("c", "b"),
                                        group("d", "a"), group("e", "d"), group("f", "a")};
  const SceneGraph graph(nodes);
  std::vector<std::string> seen;
  GraphWalk<int>(graph).run(1, [&](NodeIndex node, int& own, int& around) {
    seen.push_back(graph.name(node) + std::to_string(own));
    own *= 10;
    around += 1;
    return graph.name(node) != "d";
  });
  EXPECT_THAT(seen, ElementsAre("a1", "b10", "c100", "d11", "f12"));
}

TEST(GraphWalk, OfNoNodesVisitsNone) {
  const SceneGraph graph;
  std::vector<NodeIndex> seen;
  GraphWalk<int>(graph).run(0, [&](NodeIndex node, int&, int&) {
    seen.push_back(node);
    return true;
  });
  EXPECT_THAT(seen, IsEmpty());
}

TEST(DrawWalk, AllocatesNothingOnTheWay) {
  RandomGraph random(5);
  const SceneGraph graph(random.nodes({.nodes = 1000, .light = 0.5}));
  DrawWalk walk(graph);
  std::size_t lights = 0;
  const test::AllocationGuard guard;
  walk.run([&](const DrawnNode& node) { lights += node.lights.size(); });
  EXPECT_EQ(guard.count(), 0U);
  EXPECT_GT(lights, 0U);
}

}  // namespace
}  // namespace reckon::peer
