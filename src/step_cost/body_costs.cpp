// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/step_cost/body_costs.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "reckon/haptics/bodies/body_world.hpp"
#include "reckon/haptics/devices/simulated_device.hpp"
#include "reckon/haptics/servo/servo_loop.hpp"
#include "reckon/pdu/seconds.hpp"
#include "reckon/peer/threads/cpu_time.hpp"
#include "reckon/peer/world/shared_bodies.hpp"

namespace reckon::peer {
namespace {

using Eigen::Vector3d;
using std::chrono::nanoseconds;

constexpr std::size_t kMeasured = 700;  // periods
constexpr double kSpread = 0.02;        // [m], greatest distance of an island's bodies
constexpr double kReach = 0.1;          // [m], greatest way of a hand from an island's middle
constexpr double kSpeed = 1.0;          // [m/s], on the way there
constexpr double kReference = 0.43;     // time over counted work of the reference host

/// Notes the CPU time at which its force is written.
class StampedDevice : public haptics::SimulatedDevice {
 public:
  using SimulatedDevice::SimulatedDevice;
  void write(const Vector3d& force, nanoseconds now) noexcept override {
    written = pdu::to_seconds(thread_cpu_time());
    SimulatedDevice::write(force, now);
  }
  double written = 0.0;
};

/// Where hands sweep.
struct Sweep {
  Eigen::AlignedBox3d box;  // [m], S, of an island
  Vector3d up = Vector3d::UnitZ();

  // From above the island to its middle [m].
  [[nodiscard]] double way() const { return 0.5 * box.sizes().dot(up.cwiseAbs()) + 0.05; }
  [[nodiscard]] double arrival() const { return way() / kSpeed; }  // [s]
  [[nodiscard]] haptics::HandTarget at(double t, std::size_t hand) const {
    const double phase = 3.0 * static_cast<double>(hand);
    const Vector3d turn(std::cos(9.0 * t + phase), std::sin(12.3 * t + phase), std::sin(7.0 * t));
    const Vector3d reach = (0.35 * box.sizes()).cwiseMin(kReach);
    const double left = std::max(0.0, way() - kSpeed * t);
    return {box.center() + reach.cwiseProduct(turn) + left * up};
  }
};

// The largest group of bodies whose boxes are near one another at the start.
Eigen::AlignedBox3d largest_island(const haptics::EffectPlan& plan) {
  std::vector<Eigen::AlignedBox3d> boxes;
  for (const haptics::PlannedObject& object : plan.objects())
    if (object.moves() && object.bounds.sizes().allFinite()) boxes.push_back(object.bounds);
  std::size_t most = 0;
  Eigen::AlignedBox3d best;
  std::vector<bool> seen(boxes.size());
  for (std::size_t first = 0; first < boxes.size(); ++first) {
    if (seen[first]) continue;
    std::vector<std::size_t> island{first};
    seen[first] = true;
    Eigen::AlignedBox3d whole;
    for (std::size_t k = 0; k < island.size(); ++k) {
      whole.extend(boxes[island[k]]);
      for (std::size_t i = 0; i < boxes.size(); ++i) {
        if (seen[i] || boxes[island[k]].exteriorDistance(boxes[i]) > kSpread) continue;
        seen[i] = true;
        island.push_back(i);
      }
    }
    if (island.size() > most) best = whole;
    most = std::max(most, island.size());
  }
  return best;
}

/// A peer's bodies and hands.
class Run {
 public:
  Run(const SceneFile& scene, const std::shared_ptr<const haptics::EffectPlan>& plan,
      const Sweep& sweep, std::size_t hands, nanoseconds period, double pace)
      : period_(period),
        world_(haptics::make_bodies(*plan, scene.scene,
                                    std::make_shared<BodyMover>(*plan, scene.nodes))) {
    world_->set_pace(pace);
    haptics::ServoConfig config;
    config.period = period;
    config.probe_radius = scene.hand.radius;
    for (std::size_t hand = 0; hand < hands; ++hand) {
      haptics::SimulatedDeviceConfig device;
      device.hand_stiffness = 300.0;
      device.start = sweep.at(0.0, hand).position;
      devices_.push_back(std::make_unique<StampedDevice>(
          device, [sweep, hand](double t) { return sweep.at(t, hand); }));
      servos_.push_back(
          std::make_unique<haptics::ServoLoop>(*devices_.back(), plan, config, world_));
    }
  }
  [[nodiscard]] const haptics::BodyWorld& world() const { return *world_; }
  /// @return CPU until the last force is written, and of all [s]
  std::pair<double, double> step() {
    if (count_++ % 500 == 0) {
      for (std::uint32_t body = 0; body < world_->states().size(); ++body)
        static_cast<void>(world_->order({haptics::BodyAct::wake, body}));
    }
    now_ += period_;
    const double begin = pdu::to_seconds(thread_cpu_time());
    for (const auto& servo : servos_) servo->step(now_);
    const double end = pdu::to_seconds(thread_cpu_time());
    return {devices_.back()->written - begin, end - begin};
  }

 private:
  nanoseconds period_, now_{1'000'000'000};
  std::shared_ptr<haptics::BodyWorld> world_;
  std::vector<std::unique_ptr<StampedDevice>> devices_;
  std::vector<std::unique_ptr<haptics::ServoLoop>> servos_;
  int count_ = 0;
};

double share_of(std::vector<double> times, double share) {
  const auto nth =
      times.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(times.size() - 1));
  std::ranges::nth_element(times, nth);
  return *nth;
}

Sweep sweep_in(const SceneFile& scene, const haptics::EffectPlan& plan) {
  Sweep sweep{largest_island(plan)};
  if (scene.scene.gravity.norm() > 0) sweep.up = -scene.scene.gravity.normalized();
  return sweep;
}

// 27 boxes in a cube, which fall apart.
SceneFile pile_of_boxes() {
  SceneFile file;
  const auto add = [&file](const auto& shape, const Vector3d& at, double mass) {
    haptics::SceneObject& object = file.scene.objects.emplace_back();
    object.name = "object " + std::to_string(file.scene.objects.size());
    object.shape = shape;
    object.pose.position = at;
    object.matter.mass = mass;
    object.matter.friction = 0.5;
  };
  add(haptics::PlaneShape{Vector3d::UnitZ()}, Vector3d::Zero(), 0.0);
  for (int i = 0; i < 27; ++i)
    add(haptics::BoxShape{Vector3d::Constant(0.04)},
        {0.041 * (i % 3), 0.041 * (i / 3 % 3), 0.021 + 0.041 * (i / 9)}, 0.05);
  return file;
}

}  // namespace

std::optional<BodyCosts> measure_bodies(const SceneFile& scene, std::size_t hands,
                                        nanoseconds period, const BodyRuns& runs) {
  const auto plan = std::make_shared<const haptics::EffectPlan>(scene.scene);
  const auto has_mass = [](const haptics::SceneObject& object) { return object.matter.mass > 0; };
  if (std::ranges::none_of(scene.scene.objects, has_mass)) return std::nullopt;
  const Sweep sweep = sweep_in(scene, *plan);
  const double step = pdu::to_seconds(period), settled = sweep.arrival() + 0.05;
  std::vector<double> written, whole, awake;
  for (int run = 0; run < runs.runs; ++run) {
    Run bodies(scene, plan, sweep, hands, period, runs.pace);
    const double begin = pdu::to_seconds(thread_cpu_time());
    const auto is_over = [&](double share) {
      return pdu::to_seconds(thread_cpu_time()) - begin > share * runs.longest;
    };
    for (double time = 0.0; time < settled && !is_over(0.5); time += step) bodies.step();
    const std::size_t most = run == 0 ? kMeasured : whole.size();
    for (std::size_t i = 0; i < most && (run > 0 || !is_over(1.0)); ++i) {
      const auto [force, all] = bodies.step();
      if (run > 0) {
        written[i] = std::min(written[i], force);
        whole[i] = std::min(whole[i], all);
        continue;
      }
      written.push_back(force);
      whole.push_back(all);
      awake.push_back(static_cast<double>(
          std::ranges::count_if(bodies.world().states(), &haptics::BodyState::awake)));
    }
  }
  BodyCosts costs;
  costs.bodies = static_cast<std::size_t>(share_of(awake, 0.5));
  costs.median = share_of(whole, 0.5);
  costs.p99 = share_of(whole, 0.99);
  costs.p99_until_force = share_of(written, 0.99);
  costs.steps = whole.size();
  costs.late = static_cast<std::size_t>(std::ranges::count_if(
      whole, [&](double seconds) { return seconds > pdu::to_seconds(period); }));
  return costs;
}

double measure_body_pace() {
  const SceneFile scene = pile_of_boxes();
  const haptics::EffectPlan plan(scene.scene);
  double least = std::numeric_limits<double>::infinity();
  for (int run = 0; run < 3; ++run) {
    const auto world = haptics::make_bodies(plan, scene.scene);
    nanoseconds now{0};
    const double begin = pdu::to_seconds(thread_cpu_time());
    for (int i = 0; i < 80; ++i) world->advance_to(now += std::chrono::milliseconds(1));
    least = std::min(least, (pdu::to_seconds(thread_cpu_time()) - begin) / world->work());
  }
  return least / kReference;
}

}  // namespace reckon::peer
