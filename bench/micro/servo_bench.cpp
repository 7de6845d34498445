// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
// Cost of a servo step: a simulated hand among n remote hands, all touching it, with and without a
// wall under it, and over a scene of many objects out of reach. Each row has the time of a step,
// the difference of its force from the closed form, in newtons, and the least energy of the port,
// in joules. The motion filter's rows have the error of its velocity, in m/s.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include "reckon/haptics/contact/contact_solver.hpp"
#include "reckon/haptics/devices/simulated_device.hpp"
#include "reckon/haptics/servo/motion_filter.hpp"
#include "reckon/haptics/servo/servo_loop.hpp"
#include "reckon/tests/support/touch_meshes.hpp"

namespace {

using Eigen::Vector3d;
using namespace reckon::haptics;
using std::chrono::nanoseconds;

constexpr nanoseconds kPeriod{1'000'000};
constexpr double kRadius = 0.01;
constexpr double kStiffness = 800.0;  // of all hands together, below the passive limit
constexpr double kDepth = 0.001;
constexpr double kFewest = 8.0;  // from here on hands share the stiffness and the ring

double stiffness_each(std::size_t hands) {
  return kStiffness / std::max(kFewest, static_cast<double>(hands));
}

// n hands around ours, each pressed in by kDepth; their forces have a closed-form sum.
ContactSet ring(std::size_t hands) {
  ContactSet set;
  set.count = hands;
  for (std::size_t i = 0; i < hands; ++i) {
    const double angle = 0.5 * std::numbers::pi * static_cast<double>(i) /
                         std::max(kFewest, static_cast<double>(hands));
    RemoteHand& hand = set.hands[i];
    hand.id = {1, 1, static_cast<std::uint16_t>(i + 1)};
    hand.state.position =
        (2.0 * kRadius - kDepth) * Vector3d(std::cos(angle), std::sin(angle), 0.0);
    hand.model.kind = reckon::pdu::ForceModelKind::sphere;
    hand.model.radius = kRadius;
    hand.model.k1 = stiffness_each(hands);
    hand.valid_until = std::chrono::hours(24);
    hand.version = 1;
  }
  return set;
}

Vector3d expected(const ContactSet& set, const Vector3d& device) {
  Vector3d force = Vector3d::Zero();
  for (std::size_t i = 0; i < set.count; ++i) {
    const Vector3d away = device - set.hands[i].state.position;
    const double depth = 2.0 * kRadius - away.norm();
    if (depth > 0) force += stiffness_each(set.count) * depth * away.normalized();
  }
  return force;
}

// Presses, then trembles: a hand at perfect rest ends in denormal numbers, which no device returns.
HandTarget press(double t) {
  HandTarget target;
  target.position.z() = std::max(0.0, 0.02 - 0.02 * t) + 1e-5 * std::sin(30.0 * t);
  target.position.x() = 1e-5 * std::sin(50.0 * t);
  target.position.y() = 1e-5 * std::cos(50.0 * t);
  return target;
}

void servo_step(benchmark::State& state) {
  const auto hands = static_cast<std::size_t>(state.range(0));
  Scene scene;
  if (state.range(1) != 0) {
    SceneObject wall;
    wall.name = "wall";
    wall.shape = PlaneShape{};
    wall.pose.position.z() = 0.002;
    wall.effects.of<SpringDamper>().stiffness = 800.0;
    scene.objects.push_back(wall);
  }
  SimulatedDeviceConfig config;
  config.hand_stiffness = 2000.0;  // holds the hand in the middle
  config.start.z() = 0.02;
  SimulatedDevice device(config, press);
  ServoLoop servo(device, EffectPlan(scene), {.probe_radius = kRadius});
  const ContactSet set = ring(hands);
  nanoseconds now{0};
  servo.contacts().write(set);
  for (int i = 0; i < 4000; ++i, now += kPeriod) servo.step(now);

  for (auto _ : state) {
    // The model loop writes at half the servo's rate.
    if (now.count() / kPeriod.count() % 2 == 0) servo.contacts().write(set);
    servo.step(now);
    now += kPeriod;
  }
  servo.snapshots().update();
  const ServoSnapshot& last = servo.snapshots().read();
  state.counters["force_error_n"] =
      (last.force - last.mesh_force - expected(set, last.device)).norm();
  state.counters["energy_min_j"] = last.port_energy_min;
}

// Replays the motion of a simulated hand, forwards and back: the remaining time of a step is the
// servo's.
class RecordedDevice : public HapticDevice {
 public:
  RecordedDevice(const DeviceLimits& limits, std::vector<DeviceSample> samples)
      : limits_(limits), samples_(std::move(samples)) {
    for (std::size_t i = samples_.size(); i > 0; --i) {
      samples_.push_back(samples_[i - 1]);
      samples_.back().velocity = -samples_.back().velocity;
    }
  }
  [[nodiscard]] DeviceLimits limits() const noexcept override { return limits_; }
  [[nodiscard]] DeviceSample read(nanoseconds /*now*/) noexcept override {
    const DeviceSample& sample = samples_[next_];
    next_ = next_ + 1 == samples_.size() ? 0 : next_ + 1;
    return sample;
  }
  void write(const Vector3d& /*force*/, nanoseconds /*now*/) noexcept override {}

 private:
  DeviceLimits limits_;
  std::vector<DeviceSample> samples_;
  std::size_t next_ = 0;
};

// Returns the readings of a device and stores them.
class Recorder : public HapticDevice {
 public:
  explicit Recorder(HapticDevice& device) : device_(device) {}
  [[nodiscard]] DeviceLimits limits() const noexcept override { return device_.limits(); }
  [[nodiscard]] DeviceSample read(nanoseconds now) noexcept override {
    samples.push_back(device_.read(now));
    return samples.back();
  }
  void write(const Vector3d& force, nanoseconds now) noexcept override {
    device_.write(force, now);
  }
  std::vector<DeviceSample> samples;

 private:
  HapticDevice& device_;
};

Scene rough_torus(const std::filesystem::path& file) {
  reckon::test::write_obj(reckon::test::torus(264, 132), file);
  Scene scene;
  SceneObject torus;
  torus.name = "torus";
  torus.shape = MeshShape{file, 0.2, true};
  torus.effects.of<SpringDamper>().stiffness = 800.0;
  torus.effects.declare<StickSlipFriction>();
  scene.objects.push_back(torus);
  return scene;
}

// A hand that strokes a rough mesh 2 mm below its surface at 0.1 m/s: the whole step, with the
// simulated hand or with its recorded motion.
void servo_step_on_mesh(benchmark::State& state) {
  const std::filesystem::path file = std::filesystem::temp_directory_path() / "reckon_torus.obj";
  const auto plan = std::make_shared<const EffectPlan>(rough_torus(file));
  std::filesystem::remove(file);
  // Around the top of the tube, whose middle circle has a radius of 1 / 1.4 of half the width.
  const double width = 0.2 / std::sqrt(2.0 * 2.8 * 2.8 + 0.8 * 0.8);
  SimulatedDeviceConfig config;
  config.start = Vector3d(width, 0.0, 0.5 * width);
  config.hand_stiffness = 2000.0;
  const auto stroke = [width](double t) {
    HandTarget target;
    const double angle = 0.1 / width * t;
    target.position = width * Vector3d(std::cos(angle), std::sin(angle), 0.4) +
                      Vector3d(0.0, 0.0, -2e-3 * std::min(1.0, t));
    return target;
  };
  const ServoConfig probe{.contact_radius = 1e-3 * static_cast<double>(state.range(0))};
  SimulatedDevice hand(config, stroke);
  Recorder recorder(hand);
  nanoseconds now{0};
  ServoLoop first(recorder, plan, probe);
  for (int i = 0; i < 8000; ++i, now += kPeriod) first.step(now);
  recorder.samples.erase(recorder.samples.begin(), recorder.samples.begin() + 4000);

  SimulatedDevice simulated(config, stroke);
  RecordedDevice recorded(hand.limits(), std::move(recorder.samples));
  HapticDevice& device = state.range(1) != 0 ? static_cast<HapticDevice&>(recorded) : simulated;
  ServoLoop servo(device, plan, probe);
  now = nanoseconds{0};
  for (int i = 0; i < 4000; ++i, now += kPeriod) servo.step(now);
  for (auto _ : state) {
    servo.step(now);
    now += kPeriod;
  }
  servo.snapshots().update();
  state.counters["touches"] = servo.snapshots().read().in_mesh_contact ? 1.0 : 0.0;
  state.counters["energy_min_j"] = servo.snapshots().read().port_energy_min;
}
BENCHMARK(servo_step_on_mesh)->ArgNames({"radius_mm", "recorded"})->ArgsProduct({{0, 1}, {0, 1}});

void hands_and_walls(benchmark::internal::Benchmark* rows) {
  rows->ArgNames({"hands", "wall"})->Args({0, 0})->Args({0, 1})->Args({1, 0})->Args({1, 1});
  for (std::size_t hands = 2; hands <= kMaxRemoteHands; hands *= 2) {
    rows->Args({static_cast<std::int64_t>(hands), 0});
  }
}
BENCHMARK(servo_step)->Apply(hands_and_walls);

// Boxes of 2 cm on a grid of 0.1 m that begins 1 m away: none is ever near.
Scene far_boxes(std::size_t count) {
  const auto side = static_cast<std::size_t>(std::ceil(std::cbrt(static_cast<double>(count))));
  Scene scene;
  for (std::size_t i = 0; i < count; ++i) {
    SceneObject box;
    box.name = "box";
    box.shape = BoxShape{Vector3d::Constant(0.02)};
    box.pose.position =
        Vector3d::Constant(1.0) + 0.1 * Vector3d(static_cast<double>(i % side),
                                                 static_cast<double>(i / side % side),
                                                 static_cast<double>(i / side / side));
    scene.objects.push_back(box);
  }
  return scene;
}

// A hand that moves in free space at up to 0.3 m/s.
void far_objects(benchmark::State& state) {
  SimulatedDevice device({}, [](double t) {
    HandTarget target;
    target.position.x() = 0.05 * std::sin(6.0 * t);
    return target;
  });
  ServoLoop servo(device, EffectPlan(far_boxes(static_cast<std::size_t>(state.range(0)))), {});
  nanoseconds now{0};
  for (int i = 0; i < 1000; ++i, now += kPeriod) servo.step(now);
  for (auto _ : state) {
    servo.step(now);
    now += kPeriod;
  }
  servo.snapshots().update();
  state.counters["force_error_n"] = servo.snapshots().read().force.norm();
}
BENCHMARK(far_objects)->ArgName("objects")->Arg(1)->Arg(100)->Arg(10'000);

// A restart, which searches every object.
void reset_far_objects(benchmark::State& state) {
  const EffectPlan plan(far_boxes(static_cast<std::size_t>(state.range(0))));
  ContactSolver solver(plan);
  for (auto _ : state) benchmark::DoNotOptimize(solver.reset(Vector3d::Zero()).in_contact);
}
BENCHMARK(reset_far_objects)->ArgName("objects")->Arg(1)->Arg(100)->Arg(10'000);

// A stroke of 5 cm and up to 0.3 m/s, read in steps of `resolution` micrometres.
void motion_filter(benchmark::State& state) {
  const double step = 1e-6 * static_cast<double>(state.range(0));
  constexpr double kRate = 6.0;  // [rad/s]
  std::vector<Vector3d> positions;
  const auto place = [](double t) { return Vector3d(0.05 * std::sin(kRate * t), 0.01 * t, 0.0); };
  constexpr int kSteps = 4096;
  for (int i = 0; i < kSteps; ++i) {
    Vector3d p = place(1e-3 * i);
    if (step > 0) p = (p / step).array().round().matrix() * step;
    positions.push_back(p);
  }
  MotionFilter check;
  double worst = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    check.add(positions[static_cast<std::size_t>(i)], 1e-3 * i);
    const Vector3d truth(0.05 * kRate * std::cos(kRate * 1e-3 * i), 0.01, 0.0);
    if (i > 64) worst = std::max(worst, (check.velocity() - truth).norm());
  }

  MotionFilter filter;
  std::size_t i = 0;
  for (auto _ : state) {
    if (i == positions.size()) {
      i = 0;
      filter.reset();
    }
    filter.add(positions[i], 1e-3 * static_cast<double>(i));
    benchmark::DoNotOptimize(filter.velocity());
    ++i;
  }
  state.counters["velocity_error_m_s"] = worst;
}
BENCHMARK(motion_filter)->ArgName("resolution_um")->Arg(0)->Arg(10)->Arg(40);

// The simulated hand alone, to be subtracted from the rows of servo_step.
void simulated_device_alone(benchmark::State& state) {
  SimulatedDevice device({}, press);
  nanoseconds now{0};
  for (auto _ : state) {
    benchmark::DoNotOptimize(device.read(now).position);
    device.write(Vector3d::Zero(), now);
    now += kPeriod;
  }
}
BENCHMARK(simulated_device_alone);

}  // namespace
