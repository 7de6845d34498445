// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The scene graph: order, poses against an oracle, changes bit by bit, motion, refusals.
#include "reckon/peer/scene_graph/scene_graph.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstring>
#include <numbers>
#include <string>
#include <vector>

#include "reckon/tests/src/support/random_graph.hpp"
#include "reckon/tests/support/allocation_guard.hpp"

namespace reckon::peer {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using std::chrono::seconds;
using test::GraphOracle;
using test::GraphShape;
using test::RandomGraph;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr double kPi = std::numbers::pi;

GraphNode node(std::string name, std::optional<std::string> parent,
               const Eigen::Vector3d& position = {0, 0, 0}) {
  GraphNode made;
  made.name = std::move(name);
  made.parent = std::move(parent);
  made.pose.position = position;
  return made;
}

std::vector<std::string> names_of(const SceneGraph& graph) {
  std::vector<std::string> names;
  for (NodeIndex one = 0; one < graph.size(); ++one) names.push_back(graph.name(one));
  return names;
}

NodeIndex at(const SceneGraph& graph, std::string_view name) { return graph.find(name).value(); }

TEST(SceneGraph, HasWalkOrderForAnyList) {
  const std::vector<GraphNode> nodes = {node("right", "root"), node("leaf", "left"),
                                        node("root", {}), node("left", "root"),
                                        node("under", "right")};
  const SceneGraph graph(nodes);
  EXPECT_THAT(names_of(graph), ElementsAre("root", "right", "under", "left", "leaf"));
  EXPECT_EQ(graph.depth(), 3U);
  EXPECT_EQ(graph.end(1), 3) << "the next sibling";
  EXPECT_EQ(graph.parent(4), 3);
  EXPECT_EQ(graph.name(graph.place_of(1)), "leaf");
}

TEST(SceneGraph, PlacesNodesAsARecursionDoes) {
  for (const unsigned seed : {1U, 2U, 3U}) {
    RandomGraph random(seed);
    const auto nodes = random.nodes({.nodes = 1000, .up = seed - 1.0, .moving = 0.2});
    SceneGraph graph(nodes);
    for (const nanoseconds time : {nanoseconds(0), nanoseconds(milliseconds(1234))}) {
      graph.evaluate(time);
      const auto visits = GraphOracle(nodes).visits(time, {0, 0, 0}, true);
      ASSERT_EQ(visits.size(), nodes.size());
      double worst = 0;
      for (NodeIndex one = 0; one < graph.size(); ++one) {
        const auto& visit = visits[static_cast<std::size_t>(one)];
        ASSERT_EQ(graph.name(one), visit.name) << "seed " << seed;
        const Eigen::Matrix4d off = GraphOracle::matrix(graph.world(one)) - visit.world;
        worst = std::max(worst, off.cwiseAbs().maxCoeff() / visit.world.cwiseAbs().maxCoeff());
      }
      EXPECT_LT(worst, 1e-12) << "rounding of some hundred products; seed " << seed;
    }
  }
}

/// The node state of a graph as octets, without padding.
std::string state_of(const SceneGraph& graph) {
  std::string octets;
  const auto add = [&](const auto& value) {
    octets.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  for (NodeIndex one = 0; one < graph.size(); ++one) {
    const NodePose& pose = graph.world(one);
    for (const double value : pose.position) add(value);
    for (const double value : pose.orientation.coeffs()) add(value);
    add(pose.scale);
    for (const double value : graph.velocity(one).linear) add(value);
    for (const double value : graph.velocity(one).angular) add(value);
    add(graph.shown(one));
    add(graph.chosen(one));
  }
  return octets;
}

/// Makes the same changes to both graphs.
void change(SceneGraph& graph, RandomGraph& random, std::size_t changes) {
  for (std::size_t i = 0; i < changes; ++i) {
    const auto one = static_cast<NodeIndex>(random.below(static_cast<std::size_t>(graph.size())));
    graph.place(one, random.pose());
    if (graph.kind(one) == NodeKind::switch_) {
      NodeIndex child = one + 1;
      if (random.below(2) == 0 && graph.end(child) < graph.end(one)) child = graph.end(child);
      graph.show(one, child);
    }
  }
}

TEST(SceneGraph, ChangesEqualAWholeRewriteBitByBit) {
  RandomGraph random(7);
  const auto nodes = random.nodes({.nodes = 1000, .moving = 0.05, .procedural = 0.3});
  SceneGraph changed(nodes), whole(nodes);
  int shown = 0;
  for (unsigned round = 0; round < 300; ++round) {
    RandomGraph one(round), other(round);
    change(changed, one, round % 20);
    change(whole, other, round % 20);
    const Eigen::Vector3d eye = random.vector(1.0);
    const bool looks = round % 3 == 0;
    if (looks) changed.look_from(eye);
    if (looks) whole.look_from(eye);
    const milliseconds time(round / 2 * 17);
    changed.evaluate(time);
    whole.evaluate(time);
    whole.rewrite();
    ASSERT_EQ(state_of(changed), state_of(whole)) << "round " << round;
    for (NodeIndex n = 0; n < changed.size(); ++n) shown += changed.shown(n) ? 1 : 0;
  }
  EXPECT_GT(shown, 0);
  EXPECT_LT(shown, 300 * changed.size()) << "something is hidden";
}

TEST(SceneGraph, ChangesEqualARewriteOfManyNodes) {
  for (const GraphShape& shape : {GraphShape{.nodes = 100000, .up = 1.0},
                                  GraphShape{.nodes = 100000, .up = 3.0, .deepest = 10}}) {
    RandomGraph random(11);
    const auto nodes = random.nodes(shape);
    SceneGraph changed(nodes), whole(nodes);
    for (int round = 0; round < 3; ++round) {
      for (NodeIndex one = 0; one < changed.size(); ++one) {
        if (changed.kind(one) != NodeKind::content || random.below(100) != 0) continue;
        const NodePose pose = random.pose();
        changed.place(one, pose);
        whole.place(one, pose);
      }
      changed.update();
      whole.rewrite();
      EXPECT_TRUE(state_of(changed) == state_of(whole)) << changed.depth() << " levels";
    }
  }
}

TEST(SceneGraph, KeepsUnchangedNodes) {
  const std::vector<GraphNode> nodes = {node("root", {}), node("a", "root", {1, 0, 0}),
                                        node("b", "a", {1, 0, 0}), node("c", "root", {0, 1, 0})};
  SceneGraph graph(nodes);
  graph.place(at(graph, "a"), {{5, 0, 0}, 2.0});
  EXPECT_EQ(graph.world(at(graph, "b")).position, Eigen::Vector3d(2, 0, 0)) << "until update()";
  graph.update();
  EXPECT_EQ(graph.world(at(graph, "b")).position, Eigen::Vector3d(7, 0, 0));
  EXPECT_EQ(graph.world(at(graph, "b")).scale, 2.0);
  EXPECT_EQ(graph.world(at(graph, "c")).position, Eigen::Vector3d(0, 1, 0));
}

TEST(SceneGraph, TurnsAndSwingsByClosedForms) {
  std::vector<GraphNode> nodes = {node("root", {}), node("wheel", "root", {0, 0, 1}),
                                  node("rim", "wheel", {0.5, 0, 0})};
  nodes[1].motion = NodeMotion{.turn_axis = {0, 0, 3}, .turn_rate = 2.0};
  nodes[0].motion = NodeMotion{.swing = {0, 0.1, 0}, .swing_rate = 0.25, .swing_phase = kPi / 6};
  SceneGraph graph(nodes);
  EXPECT_NEAR(graph.world(0).position.y(), 0.05, 1e-15) << "sin 30 deg at time 0";
  graph.evaluate(seconds(1));
  const double y = 0.1 * std::sin(kPi / 2 + kPi / 6);
  const Eigen::Vector3d rim(0.5 * std::cos(2.0), y + 0.5 * std::sin(2.0), 1);
  EXPECT_LT((graph.world(2).position - rim).norm(), 1e-15);
  EXPECT_EQ(graph.velocity(2).angular, Eigen::Vector3d(0, 0, 2));
  const Eigen::Vector3d moves(-std::sin(2.0), std::cos(2.0) + 0.05 * kPi * std::cos(2 * kPi / 3),
                              0);
  EXPECT_LT((graph.velocity(2).linear - moves).norm(), 1e-15);
  const Eigen::Vector3d across(0, 0, 0.2);
  EXPECT_EQ(graph.velocity(2).at(across), graph.velocity(2).linear) << "along the axis";
}

TEST(SceneGraph, ComesBackAfterMillionsOfTurns) {
  std::vector<GraphNode> nodes = {node("root", {})};
  nodes[0].motion =
      NodeMotion{.turn_rate = 2 * kPi, .swing = {1, 0, 0}, .swing_rate = 1, .swing_phase = 0.5};
  SceneGraph graph(nodes);
  const NodePose first = graph.world(0);
  graph.evaluate(seconds(10'000'000));
  EXPECT_EQ(graph.world(0).position, first.position);
  EXPECT_LT(graph.world(0).orientation.angularDistance(first.orientation), 1e-7)
      << "rounding of 6e7 rad";
}

TEST(SceneGraph, HasTheVelocityOfItsPoses) {
  RandomGraph random(3);
  const auto nodes = random.nodes({.nodes = 300, .up = 1.0, .deepest = 6, .moving = 0.5});
  const nanoseconds now = milliseconds(700), step = std::chrono::microseconds(10);
  SceneGraph before(nodes), graph(nodes), after(nodes);
  before.evaluate(now - step);
  graph.evaluate(now);
  after.evaluate(now + step);
  double fastest = 0, worst = 0;
  for (NodeIndex one = 0; one < graph.size(); ++one) {
    const Eigen::Vector3d moved = (after.world(one).position - before.world(one).position) / 20e-6;
    const Eigen::AngleAxisd turned(after.world(one).orientation *
                                   before.world(one).orientation.conjugate());
    const Eigen::Vector3d rate = turned.angle() / 20e-6 * turned.axis();
    worst = std::max({worst, (graph.velocity(one).linear - moved).norm(),
                      (graph.velocity(one).angular - rate).norm()});
    fastest = std::max(fastest, moved.norm());
    EXPECT_EQ(graph.moves(one), moved.norm() > 0 || rate.norm() > 0);
  }
  EXPECT_GT(fastest, 1.0) << "m/s";
  EXPECT_LT(worst, 1e-6) << "of the central difference";
}

TEST(SceneGraph, MovesFromWhereItIsPlaced) {
  std::vector<GraphNode> nodes = {node("root", {}), node("wheel", "root", {1, 0, 0})};
  nodes[1].motion = NodeMotion{.turn_rate = kPi};
  SceneGraph graph(nodes);
  graph.evaluate(seconds(1));
  graph.place(1, {{2, 0, 0}});
  graph.update();
  EXPECT_EQ(graph.world(1).position, Eigen::Vector3d(2, 0, 0));
  EXPECT_EQ(graph.rest(1).orientation.w(), 1.0);
  EXPECT_NEAR(graph.world(1).orientation.angularDistance(Eigen::Quaterniond::Identity()), kPi,
              1e-7);
}

TEST(SceneGraph, ShowsOneChildOfASwitch) {
  std::vector<GraphNode> nodes = {node("root", {}), node("door", "root"), node("open", "door"),
                                  node("shut", "door"), node("lock", "shut")};
  nodes[1].kind = NodeKind::switch_;
  SceneGraph graph(nodes);
  const NodeIndex door = at(graph, "door"), shut = at(graph, "shut");
  EXPECT_EQ(graph.chosen(door), at(graph, "open")) << "the first";
  EXPECT_FALSE(graph.shown(shut));
  EXPECT_FALSE(graph.shown(at(graph, "lock")));
  graph.show(door, shut);
  graph.update();
  EXPECT_TRUE(graph.shown(at(graph, "lock")));
  EXPECT_FALSE(graph.shown(at(graph, "open")));
  nodes[1].shows = "shut";
  EXPECT_TRUE(SceneGraph(nodes).shown(shut));
}

TEST(SceneGraph, ShowsTheLevelOfItsDistance) {
  std::vector<GraphNode> nodes = {node("root", {}), node("stone", "root", {10, 0, 0}),
                                  node("fine", "stone"), node("coarse", "stone")};
  nodes[1].kind = NodeKind::level_of_detail;
  nodes[1].pose.scale = 2.0;
  nodes[2].farthest = 1.0;
  nodes[3].farthest = 4.0;
  SceneGraph graph(nodes);
  const auto seen_from = [&](double x) {
    graph.look_from({x, 0, 0});
    graph.update();
    const NodeIndex level = graph.chosen(1);
    return level == kNoNode ? std::string("none") : graph.name(level);
  };
  EXPECT_EQ(seen_from(0.0), "none") << "10 m away, and drawn twice as large: as from 5 m";
  EXPECT_EQ(seen_from(2.5), "coarse");
  EXPECT_EQ(seen_from(8.5), "fine");
  graph.place(1, {{100, 0, 0}, 2.0});
  graph.update();
  EXPECT_EQ(graph.chosen(1), kNoNode) << "it went away itself";
  EXPECT_FALSE(graph.shown(2));
}

TEST(SceneGraph, AllocatesNothingOnceItIsBuiltOrCopied) {
  RandomGraph random(5);
  const SceneGraph built(random.nodes({.nodes = 1000, .moving = 0.3, .procedural = 0.2}));
  SceneGraph graph = built;
  const NodePose pose = random.pose();
  const test::AllocationGuard guard;
  for (int step = 1; step <= 100; ++step) {
    for (NodeIndex one = 0; one < graph.size(); ++one) graph.place(one, pose);
    graph.look_from({0.01 * step, 0, 0});
    graph.evaluate(milliseconds(step));
  }
  graph.rewrite();
  EXPECT_EQ(guard.count(), 0U);
}

std::string refusal_of(const std::vector<GraphNode>& nodes) {
  try {
    const SceneGraph graph(nodes);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return {};
}

TEST(SceneGraph, HasOneRootAndNoStrangers) {
  EXPECT_EQ(refusal_of({node("a", {})}), "");
  EXPECT_THAT(refusal_of({}), HasSubstr("needs a root"));
  EXPECT_EQ(refusal_of({node("a", {}), node("b", {})}),
            "'b' is a second root beside 'a': give it a parent");
  EXPECT_EQ(refusal_of({node("a", {}), node("b", "z")}),
            "the parent of 'b', 'z', is not in this graph: name a node of it");
}

TEST(SceneGraph, HasNoCircle) {
  EXPECT_EQ(
      refusal_of({node("a", {}), node("b", "d"), node("c", "b"), node("d", "c")}),
      "a node is its own ancestor, 'b' on 'd' on 'c' on 'b': give one of them another parent");
  EXPECT_THAT(refusal_of({node("a", "a")}), HasSubstr("'a' on 'a'"));
  const auto faults = faults_of(std::vector<GraphNode>{
      node("a", {}), node("b", "c"), node("c", "b"), node("d", "c"), node("e", "e")});
  ASSERT_EQ(faults.size(), 2U) << "one for each circle, none for who hangs on one";
  EXPECT_EQ(faults[0].node, 1U);
  EXPECT_EQ(faults[1].node, 4U);
}

TEST(SceneGraph, RefusesInvalidNodes) {
  std::vector<GraphNode> nodes = {node("a", {}), node("b", "a"), node("c", "a")};
  const auto with = [&](auto change) {
    std::vector<GraphNode> changed = nodes;
    change(changed);
    return refusal_of(changed);
  };
  EXPECT_THAT(with([](auto& all) { all[2].name = "b"; }), HasSubstr("another node 'b'"));
  EXPECT_THAT(with([](auto& all) { all[1].pose.scale = 0; }), HasSubstr("scale of 'b'"));
  EXPECT_THAT(with([](auto& all) { all[1].pose.position.x() = NAN; }),
              HasSubstr("position of 'b'"));
  EXPECT_THAT(with([](auto& all) { all[1].pose.orientation.coeffs().setZero(); }),
              HasSubstr("orientation of 'b'"));
  EXPECT_THAT(with([](auto& all) {
                all[1].motion = NodeMotion{.turn_axis = {0, 0, 0}, .turn_rate = 1};
              }),
              HasSubstr("has no direction"));
  EXPECT_THAT(with([](auto& all) {
                all[1].kind = NodeKind::content;
                all[2].parent = "b";
              }),
              HasSubstr("'b', is a leaf"));
  EXPECT_THAT(with([](auto& all) { all[0].shows = "b"; }), HasSubstr("'a' is not a switch"));
  EXPECT_THAT(with([](auto& all) {
                all[0].kind = NodeKind::switch_;
                all[0].shows = "z";
              }),
              HasSubstr("not its child"));
  EXPECT_THAT(with([](auto& all) { all[1].farthest = 2; }),
              HasSubstr("not a child of a level of detail"));
  EXPECT_THAT(with([](auto& all) { all[0].kind = NodeKind::level_of_detail; }),
              HasSubstr("'c' is never shown"));
}

}  // namespace
}  // namespace reckon::peer
