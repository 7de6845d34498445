// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Awareness: time for a pair by the shape of the focus and the number of occluders, with the
// difference of distances from other formulas in longer numbers, and the pairs that each stage
// removes. Channels: time to fit a budget, for each client.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "reckon/aoim/interest/awareness.hpp"
#include "reckon/aoim/interest/channel_table.hpp"

namespace {

using namespace reckon::aoim;
using Shape = AwarenessFocus::Shape;
constexpr double kExtent = 400.0;  // [m], side of the square with all entities

struct Scene {
  std::vector<Observer> observers;
  std::vector<Subject> subjects;
  std::vector<Occluders::Box> boxes;

  Scene(Shape shape, std::size_t occluders) : observers(4096), subjects(4096) {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    for (Observer& observer : observers) {
      AwarenessFocus& focus = observer.focus;
      focus.shape = shape;
      focus.position = {kExtent * unit(random), kExtent * unit(random), 2.0};
      focus.radius = 200.0;
      const double heading = 3.14159 * unit(random);
      focus.axis = {std::cos(heading), std::sin(heading), 0.0};
      focus.half_angle = 1.0;
      focus.half_sides = {200.0, 100.0, 20.0};
      observer.aura = 300.0;
      observer.kinds = ~4U;
    }
    for (Subject& subject : subjects) {
      subject.position = {kExtent * unit(random), kExtent * unit(random), 2.0};
      subject.nimbus = 5.0;
      subject.aura = 20.0;
      subject.kind = static_cast<std::uint8_t>(random() % 4);
    }
    for (std::size_t i = 0; i < occluders; ++i) {
      const double x = kExtent * unit(random), y = kExtent * unit(random);
      boxes.push_back({{x, y, 0.0}, {x + 30.0, y + 20.0, 10.0}});
    }
  }
};

// Computed with angles, where the evaluator rotates the plane.
double by_angles(const AwarenessFocus& focus, const Position& point) {
  using Long = long double;
  const Long x = Long{point.x} - focus.position.x, y = Long{point.y} - focus.position.y,
             z = Long{point.z} - focus.position.z;
  const Long away = std::sqrt(x * x + y * y + z * z);
  if (focus.shape == Shape::ball) {
    return static_cast<double>(std::max(Long{0}, away - focus.radius));
  }
  if (focus.shape == Shape::box) {
    const auto nearest = [](Long v, double half) {
      return v - std::clamp(v, -Long{half}, Long{half});
    };
    return static_cast<double>(std::hypot(nearest(x, focus.half_sides.x),
                                          nearest(y, focus.half_sides.y),
                                          nearest(z, focus.half_sides.z)));
  }
  const Long along = x * focus.axis.x + y * focus.axis.y + z * focus.axis.z;
  const Long off = std::acos(std::clamp(along / away, Long{-1}, Long{1})) - focus.half_angle;
  if (off <= 0) return static_cast<double>(std::max(Long{0}, away - focus.radius));
  if (off >= std::acos(Long{0})) return static_cast<double>(away);
  const Long on_edge = away * std::cos(off);
  return static_cast<double>(
      std::hypot(away * std::sin(off), std::max(Long{0}, on_edge - focus.radius)));
}

void awareness_of_pair(benchmark::State& state) {
  const Scene scene(static_cast<Shape>(state.range(0)), static_cast<std::size_t>(state.range(1)));
  double error = 0;
  for (std::size_t i = 0; i < 4096; ++i) {
    const AwarenessFocus& focus = scene.observers[i].focus;
    const Position& at = scene.subjects[i].position;
    error = std::max(error, std::abs(distance_to(focus, at) - by_angles(focus, at)));
  }
  const Occluders occluders(scene.boxes);
  AwarenessEvaluator evaluator(&occluders);
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        evaluator.evaluate(scene.observers[i & 4095], scene.subjects[i * 7 & 4095]));
    ++i;
  }
  const auto share = [&](Awareness answer) {
    return static_cast<double>(evaluator.count(answer)) / static_cast<double>(i);
  };
  state.counters["error_m"] = error;
  state.counters["aware"] = share(Awareness::aware);
  state.counters["class_off"] = share(Awareness::class_off);
  state.counters["auras_apart"] = share(Awareness::auras_apart);
  state.counters["out_of_focus"] = share(Awareness::out_of_focus);
  state.counters["occluded"] = share(Awareness::occluded);
}
BENCHMARK(awareness_of_pair)
    ->ArgNames({"ball_cone_box", "occluders"})
    ->ArgsProduct({{0, 1, 2}, {0, 16}});

void channels_of_budget(benchmark::State& state) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::vector<ChannelClient> clients(static_cast<std::size_t>(state.range(0)));
  for (ChannelClient& client : clients) client = {200.0 * std::sqrt(unit(random)), true};
  ChannelTable table;
  const double all = table.fit(clients, 1e18).octets_per_second;
  ChannelBudget budget;
  for (auto _ : state) {
    budget = table.fit(clients, 0.5 * all);
    benchmark::DoNotOptimize(budget);
  }
  state.SetItemsProcessed(state.iterations() * state.range(0));
  state.counters["stretch"] = budget.stretch;
  state.counters["of_budget"] = budget.octets_per_second / (0.5 * all);
}
BENCHMARK(channels_of_budget)->ArgName("clients")->Arg(100)->Arg(10000);

}  // namespace
