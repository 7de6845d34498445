// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Cost of queries between shapes: all pairs of moving boxes, each box moving by up to 0.02 of the
// mean box for each step, with equal density for any number of boxes (thesis 2.5.6, I-COLLIDE); and
// single pairs. Before the timing, the grid must find the same pairs as the sweep.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <random>
#include <utility>
#include <vector>

#include "reckon/haptics/queries/cell_grid.hpp"
#include "reckon/haptics/queries/time_of_impact.hpp"
#include "reckon/tests/support/touch_meshes.hpp"

namespace {

using Eigen::AlignedBox3d;
using Eigen::Vector3d;
using reckon::haptics::BoxPair;
using reckon::haptics::CellGrid;
using reckon::haptics::ContactShape;
using reckon::haptics::ImplicitSolid;
using reckon::haptics::Motion;
using reckon::haptics::PairMemory;
using reckon::haptics::Placement;
using reckon::haptics::QueryShape;
using reckon::haptics::SurfaceMesh;
namespace test = reckon::test;

constexpr double kMeanBox = 0.2;  // [m]

/// Boxes whose sizes differ by up to `ratio`, one in 0.2 m3.
class Boxes {
 public:
  Boxes(std::size_t count, double ratio) {
    const double reach = 0.5 * std::cbrt(0.2 * static_cast<double>(count));
    std::uniform_real_distribution<double> place(-reach, reach), power(0.0, 1.0);
    for (std::size_t i = 0; i < count; ++i) {
      const double size = kMeanBox * std::pow(ratio, power(random_) - 0.5);
      const Vector3d low(place(random_), place(random_), place(random_));
      all_.emplace_back(low, low + Vector3d::Constant(size));
    }
  }
  void move() {
    std::uniform_real_distribution<double> way(-0.02 * kMeanBox, 0.02 * kMeanBox);
    for (AlignedBox3d& box : all_)
      box.translate(Vector3d(way(random_), way(random_), way(random_)));
  }
  [[nodiscard]] const std::vector<AlignedBox3d>& all() const { return all_; }

 private:
  std::mt19937_64 random_{7};
  std::vector<AlignedBox3d> all_;
};

/// Sweep and prune along x: the order changes little from one step to the next.
class Sweep {
 public:
  explicit Sweep(std::size_t count) : order_(count) {
    for (std::uint32_t i = 0; i < count; ++i) order_[i] = i;
  }
  std::size_t pairs(const std::vector<AlignedBox3d>& boxes) {
    const auto low = [&](std::uint32_t i) { return boxes[i].min().x(); };
    for (std::size_t i = 1; i < order_.size(); ++i)
      for (std::size_t j = i; j > 0 && low(order_[j]) < low(order_[j - 1]); --j)
        std::swap(order_[j], order_[j - 1]);
    pairs_.clear();
    for (std::size_t i = 0; i < order_.size(); ++i) {
      const AlignedBox3d& a = boxes[order_[i]];
      for (std::size_t j = i + 1; j < order_.size(); ++j) {
        const AlignedBox3d& b = boxes[order_[j]];
        if (b.min().x() > a.max().x()) break;
        if (a.intersects(b)) pairs_.push_back({order_[i], order_[j]});
      }
    }
    return pairs_.size();
  }

 private:
  std::vector<std::uint32_t> order_;
  std::vector<BoxPair> pairs_;
};

std::size_t pairs_of(CellGrid& grid, const std::vector<AlignedBox3d>& boxes) {
  for (std::uint32_t i = 0; i < boxes.size(); ++i) grid.place(i, boxes[i]);
  return grid.overlaps().size();
}

void cell_grid(benchmark::State& state) {
  Boxes boxes(static_cast<std::size_t>(state.range(0)), static_cast<double>(state.range(1)));
  CellGrid grid;
  Sweep sweep(boxes.all().size());
  for (int i = 0; i < 3; ++i) {
    if (pairs_of(grid, boxes.all()) != sweep.pairs(boxes.all()))
      return state.SkipWithError("the grid and the sweep find different pairs");
    boxes.move();
  }
  std::size_t pairs = 0;
  for (auto _ : state) {
    state.PauseTiming();
    boxes.move();
    state.ResumeTiming();
    pairs = pairs_of(grid, boxes.all());
  }
  state.counters["pairs"] = static_cast<double>(pairs);
}
BENCHMARK(cell_grid)
    ->ArgNames({"boxes", "ratio"})
    ->Args({1'000, 1})
    ->Args({10'000, 1})
    ->Args({20'000, 1})
    ->Args({40'000, 1})
    ->Args({10'000, 1'000})
    ->Unit(benchmark::kMicrosecond);

void sweep_and_prune(benchmark::State& state) {
  Boxes boxes(static_cast<std::size_t>(state.range(0)), static_cast<double>(state.range(1)));
  Sweep sweep(boxes.all().size());
  std::size_t pairs = sweep.pairs(boxes.all());
  for (auto _ : state) {
    state.PauseTiming();
    boxes.move();
    state.ResumeTiming();
    pairs = sweep.pairs(boxes.all());
  }
  state.counters["pairs"] = static_cast<double>(pairs);
}
BENCHMARK(sweep_and_prune)
    ->ArgNames({"boxes", "ratio"})
    ->Args({1'000, 1})
    ->Args({10'000, 1})
    ->Args({20'000, 1})
    ->Args({10'000, 1'000})
    ->Unit(benchmark::kMicrosecond);

// --- single pairs, about 0.2 m in size and distance ---

std::vector<Placement> drawn_placements(double reach) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> x(-reach, reach);
  std::vector<Placement> all;
  for (int i = 0; i < 512; ++i) {
    const Vector3d turn(x(random), x(random), x(random));
    all.push_back({{x(random), x(random), x(random)},
                   Eigen::AngleAxisd(30.0 * turn.norm(), turn.normalized()).toRotationMatrix()});
  }
  return all;
}

QueryShape of_kind(std::size_t kind) {
  switch (kind) {
    case 0:
      return QueryShape::box({0.2, 0.1, 0.15});
    case 1:
      return QueryShape::capsule(0.03, 0.15);
    case 2:
      return QueryShape::sphere(0.05);
    case 3:
      return QueryShape(ContactShape(
          std::make_shared<const SurfaceMesh>(test::make_mesh(test::torus(72, 36), 0.25))));
    default:
      return QueryShape(ContactShape(
          std::make_shared<const ImplicitSolid>(reckon::haptics::CylinderShape{0.06, 0.12})));
  }
}

void pair(benchmark::State& state, std::size_t one, std::size_t other) {
  const QueryShape a = of_kind(one), b = of_kind(other);
  const std::vector<Placement> places = drawn_placements(0.25);
  std::size_t i = 0;
  std::size_t overlaps = 0;
  for (auto _ : state) {
    const auto found = measure_pair(a, {}, b, places[i++ % places.size()]);
    overlaps += found.overlap == reckon::haptics::Overlap::yes ? 1 : 0;
    benchmark::DoNotOptimize(overlaps);
  }
}
BENCHMARK_CAPTURE(pair, box_box, 0, 0);
BENCHMARK_CAPTURE(pair, capsule_capsule, 1, 1);
BENCHMARK_CAPTURE(pair, box_sphere, 0, 2);
BENCHMARK_CAPTURE(pair, mesh5184_sphere, 3, 2);
BENCHMARK_CAPTURE(pair, mesh5184_box, 3, 0);
BENCHMARK_CAPTURE(pair, mesh5184_mesh5184, 3, 3);
BENCHMARK_CAPTURE(pair, solid_sphere, 4, 2);
BENCHMARK_CAPTURE(pair, solid_box, 4, 0);
BENCHMARK_CAPTURE(pair, solid_mesh5184, 4, 3);

void time_of_impact(benchmark::State& state, std::size_t one, std::size_t other) {
  const QueryShape a = of_kind(one), b = of_kind(other);
  const std::vector<Placement> places = drawn_placements(0.1);
  std::size_t i = 0;
  for (auto _ : state) {
    Motion moves{places[i++ % places.size()], {-1.0, 0.0, 0.0}, {1.0, 2.0, 3.0}};
    moves.start.position.x() += 1.0;
    benchmark::DoNotOptimize(reckon::haptics::time_of_impact(a, {}, b, moves, 2.0));
  }
}
BENCHMARK_CAPTURE(time_of_impact, box_box, 0, 0);
BENCHMARK_CAPTURE(time_of_impact, mesh5184_box, 3, 0);

}  // namespace
