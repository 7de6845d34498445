// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// The scene graph: rewriting after one leaf in a hundred has changed, against rewriting everything
// (`ratio` of the medians; both are compared bit by bit first), a step in time of a machine with
// turning parts, and searches by bounds.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include "reckon/peer/scene_graph/graph_bounds.hpp"
#include "reckon/peer/scene_graph/scene_graph.hpp"
#include "reckon/tests/src/support/random_graph.hpp"

namespace {

using namespace reckon;
using Clock = std::chrono::steady_clock;

std::vector<peer::GraphNode> nodes_of(std::size_t count, bool bushy, test::RandomGraph& random) {
  test::GraphShape shape{.nodes = count};
  if (bushy) shape = {.nodes = count, .up = 3.0, .deepest = 10};
  return random.nodes(shape);
}

bool are_equal(const peer::SceneGraph& one, const peer::SceneGraph& other) {
  bool equal = true;
  for (peer::NodeIndex node = 0; node < one.size(); ++node) {
    const peer::NodePose &a = one.world(node), &b = other.world(node);
    equal = equal && std::memcmp(a.position.data(), b.position.data(), 24) == 0 &&
            std::memcmp(a.orientation.coeffs().data(), b.orientation.coeffs().data(), 32) == 0 &&
            std::memcmp(&a.scale, &b.scale, 8) == 0;
  }
  return equal;
}

double median(std::vector<double>& times) {
  std::ranges::nth_element(times, times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2));
  return times[times.size() / 2];
}

double seconds_of(auto&& work) {
  const auto begin = Clock::now();
  work();
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

void graph_changed_leaves(benchmark::State& state) {
  test::RandomGraph random(1);
  const auto nodes =
      nodes_of(static_cast<std::size_t>(state.range(0)), state.range(1) != 0, random);
  peer::SceneGraph changed(nodes), whole(nodes);
  std::vector<double> update_times, rewrite_times;
  std::vector<peer::NodeIndex> leaves;
  std::vector<std::pair<peer::NodeIndex, peer::NodePose>> changes;
  for (peer::NodeIndex node = 0; node < changed.size(); ++node)
    if (changed.kind(node) == peer::NodeKind::content) leaves.push_back(node);
  for (auto _ : state) {
    // In alternation, so that a change of the machine's speed affects both.
    changes.clear();
    for (std::size_t i = 0; i < leaves.size() / 100; ++i)
      changes.emplace_back(leaves[random.below(leaves.size())], random.pose());
    for (const auto& [leaf, pose] : changes) changed.place(leaf, pose);
    update_times.push_back(seconds_of([&] { changed.update(); }));
    for (const auto& [leaf, pose] : changes) whole.place(leaf, pose);
    rewrite_times.push_back(seconds_of([&] { whole.rewrite(); }));
    state.SetIterationTime(update_times.back());
  }
  if (!are_equal(changed, whole)) state.SkipWithError("not equal to a whole rewrite");
  const double update = median(update_times), rewrite = median(rewrite_times);
  state.counters["depth"] = static_cast<double>(changed.depth());
  state.counters["update_us"] = 1e6 * update;
  state.counters["whole_us"] = 1e6 * rewrite;
  state.counters["ratio"] = rewrite / update;
}
BENCHMARK(graph_changed_leaves)
    ->ArgNames({"nodes", "bushy"})
    ->ArgsProduct({{1000, 100000}, {0, 1}})
    ->UseManualTime()
    ->Unit(benchmark::kMicrosecond);

/// A step of 1 ms: a number of nodes turn or swing, each with three nodes attached.
void graph_step(benchmark::State& state) {
  test::RandomGraph random(2);
  std::vector<peer::GraphNode> nodes{{.name = "root"}};
  for (int part = 0; part < state.range(0); ++part) {
    const std::string name = fmt::format("p{}", part);
    nodes.push_back(
        {.name = name, .parent = "root", .pose = random.pose(), .motion = random.motion()});
    for (int below = 0; below < 3; ++below)
      nodes.push_back({.name = fmt::format("{}/{}", name, below),
                       .parent = name,
                       .kind = peer::NodeKind::content,
                       .pose = random.pose()});
  }
  peer::SceneGraph graph(nodes);
  std::chrono::milliseconds time{0};
  for (auto _ : state) {
    graph.evaluate(++time);
    benchmark::DoNotOptimize(graph.world(graph.size() - 1));
  }
}
BENCHMARK(graph_step)->ArgName("moving")->Arg(1)->Arg(10)->Arg(100);

/// Searches in a graph whose subtrees are apart, like rooms of a building, or overlap.
void graph_search(benchmark::State& state) {
  test::RandomGraph random(3);
  std::vector<peer::GraphNode> nodes{{.name = "root"}};
  const double apart = state.range(1) != 0 ? 20.0 : 0.0;
  const auto rooms = static_cast<std::size_t>(state.range(0)) / 50;
  std::vector<std::size_t> leaves;
  for (std::size_t room = 0; room < rooms; ++room) {
    const std::string name = fmt::format("r{}", room);
    nodes.push_back({.name = name, .parent = "root", .pose = {random.vector(apart)}});
    for (int i = 0; i < 49; ++i) {
      leaves.push_back(nodes.size());
      nodes.push_back({.name = fmt::format("{}/{}", name, i),
                       .parent = name,
                       .kind = peer::NodeKind::content,
                       .pose = {random.vector(1.0)}});
    }
  }
  const peer::SceneGraph graph(nodes);
  std::vector<peer::GraphBounds::Entry> entries;
  for (const std::size_t leaf : leaves)
    entries.push_back({graph.place_of(leaf), peer::SphereBounds{{0, 0, 0}, 0.05}});
  const peer::GraphBounds bounds(graph, entries);
  std::vector<peer::NodeIndex> found;
  std::size_t seen = 0;
  for (auto _ : state) {
    const peer::NodePose eye{random.vector(1 + apart), 1.0, random.turn()};
    found.clear();
    bounds.cull(peer::view_volume(eye, 1.2, 0.8, 0.1, 10), found);
    seen += found.size();
    benchmark::DoNotOptimize(bounds.pick(eye.position, random.vector(1)));
  }
  state.counters["found"] =
      benchmark::Counter(static_cast<double>(seen), benchmark::Counter::kAvgIterations);
}
BENCHMARK(graph_search)
    ->ArgNames({"nodes", "apart"})
    ->ArgsProduct({{1000, 100000}, {0, 1}})
    ->Unit(benchmark::kMicrosecond);

}  // namespace
