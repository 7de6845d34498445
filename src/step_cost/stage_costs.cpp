// SPDX-FileCopyrightText: 2026 The Reckon authors
// SPDX-License-Identifier: Apache-2.0
#include "reckon/peer/step_cost/stage_costs.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

#include "reckon/haptics/contact/static_contact.hpp"
#include "reckon/haptics/servo/servo_loop.hpp"
#include "reckon/pdu/seconds.hpp"
#include "reckon/peer/threads/cpu_time.hpp"

namespace reckon::peer {
namespace {

using Eigen::Vector3d;
using haptics::EffectPlan;
using haptics::PlannedObject;
using haptics::PlannedRegion;

constexpr double kPeriod = 0.001;  // [s]
constexpr double kDamping = 1.0;   // [N s/m], of the device
constexpr double kDepth = 0.001;   // [m]
constexpr int kSteps = 400, kRuns = 7;
constexpr std::size_t kPairs = 11;   // alternated runs
constexpr double kMostRun = 0.02;    // [s], after which a run ends with fewer steps
constexpr double kMostSearch = 0.5;  // [s], of measure_dearest_step()
constexpr int kBatch = 10;           // steps between two looks at the clock
constexpr int kFewSteps = 50;
constexpr double kApproach = 0.5;   // [m/s], on the way to an object
constexpr double kWorkspace = 1e6;  // [m], from the origin

/// A probe in a plan, without a servo.
class Probe {
 public:
  Probe(const EffectPlan& plan, double radius) : contact_(plan, kStiffest, radius) {}

  void begin(const Vector3d& at) {
    tool_.reset({at});
    contact_.reset(tool_);
  }
  [[nodiscard]] bool touches(const Vector3d& at) {
    const Vector3d dx = at - last_;
    last_ = at;
    tool_.move({at});
    tool_.set_velocity(dx / kPeriod);
    port_.settle(dx, kPeriod);
    contact_.settle(tool_, kPeriod, port_);
    haptics::PortLoad load;
    contact_.load(tool_, kPeriod, load);
    contact_.shown(port_.hold(load, kPeriod).extra);
    return contact_.result().in_contact;
  }

 private:
  static constexpr double kStiffest = 0.75 * 0.95 * 2.0 * kDamping / kPeriod;  // [N/m]
  haptics::StaticContact contact_;
  haptics::PointTool tool_;
  haptics::EnergyPort port_{kDamping};
  Vector3d last_ = Vector3d::Zero();
};

/// A handle that is where it is put.
class PlacedDevice final : public haptics::HapticDevice {
 public:
  [[nodiscard]] haptics::DeviceLimits limits() const noexcept override {
    haptics::DeviceLimits limits;
    limits.max_force = 10.0;
    limits.damping = kDamping;
    limits.workspace_min = Vector3d::Constant(-kWorkspace);
    limits.workspace_max = Vector3d::Constant(kWorkspace);
    return limits;
  }
  [[nodiscard]] haptics::DeviceSample read(std::chrono::nanoseconds /*now*/) noexcept override {
    haptics::DeviceSample sample;
    sample.position = place;
    sample.ok = true;
    return sample;
  }
  void write(const Vector3d& /*force*/, std::chrono::nanoseconds /*now*/) noexcept override {}

  Vector3d place = Vector3d::Zero();
};

/// A servo in a plan, whose handle moves around a place.
class Stroke {
 public:
  Stroke(EffectPlan plan, double radius)
      : servo_(device_, std::make_shared<const EffectPlan>(std::move(plan)), config_of(radius)) {}

  /// Moves the handle at a hand's speed.
  void go(const Vector3d& from, const Vector3d& to) {
    const int steps = 1 + static_cast<int>((to - from).norm() / (kApproach * kPeriod));
    for (int i = 0; i <= steps; ++i) step(from + (to - from) * i / steps);
  }
  /// CPU of a step [s], the least of some runs.
  double time_round(const Vector3d& place) {
    double least = std::numeric_limits<double>::infinity();
    for (int run = 0; run < kRuns; ++run) least = std::min(least, time_run(place, kSteps));
    return least;
  }
  /// CPU of a step [s], the mean of one run.
  double time_run(const Vector3d& place, int most_steps) {
    const double begin = pdu::to_seconds(thread_cpu_time());
    double spent = 0.0;
    int steps = 0;
    while (steps < most_steps && spent < kMostRun) {
      for (int i = 0; i < kBatch; ++i) go_round(place, steps++);
      spent = pdu::to_seconds(thread_cpu_time()) - begin;
    }
    return spent / steps;
  }

 private:
  static haptics::ServoConfig config_of(double radius) {
    haptics::ServoConfig config;
    config.contact_radius = radius;
    return config;
  }
  void go_round(const Vector3d& place, int i) {
    const double turn = 0.02 * i;
    step(place + 5e-4 * Vector3d(std::cos(turn), std::sin(turn), std::sin(1.3 * turn)));
  }
  void step(const Vector3d& place) {
    device_.place = place;
    servo_.step(now_ += std::chrono::milliseconds(1));
  }

  PlacedDevice device_;
  haptics::ServoLoop servo_;
  std::chrono::nanoseconds now_{1'000'000'000};
};

/// Where a handle enters an object.
struct Entry {
  Vector3d outside, inside;  // [m]
};

/// A place kDepth inside an object, and one outside it; none if none is found.
std::optional<Entry> entry_of(const PlannedObject& object, double radius) {
  const EffectPlan plan({object}, {});
  const bool bounded = object.bounds.sizes().allFinite() && object.bounds.sizes().norm() < 1e6;
  const Vector3d centre = bounded ? Vector3d(object.bounds.center()) : object.position;
  const double reach = radius + (bounded ? 0.55 * object.bounds.sizes().norm() : 0.05);
  for (int way = 0; way < 27; ++way) {
    const Vector3d from = Vector3d(way % 3 - 1, way / 3 % 3 - 1, 1 - way / 9).stableNormalized();
    if (from.isZero()) continue;
    Probe probe(plan, radius);
    const Vector3d outside = centre + reach * from;
    probe.begin(outside);
    if (probe.touches(outside)) continue;
    const double stride = std::max(reach / 500, 2e-5);
    for (double left = reach; left > -reach; left -= stride)
      if (probe.touches(centre + left * from))
        return Entry{outside, centre + (left - kDepth) * from};
  }
  return std::nullopt;
}

double time_plan(EffectPlan plan, const Entry& entry, double radius) {
  Stroke stroke(std::move(plan), radius);
  stroke.go(entry.outside, entry.inside);
  return stroke.time_round(entry.inside);
}

/// What the first of two plans adds to a step [s]: the median of alternated runs.
double time_addition(EffectPlan plan, EffectPlan without, const Entry& entry, double radius) {
  Stroke stroke(std::move(plan), radius), other(std::move(without), radius);
  stroke.go(entry.outside, entry.inside);
  other.go(entry.outside, entry.inside);
  std::array<double, kPairs> added;
  for (double& one : added)
    one = stroke.time_run(entry.inside, kSteps) - other.time_run(entry.inside, kSteps);
  std::ranges::nth_element(added, added.begin() + kPairs / 2);
  return std::max(added[kPairs / 2], 0.0);
}

/// An object's or region's effects, of which only some are declared.
template <class Types, class... Kept>
haptics::EffectDeclarations<Types> only(const haptics::EffectDeclarations<Types>& all) {
  haptics::EffectDeclarations<Types> some;
  haptics::for_each_effect<Types>([&]<class Effect>(std::type_identity<Effect>) {
    constexpr bool kKept = haptics::AlwaysThere<Effect> || (std::is_same_v<Effect, Kept> || ...);
    if constexpr (kKept) {
      if (const auto* values = all.template find<Effect>())
        some.template declare<Effect>() = *values;
    }
  });
  return some;
}

/// Adds the stages of one object, in the same form as EffectPlan::stages().
class Measurement {
 public:
  Measurement(const haptics::Scene& scene, const EffectPlan& plan, double radius)
      : scene_(scene), plan_(plan), radius_(radius) {
    costs_.empty = time_plan(EffectPlan(), {Vector3d::Zero(), Vector3d::Zero()}, radius_);
  }

  void add_object(std::size_t index) {
    const PlannedObject& planned = plan_.objects()[index];
    const haptics::DeclaredEffects& declared = scene_.objects[index].effects;
    const auto place = index < kMostMeasured ? entry_of(planned, radius_) : std::optional<Entry>();
    const auto plan_with = [&](const haptics::DeclaredEffects& effects) {
      PlannedObject copy = planned;
      copy.effects = haptics::PlannedEffects(effects);
      return EffectPlan({std::move(copy)}, {});
    };
    const auto bare = only<haptics::EffectTypes>(declared);
    const double contact = place ? time_plan(plan_with(bare), *place, radius_) : kUnknown;
    add(place ? std::max(contact - costs_.empty, 0.0) : kUnknown);
    const std::size_t patches = planned.patches ? planned.patches->patches.size() - 1 : 0;
    for (std::size_t i = 0; i < patches; ++i) add(kUnknown);
    double sum = contact;
    for (int turn = 0; turn < haptics::kTurns; ++turn) {
      haptics::for_each_effect([&]<class Effect>(std::type_identity<Effect>) {
        if (haptics::kHooks<Effect>.turn() != turn) return;
        if (planned.effects.find<Effect>() == nullptr) return;
        if (!place || haptics::AlwaysThere<Effect> || declared.find<Effect>() == nullptr)
          return add(kUnknown);
        const double cost = time_addition(plan_with(only<haptics::EffectTypes, Effect>(declared)),
                                          plan_with(bare), *place, radius_);
        add(cost);
        sum += cost;
      });
    }
    if (place && sum > costs_.dearest) {
      costs_.dearest = sum;
      costs_.dearest_object = planned.name;
    }
  }

  void add_region(std::size_t index) {
    const PlannedRegion& planned = plan_.regions()[index];
    const haptics::DeclaredRegionEffects& declared = scene_.regions[index].effects;
    const auto plan_with = [&](const haptics::DeclaredRegionEffects& effects) {
      PlannedRegion copy = planned;
      copy.effects = haptics::PlannedRegionEffects(effects);
      return EffectPlan({}, {std::move(copy)});
    };
    const Entry middle{planned.position, planned.position};
    add(time_addition(plan_with({}), EffectPlan(), middle, radius_));
    regions_ += costs_.stages.back();
    haptics::for_each_region_effect([&]<class Effect>(std::type_identity<Effect>) {
      if (declared.find<Effect>() == nullptr) return;
      add(time_addition(plan_with(only<haptics::RegionTypes, Effect>(declared)), plan_with({}),
                        middle, radius_));
      regions_ += costs_.stages.back();
    });
  }

  [[nodiscard]] StageCosts costs() const {
    StageCosts costs = costs_;
    costs.dearest = std::max(costs.dearest, costs.empty) + regions_;
    return costs;
  }

 private:
  static constexpr double kUnknown = -1.0;
  void add(double seconds) { costs_.stages.push_back(seconds); }

  const haptics::Scene& scene_;
  const EffectPlan& plan_;
  double radius_;
  StageCosts costs_;
  double regions_ = 0.0;
};

}  // namespace

StageCosts measure_stages(const haptics::Scene& scene, const EffectPlan& plan, double radius) {
  Measurement measurement(scene, plan, radius);
  for (std::size_t i = 0; i < plan.objects().size(); ++i) measurement.add_object(i);
  for (std::size_t i = 0; i < plan.regions().size(); ++i) measurement.add_region(i);
  return measurement.costs();
}

DearestStep measure_dearest_step(const haptics::Scene& scene, const EffectPlan& plan, double radius,
                                 double enough) {
  std::vector<PlannedRegion> regions = plan.regions();
  for (std::size_t i = 0; i < regions.size(); ++i)
    regions[i].effects = haptics::PlannedRegionEffects(scene.regions[i].effects);
  DearestStep dearest;
  const double begin = pdu::to_seconds(thread_cpu_time());
  for (std::size_t i = 0; i < plan.objects().size(); ++i) {
    if (pdu::to_seconds(thread_cpu_time()) - begin > kMostSearch) break;
    PlannedObject object = plan.objects()[i];
    const bool bounded = std::holds_alternative<haptics::HalfSpace>(object.shape) ||
                         std::holds_alternative<haptics::Ball>(object.shape) ||
                         std::holds_alternative<haptics::Block>(object.shape);
    const auto place = bounded ? std::optional<Entry>() : entry_of(object, radius);
    if (!place) continue;
    object.effects = haptics::PlannedEffects(scene.objects[i].effects);
    const std::string name = object.name;
    Stroke stroke(EffectPlan({std::move(object)}, regions), radius);
    stroke.go(place->outside, place->inside);
    double seconds = stroke.time_run(place->inside, kFewSteps);
    if (seconds >= enough) seconds = stroke.time_round(place->inside);
    if (seconds > dearest.seconds) dearest = {seconds, name};
  }
  return dearest;
}

}  // namespace reckon::peer
