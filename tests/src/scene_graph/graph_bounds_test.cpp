// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Culling and picking against brute force over all nodes: corners of boxes, and surfaces of boxes
// and balls, each in the axes of S.
#include "reckon/peer/scene_graph/graph_bounds.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "reckon/tests/src/support/random_graph.hpp"
#include "reckon/tests/support/allocation_guard.hpp"

namespace reckon::peer {
namespace {

using Eigen::Vector3d;
using test::RandomGraph;
using testing::IsEmpty;

using Entries = std::vector<GraphBounds::Entry>;

Entries random_bounds(const SceneGraph& graph, RandomGraph& random) {
  Entries entries;
  for (NodeIndex node = 0; node < graph.size(); ++node) {
    if (graph.kind(node) != NodeKind::content) continue;
    if (random.below(2) == 0)
      entries.push_back({node, SphereBounds{random.vector(0.02), random.between(0, 0.05)}});
    else
      entries.push_back({node, BoxBounds{random.vector(0.02), random.vector(0.05).cwiseAbs()}});
  }
  return entries;
}

std::array<Vector3d, 8> corners_of(const BoxBounds& box, const NodePose& pose) {
  std::array<Vector3d, 8> corners;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vector3d sign((i & 1) != 0 ? 1 : -1, (i & 2) != 0 ? 1 : -1, (i & 4) != 0 ? 1 : -1);
    corners[i] = pose * (box.centre + sign.cwiseProduct(box.half));
  }
  return corners;
}

bool is_outside(const ContentBounds& bounds, const NodePose& pose, const HalfSpace& half) {
  if (const auto* ball = std::get_if<SphereBounds>(&bounds))
    return half.normal.dot(pose * ball->centre) - half.offset > pose.scale * ball->radius;
  const auto corners = corners_of(std::get<BoxBounds>(bounds), pose);
  return std::all_of(corners.begin(), corners.end(),
                     [&](const Vector3d& p) { return half.normal.dot(p) > half.offset; });
}

std::vector<NodeIndex> culled_by_force(const SceneGraph& graph, const Entries& entries,
                                       const std::vector<HalfSpace>& volume) {
  std::vector<NodeIndex> found;
  for (const auto& entry : entries) {
    const NodePose& pose = graph.world(entry.node);
    const bool out = std::any_of(volume.begin(), volume.end(), [&](const HalfSpace& half) {
      return is_outside(entry.bounds, pose, half);
    });
    if (!out && graph.shown(entry.node)) found.push_back(entry.node);
  }
  return found;
}

/// The distance to the nearest of the six faces that the ray crosses within its border; 0 from
/// inside.
std::optional<double> entered(const BoxBounds& box, const NodePose& pose, const Vector3d& from,
                              const Vector3d& along) {
  const Eigen::Matrix3d axes = pose.orientation.toRotationMatrix();
  const Vector3d centre = pose * box.centre, half = pose.scale * box.half;
  const Vector3d here = axes.transpose() * (from - centre);
  if ((here.cwiseAbs().array() <= half.array()).all()) return 0.0;
  std::optional<double> first;
  for (int face = 0; face < 6; ++face) {
    const int axis = face / 2;
    const Vector3d normal = (face % 2 != 0 ? 1.0 : -1.0) * axes.col(axis);
    const double t = (half[axis] - normal.dot(from - centre)) / normal.dot(along);
    const Vector3d across = axes.transpose() * (from + t * along - centre);
    bool within = t >= 0;
    for (int other = 0; other < 3; ++other)
      within = within && (other == axis || std::abs(across[other]) <= half[other]);
    if (within && (!first || t < *first)) first = t;
  }
  return first;
}

std::optional<double> entered(const SphereBounds& ball, const NodePose& pose, const Vector3d& from,
                              const Vector3d& along) {
  const Vector3d away = from - pose * ball.centre;
  const double b = 2 * away.dot(along);
  const double c = away.squaredNorm() - std::pow(pose.scale * ball.radius, 2);
  if (c <= 0) return 0.0;
  const double d = b * b - 4 * c;
  if (d < 0 || -b < 0) return std::nullopt;
  return (-b - std::sqrt(d)) / 2;
}

std::optional<Picked> picked_by_force(const SceneGraph& graph, const Entries& entries,
                                      const Vector3d& from, const Vector3d& along) {
  std::optional<Picked> first;
  for (const auto& entry : entries) {
    if (!graph.shown(entry.node)) continue;
    const auto t = std::visit(
        [&](const auto& bounds) { return entered(bounds, graph.world(entry.node), from, along); },
        entry.bounds);
    if (t && (!first || *t < first->distance)) first = Picked{entry.node, *t};
  }
  return first;
}

TEST(GraphBounds, FindTheSameAsBruteForce) {
  std::size_t seen = 0, hit = 0, missed = 0;
  for (const unsigned seed : {1U, 2U, 3U, 4U}) {
    RandomGraph random(seed);
    SceneGraph graph(random.nodes(
        {.nodes = 1000, .up = seed % 2 == 0 ? 1.0 : 2.0, .moving = 0.1, .procedural = 0.1}));
    const Entries entries = random_bounds(graph, random);
    GraphBounds bounds(graph, entries);
    for (int query = 0; query < 100; ++query) {
      graph.evaluate(std::chrono::milliseconds(query * 10));
      bounds.update();
      const auto centre =
          graph.world(static_cast<NodeIndex>(random.below(static_cast<std::size_t>(graph.size()))))
              .position;
      const NodePose eye{centre + random.vector(0.3), 1.0, random.turn()};
      const auto volume =
          query % 2 == 0
              ? view_volume(eye, 1.2, 0.8, 0.01, random.between(0.1, 2))
              : box_volume({centre - Vector3d(0.1, 0.2, 0.1), centre + Vector3d(0.2, 0.1, 0.1)});
      std::vector<NodeIndex> found;
      bounds.cull(volume, found);
      ASSERT_EQ(found, culled_by_force(graph, entries, volume)) << "seed " << seed << ", " << query;
      seen += found.size();
      const Vector3d along = query % 4 == 0 ? random.vector(1) : Vector3d(centre - eye.position);
      const auto picked = bounds.pick(eye.position, along);
      const auto forced = picked_by_force(graph, entries, eye.position, along.normalized());
      ASSERT_EQ(picked.has_value(), forced.has_value()) << "seed " << seed << ", " << query;
      ++(picked ? hit : missed);
      if (!picked) continue;
      ASSERT_EQ(picked->node, forced->node) << "seed " << seed << ", " << query;
      ASSERT_NEAR(picked->distance, forced->distance, 1e-12);
    }
  }
  EXPECT_GT(seen, 1000U);
  EXPECT_GT(hit, 50U);
  EXPECT_GT(missed, 50U);
}

TEST(GraphBounds, SeeAlongTheXAxisOfTheEye) {
  std::vector<GraphNode> nodes(2);
  nodes[0].name = "root";
  nodes[1].name = "ball";
  nodes[1].parent = "root";
  nodes[1].kind = NodeKind::content;
  SceneGraph graph(nodes);
  GraphBounds bounds(graph, {{1, SphereBounds{{0, 0, 0}, 0.1}}});
  const auto volume = view_volume({}, 2 * std::atan(0.5), 2 * std::atan(0.25), 1, 10);
  const auto sees = [&](const Vector3d& position) {
    graph.place(1, {position});
    graph.update();
    bounds.update();
    std::vector<NodeIndex> found;
    bounds.cull(volume, found);
    return !found.empty();
  };
  EXPECT_TRUE(sees({4, 1.9, 0}));
  EXPECT_TRUE(sees({4, 0, 0.9}));
  EXPECT_FALSE(sees({4, 2.2, 0})) << "half as wide as far";
  EXPECT_FALSE(sees({4, 0, 1.2})) << "a quarter as high";
  EXPECT_FALSE(sees({-4, 0, 0})) << "behind";
  EXPECT_FALSE(sees({0.8, 0, 0}));
  EXPECT_TRUE(sees({0.95, 0, 0}));
  EXPECT_FALSE(sees({10.2, 0, 0}));
}

TEST(GraphBounds, OmitContentHiddenByASwitch) {
  std::vector<GraphNode> nodes(4);
  nodes[0].name = "root";
  nodes[0].kind = NodeKind::switch_;
  for (std::size_t i : {1U, 2U}) {
    nodes[i].name = i == 1 ? "one" : "other";
    nodes[i].parent = "root";
  }
  nodes[3] = {.name = "ball", .parent = "other", .kind = NodeKind::content};
  SceneGraph graph(nodes);
  const NodeIndex ball = graph.find("ball").value();
  GraphBounds bounds(graph, {{ball, SphereBounds{{1, 0, 0}, 0.1}}});
  EXPECT_FALSE(bounds.pick({0, 0, 0}, {1, 0, 0}));
  graph.show(0, graph.find("other").value());
  graph.update();
  bounds.update();
  const auto picked = bounds.pick({0, 0, 0}, {5, 0, 0});
  ASSERT_TRUE(picked);
  EXPECT_EQ(picked->node, ball);
  EXPECT_NEAR(picked->distance, 0.9, 1e-15);
  EXPECT_EQ(bounds.pick({1, 0, 0}, {1, 0, 0})->distance, 0.0) << "from inside";
}

TEST(GraphBounds, OfNoContentFindNothing) {
  const SceneGraph graph;
  const GraphBounds bounds(graph, {});
  std::vector<NodeIndex> found;
  bounds.cull(box_volume({Vector3d(-1, -1, -1), Vector3d(1, 1, 1)}), found);
  EXPECT_THAT(found, IsEmpty());
  EXPECT_FALSE(bounds.pick({0, 0, 0}, {1, 0, 0}));
}

}  // namespace
}  // namespace reckon::peer
