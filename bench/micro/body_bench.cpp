// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Cost of bodies in a servo step: a row of cubes on a floor; a hand presses the first one, or none.
// Each row has the time of a step and the difference of the force from two springs in series, in
// newtons. The later rows have the time until the force is written, compared in alternation with
// the same scene without bodies.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <numeric>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "reckon/bench/timing/cpu_ns.hpp"
#include "reckon/haptics/bodies/body_world.hpp"
#include "reckon/haptics/devices/simulated_device.hpp"
#include "reckon/haptics/queries/pair_query.hpp"
#include "reckon/haptics/servo/pressing_hands.hpp"
#include "reckon/haptics/servo/servo_loop.hpp"
#include "reckon/tests/haptics/support/hands_in_a_pile.hpp"

namespace {

using Eigen::Vector3d;
using namespace reckon::haptics;
using reckon::bench::cpu_ns;
namespace test = reckon::test;
using std::chrono::nanoseconds;

constexpr nanoseconds kPeriod{1'000'000};
constexpr double kEdge = 0.04;         // [m], edge of a cube
constexpr double kStiffness = 400;     // [N/m], of the cubes
constexpr double kGrip = 300;          // [N/m], of the hand
constexpr double kWanted = 0.005;      // [m], target depth of the hand in the cube
constexpr double kOthersDeep = 0.001;  // [m], of hands of other peers

Scene row_of(std::size_t cubes, double mass) {
  Scene scene;
  SceneObject& floor = scene.objects.emplace_back();
  floor.name = "floor";
  floor.shape = PlaneShape{Vector3d::UnitZ()};
  floor.effects.of<SpringDamper>() = {kStiffness, 0.0};
  for (std::size_t i = 0; i < cubes; ++i) {
    SceneObject& cube = scene.objects.emplace_back();
    cube.name = "cube " + std::to_string(i);
    cube.shape = BoxShape{Vector3d::Constant(kEdge)};
    cube.pose.position = {kEdge * static_cast<double>(i), 0, 0.5 * kEdge};
    cube.effects.of<SpringDamper>() = {kStiffness, 0.0};
    cube.matter = {mass, 0.5, 0.0};
  }
  return scene;
}

// Arguments: number of cubes, mass of each in grams, whether the first one is pressed.
void servo_step_at_bodies(benchmark::State& state) {
  const bool holds = state.range(2) != 0;
  const Scene scene =
      row_of(static_cast<std::size_t>(state.range(0)), 1e-3 * static_cast<double>(state.range(1)));
  const auto plan = std::make_shared<const EffectPlan>(scene);
  const auto world = make_bodies(*plan, scene);
  SimulatedDeviceConfig config;
  config.damping = 1.0;
  config.hand_stiffness = kGrip;
  config.start = {0, 0, 1.5 * kEdge};
  SimulatedDevice device(config, [holds](double t) {
    HandTarget target;
    target.position.z() = holds ? kEdge + 0.01 - (0.01 + kWanted) * std::min(1.0, t) : 1.5 * kEdge;
    return target;
  });
  ServoLoop servo(device, plan, ServoConfig{}, world);
  nanoseconds now{1'000'000'000};
  for (int i = 0; i < 3000; ++i) servo.step(now += kPeriod);
  const double right =
      holds && state.range(0) > 0 ? kStiffness * kGrip / (kStiffness + kGrip) * kWanted : 0.0;
  double error = 0.0;
  for (auto _ : state) {
    servo.step(now += kPeriod);
    state.PauseTiming();
    (void)servo.snapshots().update();
    error = std::max(error, std::abs(servo.snapshots().read().force.z() - right));
    state.ResumeTiming();
  }
  state.counters["error_n"] = error;
}
BENCHMARK(servo_step_at_bodies)
    ->ArgNames({"cubes", "grams", "held"})
    ->Args({0, 50, 0})
    ->Args({1, 50, 0})
    ->Args({1, 50, 1})
    ->Args({1, 1, 1})
    ->Args({6, 50, 0})
    ->Args({6, 50, 1})
    ->Args({27, 50, 0});

/// Stores the CPU time at which its force is written.
class StampedDevice : public SimulatedDevice {
 public:
  using SimulatedDevice::SimulatedDevice;
  void write(const Vector3d& force, nanoseconds now) noexcept override {
    written = cpu_ns();
    SimulatedDevice::write(force, now);
  }
  double written = 0.0;  // [ns], see cpu_ns()
};

/// A hand that presses a wall, and balls that bounce for ever out of its reach.
struct Bouncing {
  explicit Bouncing(std::size_t balls) {
    Scene scene = row_of(0, 0.0);
    scene.objects[0].matter.restitution = 1.0;
    for (std::size_t i = 0; i < balls; ++i) {
      SceneObject& ball = scene.objects.emplace_back();
      ball.name = "ball " + std::to_string(i);
      ball.shape = SphereShape{0.5 * kEdge};
      ball.pose.position = {1 + 1.5 * kEdge * static_cast<double>(i), 0, kEdge};
      ball.matter = {0.05, 0.5, 1.0};
    }
    SimulatedDeviceConfig config;
    config.hand_stiffness = kGrip;
    device.emplace(config, [](double) { return HandTarget{{0, 0, -kWanted}}; });
    plan = std::make_shared<const EffectPlan>(scene);
    servo.emplace(*device, plan, ServoConfig{}, make_bodies(*plan, scene));
  }
  /// CPU time until the force is written, and of the whole step [us].
  std::pair<double, double> step() {
    const double begin = cpu_ns();
    servo->step(now += kPeriod);
    const double end = cpu_ns();
    return {1e-3 * (device->written - begin), 1e-3 * (end - begin)};
  }

  std::shared_ptr<const EffectPlan> plan;
  std::optional<StampedDevice> device;
  std::optional<ServoLoop> servo;
  nanoseconds now{1'000'000'000};
};

double share_of(std::vector<double>& times, double share) {
  const auto nth =
      times.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(times.size() - 1));
  std::ranges::nth_element(times, nth);
  return *nth;
}

// Argument: number of balls that are awake and not touched.
void until_force_is_written(benchmark::State& state) {
  Bouncing with(static_cast<std::size_t>(state.range(0))), without(0);
  std::vector<double> times, bare, whole;
  for (int i = 0; i < 1000; ++i) with.step(), without.step();
  for (auto _ : state) {
    const auto [written, step] = with.step();
    times.push_back(written);
    whole.push_back(step);
    bare.push_back(without.step().first);
  }
  state.counters["median_us"] = share_of(times, 0.5);
  state.counters["p999_us"] = share_of(times, 0.999);
  state.counters["bare_median_us"] = share_of(bare, 0.5);
  state.counters["bare_p999_us"] = share_of(bare, 0.999);
  state.counters["p999_ratio"] = share_of(times, 0.999) / share_of(bare, 0.999);
  state.counters["step_median_us"] = share_of(whole, 0.5);
}
// A step of all bodies while boxes fall into a pile from random places, until all are asleep; and
// the greatest overlap of two of them. Argument: number of boxes.
void pile_falls(benchmark::State& state) {
  Scene scene = row_of(0, 0.0);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  for (int i = 0; i < state.range(0); ++i) {
    SceneObject& box = scene.objects.emplace_back();
    box.name = "box " + std::to_string(i);
    box.shape = BoxShape{Vector3d::Constant(kEdge)};
    box.pose.position = {0.05 * (i % 3) + 0.004 * any(random), 0.05 * (i / 3 % 3),
                         0.05 + 0.05 * (i / 9)};
    box.pose.orientation =
        Eigen::Quaterniond(1, 0.2 * any(random), 0.2 * any(random), 0).normalized();
    box.matter = {0.1, 0.5, 0.0};
  }
  const EffectPlan plan(scene);
  const QueryShape shape = QueryShape::box(Vector3d::Constant(kEdge));
  std::vector<double> times;
  double deepest = 0.0, asleep = 0.0;
  for (auto _ : state) {
    const auto world = make_bodies(plan, scene);
    nanoseconds now{0};
    world->advance_to(now);
    const auto is_awake = [&] { return std::ranges::any_of(world->states(), &BodyState::awake); };
    for (int i = 0; i < 10'000 && is_awake(); ++i) {
      const double begin = cpu_ns();
      world->advance_to(now += kPeriod);
      times.push_back(1e-3 * (cpu_ns() - begin));
    }
    asleep = std::chrono::duration<double>(now).count();
    const auto at = [](const BodyState& body) {
      return Placement{body.position, body.orientation.toRotationMatrix()};
    };
    for (const BodyState& a : world->states())
      for (const BodyState& b : world->states())
        if (&a < &b)
          deepest = std::max(deepest, measure_pair(shape, at(a), shape, at(b)).depth.most);
  }
  state.counters["median_us"] = share_of(times, 0.5);
  state.counters["p99_us"] = share_of(times, 0.99);
  state.counters["asleep_after_s"] = asleep;
  state.counters["deepest_um"] = 1e6 * deepest;
}

/// CPU time of a step until the last force is written, and of all of it [us].
std::pair<double, double> time_step(test::HandsInAPile<StampedDevice>& pile) {
  const double begin = cpu_ns();
  pile.step();
  const double end = cpu_ns();
  return {1e-3 * (pile.devices.back()->written - begin), 1e-3 * (end - begin)};
}

// Ten seconds of hands in a pile. Arguments: number of boxes and of hands.
void hands_in_a_pile(benchmark::State& state) {
  std::vector<double> written, whole;
  double awake = 0.0, late = 0.0, counted = 0.0, spent = 0.0;
  for (auto _ : state) {
    test::HandsInAPile<StampedDevice> pile(static_cast<int>(state.range(0)),
                                           static_cast<int>(state.range(1)));
    for (int i = 0; i < 1000; ++i) time_step(pile);
    const double before = pile.world->work();
    for (int i = 0; i < 10'000; ++i) {
      const auto [force, step] = time_step(pile);
      written.push_back(force);
      whole.push_back(step);
      spent += 1e-6 * step;
      late += step > 1e6 * std::chrono::duration<double>(kPeriod).count() ? 1.0 : 0.0;
      awake += static_cast<double>(std::ranges::count_if(pile.world->states(), &BodyState::awake));
    }
    counted += pile.world->work() - before;
  }
  state.counters["awake"] = awake / static_cast<double>(whole.size());
  state.counters["force_median_us"] = share_of(written, 0.5);
  state.counters["force_p999_us"] = share_of(written, 0.999);
  state.counters["step_median_us"] = share_of(whole, 0.5);
  state.counters["step_p999_us"] = share_of(whole, 0.999);
  state.counters["late_steps"] = late;
  state.counters["counted_ratio"] = counted / spent;
}
BENCHMARK(hands_in_a_pile)
    ->ArgNames({"boxes", "hands"})
    ->Args({1, 1})
    ->Args({8, 1})
    ->Args({27, 1})
    ->Args({64, 1})
    ->Args({64, 2})
    ->Args({27, 4})
    ->Iterations(1);

/// A hand that presses a cube, or the floor beside it; cubes that sleep out of its reach; and hands
/// of other peers that press the sides of the cube.
struct Sleeping {
  Sleeping(std::size_t cubes, std::size_t asleep, bool at_cube, std::size_t others = 0) {
    Scene scene = row_of(cubes, 0.05);
    for (std::size_t i = 0; i < asleep; ++i) {
      SceneObject cube = row_of(1, 0.05).objects.back();
      cube.name = "sleeper " + std::to_string(i);
      cube.pose.position += Vector3d(1 + 2 * kEdge * static_cast<double>(i % 100),
                                     2 * kEdge * static_cast<double>(i / 100), 0);
      scene.objects.push_back(cube);
    }
    SimulatedDeviceConfig config;
    config.damping = 1.0;
    config.hand_stiffness = kGrip;
    config.start = {at_cube ? 0 : -0.1, 0, 1.5 * kEdge};
    const double goal = (at_cube ? kEdge : 0.0) - kWanted;
    device.emplace(config, [x = config.start.x(), goal](double t) {
      return HandTarget{{x, 0, std::max(goal, 1.5 * kEdge - 0.1 * t)}};
    });
    plan = std::make_shared<const EffectPlan>(scene);
    const auto world = make_bodies(*plan, scene);
    if (others > 0) pressing.emplace(*world, plan, ServoConfig{});
    servo.emplace(*device, plan, ServoConfig{}, world);
    if (others > 0) press(others);
    for (int i = 0; i < 3000; ++i) step();
  }
  void press(std::size_t others) {
    HandList& list = pressing->hands().write_slot();
    list.count = others;
    for (std::size_t i = 0; i < others; ++i) {
      RemoteHand& hand = list.hands[i];
      hand.id = {1, static_cast<std::uint16_t>(i + 2), 1};
      hand.state_time = now;
      const double side = i % 2 == 0 ? 1 : -1, along = 0.004 * static_cast<double>(i / 2);
      hand.state.position = {side * (0.5 * kEdge - kOthersDeep), along, 0.5 * kEdge};
    }
    pressing->hands().publish();
  }
  double step() {  // [us]
    const double begin = cpu_ns();
    servo->step(now += kPeriod);
    return 1e-3 * (cpu_ns() - begin);
  }
  double force() {
    (void)servo->snapshots().update();
    return servo->snapshots().read().force.z();
  }
  std::optional<SimulatedDevice> device;
  std::shared_ptr<const EffectPlan> plan;
  std::optional<PressingHands> pressing;
  std::optional<ServoLoop> servo;
  nanoseconds now{1'000'000'000};
};

// Median of means of 16 times each, because the clock has a resolution of only 10 ns.
double median_of_means(const std::vector<double>& times) {
  const std::size_t of = std::min<std::size_t>(16, times.size());
  std::vector<double> means;
  for (std::size_t i = 0; i + of <= times.size(); i += of)
    means.push_back(std::accumulate(&times[i], &times[i] + of, 0.0) / static_cast<double>(of));
  return share_of(means, 0.5);
}

// A whole step of the servo, with and without sleeping cubes. Arguments: number of sleeping cubes,
// whether the hand presses a cube of its own.
void beside_those_asleep(benchmark::State& state) {
  const bool at_cube = state.range(1) != 0;
  const std::size_t own = at_cube ? 1 : 0;
  Sleeping with(own, static_cast<std::size_t>(state.range(0)), at_cube);
  Sleeping without(own, 0, at_cube);
  std::vector<double> times, bare;
  for (auto _ : state) times.push_back(with.step()), bare.push_back(without.step());
  state.counters["median_us"] = median_of_means(times);
  state.counters["bare_median_us"] = median_of_means(bare);
  state.counters["median_ratio"] = median_of_means(times) / median_of_means(bare);
  state.counters["p999_ratio"] = share_of(times, 0.999) / share_of(bare, 0.999);
  state.counters["force_off_n"] = std::abs(with.force() - without.force());
}
BENCHMARK(beside_those_asleep)
    ->ArgNames({"asleep", "at_cube"})
    ->ArgsProduct({{0, 60, 1000, 10'000}, {0, 1}});

// The same beside a cube that hands of other peers press too. Argument: number of those hands.
void beside_hands_of_others(benchmark::State& state) {
  Sleeping with(1, 0, true, static_cast<std::size_t>(state.range(0)));
  Sleeping without(1, 0, true);
  std::vector<double> times, bare;
  for (auto _ : state) times.push_back(with.step()), bare.push_back(without.step());
  state.counters["median_us"] = median_of_means(times);
  state.counters["bare_median_us"] = median_of_means(bare);
  state.counters["median_ratio"] = median_of_means(times) / median_of_means(bare);
  state.counters["force_off_n"] = std::abs(with.force() - without.force());
}
BENCHMARK(beside_hands_of_others)->ArgName("others")->Arg(1)->Arg(2)->Arg(8);

BENCHMARK(pile_falls)->ArgName("boxes")->Arg(10)->Arg(30)->Arg(60)->Iterations(1);

BENCHMARK(until_force_is_written)->ArgName("balls")->Arg(0)->Arg(8)->Arg(27)->Arg(60);

}  // namespace
